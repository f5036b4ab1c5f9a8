"""What changed since last time, put into a folder: all rows of a participation replace all that were there of it.

The new files are written beside the old ones and take their places when all are ready; the manifest is the last. A
folder that was interrupted in between has the old cursor, so that the next time brings the same news again.
"""

from __future__ import annotations

import hashlib
import json
from itertools import chain
from typing import TYPE_CHECKING, Any

import pyarrow as pa
import pyarrow.compute as pc
from pyarrow import parquet

from .export import MANIFEST

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from .export import Export


def merged(known: Export | None, news: Export, folder: Path, place: Path) -> None:
    """Write what is known and what is new into a folder, by way of another one on the same disk."""
    gone = news.arrow("participations")["participation"].combine_chunks()
    if known is not None and not len(gone):
        return
    files = []
    for file in news.manifest["files"]:
        path = place / file["path"]
        for beginning in (place, folder):
            (beginning / file["path"]).parent.mkdir(parents=True, exist_ok=True)
        if "table" in file:
            # A folder that an earlier release began may lack a table.
            old = folder / file["path"] if known is not None and file["table"] in known.tables else None
            rows = _merge_table(old, news.arrow(file["table"]), gone, path)
            files.append({"path": file["path"], "table": file["table"], "rows": rows, **_told(path)})
        else:
            path.write_bytes(news.read(file["path"]))
            files.append({"path": file["path"], **_told(path)})
    manifest = {**news.manifest, "since": None, "files": files}
    manifest["participations"] = next(file["rows"] for file in files if file.get("table") == "participations")
    (place / MANIFEST).write_text(json.dumps(manifest, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    for name in (*(file["path"] for file in files), MANIFEST):
        (place / name).replace(folder / name)


def _merge_table(old: Path | None, new: pa.Table, gone: pa.Array, path: Path) -> int:
    schema = new.schema
    if old is not None:
        schema = pa.unify_schemas([schema, parquet.read_schema(old)])
    rows = 0
    with parquet.ParquetWriter(path, schema, compression="zstd") as writer:
        for batch in chain(_kept(old, gone), new.to_batches()):
            whole = _widened(batch, schema)
            writer.write_batch(whole)
            rows += whole.num_rows
    return rows


def _kept(old: Path | None, gone: pa.Array) -> Iterator[pa.RecordBatch]:
    if old is None:
        return
    with parquet.ParquetFile(old) as file:
        for batch in file.iter_batches():
            yield batch.filter(pc.invert(pc.is_in(batch["participation"], gone)))


def _widened(batch: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """Return rows with the columns that another face model brought, empty."""
    there = set(batch.schema.names)
    columns = [batch[field.name] if field.name in there else pa.nulls(batch.num_rows, field.type) for field in schema]
    return pa.record_batch(columns, schema=schema)


def _told(path: Path) -> dict[str, Any]:
    with path.open("rb") as file:
        return {"bytes": path.stat().st_size, "sha256": hashlib.file_digest(file, "sha256").hexdigest()}

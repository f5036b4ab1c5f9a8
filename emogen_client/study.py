"""A study on a server: its tables as frames, and a copy of them that is kept up to date."""

from __future__ import annotations

import hashlib
import io
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import httpx2
from pyarrow import parquet

from .errors import IncompleteError, RefusedError
from .export import MANIFEST, Export
from .frames import Frames, framed
from .merging import merged

if TYPE_CHECKING:
    from os import PathLike
    from typing import IO

CHUNK = 2**20
BROKE_OFF = (httpx2.RemoteProtocolError, httpx2.ReadError, httpx2.ReadTimeout)
"""What is raised where the other side closes too early, where the connection is reset, and where nothing comes."""


class Study:
    """A study, seen through a token of scope `export`.

    Args:
        address: of the server, as in https://study.example.org.
        study: its id, as in its address on the admin pages.
        token: as the admin pages gave it, emg_...
        client: what sends the requests, if not a client of its own.
    """

    def __init__(self, address: str, study: str, token: str, *, client: httpx2.Client | None = None) -> None:
        self._base = f"{address.rstrip('/')}/api/v1/studies/{study}"
        self._headers = {"Authorization": f"Bearer {token}"}
        self._client = client or httpx2.Client(timeout=60, follow_redirects=False)

    def table(self, name: str, frames: Frames = "pandas", **filters: str) -> Any:
        """Return a table as a frame, as it is now: pandas, polars or arrow.

        Args:
            name: of the table.
            frames: the library of the frame.
            filters: condition, kind, arrived_from, arrived_before, block, emotion.

        Raises:
            RefusedError: the server does not give it.
            IncompleteError: the download was interrupted.
            FramesMissingError: the library is not installed.
        """
        file = io.BytesIO()
        self._download("export", {"table": name, "format": "parquet", **filters}, file)
        return framed(parquet.read_table(file), frames)

    def download(self, path: str | PathLike[str], form: str = "parquet", **asked: str) -> Export:
        """Load everything into one zip and return it; the file is there as a whole or not at all.

        Args:
            path: of the zip.
            form: parquet, csv, jsonl or psych-ds.
            asked: filters, and `since`, a cursor.

        Raises:
            RefusedError: the server does not give it.
            IncompleteError: the download was interrupted.
        """
        target = Path(path)
        with tempfile.TemporaryDirectory(dir=target.parent) as folder:
            part = Path(folder) / "part.zip"
            with part.open("w+b") as file:
                self._download("package", {"format": form, **asked}, file)
            Export(part).verify()
            part.replace(target)
        return Export(target)

    def update(self, folder: str | PathLike[str], **filters: str) -> Export:
        """Bring a folder up to date and return it: what came or changed since last time, or everything.

        All rows of a participation that changed replace all that the folder had of it, in every table. The filters
        of the first time stay.

        Raises:
            RefusedError: the server does not give it; where it says that the cursor cannot be used, delete the folder.
            IncompleteError: the download was interrupted; the folder is as it was.
        """
        target = Path(folder)
        target.mkdir(parents=True, exist_ok=True)
        known = Export(target) if (target / MANIFEST).exists() else None
        asked = filters if known is None else {**known.manifest["filters"], "since": known.cursor}
        with tempfile.TemporaryDirectory(dir=target) as place:
            news = self.download(Path(place) / "news.zip", "parquet", **asked)
            merged(known, news, target, Path(place))
        return Export(target)

    def dictionary(self) -> dict[str, Any]:
        """Return what every table and column means."""
        return cast("dict[str, Any]", self._get("dictionary")["tables"])

    def configurations(self) -> list[dict[str, Any]]:
        """Return every version of the study."""
        return cast("list[dict[str, Any]]", self._get("configurations")["versions"])

    def _get(self, path: str) -> dict[str, Any]:
        reply = self._client.get(f"{self._base}/{path}", headers=self._headers)
        _check(reply)
        return cast("dict[str, Any]", reply.json())

    def _download(self, path: str, asked: dict[str, str], file: IO[bytes]) -> None:
        """Write a download into a file and compare it with its receipt."""
        told, size = hashlib.sha256(), 0
        try:
            with self._client.stream("GET", f"{self._base}/{path}", params=asked, headers=self._headers) as reply:
                _check(reply)
                for chunk in reply.iter_bytes(CHUNK):
                    told.update(chunk)
                    size += file.write(chunk)
                receipt = reply.headers["emogen-receipt"]
        except BROKE_OFF as error:
            raise IncompleteError(path, "a whole download", f"{size} bytes") from error
        self._compare(path, receipt, size, told.hexdigest())
        file.seek(0)

    def _compare(self, path: str, receipt: str, size: int, sha256: str) -> None:
        try:
            sent = self._get(f"receipts/{receipt}")
        except RefusedError as error:
            if error.status != 404:
                raise
            raise IncompleteError(path, "a download that was sent to its end", f"{size} bytes") from error
        if (sent["bytes"], sent["sha256"]) != (size, sha256):
            raise IncompleteError(path, f"{sent['bytes']} bytes, SHA-256 {sent['sha256']}", f"{size}, {sha256}")


def _check(reply: httpx2.Response) -> None:
    if reply.status_code == 200:
        return
    reply.read()
    try:
        error = reply.json()["error"]
    except (ValueError, KeyError, TypeError):
        error = {"code": "error", "message": f"The server answered {reply.status_code}, not as Emogen does."}
    details = [f"{name} {error[name]}" for name in ("expected", "got") if error.get(name)]
    told = f" ({', '.join(details)})" if details else ""
    raise RefusedError(reply.status_code, error["code"], error["message"] + told)

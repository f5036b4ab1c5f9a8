"""The files of a report: written beside the earlier ones, they take their places only when all are there.

The last one is the page: whatever fails before that, an earlier report stays whole.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


def replace(folder: Path, files: Mapping[str, str | bytes], stale: Iterable[str] = ()) -> None:
    """Put files into a folder, the last one at the end, once all are written in a folder of their own on its disk.

    Args:
        folder: where they go; made if need be.
        files: texts, or bytes of pictures, by name.
        stale: names of files of an earlier report that this one does not have.

    Raises:
        OSError: they cannot be written; an earlier report is as it was.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix=".new-", dir=folder) as new:
        for name, content in files.items():
            (Path(new) / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        *numbers, last = files
        for name in numbers:
            (Path(new) / name).replace(folder / name)
        for name in stale:
            (folder / name).unlink(missing_ok=True)
        (Path(new) / last).replace(folder / last)

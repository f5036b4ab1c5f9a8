"""Which release of Emogen this is."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def release() -> str:
    """Return the version of this distribution."""
    try:
        return version("emogen-study")
    except PackageNotFoundError:
        return "0"

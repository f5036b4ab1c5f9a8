"""Arrow tables as frames of the library that somebody works with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

from .errors import FramesMissingError

if TYPE_CHECKING:
    from collections.abc import Callable

    import pandas as pd
    import polars as pl
    import pyarrow as pa

Frames = Literal["pandas", "polars", "arrow"]


@overload
def framed(table: pa.Table, frames: Literal["pandas"]) -> pd.DataFrame: ...
@overload
def framed(table: pa.Table, frames: Literal["polars"]) -> pl.DataFrame: ...
@overload
def framed(table: pa.Table, frames: Frames) -> Any: ...
def framed(table: pa.Table, frames: Frames) -> Any:
    """Return a table as a frame.

    Raises:
        FramesMissingError: the library is not installed.
    """
    try:
        return _MAKERS[frames](table)
    except ImportError as error:
        raise FramesMissingError(frames) from error


def _pandas(table: pa.Table) -> pd.DataFrame:
    import pandas  # noqa: F401, PLC0415 - an extra; Arrow would name itself as what is missing

    frame: pd.DataFrame = table.to_pandas()
    return frame


def _polars(table: pa.Table) -> Any:
    import polars  # noqa: PLC0415 - an extra

    return polars.from_arrow(table)


_MAKERS: dict[str, Callable[[Any], Any]] = {"pandas": _pandas, "polars": _polars, "arrow": lambda table: table}

"""Data of Emogen studies in Python: from a server, kept up to date in a folder, or from a file that was downloaded.

>>> study = Study("https://study.example.org", "demo", token)
>>> faces = study.table("faces")
>>> trials = study.update("data").table("trials", frames="polars")
>>> Export("demo-parquet.zip").table("faces")
"""

from .errors import EmogenClientError, FramesMissingError, IncompleteError, RefusedError, UnreadableError
from .export import Export
from .study import Study

__all__ = [
    "EmogenClientError", "Export", "FramesMissingError", "IncompleteError", "RefusedError", "Study", "UnreadableError",
]  # fmt: skip

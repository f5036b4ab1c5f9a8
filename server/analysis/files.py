"""The files of an analysis: the page, a CSV file a table, the text for a paper, where all comes from as JSON."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..reporting.files import replace
from ..reporting.page import template
from ..reporting.pictures import scale
from ..services.spreadsheet import guarded

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from .methods import Facts
    from .section import Section, Sheet, Value

PAGE, METHODS, ABOUT = "report.html", "methods.txt", "about.json"


def write(sections: Sequence[Section], text: Sequence[str], facts: Facts, folder: Path, *, faces: bool) -> None:
    """Write an analysis into a folder.

    Args:
        sections: its parts.
        text: the paragraphs for a paper.
        facts: where the numbers come from.
        folder: where it goes; made if need be.
        faces: whether this machine could draw.

    Raises:
        OSError: the files cannot be written; an earlier analysis is as it was.
    """
    sheets = [sheet for section in sections for sheet in (section.sheet, *section.files)]
    files = {f"{sheet.name}.csv": comma_separated(sheet) for sheet in sheets}
    files[METHODS] = "\n\n".join(text) + "\n"
    files[ABOUT] = json.dumps(plain(sections, facts), indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    files[PAGE] = page(sections, text, facts, faces=faces)
    replace(folder, files, _stale(folder, files))


def page(sections: Sequence[Section], text: Sequence[str], facts: Facts, *, faces: bool) -> str:
    """Return the report as HTML that fetches nothing."""
    return template("analysis/report.html").render(
        sections=sections, methods=text, facts=facts, scale=scale(), faces=faces
    )


def comma_separated(sheet: Sheet) -> str:
    """Return a table as CSV; gaps are empty, numbers as they are, booleans and guarded texts as in exports."""
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow([column.name for column in sheet.columns])
    for row in sheet.rows:
        writer.writerow(map(_cell, row))
    return text.getvalue()


def _cell(value: Value) -> Value:
    if isinstance(value, bool):
        return str(value).lower()
    return guarded(value) if isinstance(value, str) else value


def plain(sections: Sequence[Section], facts: Facts) -> dict[str, Any]:
    """Return facts, and of every part its numbers and what cannot be said, as plain data."""
    told = [
        {
            "name": section.name,
            "title": section.title,
            "lacks": section.lacks,
            "files": [f"{sheet.name}.csv" for sheet in (section.sheet, *section.files)],
            "columns": {column.name: column.help for column in section.sheet.columns},
            "rows": section.sheet.rows,
        }
        for section in sections
    ]
    return {**asdict(facts), "sections": told}


def _stale(folder: Path, files: dict[str, str]) -> set[str]:
    """Return the tables of an earlier analysis, as its own list has them, that this one does not have."""
    try:
        earlier = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
        named = {name for section in earlier["sections"] for name in section["files"]}
    except (OSError, ValueError, KeyError, TypeError):
        return set()
    return {name for name in named if name.endswith(".csv") and "/" not in name} - set(files)

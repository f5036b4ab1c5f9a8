"""The files of a report: the page, every table as CSV and all in one Markdown file, where they come from as JSON."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..reporting.files import replace
from .numbers import cells, compared, filled
from .report import page

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from emogen_core.simulation.evaluation.table import Table

    from .faces import Studio
    from .report import Facts

PAGE = "report.html"
ABOUT = "about.json"
MARKDOWN = "tables.md"


def write(
    tables: Sequence[Table], facts: Facts, folder: Path, studio: Studio | None = None, known: Iterable[str] = ()
) -> None:
    """Write the report into a folder.

    Args:
        tables: what it is about.
        facts: where the numbers come from.
        folder: where it goes; made if need be.
        studio: what draws faces; the page says so where there is none.
        known: names of tables whose files go when this report does not have them: an earlier one made them.

    Raises:
        OSError: the files cannot be written; an earlier report is as it was.
    """
    files = {f"{table.name}.csv": comma_separated(table) for table in tables}
    stale = {f"{name}.csv" for name in known} - set(files)
    files |= {ABOUT: _about(tables, facts), MARKDOWN: markdown(tables, facts), PAGE: page(tables, facts, studio)}
    replace(folder, files, stale)


def comma_separated(table: Table) -> str:
    """Return a table as CSV: a label, every column, and those for which the paper has a number; gaps are empty."""
    names, there = [column.name for column in table.columns], compared(table)
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(["label", *names, *(f"{names[at]} (paper)" for at in there)])
    for row in table.rows:
        paper = filled(row.paper, table)
        writer.writerow([row.label, *filled(row.ours, table), *(paper[at] for at in there)])
    return text.getvalue()


def markdown(tables: Sequence[Table], facts: Facts) -> str:
    """Return all tables as one Markdown page, for documents: our numbers, the paper's in brackets."""
    head = f"# Tables\n\nFrom `{facts.command}`, Emogen {facts.version}, face model `{facts.rig_hash}`.\n"
    return "\n".join([head, *(_section(table) for table in tables)])


def plain(table: Table) -> dict[str, Any]:
    """Return a table as plain data, for JSON."""
    return {
        "agreement": table.agreement,
        "verdict": table.verdict,
        "findings": [asdict(finding) for finding in table.findings],
        "notes": table.notes,
        "columns": [column.name for column in table.columns],
        "rows": [asdict(row) for row in table.rows],
    }


def _section(table: Table) -> str:
    said = [f"- {one.says} **{'Holds' if one.holds else 'Does not hold'}:** {one.here}" for one in table.findings]
    rows = [
        f"| {row.label} | {' | '.join(f'{ours} ({paper})' if paper else ours for ours, paper in cells(table, row))} |"
        for row in table.rows
    ]
    names = " | ".join(column.name for column in table.columns)
    lines = [
        f"## {table.title}", "", table.verdict, "", *said, *([""] if said else []),
        f"| | {names} |", f"| --- |{' --- |' * len(table.columns)}", *rows, "",
        *(f"- {note}" for note in table.notes),
    ]  # fmt: skip
    return "\n".join([*lines, ""])


def _about(tables: Sequence[Table], facts: Facts) -> str:
    told: dict[str, Any] = asdict(facts)
    told["tables"] = [
        {
            "name": table.name,
            "file": f"{table.name}.csv",
            "title": table.title,
            "source": table.source,
            "agreement": table.agreement,
            "verdict": table.verdict,
            "columns": {column.name: column.help for column in table.columns},
        }
        for table in tables
    ]
    return json.dumps(told, indent=2, ensure_ascii=False, allow_nan=False) + "\n"

"""An export as a Psych-DS dataset (psych-ds.github.io): names of files, and what describes them.

The description of the dataset has every name once, with what it means in each table. Beside each table a sidecar
describes its columns alone, which a reader prefers.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

from .columns import TABLES
from .dictionary import header

if TYPE_CHECKING:
    from .column import Column
    from .selection import Selection

README = """# {title}

Data of the study {study}, as exported by Emogen. People picked among ten rendered faces what came closest to an
expression that they had in mind; a search made the next ten of it (`algorithm` in participations).

- `data/`: one CSV file a table, and beside it a JSON file that describes its columns. Rows belong together by the
  columns `participation` and `trial`.
- `documentation/`: what every column means, as CSV (codebook.csv) and as JSON (dictionary.json).
- `materials/`: every version of the study's configuration, as it was frozen (configurations.json), and in heads/ the
  heads that it brought along, as they were fitted.
- `manifest.json`: rows, bytes and SHA-256 of every file.

The columns that tell the rows of a table apart:

{keys}

An empty cell means that there is no value. A text that a spreadsheet would take for a formula begins with `'`.
"""
CHANGES = """# Changes

- Exported. `manifest.json` says when, with which filters, and up to where.
"""
IGNORE = """.psychds-ignore
manifest.json
"""
"""What the specification does not know; the list itself has to be in it."""
TECHNIQUE = (
    "Interactive evolution: people choose among ten rendered faces, a search (a genetic algorithm, or one that learns"
    " from all choices) makes the next ten, and the last best face is the measurement."
)
_SCHEMA_ORG = {"@context": "https://schema.org/", "@type": "Dataset"}


def data_file(study_id: str, table: str, ending: str = "csv") -> str:
    """Return the path of a table by the names that Psych-DS gives, or with `json` that of its sidecar."""
    return f"data/study-{_plain(study_id)}_description-{table}_data.{ending}"


def documents_of(chosen: Selection, documents: dict[str, str]) -> dict[str, str]:
    """Return what stands around the data: what describes it, and the documents of every export in their folders."""
    told = {"title": chosen.title, "study": chosen.wanted.study_id, "keys": _keys()}
    return {
        "dataset_description.json": _json(description(chosen)),
        "README.md": README.format(**told),
        "CHANGES.md": CHANGES,
        ".psychds-ignore": IGNORE,
        "materials/configurations.json": documents["configurations.json"],
        "documentation/dictionary.json": documents["dictionary.json"],
        "documentation/codebook.csv": documents["codebook.csv"],
        "analysis/README.md": "What is made of the data goes here.\n",
        "results/README.md": "What comes out of the analysis goes here.\n",
        "data/file_metadata.json": _json({**_SCHEMA_ORG, "measurementTechnique": TECHNIQUE}),
        **{data_file(told["study"], table, "json"): _json(sidecar(chosen, table)) for table in TABLES},
    }


def description(chosen: Selection) -> dict[str, Any]:
    """Return dataset_description.json: a Dataset of schema.org with every column of every file."""
    return {
        **_SCHEMA_ORG,
        "name": chosen.title,
        "description": f"Facial expressions that people had in mind, found by choosing among rendered faces: the study"
        f" {chosen.wanted.study_id}, one file a table ({', '.join(TABLES)}).",
        "identifier": chosen.wanted.study_id,
        "keywords": ["facial expression", "emotion", "interactive evolution", "psychology"],
        "variableMeasured": [_variable(name, found) for name, found in _variables(chosen).items()],
    }


def sidecar(chosen: Selection, table: str) -> dict[str, Any]:
    """Return what describes one table: fields that stand for those of the dataset's description."""
    columns = header(table, chosen.rigs)
    return {
        **_SCHEMA_ORG,
        "name": f"{chosen.title}: {table}",
        "description": TABLES[table].about,
        "variableMeasured": [_variable(column.name, {table: column}) for column in columns],
    }


def _variables(chosen: Selection) -> dict[str, dict[str, Column]]:
    found: dict[str, dict[str, Column]] = {}
    for table in TABLES:
        for column in header(table, chosen.rigs):
            found.setdefault(column.name, {})[table] = column
    return found


def _variable(name: str, tables: dict[str, Column]) -> dict[str, Any]:
    first = next(iter(tables.values()))
    told: dict[str, Any] = {"@type": "PropertyValue", "name": name, "description": _described(tables)}
    told |= {"unitText": first.unit} if first.unit else {}
    told |= {"minValue": first.least} if first.least is not None else {}
    return told | ({"maxValue": first.most} if first.most is not None else {})


def _described(tables: dict[str, Column]) -> str:
    """Return what a name means; where tables differ in it, for each of them."""
    meant: dict[str, list[str]] = {}
    for table, column in tables.items():
        values = f" Values: {', '.join(column.allowed)}." if column.allowed else ""
        meant.setdefault(column.help + values, []).append(table)
    if len(meant) == 1:
        return next(iter(meant))
    return " ".join(f"In {', '.join(names)}: {text}" for text, names in meant.items())


def _keys() -> str:
    """Return the key of every table, as a list."""
    return "\n".join(f"- {table.name}: {', '.join(f'`{name}`' for name in table.key)}" for table in TABLES.values())


def _json(content: dict[str, Any]) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _plain(study_id: str) -> str:
    """Return a value of a keyword: letters and digits only."""
    return re.sub(r"[^a-zA-Z0-9]", "", study_id) or "emogen"

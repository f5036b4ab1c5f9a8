"""What the published schema of Psych-DS asks of a dataset, as its official validator reads it.

Every rule is read from the schema: which files there must be and where, which files it knows, how data files are called
and laid out, which fields metadata must have after inheritance, and that files and metadata name the same columns.
Codes are the schema's own. The validator was in no package registry; what it does beyond the schema was read in its
source (github.com/psych-ds/psychds-validator, 1.5): folders that it passes over, files that no rule knows, and sidecars
that are not there. It looks every property up in schema.org as well; here those that an export uses are listed below.
"""

import csv
import json
import re
from collections import ChainMap
from fnmatch import fnmatch
from pathlib import Path

SCHEMA = json.loads((Path(__file__).parent / "schema.json").read_text(encoding="utf-8"))
FIELDS = SCHEMA["rules"]["compiled_metadata"]["CompiledMetadata"]["fields"]
KEYWORDS = set(SCHEMA["meta"]["context"]["context"]["properties"]["keywords"]["properties"])
CODES = {name: rule["code"] for name, rule in SCHEMA["rules"]["errors"].items()}
FILES = SCHEMA["rules"]["files"]
RULES = {**FILES["tabular_data"]["data"], **FILES["common"]["core"], **FILES["metadata"]}
DATA = RULES["Datafile"]
UNSEEN = ("sourcedata", "code", "stimuli", "materials", "results", "products", "analysis", "documentation", "log")
"""Folders whose files the validator passes over."""
SCHEMA_ORG = {
    "Dataset": {*FIELDS, "measurementTechnique"},
    "PropertyValue": {"name", "description", "unitText", "minValue", "maxValue"},
}
"""Types and their properties, as far as an export uses them."""
RANGES = {"variableMeasured": {"PropertyValue"}}
CONTEXTS = {"https://schema.org", "https://schema.org/", "http://schema.org", "http://schema.org/"}


def problems(folder):
    """The codes of everything that is wrong with the dataset in a folder, errors and warnings, with their places."""
    found = [*_core(folder), *_json(folder)]
    if found:
        return found
    return [*_files(folder), *_data(folder)]


def _core(folder):
    for name, rule in RULES.items():
        if "path" in rule:
            place = folder / rule["path"].lstrip("/")
            there = place.is_dir() if rule.get("directory") else place.is_file()
        else:
            there = any(_matches(rule, path) for path in _seen(folder))
        if not there:
            yield rule["code"], name


def _seen(folder):
    """Paths from the root of all files that the validator looks at."""
    ignored = folder / RULES["psychds-ignore"]["path"].lstrip("/")
    lines = ignored.read_text(encoding="utf-8").split() if ignored.is_file() else []
    for path in sorted(one.relative_to(folder) for one in folder.rglob("*") if one.is_file()):
        if path.parts[0] not in UNSEEN and not any(fnmatch(str(path), line) for line in lines):
            yield path


def _matches(rule, path):
    if "arbitraryNesting" not in rule:
        return False
    base = rule["baseDir"].strip("/")
    nested = path.parts[0] == base if rule["arbitraryNesting"] else path.parent == Path(base)
    called = _suffix(path) == rule["suffix"] if "suffix" in rule else path.name.startswith(rule["stem"])
    return nested and called and path.suffix in rule["extensions"]


def _suffix(path):
    return path.name.rpartition("_")[2].partition(".")[0]


def _files(folder):
    for path in _seen(folder):
        if not (folder / path).stat().st_size:
            yield CODES["FileEmpty"], path.name
        if not any(_matches(rule, path) for rule in RULES.values()):
            misplaced = path.name == "dataset_description.json"
            yield CODES["WrongMetadataLocation" if misplaced else "FileNotChecked"], path.name


def _json(folder):
    for path in folder.rglob("*.json"):
        try:
            json.loads(path.read_bytes().decode("utf-8"))
        except UnicodeDecodeError:
            yield CODES["JsonEncodingError"], path.name
        except ValueError:
            yield CODES["InvalidJsonFormatting"], path.name


def _data(folder):
    measured, columns = set(), set()
    for path in (one for one in _seen(folder) if one.parts[0] == DATA["baseDir"] and one.suffix != ".json"):
        yield from _name(path.name)
        header, wrong = _table(folder / path)
        metadata = _compiled(folder, path)
        known = {one.get("name") for one in metadata.get("variableMeasured", ())}
        yield from wrong
        yield from _described(metadata)
        yield from ((CODES["CsvColumnMissingFromMetadata"], name) for name in header if name not in known)
        measured |= known
        columns.update(header)
    yield from ((CODES["VariableMissingFromCsvColumns"], name) for name in measured - columns)


def _compiled(folder, path):
    """What a data file inherits from the folders above it, and what its sidecar says instead."""
    above = [folder / parent / "file_metadata.json" for parent in path.parents]
    places = [(folder / path).with_suffix(".json"), *above, folder / "dataset_description.json"]
    return ChainMap(*(json.loads(place.read_text(encoding="utf-8")) for place in places if place.is_file()))


def _described(metadata):
    if metadata.get("@context") not in CONTEXTS:
        yield CODES["InvalidJsonldFormatting"], "@context"
    if "@type" not in metadata:
        yield CODES["MissingDatasetType"], "@type"
    elif metadata["@type"] != "Dataset":
        yield CODES["IncorrectDatasetType"], metadata["@type"]
    else:
        yield from _properties(metadata)
    for field, level in FIELDS.items():
        if level == "required" and not metadata.get(field):
            yield CODES["JsonKeyRequired"], field


def _properties(node):
    for name, value in node.items():
        if name.startswith("@"):
            continue
        if ":" in name:
            yield CODES["UnknownNamespace"], name
        elif name not in SCHEMA_ORG.get(node["@type"], ()):
            yield CODES["InvalidSchemaorgProperty"], name
        else:
            for one in value if isinstance(value, list) else [value]:
                yield from _object(name, one)


def _object(name, value):
    if not isinstance(value, dict):
        return
    if "@type" not in value:
        yield CODES["ObjectTypeMissing"], name
    elif value["@type"] not in RANGES.get(name, ()):
        yield CODES["InvalidObjectType"], value["@type"]
    else:
        yield from _properties(value)


def _name(name):
    if not name.endswith(tuple(DATA["extensions"])):
        yield CODES["ExtensionMismatch"], name
    elif not re.fullmatch(DATA["fileRegex"], name):
        yield CODES["FilenameKeywordFormattingError"], name
    elif not KEYWORDS.issuperset(part.partition("-")[0] for part in name.split("_")[:-1]):
        yield CODES["FilenameUnofficialKeywordWarning"], name


def _table(path):
    try:
        text = path.read_bytes().decode("utf-8")
        rows = list(csv.reader(text.splitlines(keepends=True), strict=True))
    except (UnicodeDecodeError, csv.Error):
        return [], [(CODES["CSVFormattingError"], path.name)]
    if not rows or not any(rows[0]):
        return [], [(CODES["CSVHeaderMissing"], path.name)]
    header, *body = rows
    wrong = [(CODES["CSVHeaderRepeated"], path.name)] if len(set(header)) < len(header) else []
    wrong += [(CODES["CSVHeaderLengthMismatch"], path.name)] if any(len(row) != len(header) for row in body) else []
    if "row_id" in header:
        ids = [row[header.index("row_id")] for row in body]
        wrong += [(CODES["RowidValuesNotUnique"], path.name)] if len(set(ids)) < len(ids) else []
    return header, wrong

"""A real export is a dataset by the published rules of Psych-DS, and the checker that says so notices what is wrong."""

import json
import shutil

import pytest

from server.services.reports.tables.columns import TABLES
from server.services.reports.tables.package import write_folder
from server.services.reports.tables.psych_ds import data_file
from tests.psych_ds.check import CODES, FIELDS, KEYWORDS, RULES, problems

ROOT = "dataset_description.json"
NOT_TOLD = {
    "JSON_INVALID": "of a file that is no JSON INVALID_JSON_FORMATTING tells",
    "FILE_NOT_READ": "the files were just written",
    "MISSING_REQUIRED_ELEMENT": "every element that can be missing has a code of its own",
    "FILENAME_UNOFFICIAL_KEYWORD_ERROR": "the schema allows keywords of one's own, with a warning",
    "JSON_KEY_RECOMMENDED": "the validator passes over it; the test below names what is left to the experimenter",
}


@pytest.fixture
def dataset(house, people, tmp_path):
    list(write_folder(house.exports.package(people[0].id, "psych-ds").entries(), tmp_path / "whole"))
    return tmp_path / "whole"


@pytest.fixture
def of(people):
    return lambda table, ending="csv": data_file(people[0].id, table, ending)


def edited(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def test_a_real_export_conforms(dataset):
    assert problems(dataset) == []
    assert len(KEYWORDS) == 9


def test_only_what_nobody_but_the_experimenter_knows_is_left_to_fill_in(dataset):
    told = read(dataset / ROOT)
    left = {field for field, level in FIELDS.items() if level == "recommended" and field not in told}
    assert left == {"author", "citation", "license", "funder", "url", "privacyPolicy"}


def test_every_variable_says_what_it_means(dataset, of):
    meant = {one["name"]: one for one in read(dataset / ROOT)["variableMeasured"]}
    assert meant["onset_ms"]["unitText"] == "ms"
    assert (meant["slot"]["minValue"], meant["slot"]["maxValue"]) == (1, 10)
    assert "In trials, " not in meant["participation"]["description"]
    assert "In faces: Whether it was chosen" in meant["selected"]["description"]
    assert "elite-mean" in meant["origin"]["description"]
    own = {one["name"]: one for one in read(dataset / of("choices", "json"))["variableMeasured"]}
    assert own["selected"]["description"] == "The chosen faces, in the order of choosing."


def test_a_sidecar_has_the_columns_of_its_table_and_the_readme_its_key(dataset, of):
    readme = (dataset / "README.md").read_text(encoding="utf-8")
    for table in TABLES.values():
        header = (dataset / of(table.name)).read_text(encoding="utf-8").splitlines()[0].split(",")
        assert [one["name"] for one in read(dataset / of(table.name, "json"))["variableMeasured"]] == header
        assert f"- {table.name}: {', '.join(f'`{name}`' for name in table.key)}\n" in readme


def broken(of):
    """What is done to a dataset, as functions of its folder, by the code that has to be told."""
    table, side = of("ratings"), of("ratings", "json")
    yield "CSV_COLUMN_MISSING_FROM_METADATA", lambda at: edited(at / side, '"name": "value"', '"name": "worth"')
    yield "CSV_COLUMN_MISSING_FROM_METADATA", lambda at: edited(at / table, "value", "worth")
    yield "VARIABLE_MISSING_FROM_CSV_COLUMNS", lambda at: edited(at / side, '"name": "value"', '"name": "worth"')
    yield "INCORRECT_DATASET_TYPE", lambda at: edited(at / side, '"Dataset"', '"Book"')
    yield (
        "MISSING_DATASET_TYPE",
        lambda at: [
            path.write_text(path.read_text().replace('"@type": "Dataset",', "")) for path in at.rglob("*.json")
        ],
    )
    yield "INVALID_JSON_FORMATTING", lambda at: edited(at / ROOT, "{", "")
    yield "JSON_ENCODING_ERROR", lambda at: (at / ROOT).write_bytes(b'{"name": "\xe4"}')
    yield "INVALID_JSONLD_FORMATTING", lambda at: edited(at / side, "https://schema.org/", "https://example.org/")
    yield "JSON_KEY_REQUIRED", lambda at: edited(at / side, '"name": "Small study: ratings"', '"name": ""')
    yield "INVALID_SCHEMAORG_PROPERTY", lambda at: edited(at / ROOT, '"identifier"', '"schema_version"')
    yield "INVALID_SCHEMAORG_PROPERTY", lambda at: edited(at / side, '"minValue"', '"least"')
    yield "UNKNOWN_NAMESPACE", lambda at: edited(at / ROOT, '"identifier"', '"dcterms:identifier"')
    yield "OBJECT_TYPE_MISSING", lambda at: edited(at / side, '"@type": "PropertyValue",', "")
    yield "INVALID_OBJECT_TYPE", lambda at: edited(at / side, '"PropertyValue"', '"Person"')
    yield "CSV_HEADER_REPEATED", lambda at: edited(at / table, "study_id", "trial")
    yield "CSV_HEADER_LENGTH_MISMATCH", lambda at: edited(at / table, "\n", "\n1,2\n")
    yield "CSV_HEADER_MISSING", lambda at: (at / table).write_text("\n")
    yield "CSV_FORMATTING_ERROR", lambda at: (at / table).write_bytes(b'a,"b\n')
    yield "ROWID_VALUES_NOT_UNIQUE", lambda at: edited(at / table, "study_id", "row_id")
    yield "FILE_EMPTY", lambda at: (at / "CHANGES.md").write_text("")
    yield "FILE_NOT_CHECKED", lambda at: edited(at / ".psychds-ignore", "manifest.json", "")
    yield "FILE_NOT_CHECKED", lambda at: edited(at / ".psychds-ignore", ".psychds-ignore", "")
    yield "WRONG_METADATA_LOCATION", lambda at: shutil.copy(at / ROOT, at / "data")
    yield "EXTENSION_MISMATCH", lambda at: shutil.copy(at / table, (at / table).with_suffix(".xlsx"))
    yield "FILENAME_KEYWORD_FORMATTING_ERROR", lambda at: (at / table).rename(at / "data" / "ratings_data.csv")
    yield "FILENAME_UNOFFICIAL_KEYWORD_WARNING", lambda at: (at / table).rename(at / "data" / "house-1_data.csv")
    yield "MISSING_DATASET_DESCRIPTION", lambda at: (at / ROOT).unlink()
    yield "MISSING_README_DOC", lambda at: (at / "README.md").unlink()
    yield "MISSING_CHANGES_DOC", lambda at: (at / "CHANGES.md").unlink()
    yield "MISSING_PSYCHDSIGNORE", lambda at: (at / ".psychds-ignore").unlink()
    yield "MISSING_DIRECTORY_METADATA", lambda at: (at / "data" / "file_metadata.json").unlink()
    yield "MISSING_SIDECAR_METADATA", lambda at: [path.unlink() for path in at.rglob("*_data.json")]
    yield "MISSING_DATAFILE", lambda at: [path.unlink() for path in at.rglob("*_data.csv")]
    yield "MISSING_DATA_DIRECTORY", lambda at: shutil.rmtree(at / "data")
    for folder in ("analysis", "results", "materials", "documentation"):
        yield f"MISSING_{folder.upper()}_DIRECTORY", lambda at, folder=folder: shutil.rmtree(at / folder)


def test_the_checker_notices_a_breach_of_every_rule_of_the_schema(dataset, of, tmp_path):
    told = set()
    for number, (code, harm) in enumerate(broken(of)):
        at = tmp_path / str(number)
        shutil.copytree(dataset, at)
        harm(at)
        assert code in {found for found, _ in problems(at)}, code
        told.add(code)
    assert told | set(NOT_TOLD) == {*CODES.values(), *(rule["code"] for rule in RULES.values())}
    assert not told & set(NOT_TOLD)

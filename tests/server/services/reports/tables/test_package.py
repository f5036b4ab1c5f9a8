"""A package holds everything, its manifest comes last, and it is the same as a zip and as a folder."""

import hashlib
import io
import json
import zipfile

import pytest

from server.services.errors import NotFoundError
from server.services.reports.tables.columns import TABLES
from server.services.reports.tables.package import write_folder, write_zip
from tests.server.exported import text


@pytest.fixture
def study(people):
    return people[0]


def opened(download):
    return zipfile.ZipFile(io.BytesIO(b"".join(download.chunks)))


@pytest.mark.parametrize("form", ["csv", "jsonl", "parquet", "psych-ds"])
def test_the_manifest_tells_of_every_file_and_is_the_last(house, study, form):
    download = house.exports.zip(study.id, form)
    file = opened(download)
    assert file.testzip() is None
    *files, last = file.namelist()
    assert last == "manifest.json"
    manifest = json.loads(file.read(last))
    assert [one["path"] for one in manifest["files"]] == files
    for one in manifest["files"]:
        data = file.read(one["path"])
        assert (one["bytes"], one["sha256"]) == (len(data), hashlib.sha256(data).hexdigest())
    counted = {one["table"]: one["rows"] for one in manifest["files"] if "table" in one}
    assert counted == {view.name: view.rows for view in house.exports.overview(study.id)}
    assert list(counted) == list(TABLES)
    assert (manifest["cursor"], manifest["changed_meanwhile"]) == (download.cursor, [])
    assert download.tally.rows == sum(counted.values())


def test_what_is_in_the_zip_is_what_the_table_is(house, study):
    file = opened(house.exports.zip(study.id, "csv"))
    for table in TABLES:
        assert file.read(f"{table}.csv").decode() == text(house, study.id, table, "csv")
    assert json.loads(file.read("configurations.json")) == house.exports.configurations(study.id)
    assert json.loads(file.read("dictionary.json")) == house.exports.dictionary(study.id)
    codebook = file.read("codebook.csv").decode().splitlines()
    assert len(codebook) == 1 + sum(len(told["columns"]) for told in house.exports.dictionary(study.id).values())


def test_a_zip_that_broke_off_is_none(house, study):
    data = b"".join(house.exports.zip(study.id, "csv").chunks)
    for length in (100, len(data) // 2, len(data) - 30):
        with pytest.raises(zipfile.BadZipFile):
            zipfile.ZipFile(io.BytesIO(data[:length]))


def test_a_folder_without_its_manifest_is_unfinished(house, study, tmp_path):
    entries = house.exports.package(study.id, "jsonl").entries()
    assert [path.name for path in write_folder(entries, tmp_path)][-1] == "manifest.json"
    again = write_folder(house.exports.package(study.id, "jsonl").entries(), tmp_path)
    next(again)
    assert not (tmp_path / "manifest.json").exists()
    list(again)
    assert (tmp_path / "manifest.json").exists()
    assert not list(tmp_path.rglob("*.part"))


def test_a_zip_is_written_whole_or_not_at_all(house, study, tmp_path):
    def broken():
        yield from list(house.exports.package(study.id, "csv").entries())[:0]
        raise RuntimeError

    with pytest.raises(RuntimeError):
        write_zip(broken(), tmp_path / "a.zip")
    assert not (tmp_path / "a.zip").exists()


def test_who_went_on_meanwhile_is_told(house, people):
    study, walkers = people
    package = house.exports.package(study.id, "csv")
    entries = package.entries()
    for entry in entries:
        b"".join(entry.chunks)
        if entry.table == "trials":
            walkers[1].finish(steps=1)
        if entry.table == "responses":
            break
    told = json.loads(b"".join(next(entries).chunks))
    with house.database.read() as tx:
        from server.store import runs

        assert told["changed_meanwhile"] == [runs.participation_ids(tx, study.id)[1]]


def test_a_receipt_is_there_when_all_was_sent(house, study):
    download = house.exports.table(study.id, "faces", "csv")
    receipt, chunks = house.exports.receipted(study.id, download)
    first = next(chunks)
    with pytest.raises(NotFoundError, match="not sent to its end"):
        house.exports.receipt(study.id, receipt)
    data = first + b"".join(chunks)
    found = house.exports.receipt(study.id, receipt)
    assert (found.bytes, found.sha256) == (len(data), hashlib.sha256(data).hexdigest())
    assert found.rows == data.count(b"\n") - 1
    with pytest.raises(NotFoundError):
        house.exports.receipt("another", receipt)

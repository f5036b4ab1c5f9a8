"""The client gives what the server has, keeps a copy of it up to date, and notices what is not whole."""

import json

import httpx2
import pytest
from pyarrow import parquet

from emogen_client import EmogenClientError, Export, FramesMissingError, IncompleteError, RefusedError, Study
from emogen_client.study import BROKE_OFF
from emogen_core.face.identity import Identity, signed_document
from emogen_core.face.space_file import load_bundled_space
from server.services.reports.tables.columns import TABLES
from tests.conftest import small_study
from tests.emogen_client.conftest import ADDRESS
from tests.server.exported import lines
from tests.server.walker import Walker


def sorted_rows(table):
    return sorted((tuple(sorted(row.items())) for row in table.to_pylist()), key=repr)


def test_a_table_in_every_kind_of_frame(study, house, made):
    ids = [row["face"] for row in lines(house, made[0], "faces")]
    assert study.table("faces")["face"].tolist() == ids
    assert study.table("faces", frames="polars")["face"].to_list() == ids
    assert study.table("faces", frames="arrow")["face"].to_pylist() == ids
    assert len(study.table("faces", emotion="happy")) < len(ids)


def test_what_the_columns_mean_and_how_the_study_was_set_up(study, house, made):
    assert study.dictionary()["faces"]["key"] == ["face"]
    assert [one["number"] for one in study.configurations()] == [1]


@pytest.mark.parametrize("form", ["csv", "jsonl", "parquet", "psych-ds"])
def test_a_package_reads_the_same_in_every_format(study, tmp_path, form):
    folder = tmp_path / "data"
    folder.mkdir()
    export = study.download(folder / "all.zip", form)
    assert export.tables == tuple(TABLES)
    assert list(folder.iterdir()) == [folder / "all.zip"]
    export.verify()
    for table in TABLES:
        want = study.table(table, frames="arrow")
        found = export.arrow(table)
        assert found.schema.names == want.schema.names
        assert sorted_rows(found.cast(want.schema)) == sorted_rows(want), (form, table)
    assert export.configurations() == study.configurations()
    assert set(export.dictionary()) == set(TABLES)


def test_heads_that_a_study_brought_along_come_with_its_data(house, client, token, tmp_path):
    head = signed_document(Identity("Somebody", {"age": 40.0}), load_bundled_space())
    made = house.studies.create(small_study(identities=(head,)))
    study = Study(ADDRESS, made.id, token, client=client)
    for _ in range(2):
        Walker(client, made.links[0]).finish()
        export = study.update(tmp_path)
        export.verify()
        (path,) = (path for path in export.paths if path.startswith("heads/"))
        assert export.read(path) == (tmp_path / path).read_bytes()


def test_a_folder_is_kept_up_to_date(study, made, client, house, tmp_path):
    folder = tmp_path / "data"
    first = study.update(folder)
    walkers = made[1]
    walkers[2].finish()
    client.post(f"{walkers[1].address}/stop", json={"erase": True})
    second = study.update(folder)
    assert first.cursor != second.cursor
    for table in TABLES:
        want = study.table(table, frames="arrow")
        assert sorted_rows(second.arrow(table)) == sorted_rows(want), table
    second.verify()
    erased = second.table("participations").query("erased_at.notna()").participation
    assert not second.table("faces").participation.isin(erased).any()
    assert study.update(folder).manifest["files"] == second.manifest["files"]
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [
            *(f"{table}.parquet" for table in TABLES),
            "manifest.json",
            "configurations.json",
            "dictionary.json",
            "codebook.csv",
        ]
    )


def test_a_folder_keeps_its_filters(study, tmp_path):
    first = study.update(tmp_path, emotion="happy")
    again = study.update(tmp_path)
    assert first.manifest["filters"] == again.manifest["filters"] == {"emotion": "happy"}
    assert set(again.table("faces").emotion) == {"happy"}


def test_columns_of_another_face_model_are_added(study, made, tmp_path):
    folder = tmp_path / "data"
    study.update(folder)
    path = folder / "faces.parquet"
    table = parquet.read_table(path)
    last = table.schema.names[-1]
    parquet.write_table(table.drop_columns([last]), path)
    made[1][2].finish(steps=5)
    found = study.update(folder).arrow("faces")
    assert found.schema.names[-1] == last
    assert found[last].null_count == len(table)
    assert len(found) > len(table)


def test_a_table_that_an_earlier_release_did_not_have_is_added(study, made, tmp_path):
    study.update(tmp_path)
    manifest = json.loads((tmp_path / "manifest.json").read_text())
    manifest["files"] = [file for file in manifest["files"] if file.get("table") != "estimates"]
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    (tmp_path / "estimates.parquet").unlink()
    made[1][2].finish(steps=5)
    found = study.update(tmp_path)
    found.verify()
    assert set(found.tables) == set(TABLES)
    assert len(found.arrow("estimates")) == 0


def test_an_interrupted_download_is_noticed_and_leaves_nothing(cut, study, tmp_path):
    with pytest.raises(IncompleteError, match="SHA-256"):
        cut.table("faces")
    folder = tmp_path / "data"
    folder.mkdir()
    with pytest.raises(IncompleteError):
        cut.download(folder / "all.zip")
    assert list(folder.iterdir()) == []
    before = study.update(folder).manifest
    with pytest.raises(IncompleteError):
        cut.update(folder)
    assert Export(folder).manifest == before


def test_a_download_that_the_server_broke_off_is_noticed(made, client, token):
    def handle(request):
        if "/receipts/" in request.url.path:
            return httpx2.Response(404, json={"error": {"code": "not_found", "message": "No such receipt."}})
        reply = client.request(request.method, str(request.url), headers=request.headers)
        return httpx2.Response(200, content=reply.content[:100], headers={"emogen-receipt": "x"})

    with (
        httpx2.Client(transport=httpx2.MockTransport(handle)) as sending,
        pytest.raises(IncompleteError, match="sent to its end"),
    ):
        Study(ADDRESS, made[0], token, client=sending).table("faces")


@pytest.mark.parametrize("broken", BROKE_OFF)
def test_a_connection_that_breaks_is_an_interrupted_download(tmp_path, broken):
    class Breaking(httpx2.SyncByteStream):
        def __iter__(self):
            yield b"PAR1"
            raise broken("the network is gone")

    answer = httpx2.MockTransport(lambda _: httpx2.Response(200, stream=Breaking(), headers={"emogen-receipt": "x"}))
    with httpx2.Client(transport=answer) as sending:
        study = Study(ADDRESS, "any", "emg_x", client=sending)
        for load in (lambda: study.table("faces"), lambda: study.download(tmp_path / "all.zip")):
            with pytest.raises(IncompleteError, match="a whole download"):
                load()
    assert list(tmp_path.iterdir()) == []


def test_refusals_are_the_server_s_sentences(client, made, study):
    with pytest.raises(RefusedError, match="valid token") as refused:
        Study(ADDRESS, made[0], "emg_guess", client=client).table("faces")
    assert (refused.value.status, refused.value.code) == (401, "unauthorised")
    with pytest.raises(RefusedError, match=r"no such table[.] \(expected one of participations.*, got secrets\)"):
        study.table("secrets")
    broken = httpx2.MockTransport(lambda _: httpx2.Response(502, text="<html>"))
    with httpx2.Client(transport=broken) as sending, pytest.raises(RefusedError, match="502"):
        Study(ADDRESS, made[0], "emg_x", client=sending).dictionary()


def test_a_file_that_was_changed_or_lost_is_noticed(study, tmp_path):
    export = study.update(tmp_path)
    path = tmp_path / "ratings.parquet"
    path.write_bytes(path.read_bytes() + b"x")
    with pytest.raises(IncompleteError, match="ratings"):
        export.verify()
    with pytest.raises(IncompleteError):
        export.table("ratings")
    path.unlink()
    with pytest.raises(IncompleteError, match="no such file"):
        export.verify()
    with pytest.raises(EmogenClientError, match="expected one of participations"):
        export.table("secrets")
    for wrong in (tmp_path / "none", path.with_name("dictionary.json")):
        with pytest.raises(IncompleteError, match=r"manifest\.json"):
            Export(wrong)
    assert json.loads((tmp_path / "manifest.json").read_text())["format"] == "parquet"


def test_frames_that_are_not_installed_are_one_sentence(study, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "polars", None)
    with pytest.raises(FramesMissingError, match="polars is not installed"):
        study.table("trials", frames="polars")

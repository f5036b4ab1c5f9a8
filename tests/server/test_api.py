"""The analyst's interface: what it says of itself, downloads with cursor and receipt, and the dashboard's links."""

import csv
import hashlib
import io
import json
import re
import shutil
import subprocess
import threading
import time
import zipfile
from pathlib import Path

import pytest
import uvicorn

from server.app import create_app
from server.services.reports.tables.columns import TABLES
from server.services.reports.tables.dictionary import markdown
from tests.conftest import small_study
from tests.server.exported import lines, text
from tests.server.openapi import described
from tests.server.walker import Walker

DOCS = Path(__file__).parents[2] / "docs"
HOST = "https://study.example.org"


@pytest.fixture
def study(client, house):
    made = house.studies.create(small_study())
    Walker(client, made.links[0]).finish()
    Walker(client, made.links[0]).finish(steps=3)
    return made


@pytest.fixture
def token(house):
    return house.tokens.create("analysis", ["export"])


@pytest.fixture
def get(client, study, token):
    def fetch(path, **params):
        headers = {"Authorization": f"Bearer {token}"}
        return client.get(f"/api/v1/studies/{study.id}/{path}", params=params, headers=headers)

    return fetch


def genes_of(emotion, row):
    return {(emotion, name): float(value) for name, value in row.items() if name.startswith("gene_")}


def documented(language):
    text = (DOCS / "export.md").read_text(encoding="utf-8")
    return re.search(rf"```{language}\n(.*?)```", text, re.DOTALL)[1]


def test_the_description_is_the_one_that_is_checked_in(client):
    kept = (DOCS / "openapi.json").read_text(encoding="utf-8")
    assert described() == kept, "python -m tests.server.openapi docs/openapi.json"
    assert client.get("/api/v1/openapi.json").json() == json.loads(kept)


def test_the_description_tells_every_error_and_every_reply(client):
    told = json.loads((DOCS / "openapi.json").read_text(encoding="utf-8"))
    for path, methods in told["paths"].items():
        for one in methods.values():
            assert one["tags"] and one["description"] and one["security"], path
            assert {"200", "401", "403", "404", "422"} <= set(one["responses"])
            for word in one["parameters"]:
                said = {*word, *word["schema"]}
                assert {"example", "examples", "enum"} & said or word["in"] == "path", word["name"]
            for status, reply in one["responses"].items():
                for content in reply["content"].values():
                    assert "schema" in content
                if status != "200":
                    assert reply["content"]["application/json"]["schema"]["$ref"].endswith("/ErrorBody")
                    assert reply["content"]["application/json"]["example"]["error"]["code"]


@pytest.mark.parametrize("form", ["csv", "jsonl", "parquet"])
@pytest.mark.parametrize("path", ["export", "package"])
def test_a_download_is_what_its_receipt_says(get, path, form):
    reply = get(path, format=form)
    assert reply.status_code == 200
    receipt = get(f"receipts/{reply.headers['emogen-receipt']}").json()
    assert receipt["bytes"] == len(reply.content)
    assert receipt["sha256"] == hashlib.sha256(reply.content).hexdigest()
    assert receipt["file"] in reply.headers["content-disposition"]
    assert get("export", since=reply.headers["emogen-cursor"]).text.count("\n") == 1


def test_errors_have_one_shape(get, client, study):
    for reply in (
        get("export", table="secrets"), get("export", format="xlsx"), get("export", since="x"), get("receipts/none"),
        get("export", kind="dead"), get("export", arrived_from="2026-01-01T00:00"), get("package", arrived_before="x"),
    ):  # fmt: skip
        assert reply.status_code in {404, 422}
        assert {"code", "message"} <= set(reply.json()["error"])
    assert client.get(f"/api/v1/studies/{study.id}/export?format=xlsx").status_code == 401, "before anything else"


def test_filters_reach_the_data(get):
    assert get("export", kind="people").text.count("\n") == 3
    assert get("export", kind="simulated").text.count("\n") == 1
    assert get("export", arrived_before="2020-01-01T00:00Z").text.count("\n") == 1
    assert set(
        re.findall(r'"emotion":"(\w*)"', get("export", table="trials", format="jsonl", emotion="angry").text)
    ) == {"angry"}


def test_the_dictionary_leaves_out_what_does_not_apply(get):
    columns = {one["name"]: one for one in get("dictionary").json()["tables"]["faces"]["columns"]}
    assert columns["slot"] == {
        "name": "slot", "type": "integer", "help": "Place in the algorithm's population.", "least": 1, "most": 10,
    }  # fmt: skip


def test_the_dashboard_downloads_the_same(house_owner, house, study):
    page = house_owner.get(f"/admin/studies/{study.id}/data?kind=people").text
    for link in re.findall(r'href="(/admin/studies/[^"]+/(?:export|package)\?[^"]+)"', page):
        reply = house_owner.get(link.replace("&amp;", "&"))
        assert reply.status_code == 200, link
        assert "kind=people" in link
    assert page.count("/export?") == 3 * len(TABLES) + 1
    psych = house_owner.get(f"/admin/studies/{study.id}/package?format=psych-ds")
    assert "dataset_description.json" in zipfile.ZipFile(io.BytesIO(psych.content)).namelist()
    nobody = house_owner.get(f"/admin/studies/{study.id}/data?kind=simulated").text
    assert '<option value="simulated" selected>' in nobody


def test_the_tables_of_the_document_are_the_declared_ones():
    assert markdown() in (DOCS / "export.md").read_text(encoding="utf-8")


@pytest.fixture
def place(tmp_path, monkeypatch, token, client):
    """An empty folder to run in, with the token in the environment; requests go to the app."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("EMOGEN_API_TOKEN", token)
    monkeypatch.setattr("httpx2.Client", lambda **_: client)


def test_the_python_of_the_document_runs_and_counts_only_who_completed(client, house, place, capsys):
    """Others did the pilot, or left shortly before the end."""
    study = house.studies.create(small_study(), "pilot")
    pilot = Walker(client, study.links[0])
    pilot.finish()
    client.cookies.clear()
    house.life.move(study.id, "recruiting", "u")
    Walker(client, study.links[0]).finish()
    client.cookies.clear()
    Walker(client, study.links[0]).finish(steps=len(pilot.sent) - 1)
    code = documented("python")
    assert len([line for line in code.splitlines() if line.strip()]) <= 10
    names = {}
    code = code.replace(HOST, "http://testserver").replace('"demo"', f'"{study.id}"')
    exec(compile(code, "export.md", "exec"), names)
    said = capsys.readouterr().out
    assert "happy" in said
    assert "gene_" in said
    people = [json.loads(line) for line in text(house, study.id, "participations").splitlines()]
    assert [one["pilot"] for one in people] == [True, False, False]
    assert [one["outcome"] for one in people] == ["complete", "complete", None]
    done = names["trials"].dropna(subset="final_face")
    assert set(done["participation"]) == {one["participation"] for one in people}, "everybody has finished faces"
    assert set(names["measured"]["participation"]) == {people[1]["participation"]}


@pytest.mark.skipif(shutil.which("Rscript") is None, reason="R is not installed")
def test_the_r_of_the_document_runs_and_means_what_python_finds(house, study, token, tmp_path):
    code = documented("r")
    assert len(code.splitlines()) <= 10
    server = uvicorn.Server(uvicorn.Config(create_app(house), port=0, log_level="error"))
    thread = threading.Thread(target=server.run)
    thread.start()
    while not server.started:
        time.sleep(0.05)
    port = server.servers[0].sockets[0].getsockname()[1]
    here = code.replace(HOST, f"http://127.0.0.1:{port}").replace("/studies/demo", f"/studies/{study.id}")
    here += 'write.csv(measured[c("emotion", grep("^gene_", names(measured), value = TRUE))], "measured.csv")'
    try:
        done = subprocess.run(
            ["Rscript", "-e", here], capture_output=True, text=True, timeout=120, check=False,
            env={"EMOGEN_API_TOKEN": token, "PATH": "/usr/bin:/usr/local/bin:/bin"}, cwd=tmp_path,
        )  # fmt: skip
    finally:
        server.should_exit = True
        thread.join()
    assert done.returncode == 0, done.stderr
    assert "happy" in done.stdout
    with (tmp_path / "measured.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    faces = {face["face"]: face for face in lines(house, study.id, "faces")}
    trials = [trial for trial in lines(house, study.id, "trials") if trial["final_face"] and not trial["practice"]]
    found, meant = {}, {}
    for row in rows:
        found |= genes_of(row["emotion"], row)
    for trial in trials:
        meant |= genes_of(trial["emotion"], faces[trial["final_face"]])
    assert len(rows) == len(trials) > 1
    assert found == pytest.approx(meant, abs=1e-12)

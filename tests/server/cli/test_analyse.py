"""`emogen analyse` in a process of its own: what it writes, and that the same seed writes the same from any format."""

import json
import re

import pytest

from tests.server.analysis.recorded import export_of_own_head
from tests.server.cli.running import emogen


@pytest.fixture(scope="module")
def written(analysed, tmp_path_factory):
    out = tmp_path_factory.mktemp("analysis")
    done = emogen(analysed, "analyse", str(analysed / "csv"), "--out", str(out / "one"), "--simulated")
    assert done.returncode == 0, done.stderr
    again = emogen(analysed, "analyse", str(analysed / "parquet"), "--out", str(out / "two"), "--simulated", "--json")
    assert again.returncode == 0, again.stderr
    return out, json.loads(again.stdout)


def files(folder):
    """The texts of a report, without the two things that differ between exports of the same data."""
    told = json.loads((folder / "about.json").read_text(encoding="utf-8"))
    texts = {path.name: path.read_text(encoding="utf-8") for path in folder.iterdir()}
    for name in ("command", "exported_at"):
        texts = {file: text.replace(told[name], name) for file, text in texts.items()}
    return texts


def test_the_same_seed_writes_the_same_from_another_format(written):
    out, _ = written
    assert files(out / "one") == files(out / "two")


def test_the_page_fetches_nothing_and_every_table_has_its_file(written):
    out, told = written
    page = (out / "one" / "report.html").read_text(encoding="utf-8")
    assert 'src="http' not in page and 'href="http' not in page and "url(/" not in page
    assert "All participants are simulated" in page
    assert told["counted"] == "4 simulated participants" and told["counted"] in page
    for section in told["sections"]:
        assert f'id="{section["name"]}"' in page
        assert all((out / "one" / file).exists() for file in section["files"])
    assert json.loads((out / "two" / "about.json").read_text(encoding="utf-8")) == told


def test_with_two_people_a_cell_no_interval_is_told(written):
    _, told = written
    sections = {section["name"]: section for section in told["sections"]}
    for name in ("means", "within", "proxy", "convergence", "conditions", "retest", "kinds"):
        assert any("needs at least" in sentence for sentence in sections[name]["lacks"]), name
    column = list(sections["within"]["columns"]).index("low")
    assert {row[column] for row in sections["within"]["rows"]} == {None}
    p = list(sections["conditions"]["columns"]).index("p")
    assert {row[p] for row in sections["conditions"]["rows"]} == {None}


def test_the_text_names_what_a_paper_has_to(written):
    out, told = written
    text = (out / "two" / "methods.txt").read_text(encoding="utf-8")
    for word in (told["rig_hash"], *told["configurations"], told["command"], "4 generations", "6 generations"):
        assert word in text


def test_conditions_are_tested_on_ratings_as_well(written):
    _, told = written
    (section,) = (one for one in told["sections"] if one["name"] == "conditions")
    questions = {row[list(section["columns"]).index("question")] for row in section["rows"]}
    assert questions == {"mean face", "intensity", "dispersion", "rated intensity"}


@pytest.fixture(scope="module")
def with_own_head(tmp_path_factory):
    data = tmp_path_factory.mktemp("own-head")
    export_of_own_head(data)
    done = emogen(data, "analyse", str(data / "parquet"), "--out", str(data / "out"), "--simulated", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout), (data / "out" / "report.html").read_text(encoding="utf-8")


def test_a_head_of_the_study_is_worn_by_its_mean_faces(with_own_head):
    told, page = with_own_head
    (means,) = (one for one in told["sections"] if one["name"] == "means")
    heads = {row[list(means["columns"]).index("head")] for row in means["rows"]}
    (own,) = (head for head in heads if head.startswith("custom-"))
    assert heads == {own, "female"}
    pictures = dict(re.findall(r'<img src="(data:[^"]+)" alt="angry, ([^,:]+)', page))
    assert sorted(pictures.values()) == ["Somebody", "female"]
    assert any(one["name"] == "heads" for one in told["sections"])
    assert told["heads"] == {own: "Somebody"}


def test_a_restricted_export_says_so_everywhere(analysed, tmp_path):
    only = {"block": "first", "condition": "plain"}
    options = [word for name, value in only.items() for word in (f"--{name}", value)]
    study = json.loads((analysed / "csv" / "manifest.json").read_text(encoding="utf-8"))["study"]
    done = emogen(analysed, "export", "--study", study, *options, "--out", str(tmp_path / "part.zip"))
    assert done.returncode == 0, done.stderr
    done = emogen(tmp_path, "analyse", str(tmp_path / "part.zip"), "--simulated", "--out", str(tmp_path / "out"))
    assert done.returncode == 0, done.stderr
    words = "the condition “plain” and trials of the block “first”"
    told = json.loads((tmp_path / "out" / "about.json").read_text(encoding="utf-8"))
    assert (told["filters"], told["restricted"]) == (only, words)
    for name in ("methods.txt", "report.html"):
        assert words in (tmp_path / "out" / name).read_text(encoding="utf-8"), name


def test_nobody_to_count_is_one_sentence_and_writes_nothing(analysed, tmp_path):
    done = emogen(analysed, "analyse", str(analysed / "csv"), "--out", str(tmp_path / "out"))
    assert done.returncode == 1, (done.returncode, done.stderr)
    assert "--simulated" in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()


def test_what_is_no_export_is_one_sentence(tmp_path):
    done = emogen(tmp_path, "analyse", str(tmp_path), "--out", str(tmp_path / "out"))
    assert done.returncode == 1
    assert "expected" in done.stderr and "Traceback" not in done.stderr

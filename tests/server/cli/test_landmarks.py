"""`emogen landmarks`: from a file to weights that a study takes, and from a wrong file to one sentence."""

import csv
import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import Image
from typer.testing import CliRunner

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import save_rig
from emogen_core.landmarks.arkit import TABLE, core_weights
from emogen_core.landmarks.points import NAMES
from emogen_core.landmarks.solvers import METHODS
from emogen_core.rigs.landmark_head import driven_head
from emogen_core.search.initial import initial_population
from server.cli import app
from server.cli.landmark_files import population
from server.services.config.files import read_study
from server.services.studies.fitting import misfits
from server.services.trials.evolution import params_of
from tests.rig_factory import full_rig

DOC = (Path(__file__).parents[3] / "docs" / "landmarks.md").read_text()
RIG = load_bundled_rig()


def run(*words, code=0):
    done = CliRunner().invoke(app, ["landmarks", *map(str, words)])
    assert done.exit_code == code, (done.output, done.exception)
    assert code == 0 or not done.exception or isinstance(done.exception, SystemExit)
    return done


def block(mark):
    return re.search(rf"<!-- {mark} -->\n```\w*\n(.*?)```", DOC, re.DOTALL).group(1)


@pytest.fixture
def write(tmp_path):
    def written(text, name="given.csv"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.fixture(scope="module")
def phone():
    """A recording: three frames, the second without a face."""
    rng = np.random.default_rng(1)
    header = ["Timecode", "BlendShapeCount", *(name[0].upper() + name[1:] for name in TABLE), "HeadYaw", "Extra"]
    one, two = ({name: round(float(value), 3) for name, value in zip(TABLE, rng.random(52), strict=True)} for _ in "ab")
    rows = [["00:01", 61, *one.values(), 0.1, 1], ["00:02", 0], ["00:03", 61, *two.values(), 0.1, 1]]
    return "\n".join(",".join(map(str, row)) for row in [header, *rows]), (one, two)


def test_the_worked_example_of_the_documentation(write, tmp_path):
    done = run("fit", write(block("example")), "--out", tmp_path / "face")
    assert done.stdout == block("printed")
    assert sorted(path.name for path in (tmp_path / "face").iterdir()) == [
        "genes.csv", "shapes.csv", "study.yaml", "weights.json",
    ]  # fmt: skip
    named = yaml.safe_load((tmp_path / "face" / "study.yaml").read_text())["blocks"][1]["faces"]
    (told,) = (yaml.safe_load(text)["faces"] for text in re.findall(r"```yaml\n(faces:.*?)```", DOC, re.DOTALL))
    assert named == told


def test_a_study_begins_with_the_faces_and_shows_them(write, tmp_path):
    run("fit", write(block("example")), "--out", tmp_path / "face")
    config = read_study((tmp_path / "face" / "study.yaml").read_text())
    assert list(misfits(RIG, config)) == []
    genes = json.loads((tmp_path / "face" / "weights.json").read_text())["frames"][0]["genes"]
    first = initial_population(params_of(RIG, config), 0, 0).genes
    assert dict(zip(RIG.gene_names, first[0].tolist(), strict=True)).items() >= genes.items()
    assert first[9].tolist() == pytest.approx((0.1 * first[0]).tolist(), abs=1e-4)
    assert config.blocks[1].faces.named[0].genes == genes


def test_the_simulation_of_the_documentation(write, tmp_path, monkeypatch, capsys):
    run("fit", write(block("example")), "--out", tmp_path / "face")
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", DOC, re.DOTALL)
    exec(compile(code, "docs/landmarks.md", "exec"), {})
    assert f"({float(capsys.readouterr().out):.3f}, cosine distance)" in DOC


def test_ten_faces_from_any_number_of_frames():
    frames = np.eye(12)
    assert population(frames) == np.minimum(frames[[0, 1, 2, 4, 5, 6, 7, 9, 10, 11]], 0.9999).tolist()
    assert population(frames[:10]) == np.minimum(frames[:10], 0.9999).tolist()
    one = np.array(population(frames[:1]))
    assert one[:, 0].tolist() == pytest.approx([0.9999, *np.arange(0.9, 0, -0.1)])
    three = np.array(population(frames[:3]))
    assert three.argmax(1).tolist() == [0, 1, 2] * 3 + [0]
    assert three.max(1).tolist() == pytest.approx([0.9999] * 3 + [0.75] * 3 + [0.5] * 3 + [0.25])
    assert 0 <= np.array(population(frames[:4])).min() <= np.array(population(frames[:4])).max() < 1


def test_a_long_recording_is_shown_from_first_to_last(write, tmp_path):
    rows = "\n".join(f"{n},{n / 250}" for n in range(250))
    done = run("fit", write(f"Timecode,JawOpen\n{rows}\n"), "--out", tmp_path / "face.yaml")
    assert done.stdout.count("frame ") == 10
    assert done.stdout.endswith("and 240 frames more (--json, --out)\n")
    config = read_study((tmp_path / "face.yaml").read_text())
    named = config.blocks[1].faces.named
    assert (len(named), named[0].name, named[-1].name) == (100, "frame-1", "frame-250")
    assert named[-1].genes == {"jawOpen": 0.996}
    jaw = RIG.gene_names.index("jawOpen")
    assert [face[jaw] for face in config.search.fixed_population][::9] == [0, 0.996]


@pytest.mark.parametrize("identity", ["female", "asian-male-old"])
def test_a_recording_becomes_the_weights_of_its_table(write, tmp_path, phone, identity):
    text, frames = phone
    out = tmp_path / "weights.json"
    run("fit", write(text), "--out", out, "--identity", identity)
    told = json.loads(out.read_text())
    assert [frame["frame"] for frame in told["frames"]] == ["00:01", "00:03"]
    assert (told["not_known"], told["not_in_the_file"], told["not_on_the_rig"]) == (["Extra"], [], ["mouthClose"])
    head = driven_head(RIG, identity)
    for frame, given in zip(told["frames"], frames, strict=True):
        shapes = head.face(core_weights(RIG, given))
        assert frame["shapes"] == {
            name: pytest.approx(float(weight), abs=1e-4)
            for name, weight in zip(RIG.shape_names, shapes, strict=True)
            if round(float(weight), 4)
        }
        assert frame["shapes"]["mouthSmile.L"] == given["mouthSmileLeft"]
        assert frame["genes"]["mouthSmile"] == pytest.approx((given["mouthSmileLeft"] + given["mouthSmileRight"]) / 2)
        assert frame["asymmetry"] > 0


def test_a_recording_goes_round(write, tmp_path, phone):
    """From shapes back to coefficients: what was recorded."""
    text, (given, _) = phone
    run("fit", write(text), "--out", tmp_path / "face", "--frame", "1")
    (row,) = csv.DictReader(io.StringIO((tmp_path / "face" / "shapes.csv").read_text()))
    back = {name: float(row[shapes[0]]) for name, shapes in TABLE.items() if shapes}
    assert back == {name: value for name, value in given.items() if name != "mouthClose"}


def test_mediapipe_says_the_same_as_a_phone(write, phone):
    text, (given, _) = phone
    scores = [{"categoryName": name, "score": value} for name, value in given.items()]
    result = write(json.dumps({"faceBlendshapes": [{"categories": scores}]}), "result.json")
    one, other = (
        json.loads(run("fit", path, "--frame", "1", "--json").stdout)["frames"][0] for path in (result, write(text))
    )
    assert one["genes"] == other["genes"]


def test_a_frame_is_chosen_by_name_or_number(write, phone):
    path = write(phone[0])
    names = {
        wanted: [frame["frame"] for frame in json.loads(run("fit", path, "--frame", wanted, "--json").stdout)["frames"]]
        for wanted in ("all", "00:03", "2")
    }
    assert names == {"all": ["00:01", "00:03"], "00:03": ["00:03"], "2": ["00:03"]}
    assert (
        "expected all, a number up to 2 or a name (00:01, 00:03), got '3'"
        in run("fit", path, "--frame", "3", code=1).stderr
    )


def test_emphasis_strengthens_coefficients_up_to_one(write):
    path = write("JawOpen,BrowInnerUp\n0.8,0.2\n")
    genes = json.loads(run("fit", path, "--emphasis", 2, "--json").stdout)["frames"][0]["genes"]
    assert genes == {"browInnerUp": 0.4, "jawOpen": 1.0}
    assert "emphasis: expected a number above 0" in run("fit", path, "--emphasis", 0, code=1).stderr


@pytest.mark.parametrize("method", METHODS)
def test_every_method_fits_and_repeats_itself(write, method):
    words = ("fit", write(block("example")), "--method", method, "--regions", 2, "--seed", 3, "--json")
    one, again = (run(*words).stdout for _ in range(2))
    assert one == again
    (frame,) = json.loads(one)["frames"]
    assert frame["fitness"] > 0.9
    assert frame["genes"]["mouthSmile"] > 0.1


def test_positions_of_another_head_give_the_same_weights(write):
    points = driven_head(RIG).points
    wanted = list(csv.DictReader(io.StringIO(block("example"))))
    lines = ["frame,name,x,y,z"]
    for row in wanted:
        place = points[NAMES.index(row["name"])]
        moved = place + [float(row[axis]) for axis in ("dx", "dy", "dz")]
        for frame, where in (("neutral", place), ("smile", moved)):
            lines.append(f"{frame},{row['name']},{','.join(repr(0.0013 * float(n) + 0.2) for n in where)}")
    found = json.loads(run("fit", write("\n".join(lines)), "--unit", "m", "--json").stdout)["frames"][0]
    given = json.loads(run("fit", write(block("example")), "--json").stdout)["frames"][0]
    assert found["genes"] == pytest.approx(given["genes"], abs=2e-3)


@pytest.mark.parametrize("ending", [".json", ".csv", ".yaml"])
def test_one_file_is_written_where_a_file_is_named(write, tmp_path, ending):
    out = tmp_path / "new" / f"face{ending}"
    run("fit", write(block("example")), "--out", out)
    assert [path.name for path in out.parent.iterdir()] == [out.name]
    assert "mouthSmile" in out.read_text()


@pytest.mark.parametrize(
    ("text", "words", "said"),
    [
        ("", (), "file: expected a line with the names of columns"),
        ("name,dx,dy,dz\n", (), "rows below the header, got 0"),
        (block("example").replace("5.1,", "5.9,"), (), "expected MPEG-4 names, as 8.3 (emogen landmarks points)"),
        (block("example").replace("6.1", "nan"), (), "expected finite numbers, got"),
        (block("example").replace("6.1", "high"), (), "line 2: expected a number for dy, got 'high'"),
        (block("example").replace("6.1", "6100"), (), "leave the face"),
        ("\n".join(block("example").splitlines()[:4]), (), "at least 5 of the 56, got 3"),
        (block("example"), ("--unit", "m"), "another unit than millimetres"),
        (block("example"), ("--unit", "inch"), "unit: expected one of"),
        (block("example"), ("--method", "magic"), "method: expected one of"),
        (block("example"), ("--regions", "3"), "regions: expected 1, 2 or 4, got 3"),
        (block("example"), ("--emphasis", "-1"), "emphasis: expected a number above 0"),
        (block("example"), ("--identity", "nobody"), "identity: expected one of"),
        (block("example"), ("--frame", "smile"), "frame: expected all, a number up to 1"),
        ("a,b\n1,2\n", (), "columns of feature points (name,dx,dy,dz) or ARKit names"),
        ("JawOpen\n55\n", (), "jawOpen: expected a coefficient in [0, 1], got 55.0"),
        ("{}", (), "result 1: expected faceBlendshapes"),
        ("[", (), "file: expected JSON"),
    ],
)
def test_bad_input_is_one_sentence_and_writes_nothing(write, tmp_path, text, words, said):
    out = tmp_path / "out"
    done = run("fit", write(text), *words, "--out", out, code=1)
    assert said in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert not out.exists()


def test_motions_in_metres_are_told_apart(write):
    rows = list(csv.reader(io.StringIO(block("example"))))
    small = [rows[0], *([row[0], *(repr(float(n) / 1000) for n in row[1:])] for row in rows[1:])]
    path = write("\n".join(",".join(row) for row in small))
    assert "if these are metres, say --unit m" in run("fit", path, code=1).stderr
    plain = json.loads(run("fit", write(block("example"), "mm.csv"), "--json").stdout)
    assert json.loads(run("fit", path, "--unit", "m", "--json").stdout)["frames"] == plain["frames"]


def test_places_that_cannot_be_written_are_told(write, tmp_path):
    path = write(block("example"))
    assert "--out: expected a folder, or a file that ends in" in run("fit", path, "--out", "x.png", code=1).stderr
    assert "--out: expected a place to write to" in run("fit", path, "--out", path / "x", code=1).stderr
    assert "expected a file to read" in run("fit", tmp_path / "none.csv", code=1).stderr
    (tmp_path / "bytes.csv").write_bytes(b"\xff\xfe\x00")
    assert "expected text in UTF-8" in run("fit", tmp_path / "bytes.csv", code=1).stderr


def test_another_rig_takes_coefficients_without_points(write, tmp_path):
    """Its mesh is no face, so points are refused; its one ARKit shape takes its coefficient all the same."""
    small = full_rig()
    gene = replace(small.genes[0], members=("jawOpen",))
    renamed = replace(small, genes=(gene, *small.genes[1:]), core_shapes=("jawOpen", *small.core_shapes[1:]))
    rig = tmp_path / "lab.rig"
    save_rig(renamed, rig)
    phone, out = write("JawOpen,TongueOut\n0.4,1\n"), tmp_path / "face"
    told = json.loads(run("fit", phone, "--rig", rig, "--out", out, "--json").stdout)
    assert told["frames"][0]["genes"] == {"g0": 0.4}
    assert told["not_on_the_rig"] == ["tongueOut"]
    assert yaml.safe_load((out / "study.yaml").read_text())["identities"] == ["lab:female"]
    refused = run("fit", write(block("example"), "points.csv"), "--rig", rig, "--out", tmp_path / "none", code=1)
    assert "feature points: " in refused.stderr
    assert not (tmp_path / "none").exists()


@pytest.mark.gl
def test_points_are_listed_and_drawn(tmp_path):
    out = tmp_path / "points.jpg"
    listed = json.loads(run("points", "--out", out, "--json").stdout)
    assert [row["name"] for row in listed] == list(NAMES)
    with Image.open(out) as picture:
        assert picture.size[0] == 1500
    assert run("points").stdout.splitlines()[0].split() == ["2.1", "732", "bottom", "of", "the", "chin"]
    assert "a file that ends in" in run("points", "--out", tmp_path / "points.txt", code=1).stderr
    assert "expected one of" in run("points", "--identity", "nobody", "--out", out, code=1).stderr


def test_the_seam_is_measured_as_the_documentation_says():
    rows = json.loads(run("seam", "--json").stdout)
    table = [
        [float(number) for number in re.findall(r"[\d.]+", line)]
        for line in re.findall(r"^\| [24] \| .* mm \|$", DOC, re.MULTILINE)
    ]
    for told, (apart, blended) in zip(table, (rows[:2], rows[2:]), strict=True):
        measured = [apart["largest_jump_mm"], blended["largest_jump_mm"], apart["without_a_border_mm"]]
        assert told == [apart["regions"], *(pytest.approx(number, abs=0.06) for number in measured)]
    assert run("seam").stdout.startswith("regions: 2, band_mm: 0.0")

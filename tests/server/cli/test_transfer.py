"""`emogen rig transfer`: from a neutral and expressions to a rig file."""

import csv
import json

import numpy as np
import pytest
from typer.testing import CliRunner

from emogen_core.face.rig_file import load_rig, save_rig
from server.cli import app
from tests.rig_factory import full_rig

RUN = CliRunner()


def run(*words):
    return RUN.invoke(app, ["rig", "transfer", *map(str, words)])


def write_obj(path, mesh):
    path.write_text("# made up\n" + "".join(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in mesh) + "f 1 2 3\n")
    return path


@pytest.fixture
def rig(tmp_path):
    return save_rig(full_rig(), tmp_path / "small.rig")


@pytest.fixture
def expressions(tmp_path, rig):
    """Two expressions of the first head, with every shape a fifth larger."""
    folder = tmp_path / "made"
    folder.mkdir()
    weights = np.zeros((3, len(rig.core_shapes)))
    weights[0, 0] = weights[1, 2] = weights[2, 5] = 1
    with (folder / "weights.csv").open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["expression", *rig.core_shapes])
        table.writerows([f"expression-{i + 1}", *row] for i, row in enumerate(weights))
    for i in range(2):
        mesh = rig.neutral("female") + 1.2 * np.tensordot(weights[i], rig.offsets[: len(rig.core_shapes)], 1)
        write_obj(folder / f"expression-{i + 1}.obj", mesh)
    return folder


def test_a_head_of_the_rig_becomes_a_rig_of_its_own(tmp_path, rig):
    out = tmp_path / "male.rig"
    done = run(tmp_path / "small.rig", "male", "--out", out, "--json")
    assert done.exit_code == 0, done.output
    report, made = json.loads(done.stdout), load_rig(out)
    assert (report["rig"], report["hash"], report["head"]) == ("small-male", made.hash, "male")
    assert (report["expressions"], report["lids_and_lips_fitted"]) == (0, False)
    assert report["template_hash"] == rig.hash
    assert np.array_equal(made.neutral("male"), rig.neutral("male"))
    assert made.shape_names == rig.shape_names


def test_what_expressions_show_is_learnt(tmp_path, rig, expressions):
    target, out = write_obj(tmp_path / "My head.obj", rig.neutral("female")), tmp_path / "made.rig"
    done = run(tmp_path / "small.rig", target, "--expressions", expressions, "--out", out)
    assert done.exit_code == 0, done.output
    assert "core_shapes_shown: 2" in done.stdout
    assert str(out) in done.stdout
    made = load_rig(out)
    assert made.identities == ("My-head",)
    assert np.allclose(made.offsets[[0, 2]], 1.2 * rig.offsets[[0, 2]], atol=0.01)
    assert np.allclose(made.offsets[[1, 5]], rig.offsets[[1, 5]], atol=0.01)


def test_expressions_have_to_be_the_neutrals_mesh_in_any_dialect(tmp_path, rig, expressions):
    """The same reader as an import's: corners with normals, tabs, and refusal of other faces."""
    target, out = write_obj(tmp_path / "head.obj", rig.neutral("female")), tmp_path / "made.rig"
    path = expressions / "expression-2.obj"
    whole = path.read_text()
    path.write_text(whole.replace("v ", "v\t").replace("f 1 2 3", "vn 0 0 1\r\nf 1//1 2//1 -22//1"))
    done = run(tmp_path / "small.rig", target, "--expressions", expressions, "--out", out)
    assert done.exit_code == 0, done.output
    assert np.allclose(load_rig(out).offsets[2], 1.2 * rig.offsets[2], atol=0.01)
    out.unlink()
    for spoilt, message in (
        (whole.replace("f 1 2 3", "f 1 2 4"), "expression-2.obj: expected the 1 faces of head.obj, got others"),
        (whole.replace("f 1 2 3\n", ""), "expression-2.obj: expected vertices (v) and faces (f), got 24 and 0"),
        (whole.replace("v ", "v x", 1), "expression-2.obj: "),
        (whole.replace("\nv ", "\nv nan ", 1), "expression-2.obj: expected finite coordinates"),
    ):
        path.write_text(spoilt)
        done = run(tmp_path / "small.rig", target, "--expressions", expressions, "--out", out)
        assert (done.exit_code, out.exists()) == (1, False)
        assert message in done.stderr
        assert len(done.stderr.strip().splitlines()) == 1


def test_the_name_and_the_method_can_be_chosen(tmp_path, rig, expressions):
    out = tmp_path / "made.rig"
    given = ("--expressions", expressions, "--method", "copy", "--name", "Eva 2")
    done = run(tmp_path / "small.rig", "female", "--out", out, *given)
    assert done.exit_code == 0, done.output
    assert load_rig(out).identities == ("Eva-2",)
    assert np.array_equal(load_rig(out).offsets, rig.offsets)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nobody"], "target: expected one of ['female', 'male'] or an OBJ file, got 'nobody'"),
        (["a", "b"], "arguments: expected a template and a target"),
        (["short.obj"], "target: expected shape (24, 3), got (3, 3); it has to be the template's mesh"),
        (["nan.obj"], "nan.obj: expected finite coordinates, got [nan, nan, nan] at vertex 0, and 23 more such"),
        (["male", "--method", "magic"], "method: expected one of"),
        (["male", "--expressions", "nowhere"], "expressions: expected weights.csv of emogen rig pack"),
    ],
)
def test_what_cannot_be_done_is_said_and_nothing_written(tmp_path, rig, words, message, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_obj(tmp_path / "short.obj", np.eye(3))
    write_obj(tmp_path / "nan.obj", np.full((24, 3), np.nan))
    done = run("small.rig", *words, "--out", "made.rig")
    assert done.exit_code == 1
    assert message in done.stderr
    assert "Traceback" not in done.output
    assert not (tmp_path / "made.rig").exists()


def test_a_template_that_is_no_rig_is_named(tmp_path):
    done = run(tmp_path / "no.rig", "male", "--out", tmp_path / "made.rig")
    assert done.exit_code == 1
    assert "no.rig" in done.stderr
    done = run("male", "--out", tmp_path / "nowhere" / "made.rig")
    assert done.exit_code == 1
    assert "expected a folder to write to" in done.stderr


def spoil(folder, old, new):
    path = folder / "weights.csv"
    path.write_text(path.read_text().replace(old, new, 1))


@pytest.mark.parametrize(
    ("spoilt", "message"),
    [
        (
            lambda f: spoil(f, "g0", "smile"),
            "weights.csv: expected columns expression and core shapes of small, each once",
        ),
        (lambda f: spoil(f, "g1R", "g0"), "weights.csv: expected columns"),
        (lambda f: spoil(f, "expression,", "name,"), "weights.csv: expected columns"),
        (lambda f: spoil(f, ",1.0,", ",much,"), "weights.csv: expected 12 weights of expression-1"),
        (lambda f: spoil(f, ",1.0,", ","), "weights.csv: expected 12 weights of expression-1"),
        (lambda f: spoil(f, ",1.0,", ",-1,"), "weights: expected finite weights of 0 and above"),
        (lambda f: spoil(f, ",1.0,", ",nan,"), "weights: expected finite weights of 0 and above"),
        (lambda f: write_obj(f / "grin.obj", np.eye(3)), "named after the expressions of weights.csv"),
        (lambda f: [one.unlink() for one in f.glob("*.obj")], "named after the expressions of weights.csv"),
        (lambda f: write_obj(f / "expression-2.obj", np.eye(3)), "expression-2.obj: expected 24 vertices, got 3"),
    ],
)
def test_expressions_that_do_not_fit_are_named(tmp_path, rig, expressions, spoilt, message):
    spoilt(expressions)
    done = run(tmp_path / "small.rig", "female", "--expressions", expressions, "--out", tmp_path / "made.rig")
    assert done.exit_code == 1
    assert message in done.stderr
    assert not (tmp_path / "made.rig").exists()

"""The fast renderer, on whatever GL this machine has."""

import io
import os
import subprocess
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from emogen_core.correctives.pipeline import shape_weights
from emogen_core.errors import InvalidInputError, MissingGLError, RenderingError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.protocol import SURROUND_DARK, SURROUND_LIGHT, RenderSettings
from emogen_core.rendering.pyrender_backend import PyrenderRenderer
from emogen_core.rendering.setup import look_for, make_renderer

from .ball import ball_rig

pytestmark = pytest.mark.gl

rig = load_bundled_rig()
SIZE = RenderSettings(200, 240)
NEUTRAL = np.zeros((1, len(rig.shape_names)), np.float32)


@pytest.fixture(scope="module")
def renderer():
    renderer, _ = make_renderer("pyrender")
    yield renderer
    renderer.close()


def faces(*each):
    values = np.zeros((len(each), len(rig.genes)))
    for row, genes in zip(values, each, strict=True):
        for name, value in genes.items():
            row[rig.gene_names.index(name)] = value
    return shape_weights(rig, values)


def test_one_face_one_picture(renderer):
    pictures = renderer.draw("female", faces({}, {"mouthSmile": 1}, {"jawOpen": 0.6}), SIZE)
    assert pictures.shape == (3, 240, 200, 3)
    assert pictures.dtype == np.uint8


def test_the_same_weights_give_the_same_bytes(renderer):
    weights = faces({"mouthSmile": 0.7, "browDown": 0.3}, {"jawOpen": 1})
    first = renderer.draw("male", weights, SIZE)
    renderer.draw("african-female-old", weights, RenderSettings(80, 96))
    assert np.array_equal(renderer.draw("male", weights, SIZE), first)
    assert np.array_equal(renderer.draw("male", weights[1:], SIZE)[0], first[1])


def test_a_second_renderer_in_the_same_process_draws_the_same_and_leaves_the_first_alive(renderer):
    before = renderer.draw("female", NEUTRAL, SIZE)
    other, _ = make_renderer("pyrender")
    assert np.array_equal(other.draw("female", NEUTRAL, SIZE), before)
    other.close()
    assert np.array_equal(renderer.draw("female", NEUTRAL, SIZE), before)


def test_another_process_draws_the_same_bytes(renderer, tmp_path):
    script = (
        "import sys, numpy as np\n"
        "from emogen_core.rendering.setup import make_renderer\n"
        "from emogen_core.rendering.protocol import RenderSettings\n"
        "renderer, rig = make_renderer('pyrender')\n"
        "weights = np.zeros((1, len(rig.shape_names)), np.float32)\n"
        "np.save(sys.argv[1], renderer.draw('female', weights, RenderSettings(200, 240)))\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "LP_NUM_THREADS": "0"}
    subprocess.run([sys.executable, "-c", script, tmp_path / "a.npy"], env=environment, check=True, timeout=120)
    assert np.array_equal(np.load(tmp_path / "a.npy"), renderer.draw("female", NEUTRAL, SIZE))


def test_it_draws_in_another_thread_when_made_there():
    pictures = []

    def draw():
        renderer, _ = make_renderer("pyrender")
        pictures.append(renderer.draw("female", NEUTRAL, SIZE))
        renderer.close()

    thread = threading.Thread(target=draw)
    thread.start()
    thread.join(60)
    assert pictures[0].std() > 20


@pytest.mark.parametrize("background", [SURROUND_LIGHT, SURROUND_DARK, (0, 0, 0), (255, 255, 255), (1, 128, 254)])
def test_the_background_is_exactly_the_colour_asked_for(renderer, background):
    picture = renderer.draw("female", NEUTRAL, RenderSettings(200, 240, background))[0]
    assert (picture[:8] == background).all()
    assert (picture[:100, :12] == background).all()
    assert (picture[:100, -12:] == background).all()


def test_the_bust_fades_into_the_background(renderer):
    last = renderer.draw("female", NEUTRAL, RenderSettings(400, 480))[0, -1].astype(int)
    assert np.abs(last - SURROUND_LIGHT).max() < 40


@pytest.mark.parametrize("identity", rig.identities)
def test_the_crown_stands_at_seven_hundredths(renderer, identity):
    picture = renderer.draw(identity, NEUTRAL, RenderSettings(400, 480))[0]
    rows = np.flatnonzero((np.abs(picture.astype(int) - SURROUND_LIGHT).max(2) > 12).any(1))
    assert 0.058 <= rows[0] / 480 <= 0.082


@pytest.mark.parametrize("identity", rig.identities)
def test_every_identity_has_a_face_of_its_own(renderer, identity):
    picture = renderer.draw(identity, NEUTRAL, SIZE)[0].astype(int)
    for other in rig.identities:
        # The paper's two heads look like their nearest presets.
        if other not in {identity, "female", "male"} and identity not in {"female", "male"}:
            assert np.abs(renderer.draw(other, NEUTRAL, SIZE)[0] - picture).mean() > 1.5


def test_neutral_faces_are_nearly_symmetric_but_for_the_light(renderer):
    picture = renderer.draw("female", NEUTRAL, RenderSettings(400, 480))[0].astype(int)
    silhouette = np.abs(picture - SURROUND_LIGHT).max(2) > 20
    assert (silhouette[:300] != silhouette[:300, ::-1]).mean() < 0.01


@pytest.mark.parametrize("gene", [g.name for g in rig.genes if not g.flags & {"disabled"}])
def test_every_gene_can_be_seen(renderer, gene):
    calm, moved = renderer.draw("female", faces({}, {gene: 1}), RenderSettings(400, 480)).astype(int)
    changed = np.abs(moved - calm).max(2) > 10
    assert changed.sum() > 40


def test_leaving_out_what_has_faded_changes_no_picture(renderer, monkeypatch):
    weights = faces({}, {"neckTighten": 1, "jawOpen": 1}, {"mouthDepress": 1, "chinRaise": 1})
    framed = renderer.draw("male", weights, SIZE)
    whole, _ = make_renderer("pyrender")
    monkeypatch.setattr(whole.surface, "framed_skin", lambda *_: look_for(rig).layers["skin"].triangles)
    assert np.array_equal(whole.draw("male", weights, SIZE), framed)
    whole.close()


def test_without_lines_a_face_is_the_one_with_smooth_relief(renderer):
    look, weights = look_for(rig), faces({"browRaise": 1, "mouthSmile": 1, "noseWrinkle": 1})
    smooth = {**look.textures, "relief": grey(128)}
    off = {name: replace(style, wrinkles=0.0) for name, style in look.styles.items()}
    pictures = []
    for changed in (replace(look, textures=smooth), replace(look, styles=off)):
        other = PyrenderRenderer(rig, changed)
        pictures.append(other.draw("female", weights, SIZE))
        other.close()
    assert np.array_equal(*pictures)
    assert np.abs(renderer.draw("female", weights, SIZE).astype(int) - pictures[0]).max() > 12


def grey(level):
    buffer = io.BytesIO()
    Image.new("L", (64, 64), level).resize((1024, 1024)).save(buffer, "PNG")
    return np.frombuffer(buffer.getvalue(), np.uint8)


@pytest.mark.parametrize("identity", ["female", "african-male-old"])
def test_no_gene_leaves_a_black_hole(renderer, identity):
    every = faces(*({gene.name: 1} for gene in rig.genes))
    assert not (renderer.draw(identity, every, SIZE) == 0).all(3).any()


@pytest.mark.parametrize("identity", rig.identities)
@pytest.mark.parametrize("size", [(384, 384), (400, 480)])
def test_no_bust_reaches_the_frame(renderer, identity, size):
    picture = renderer.draw(identity, NEUTRAL, RenderSettings(*size))[0].astype(int)
    for edge in (picture[-1], picture[:, 0], picture[:, -1], picture[0]):
        assert np.abs(edge - SURROUND_LIGHT).max() <= 6


def test_a_refused_face_leaves_the_next_one_whole(renderer):
    before = renderer.draw("female", NEUTRAL, SIZE)
    bad = NEUTRAL.copy()
    bad[0, 0] = np.nan
    for identity, weights in (("female", bad), ("female", NEUTRAL[:, :-1]), ("nobody", NEUTRAL)):
        with pytest.raises(InvalidInputError, match="expected"):
            renderer.draw(identity, weights, SIZE)
    assert np.array_equal(renderer.draw("female", NEUTRAL, SIZE), before)


def test_closed_eyes_hide_the_iris(renderer):
    wide, shut = renderer.draw("caucasian-female-young", faces({}, {"lidsClose": 1}), RenderSettings(400, 480)).astype(
        int
    )
    blue = [((p[..., 2] > p[..., 0] + 10) & (p[..., 2] > 60)).sum() for p in (wide, shut)]
    assert blue[0] > 40
    assert blue[1] < 0.1 * blue[0]


def test_sizes_and_shapes_change_over_its_life(renderer):
    for width, height in ((60, 72), (333, 401), (61, 47), (660, 792), (60, 72)):
        assert renderer.draw("female", NEUTRAL, RenderSettings(width, height)).shape == (1, height, width, 3)


def test_a_foreign_rig_is_drawn_in_flat_colours():
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer

    rig = ball_rig()
    renderer = PyrenderRenderer(rig, plain_look(rig))
    calm, wide = renderer.draw("ball", np.array([[0], [1]], np.float32), SIZE).astype(int)
    covered = [(np.abs(p - SURROUND_LIGHT).max(2) > 12).sum() for p in (calm, wide)]
    assert covered[1] > 1.1 * covered[0] > 0
    renderer.close()


def test_bad_input_is_refused_and_the_renderer_lives_on(renderer):
    with pytest.raises(InvalidInputError):
        renderer.draw("female", NEUTRAL + 2, SIZE)
    with pytest.raises(InvalidInputError):
        renderer.draw("nobody", NEUTRAL, SIZE)
    with pytest.raises(InvalidInputError):
        renderer.draw("female", NEUTRAL[:, :3], SIZE)
    assert renderer.draw("female", NEUTRAL, SIZE).std() > 20


def test_a_closed_renderer_says_so():
    renderer, _ = make_renderer("pyrender")
    renderer.close()
    renderer.close()
    with pytest.raises(RenderingError, match="closed"):
        renderer.draw("female", NEUTRAL, SIZE)


def test_a_look_for_another_topology_is_refused():
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer

    with pytest.raises(InvalidInputError, match="made for the rig"):
        PyrenderRenderer(ball_rig(), look_for(rig))


BROKEN = {
    "no EGL library": "import ctypes.util as u, ctypes as c; u.find_library = lambda n: None\n"
    "real = c.CDLL.__init__\n"
    "def load(self, name, *a, **k):\n"
    "    if name and ('EGL' in str(name) or 'GL' in str(name)): raise OSError('cannot open ' + str(name))\n"
    "    real(self, name, *a, **k)\n"
    "c.CDLL.__init__ = load\n",
    "no vendor": "import os; os.environ['__EGL_VENDOR_LIBRARY_DIRS'] = '/nowhere'\n",
    "no device of that number": "import os; os.environ['EGL_DEVICE_ID'] = '99'\n",
}


@pytest.mark.parametrize("trouble", BROKEN)
def test_missing_gl_is_one_sentence_with_the_remedy(trouble):
    script = BROKEN[trouble] + (
        "from emogen_core.errors import MissingGLError\n"
        "from emogen_core.rendering.setup import make_renderer\n"
        "try:\n    make_renderer('pyrender')\n"
        "except MissingGLError as error:\n    print(error)\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    assert done.stdout.count("\n") == 1
    assert "apt-get install libegl1 libgl1 libgl1-mesa-dri" in done.stdout


def test_a_pool_without_gl_fails_with_that_sentence(monkeypatch):
    from emogen_core.rendering.pool import RenderPool

    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nowhere")
    with pytest.raises(MissingGLError, match="libgl1-mesa-dri"):
        RenderPool(1)


def test_heads_come_and_go_and_their_textures_are_freed(monkeypatch):
    from OpenGL import GL

    from emogen_core.face.appearance import Appearance
    from emogen_core.rendering import pyrender_backend
    from emogen_core.rendering.worn import WornHead

    monkeypatch.setattr(pyrender_backend, "HEADS", 2)
    renderer = PyrenderRenderer(rig, look_for(rig))
    first = renderer.draw("female", NEUTRAL, SIZE)
    textures = []
    for number in range(4):
        document = Appearance(skin_depth=number / 4).to_document()
        renderer.wear(WornHead(f"custom-{number}", rig.neutral("male"), None, document, "male"))
        renderer.draw(f"custom-{number}", NEUTRAL, SIZE)
        textures.append({texture._texid for texture in renderer._pass._mesh_textures})
    assert all(len(bound) <= 6 for bound in textures), "two heads with three textures each"
    assert not any(GL.glIsTexture(gone) for gone in set.union(*textures) - textures[-1])
    assert all(GL.glIsTexture(kept) for kept in textures[-1])
    assert np.array_equal(renderer.draw("female", NEUTRAL, SIZE), first), "what was freed is painted anew"
    renderer.close()

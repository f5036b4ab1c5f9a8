"""Recordings made by hand: the truth about every face is known."""

import numpy as np

from emogen_core.analysis.matching import Judgements
from emogen_core.analysis.recorded import Faces, joined
from emogen_core.correctives.pipeline import shape_weights
from emogen_core.simulation.evaluation.dispersion import Dispersion
from emogen_core.simulation.evaluation.results import Spread
from emogen_core.simulation.evaluation.threshold import Noise, Threshold
from server.analysis.context import Context
from server.analysis.methods import Facts
from server.analysis.reading import Recording
from server.analysis.simulated import Crowd, Simulated, group
from tests.conftest import small_study
from tests.rig_factory import small_rig

RIG = small_rig(genes=12)
GENES, SHAPES = len(RIG.gene_names), len(RIG.shape_names)
GENERATIONS = 3
SEARCH = "a search"
FACTS = Facts(
    "emogen analyse x --seed 1", "1.0", "1.0", "2026-01-01", "A study", "a", "small", "f0", ("c0",), ("emogen/1",),
    "all", "none", 1, 500,
)  # fmt: skip


def template(seed):
    """A face that somebody may have in mind: half of the genes at work."""
    rng = np.random.default_rng(seed)
    return np.where(rng.random(GENES) < 0.5, rng.uniform(0.3, 0.9, GENES), 0.0)


def made(  # noqa: PLR0917 - who, what and how many are clear by their place
    mind, people, seed=1, spread=0.1, name="p", emotion="happy", identity="female", condition="", repetition=0,
    ratings=None,
):  # fmt: skip
    """Faces of people with one face in mind, or (people, G) faces, one each, found with normal errors."""
    rng = np.random.default_rng(seed)
    genes = np.clip(mind + spread * rng.normal(size=(people, GENES)), 0, 1)
    weights = shape_weights(RIG, genes).astype(float)
    return Faces(
        people=[f"{name}{at:02d}" for at in range(people)], emotions=[emotion] * people,
        identities=[identity] * people, conditions=[condition] * people, repetitions=[repetition] * people,
        genes=genes, weights=weights, ratings=ratings or {}, elites=tuple(way(face, rng) for face in weights),
    )  # fmt: skip


def way(face, rng):
    """Faces that come nearer to the finished one in equal steps."""
    begin = rng.uniform(0, 1, SHAPES)
    return np.stack([begin + (face - begin) * at / GENERATIONS for at in range(GENERATIONS)] + [face])


def spread(mean):
    return Spread(mean, 0.05, mean + 0.08, 500)


def noise(level):
    vary = Dispersion(level, 10.0)
    return Noise(spread(level), spread(level + 0.1), spread(level + 0.05), (), 1.0, vary, vary, 0.5, 10.0)


def threshold(level=0.05):
    return Threshold(500, noise(level), noise(level + 0.1), noise(0.6), 0.7, spread(level))


def crowd(size, level=0.05):
    """A group whose distances tell its size and the generation."""
    rough = 1 / (10 * size)
    falling = [level + rough + 0.1 * (GENERATIONS - at) for at in range(GENERATIONS + 1)]
    return Crowd(tuple(map(spread, falling)), tuple(spread(one + 0.1) for one in falling))


def recording(*parts, searches=None, judgements=None):
    """What was recorded, as if it were read from an export; `searches` gives each part the key of its search."""
    faces = joined(*parts)
    keys = np.repeat(searches or [SEARCH] * len(parts), list(map(len, parts)))
    ids = tuple(f"f{at}" for at in range(len(faces)))
    nothing = Judgements(np.array([], str), np.array([], str), np.zeros((0, SHAPES)), np.array([], bool))
    return Recording(
        title="A study", study="a", faces=faces, face_ids=ids, trials=tuple(f"t{at}" for at in range(len(faces))),
        searches=keys, seeds=("1",) * len(faces),
        configs={key: small_study(generations=GENERATIONS) for key in dict.fromkeys(keys.tolist())},
        studies=(), config_hashes=("c0",), algorithms=("emogen/1",), counted=faces.person_count, simulated=0,
        left_out={"not complete": 2}, judgements=judgements or nothing, chosen=faces,
    )  # fmt: skip


def context(*parts, levels=None, seed=1, **more):
    """An analysis; `levels` gives each search its noise."""
    told = recording(*parts, **more)
    levels = levels or {}
    thresholds = {key: threshold(levels.get(key, 0.05)) for key in told.configs}
    groups = {group(told, cell) for cell in told.faces.only(repetition=0).cells}
    crowds = {(key, size): crowd(size, levels.get(key, 0.05)) for key, size in groups}
    return Context(told, RIG, Simulated(thresholds, crowds), corrected, seed, None)


def corrected(_identity, genes):
    return shape_weights(RIG, genes[None])[0]


def rows(section, sheet=None):
    """The rows of a section's table, or of one of its files, as dictionaries."""
    one = section.sheet if sheet is None else next(file for file in section.files if file.name == sheet)
    names = [column.name for column in one.columns]
    assert len(set(names)) == len(names), names
    return [dict(zip(names, row, strict=True)) for row in one.rows]

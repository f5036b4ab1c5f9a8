"""Tables of every kind with invented numbers, what draws their faces, and a reader of the page."""

from __future__ import annotations

import io
from html.parser import HTMLParser

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.simulation.evaluation.table import Cluster, Column, Finding, Heat, PlaneMap, Row, Table, Whisker
from server.evaluation.faces import Studio
from server.evaluation.report import Facts

FACTS = Facts("emogen evaluate --quick --seed 7", "0.1.0", "small", "ab12" * 16, "female", 1200, 7)
VOID = {"meta", "img", "br", "link", "input", "path", "rect"}


RIG = load_bundled_rig()


class PlainRenderer:
    """Draws every face as one colour that is its own; counts."""

    def __init__(self):
        self.drawn = 0

    def draw(self, identity, weights, settings):
        self.drawn += len(weights)
        shade = (weights * np.arange(1, weights.shape[1] + 1)).sum(1) * 37 % 200
        return np.broadcast_to(
            shade.astype(np.uint8)[:, None, None, None], (len(weights), settings.height, settings.width, 3)
        )


def studio(renderer=None):
    return Studio(RIG, "female", renderer or PlainRenderer())


def face(*open_):
    """Full weights with some of the first shapes."""
    weights = np.zeros(len(RIG.offsets), np.float32)
    weights[: len(open_)] = open_
    return weights


def errors(rng, searches=40, generations=10):
    """Cosine distances that fall."""
    return rng.beta(4, 6, (searches, generations + 1)) * np.linspace(1, 0.4, generations + 1)


def noise(seed=3):
    """One with what the paper found, in part, distributions, curves and faces."""
    rng = np.random.default_rng(seed)
    runs = {label: errors(rng) for label in ("target 1", "mean <happy>")}
    rows = (
        *(Row(label, (one[:, -1].mean(), one[:, -1].std()), (0.2, 0.1643)) for label, one in runs.items()),
        Row("threshold", (1234.5678,), (None, 0.065)),
    )
    return Table(
        "noise", "Noise of the search", "Table V", (Column("mean"), Column("sd", 2, "of all <searches>")), rows,
        findings=(
            Finding("The error falls & stays.", "It falls by 0.1.", True),
            Finding("It ends at 0.2.", "It ends at 0.3.", False),
        ),
        why="this face has more shapes", notes=("100 searches for the last row.",), errors=runs,
        curves={label: np.geomspace(2, 0.001 * (at + 1), 10) for at, label in enumerate(runs)},
        heats=tuple(Heat(label, face(0.2, 0.1 * at), face(0.5, 0, 0.5)) for at, label in enumerate(runs)),
    )  # fmt: skip


def clouds(seed=4):
    """One with maps, and no number of the paper."""
    rng = np.random.default_rng(seed)

    def cluster(x):
        points = rng.normal((x, 0), (1, 0.2), (30, 2))
        return Cluster(points, points.mean(0), np.cov(points.T))

    maps = {
        metric: PlaneMap({"target 1": cluster(0), "target 2": cluster(4)}, (0.614, 0.213))
        for metric in ("cosine", "vertex_rms")
    }
    rows = (Row("cosine, target 1", (30.0, 0.0)), Row("cosine, target 2", (1.0, None)))
    return Table(
        "separability", "Which metric tells targets apart", "Table I", (Column("cluster 1", 0), Column("cluster 2", 0)),
        rows, findings=(Finding("The cosine separates best.", "It does.", True),), maps=maps,
    )  # fmt: skip


def settings():
    """One that is not in the paper, with rows that are drawn side by side."""
    rows = tuple(
        Row(label, numbers)
        for label, numbers in (
            ("as the paper", (0.244, 0.053, 0.31, 0.071)),
            ("generations 5", (0.293, 0.057, 0.35, None)),
            ("no answer at all", (0.33, None, None, None)),
        )
    )
    columns = tuple(Column(name) for name in ("mean", "sd", "mean, noise .1", "sd, noise .1"))
    return Table(
        "settings", "Choosing settings", "", columns, rows, why="More generations help.",
        whiskers=(Whisker("never errs", 0, 1), Whisker("noise .1", 2, 3)),
    )  # fmt: skip


def threshold():
    """The one whose sentence is cited."""
    return Table(
        "threshold", "How far apart two faces have to be", "", (Column("most"),), (Row("never errs", (0.352,)),),
        why="Two faces of one person lie less than 0.352 apart in 19 of 20 cases.",
        notes=("500 searches for each kind of participant.", "And more."),
    )  # fmt: skip


def every():
    return [noise(), clouds(), settings(), threshold()]


class Seen(HTMLParser):
    """What a page has: elements with their attributes and texts, and the text as it is read."""

    def __init__(self, page):
        super().__init__()
        self.elements = []
        self._open = []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        element = {"tag": tag, "attributes": dict(attrs), "text": ""}
        self.elements.append(element)
        if tag not in VOID:
            self._open.append(element)

    def handle_startendtag(self, tag, attrs):
        self.elements.append({"tag": tag, "attributes": dict(attrs), "text": ""})

    def handle_endtag(self, tag):
        while self._open and self._open.pop()["tag"] != tag:
            pass

    def handle_data(self, data):
        for element in self._open:
            element["text"] += data

    def all(self, tag, class_=None):
        """Return the elements of a name, and of a class."""
        return [
            one
            for one in self.elements
            if one["tag"] == tag and (class_ is None or class_ in (one["attributes"].get("class") or "").split())
        ]

    def texts(self, tag, class_=None):
        return [" ".join(one["text"].split()) for one in self.all(tag, class_)]


def lines(text):
    """Return the lines of a CSV file as they were written."""
    return io.StringIO(text, newline="")

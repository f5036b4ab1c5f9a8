"""A packing of the bundled rig, drawn by nobody."""

import numpy as np

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.transfer.packing.pack import Options
from server.packing.facts import Facts, document
from server.packing.making import make
from server.packing.studio import Studio

RIG = load_bundled_rig()
OPTIONS = Options(most=3)
MADE = make(RIG, "male", OPTIONS)
DOCUMENT = document(MADE, OPTIONS, Facts("emogen rig pack --max=3", "9.9", RIG.name, RIG.hash, "male"))


class FlatRenderer:
    """Draws every face as one colour that depends on its weights; counts, and says whether it was closed."""

    def __init__(self):
        self.drawn, self.closed = [], False

    def draw(self, identity, weights, settings):
        self.drawn.append((identity, weights[0]))
        shade = np.uint8(int(weights.sum() * 37) % 200)
        return np.full((1, settings.height, settings.width, 3), shade)

    def close(self):
        self.closed = True


def studio(front=None, turned=None):
    return Studio(RIG, "male", front or FlatRenderer(), turned or FlatRenderer())

"""A renderer whose pictures tell what was asked of it, and that hangs or dies on demand. For the pool's tests."""

import os
import time
from pathlib import Path

import numpy as np

from emogen_core.errors import InvalidInputError, MissingGLError


class FakeRenderer:
    """Identity "head" draws; the others name the trouble that they make."""

    def __init__(self):
        self.heads, self.told = {}, 0

    def wear(self, head):
        if head.like == "refused":
            raise InvalidInputError("appearance: expected an object, got 3")
        self.heads[head.name] = head
        self.told += 1

    def drop(self, name):
        del self.heads[name]

    def draw(self, identity, weights, settings):
        if identity.startswith("custom-"):
            assert identity in self.heads, "a head was drawn that had not been handed over"
            assert len(self.heads) <= 16
            weights = np.full_like(weights, self.told / 255)
        if identity == "slow":
            time.sleep(0.15)
        if identity == "hang":
            time.sleep(60)
        if identity == "die":
            os._exit(3)
        if identity == "bug":
            raise ZeroDivisionError("a bug")
        if identity == "die once" and not (flag := Path(os.environ["FAKE_BACKEND_FLAG"])).exists():
            flag.touch()
            os._exit(3)
        if (weights > 1).any():
            raise InvalidInputError("weights: expected values in [0, 1], got 2.0")
        picture = np.round(weights[:, :1, None, None] * 255).astype(np.uint8)
        return np.broadcast_to(picture, (len(weights), settings.height, settings.width, 3))

    def close(self):
        pass


def make():
    return FakeRenderer()


def without_gl():
    raise MissingGLError("Faces cannot be drawn: this machine offers no OpenGL through EGL.")


def broken():
    raise ValueError("cannot start")


def stuck():
    time.sleep(60)

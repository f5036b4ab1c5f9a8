"""A renderer whose pictures tell what was asked of it, and that hangs or dies on demand. For the pool's tests."""

import os
import time
from pathlib import Path

import numpy as np

from emogen_core.errors import InvalidInputError, MissingGLError


class FakeRenderer:
    """Identity "head" draws; the others name the trouble that they make."""

    def draw(self, identity, weights, settings):
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

"""Heads between and around the presets: what sliders do one by one, and random heads at rest and happy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.face.identity import Identity
from emogen_core.face.space import ANCESTRIES
from emogen_core.face.space_file import load_bundled_space
from emogen_core.rigs.contact import PORTRAIT, arranged, captioned
from emogen_core.rigs.head_portrait import draw_head
from emogen_core.rigs.random_heads import random_head

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from PIL import Image

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

    Tile = tuple[str, Identity, str]

COLUMNS = 6
AGES = (18, 25, 40, 55, 70, 90)
DETAILS = ("head-width", "head-fat", "nose-width", "mouth-width", "brow-height", "lip-lower")
RANDOM_HEADS = 9
_EMOTION = "happy"
# From one ancestry preset to the next and back to the first.
_HALVES = (
    (1.0, 0.0, 0.0), (0.5, 0.5, 0.0), (0.0, 1.0, 0.0), (0.0, 0.5, 0.5), (0.0, 0.0, 1.0), (0.5, 0.0, 0.5),
)  # fmt: skip


def head_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw ladders of age, sex, weight, ancestry and some details, then random heads, each at rest and happy."""
    space = load_bundled_space()
    ladders = [*_macros(), *_details()]
    randoms = (random_head(space, seed) for seed in range(1, RANDOM_HEADS + 1))
    pairs = [(_told(head, emotion), head, emotion) for head in randoms for emotion in ("", _EMOTION)]
    pictures = (
        (caption, draw_head(renderer, rig, space, head, PORTRAIT.settings, emotion))
        for caption, head, emotion in (*ladders, *pairs)
    )
    return arranged([captioned([picture], caption) for caption, picture in pictures], COLUMNS)


def _macros() -> Iterator[Tile]:
    for years in AGES:
        yield _tile(f"age {years}", {"age": float(years)})
    for share in np.linspace(0, 1, COLUMNS):
        yield _tile(f"sex {share:.1f}, age 30", {"sex": share, "age": 30.0})
    for weight in np.linspace(-1, 1, COLUMNS):
        yield _tile(f"weight {weight:+.1f}, sex 1, age 40", {"weight": weight, "sex": 1.0, "age": 40.0})
    for shares in _HALVES:
        mix = dict(zip(ANCESTRIES, shares, strict=True))
        caption = ", ".join(f"{name} {share:g}" for name, share in mix.items() if share)
        yield _tile(f"{caption}, age 35", {"sex": 0.5, "age": 35.0, **mix})


def _details() -> Iterator[Tile]:
    for place, name in enumerate(DETAILS):
        base = {"sex": float(place % 2), "age": 35.0}
        for value in (-1.0, 0.0, 1.0):
            yield _tile(f"{name} {value:+g}" if value else f"{name} 0", {**base, name: value})


def _told(head: Identity, emotion: str) -> str:
    return f"{head.name}: sex {head.head['sex']:.1f}, age {head.head['age']:.0f}{emotion and f', {emotion}'}"


def _tile(caption: str, point: Mapping[str, float]) -> Tile:
    return caption, Identity(caption, {name: float(value) for name, value in point.items()}), ""

"""All contact sheets of a rig, so that somebody can look at everything: `emogen rig sheet`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.correctives.collision.regions import has_regions
from emogen_core.errors import InvalidInputError, expected
from emogen_core.rendering.setup import make_renderer
from emogen_core.rigs.collision_sheet import collision_sheet
from emogen_core.rigs.combination_sheet import combination_sheet
from emogen_core.rigs.contact import FACE, PORTRAIT, QUALITY, Frame, Tile, contact_sheet
from emogen_core.rigs.head_sheet import head_sheet
from emogen_core.rigs.look.sheet import appearance_sheet
from emogen_core.rigs.random_faces import random_genes
from emogen_core.rigs.wrinkle_sheet import wrinkle_sheet

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from PIL import Image

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.protocol import Renderer

    Sheet = Callable[[Renderer, Rig], Image.Image]

RANDOM_FACES = 20
_SEED = 2021
# Heads that differ in everything the grid of presets has.
FOUR = ("female", "male", "asian-female-old", "african-male-young")
_LARGE = Frame(300, FACE.part)


def make_sheets(
    out_dir: Path, backend: str = "pyrender", only: Sequence[str] = (), rig: Path | None = None
) -> list[Path]:
    """Draw sheets of a rig as JPEG files.

    Args:
        out_dir: the folder to write to; made if need be.
        backend: which renderer draws.
        only: names among `SHEETS`; all that fit the rig if none is named.
        rig: a rig file, with its look beside it; the bundled one by default.

    Returns:
        The files, each named after its sheet.

    Raises:
        InvalidInputError: an unknown sheet, or one that the rig has nothing for.
        MissingGLError: ``pyrender`` on a machine without OpenGL.
        RigFileError: a file is missing or damaged.
    """
    unknown = [name for name in only if name not in SHEETS]
    if unknown:
        raise InvalidInputError(f"sheets: {expected(f'names among {list(SHEETS)}', unknown)}")
    out_dir.mkdir(parents=True, exist_ok=True)
    renderer, model = make_renderer(backend, rig)
    fitting = [name for name in SHEETS if rig is None or _fits(name, model)]
    if unfit := sorted(set(only) - set(fitting)):
        raise InvalidInputError(f"sheets: {expected(f'of this rig {fitting}', unfit)}")
    paths = []
    for name in only or fitting:
        paths.append(out_dir / f"{name}.jpg")
        SHEETS[name](renderer, model).save(paths[-1], quality=QUALITY)
    renderer.close()
    return paths


def _fits(sheet: str, rig: Rig) -> bool:
    """Return whether a sheet shows what any rig has, or what this one has."""
    needs = {"combinations": bool(rig.combinations), "collisions": has_regions(rig)}
    return sheet not in _OF_THE_BUNDLED and needs.get(sheet, True)


def genes_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw every gene at 1 on two heads."""
    return contact_sheet(renderer, rig, _genes(rig), 10, FACE)


def identities_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw every head at rest."""
    nothing = np.zeros(len(rig.genes))
    return contact_sheet(renderer, rig, (Tile(name, name, nothing) for name in rig.identities), 7, PORTRAIT)


def emotions_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw every emotion set at full strength on four heads, a row a head."""
    heads = [name for name in FOUR if name in rig.identities] or rig.identities[: len(FOUR)]
    return contact_sheet(renderer, rig, _emotions(rig, heads), 1 + len(rig.emotion_sets), _LARGE)


def all_emotions_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw every emotion set at full strength on every head, a row a head."""
    return contact_sheet(renderer, rig, _emotions(rig, rig.identities), 1 + len(rig.emotion_sets), FACE)


def random_sheet(renderer: Renderer, rig: Rig) -> Image.Image:
    """Draw twenty corrected random faces."""
    return contact_sheet(renderer, rig, _random(rig), 5, PORTRAIT)


# Name of the file and what draws it; a sheet more is a line more.
SHEETS: dict[str, Sheet] = {
    "genes": genes_sheet,
    "identities": identities_sheet,
    "heads": head_sheet,
    "appearance": appearance_sheet,
    "emotions": emotions_sheet,
    "emotions-all": all_emotions_sheet,
    "wrinkles": wrinkle_sheet,
    "random": random_sheet,
    "combinations": combination_sheet,
    "collisions": collision_sheet,
}
# What these draw is written for the bundled heads.
_OF_THE_BUNDLED = frozenset({"heads", "appearance", "wrinkles"})


def _genes(rig: Rig) -> Iterator[Tile]:
    for identity in rig.identities[:2]:
        yield Tile(identity, "neutral", np.zeros(len(rig.genes)))
        for row, gene in zip(np.eye(len(rig.genes)), rig.genes, strict=True):
            yield Tile(identity, f"{gene.name} {'+'.join(gene.action_units)}", row)


def _emotions(rig: Rig, heads: Sequence[str]) -> Iterator[Tile]:
    for identity in heads:
        yield Tile(identity, identity, np.zeros(len(rig.genes)))
        for emotion in rig.emotion_sets:
            yield Tile(identity, emotion, rig.emotion_genes(emotion))


def _random(rig: Rig) -> Iterator[Tile]:
    # Where the eyes look tells little about a face, and a row of squints hides what the rest does.
    for number, genes in enumerate(random_genes(rig, RANDOM_FACES, _SEED, without={"gaze"})):
        identity = rig.identities[number % len(rig.identities)]
        yield Tile(identity, f"{number + 1} {identity}", genes)

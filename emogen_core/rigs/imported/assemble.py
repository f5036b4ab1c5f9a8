"""A foreign head made into a rig and its look: the order of the steps, and nothing else.

read -> genes -> left like right -> eyes that turn -> the bundled head laid over it -> parts of the flesh -> heads
-> lids that close -> correctives -> mouths that stay shut -> look
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig import Rig
from emogen_core.rendering.plain import plain_look
from emogen_core.rendering.setup import bundled_look
from emogen_core.rigs.foreign.mirror import mirrored, permutation
from emogen_core.rigs.foreign.names import meaning
from emogen_core.rigs.foreign.read import read_head
from emogen_core.rigs.imported.combined import with_combinations
from emogen_core.rigs.imported.dressed import Dresser
from emogen_core.rigs.imported.emotions import emotion_sets
from emogen_core.rigs.imported.evened import evened, say_evened
from emogen_core.rigs.imported.front import Front
from emogen_core.rigs.imported.gaze import SIDES, Eyeball, find_eyeball, with_turning_eyes
from emogen_core.rigs.imported.genes import GeneShapes, make_genes
from emogen_core.rigs.imported.heads import FIRST, mixed_head, random_weights
from emogen_core.rigs.imported.lids import with_fitted_lids
from emogen_core.rigs.imported.lying import EYES, bundled_on, skin_of
from emogen_core.rigs.imported.match import islands, islands_of
from emogen_core.rigs.imported.mouth import drop_of, freed, lower_side, with_collision_correctives
from emogen_core.rigs.imported.overlay import Skin
from emogen_core.rigs.imported.parts import FLESH, Parts, pieces, sort_parts
from emogen_core.rigs.imported.shut import with_shut_mouths
from emogen_core.rigs.rest import BROWS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rendering.look import Look
    from emogen_core.rigs.foreign.model import Findings, HeadModel
    from emogen_core.rigs.foreign.read import ReadHead

    Floats = NDArray[np.float64]

# Part of the flesh -> in how many pieces it is.
_HOLLOWS = {"mouth": 1, "sockets": 2}
# Millimetres within which vertices are mirror images. Where it matters, at lips and teeth, collisions look closer.
_SYMMETRIC = 0.3


@dataclass(frozen=True)
class Wishes:
    """What an import is told beside the files.

    Attributes:
        name: of the rig; that of the file or folder by default.
        unit: of the lengths, as `foreign.read.read_head`.
        neutral: the neutral's name in a folder of OBJs.
        wears: the bundled identity whose skin, eyes and hair the head has.
        heads: name -> weights of identity modes, for each head beside the neutral.
        random: how many random heads there are beside these.
        seed: of the random heads.
        combinations: whether correctives of pairs of genes are derived, which takes minutes.
    """

    name: str = ""
    unit: str = ""
    neutral: str = ""
    wears: str = "female"
    heads: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    random: int = 0
    seed: int = 1
    combinations: bool = True


@dataclass(frozen=True, eq=False)
class Imported:
    """A rig that was not stored yet, its look, its identity modes, and what its user is told."""

    rig: Rig
    look: Look
    findings: Findings
    modes: Mapping[str, NDArray[np.float32]] = field(default_factory=dict)


def import_head(path: Path, wishes: Wishes, tell: Callable[[str], object] = str) -> Imported:
    """Make a rig and a look of a foreign head.

    Args:
        path: an ICT-FaceKit folder, a folder of OBJ files, or a ``.glb`` or ``.gltf`` file.
        wishes: what it shall be called, and which heads it has.
        tell: is told what takes long when it begins, once the head is known to be good.

    Raises:
        InvalidInputError: it cannot become a rig; the message says what was expected, what was found and what to do.
    """
    template, look = load_bundled_rig(), bundled_look()
    if wishes.wears not in look.styles:
        raise InvalidInputError(f"wears: {expected(f'one of {sorted(look.styles)}', wishes.wears)}")
    head = read_head(path, wishes.unit, wishes.neutral)
    made, mirror = make_genes(head), _mirror(head.model, head.findings)
    made = replace(made, shapes=_evened(made, mirror, head.findings))
    parts = _parts(head)
    eyes = _eyes(head.model, parts)
    drop = drop_of(made.shapes, parts.vertices(*FLESH), len(head.model.vertices))
    front = Front(head.model.vertices.astype(np.float64), parts.of(*FLESH), parts.of(*EYES), drop)
    warped = bundled_on(template, wishes.wears, front, head.findings)
    if warped:
        parts = _classified(parts, look, front, warped)
    shapes = with_turning_eyes(head.model.vertices, made.shapes, eyes, head.findings)
    rig = replace(_bare(head, replace(made, shapes=shapes), parts, wishes), mirror=mirror)
    if warped:
        rig = replace(rig, regions={BROWS: _brows(template, warped, rig)})
    rig = with_fitted_lids(rig, eyes, head.findings)
    if wishes.combinations:
        tell("Correctives are derived, which takes some minutes.")
        rig = with_combinations(rig, made.correctives, eyes, head.findings)
    rig = with_collision_correctives(rig, drop, head.findings)
    # What is derived of symmetric shapes is symmetric but for hundredths of a millimetre.
    even = evened(dict(zip(rig.shape_names, rig.offsets, strict=True)), rig.mirror)
    rig = freed(replace(rig, offsets=np.stack([*even.values()])), drop, head.findings)
    rig = with_shut_mouths(rig, lower_side(drop), head.findings)
    if not warped:
        return Imported(rig, plain_look(rig), head.findings, head.model.identity_modes)
    dresser = Dresser(rig, look, template, warped, skin_of(front), eyes)
    return Imported(rig, dresser.dressed(wishes.wears, front.edges()), head.findings, head.model.identity_modes)


def _parts(head: ReadHead) -> Parts:
    return sort_parts(head.model, head.regions.get("teeth_upper", np.zeros(0, np.int32)))


def _eyes(model: HeadModel, parts: Parts) -> dict[str, Eyeball]:
    rows = {side: parts.vertices(f"eye_{side}") for side in SIDES}
    return {side: find_eyeball(model.vertices, own) for side, own in rows.items() if len(own) > 8}


def _evened(made: GeneShapes, mirror: NDArray[np.int32], findings: Findings) -> dict[str, NDArray[np.float32]]:
    shapes = evened(made.shapes, mirror)
    say_evened(made.shapes, shapes, findings)
    return shapes


def _brows(template: Rig, warped: Skin, rig: Rig) -> NDArray[np.int32]:
    """Return the vertices of a rig's skin that lie nearest to those under the bundled brows."""
    skin = np.unique(rig.triangles[slice(*rig.parts["skin"])])
    points = warped.vertices[template.regions[BROWS]]
    return np.unique(skin[cKDTree(rig.neutral(FIRST)[skin]).query(points)[1]]).astype(np.int32)


def _classified(parts: Parts, look: Look, front: Front, warped: Skin) -> Parts:
    """Return parts in which mouth and sockets are told from the skin, by where the bundled head has them."""
    missing = [name for name in FLESH if name not in parts.named]
    if not missing:
        return parts
    skin = parts.of("skin")
    template = islands(look.layers["skin"], warped)
    allowed = {name: np.full(len(skin), name == "skin" or name in missing) for name in FLESH}
    number = islands_of(Skin(front.vertices, skin, front.drop), template, allowed)
    part = np.array(template.part)[number]
    for name, count in _HOLLOWS.items():
        # Nostrils and ears are hollow too, and no mouths.
        inside = np.flatnonzero(part == name)
        piece = pieces(skin[inside])
        largest = np.argsort(-np.bincount(piece, minlength=1), kind="stable")[:count]
        part[inside[~np.isin(piece, largest)]] = "skin"
    split = {name: np.concatenate([skin[part == name], parts.of(name)[:0]]) for name in ("skin", *missing)}
    return parts.with_flesh({**{name: parts.of(name) for name in FLESH}, **split})


def _bare(head: ReadHead, made: GeneShapes, parts: Parts, wishes: Wishes) -> Rig:
    """Return the rig without correctives."""
    triangles, rows = parts.sorted()
    model, findings = head.model, head.findings
    emotions = emotion_sets(made.genes, findings)
    return Rig(
        name=wishes.name or model.name,
        genes=made.genes,
        core_shapes=tuple(made.shapes),
        combinations=(),
        collision_shapes=(),
        emotion_sets=emotions,
        offsets=np.stack([*made.shapes.values()]).astype(np.float32),
        neutrals=_neutrals(model, parts, wishes, findings),
        triangles=triangles,
        parts=rows,
    )


def _neutrals(model: HeadModel, parts: Parts, wishes: Wishes, findings: Findings) -> dict[str, NDArray[np.float32]]:
    eyes = parts.vertices(*EYES)
    generator = np.random.default_rng(wishes.seed)
    chosen = dict(wishes.heads)
    if wishes.random and not model.identity_modes:
        wanted = "a model with identity modes for other heads"
        raise InvalidInputError(f"heads: {expected(wanted, model.name)}; leave the heads out")
    for number in range(wishes.random):
        chosen[f"random-{number + 1}"] = random_weights(model.identity_modes, generator)
    neutrals = {FIRST: model.vertices}
    for name, weights in chosen.items():
        neutrals[name] = mixed_head(model.vertices, model.identity_modes, weights, eyes)
    if model.identity_modes:
        findings.found.append(
            f"{len(neutrals)} heads of {len(model.identity_modes)} identity modes, each from -2 to 2."
        )
    return neutrals


def _mirror(model: HeadModel, findings: Findings) -> NDArray[np.int32]:
    """Return which vertex mirrors which, or none where one of them has no mirror image."""
    jaw = next((moved for name, moved in model.expressions.items() if meaning(name).standard == "jawOpen"), None)
    found = permutation(model.vertices, mirrored(model.vertices, jaw), _SYMMETRIC)
    if found is not None:
        findings.found.append("The head is its own mirror image.")
        return found.astype(np.int32)
    findings.missing.append("The head is not its own mirror image: symmetric faces may be corrected a little unevenly.")
    return np.zeros(0, np.int32)

"""Which part of the base mesh is the head, and how its render mesh hangs on the base mesh's vertices.

Everything but the eyeballs is one sparse matrix times the base mesh's 19,158 vertices, so identities and units, which
are given on those, carry over by the same product. The eyeballs are spheres of their own (`eyeballs.py`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csr_array, vstack

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.base_mesh import EYE_CENTRE, MILLIMETRES, components, load_base_mesh
from emogen_core.rigs.eyeballs import eyeball
from emogen_core.rigs.grids import grid_of, grid_triangles
from emogen_core.rigs.refine import bend, refine
from emogen_core.rigs.teeth import LOWER_WIDTHS, UPPER_WIDTHS, tooth_strip

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.rigs.base_mesh import BaseMesh
    from emogen_core.rigs.refine import Refined
    from emogen_core.rigs.source import Source

PARTS = ("skin", "mouth", "sockets", "tongue", "teeth_upper", "teeth_lower", "lashes", "eye_left", "eye_right")
HEAD_QUADS = 4570
# Skin quads whose flat edges or middle lie further off the smooth surface than this are split in four, down to the
# neck: half a pixel of a 480 pixels high portrait. Where a portrait shows the outline, half as much, and what would
# still show after one step is split again: a step leaves a quarter.
FACET_MILLIMETRES = 0.25
FACET_BOTTOM = -130.0
_OUTLINE_FACET, _STEP_LEAVES = 0.20, 0.25
# The outline: seen at a slant from anywhere within 30 degrees of the front, and above the jaw. The back of the head is
# never seen.
_SLANT, _BACK, _OUTLINE_BOTTOM = 0.45, -0.45, -115.0

# The tongue's tip, which leaves the mouth, is rounded as skin is.
_TIP_OF_TONGUE = 2.0

_CROP_BOTTOM, _CROP_SIDE = 5.05, 1.75
_SOCKET_RINGS = 3
_ISLANDS = {3116: "skin", 470: "skin", 398: "mouth", 293: "sockets"}


@dataclass(frozen=True)
class HeadGeometry:
    """The render mesh of every identity: N vertices welded within a part, T triangles.

    ``skin``, ``mouth`` and ``sockets`` share their rim vertices; every other part stands alone.

    Attributes:
        mesh: the base mesh (its ``uv`` is what ``corner_uv`` was interpolated from).
        operator: (N, 19158) weights: render vertices = operator @ base vertices; the eyeballs' rows are empty.
        triangles: (T, 3) int32, counter-clockwise from outside.
        parts: part -> (first, last + 1) row of ``triangles``; the names are `PARTS`.
        mirror: (N,) mirror image of every vertex.
        corner_uv: (T, 3, 2) base.obj's texture coordinates of skin, mouth, sockets and tongue; 0 elsewhere.
        surface: (N, 3) coordinates on the surface of the parts without texture coordinates, else 0. Teeth: tooth
            (0, 1.. to the left, -1, -2.. to the right), across it in [-1, 1], down it (0.34 gum, 1 edge, 2 inside).
            Lashes: strip (0 upper left, 1 upper right, 2 lower left, 3 lower right), along it from the inner
            corner in [0, 1], root 0 to tip 1. Eyeballs: degrees from the axis, azimuth (see `eyeballs.py`), 0.
        positions: (N, 3) millimetres, the base mesh's own head: the frame in which masks and textures are painted.
    """

    mesh: BaseMesh
    operator: csr_array
    triangles: NDArray[np.int32]
    parts: Mapping[str, tuple[int, int]]
    mirror: NDArray[np.intp]
    corner_uv: NDArray[np.float32]
    surface: NDArray[np.float32]
    positions: NDArray[np.float64]

    def part_vertices(self, *names: str) -> NDArray[np.intp]:
        """Return the sorted vertices of some parts."""
        return np.unique(np.concatenate([self.triangles[slice(*self.parts[name])].ravel() for name in names]))

    def assemble(self, base: NDArray[np.float64], eye_centre: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the (N, 3) render mesh of an identity: base vertices and left eye centre in millimetres."""
        vertices = np.asarray(self.operator @ base, np.float64)
        for part, side in (("eye_left", 1), ("eye_right", -1)):
            vertices[self.part_vertices(part)] = (eyeball()[0] + eye_centre) * (side, 1, 1)
        return vertices

    def offsets(self, base: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the (N, 3) offsets of a unit given on the base mesh, millimetres; eyeballs stay."""
        return np.asarray(self.operator @ base, np.float64)


@dataclass(frozen=True, slots=True)
class _Piece:
    """A part before it is numbered into the whole."""

    part: str
    operator: csr_array
    triangles: NDArray[np.intp]
    mirror: NDArray[np.intp]
    surface: NDArray[np.float64]


@lru_cache(maxsize=2)
def build_geometry(source: Source) -> HeadGeometry:
    """Cut the head out of the base mesh, refine it, and add teeth, lashes and eyeballs."""
    mesh = load_base_mesh(source)
    pieces = _strips(mesh)
    skin, parts = _surface(mesh)
    base, first = skin.operator.shape[0], len(skin.triangles)
    rows, faces, images, surface = [skin.operator], [skin.triangles], [skin.mirror], [np.zeros((base, 3))]
    for piece in pieces:
        rows.append(piece.operator)
        faces.append(piece.triangles + base)
        images.append(piece.mirror + base)
        surface.append(piece.surface)
        parts[piece.part] = (parts.get(piece.part, (first,))[0], first + len(piece.triangles))
        base, first = base + piece.operator.shape[0], first + len(piece.triangles)
    padding = np.zeros((first - len(skin.triangles), 3, 2))
    whole = HeadGeometry(
        mesh,
        csr_array(vstack(rows)),
        np.concatenate(faces).astype(np.int32),
        parts,
        _swap_eyes(np.concatenate(images)),
        np.concatenate([skin.corner_uv, padding]).astype(np.float32),
        np.concatenate(surface).astype(np.float32),
        np.zeros((base, 3)),
    )
    whole.positions[:] = whole.assemble(mesh.canonical(), EYE_CENTRE * (1, 0, 0) * MILLIMETRES)
    return whole


def head_quads(mesh: BaseMesh) -> dict[str, tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Return part -> (quads, uv quads) of skin, mouth, sockets and tongue.

    Body quads above the chest are taken, then those connected to the nose; the texture's islands tell the parts.

    Raises:
        InvalidInputError: the crop is not the known head.
    """
    body, uv = mesh.quads["body"], mesh.uv_quads["body"]
    centre = mesh.vertices[body].mean(1)
    near = (centre[:, 1] > _CROP_BOTTOM) & (np.abs(centre[:, 0]) < _CROP_SIDE)
    body, uv = body[near], uv[near]
    piece = components(body, len(mesh.vertices))
    head = piece == piece[centre[near, 2].argmax()]
    if head.sum() != HEAD_QUADS:
        raise InvalidInputError(f"head: {expected(f'{HEAD_QUADS} quads', int(head.sum()))}")
    body, uv = body[head], uv[head]
    island = components(uv, len(mesh.uv))
    sizes = dict(zip(*(a.tolist() for a in np.unique(island, return_counts=True)), strict=True))
    label = np.array([_ISLANDS[sizes[i]] for i in island.tolist()])
    kept = {part: label == part for part in ("skin", "mouth", "sockets")}
    kept["sockets"] = _near_rim(body, kept["sockets"], kept["skin"])
    parts = {part: (body[rows], uv[rows]) for part, rows in kept.items()}
    parts["tongue"] = (mesh.quads["helper-tongue"], mesh.uv_quads["helper-tongue"])
    return parts


def _near_rim(quads: NDArray[np.intp], sockets: NDArray[np.bool_], skin: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the socket quads within a few rings of the lid's rim; the rest lies behind the eyeball."""
    reached = np.unique(quads[skin])
    near = np.zeros(len(quads), bool)
    for _ in range(_SOCKET_RINGS):
        near |= sockets & np.isin(quads, reached).any(1)
        reached = np.union1d(reached, quads[near])
    return near


def _surface(mesh: BaseMesh) -> tuple[Refined, dict[str, tuple[int, int]]]:
    """Return the refined skin, mouth, sockets and tongue, triangles sorted by part, and the parts."""
    found = head_quads(mesh)
    quads, uv = (np.concatenate([pair[i] for pair in found.values()]) for i in (0, 1))
    label = np.repeat(np.arange(len(found)), [len(pair[0]) for pair in found.values()])
    left = np.flatnonzero(mesh.vertices[quads].mean(1)[:, 0] > 0)
    right_quads, right_uv = _twins(mesh, quads, uv, left)
    positions = mesh.canonical()
    skin, tongue = (label[left] == PARTS.index(part) for part in ("skin", "tongue"))
    tip = tongue & (positions[quads[left], 2].mean(1) > _TIP_OF_TONGUE)
    levels = _levels(quads[left], right_quads, positions)
    wanted = levels * skin + np.minimum(levels, 1) * tip
    coordinates = mesh.uv[uv[left]], mesh.uv[right_uv]
    refined = refine(quads[left], right_quads, coordinates, wanted, positions)
    part = label[left][refined.quad]
    order = np.argsort(part, kind="stable")
    ends = np.searchsorted(part[order], np.arange(len(found) + 1))
    parts = {name: (int(ends[i]), int(ends[i + 1])) for i, name in enumerate(found)}
    sorted_by_part = replace(
        refined,
        triangles=refined.triangles[order],
        quad=refined.quad[order],
        corner_uv=refined.corner_uv[order],
    )
    return sorted_by_part, parts


def _levels(left: NDArray[np.intp], right: NDArray[np.intp], positions: NDArray[np.float64]) -> NDArray[np.intp]:
    """Return (Q,) how often the left half's skin quads have to be split."""
    facets = bend(np.concatenate([left, right]), positions)[: len(left)]
    corners = positions[left]
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    forward = normal[:, 2] / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    height = corners[:, :, 1].mean(1)
    outline = (forward < _SLANT) & (forward > _BACK) & (height > _OUTLINE_BOTTOM)
    once = (height > FACET_BOTTOM) & (facets > np.where(outline, _OUTLINE_FACET, FACET_MILLIMETRES))
    twice = outline & (_STEP_LEAVES * facets > _OUTLINE_FACET)
    return np.asarray(once.astype(np.intp) + twice, np.intp)


def _twins(
    mesh: BaseMesh, quads: NDArray[np.intp], uv: NDArray[np.intp], left: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the mirror images of the left quads, corner by corner, with their own uv."""
    index = {frozenset(row): i for i, row in enumerate(quads.tolist())}
    images = mesh.mirror[quads[left]]
    found = np.array([index[frozenset(row)] for row in images.tolist()])
    corner = (quads[found][:, None, :] == images[:, :, None]).argmax(-1)
    return images, np.take_along_axis(uv[found], corner, 1)


def _strips(mesh: BaseMesh) -> list[_Piece]:
    teeth = [
        _teeth(mesh, "teeth_upper", "helper-upper-teeth", UPPER_WIDTHS),
        _teeth(mesh, "teeth_lower", "helper-lower-teeth", LOWER_WIDTHS),
    ]
    return [*teeth, _lashes(mesh), _eye("eye_left", len(mesh.vertices)), _eye("eye_right", len(mesh.vertices))]


def _teeth(mesh: BaseMesh, part: str, group: str, widths: tuple[float, ...]) -> _Piece:
    weights, grid, surface = tooth_strip(mesh, group, widths)
    # The rows run down in the upper jaw and up in the lower one; the halves are cut along mirrored diagonals.
    right = grid[:: 1 if part == "teeth_upper" else -1, : grid.shape[1] // 2 + 1]
    mirror = grid[:, ::-1].ravel()
    triangles = grid_triangles(right)
    both = np.concatenate([triangles, mirror[triangles][:, ::-1]])
    return _Piece(part, csr_array(weights), both, mirror, surface)


def _lashes(mesh: BaseMesh) -> _Piece:
    """Return four strips: upper left, upper right, lower left, lower right."""
    grids = [_lash_grid(mesh, f"helper-l-eyelashes-{number}") for number in (2, 1)]
    sources = np.concatenate([part.ravel() for grid in grids for part in (grid, mesh.mirror[grid])])
    surface, triangles, mirror = [], [], []
    base = 0
    for strip, grid in enumerate((grids[0], grids[0], grids[1], grids[1])):
        local = base + np.arange(grid.size).reshape(grid.shape)
        triangles.append(grid_triangles(local)[:, :: -1 if strip in (0, 3) else 1])
        mirror.append(local.ravel() + (grid.size if strip % 2 == 0 else -grid.size))
        t, s = np.meshgrid(*(np.linspace(0, 1, n) for n in grid.shape), indexing="ij")
        surface.append(np.stack([np.full(grid.size, strip), s.ravel(), t.ravel()], 1))
        base += grid.size
    pointer = np.arange(len(sources) + 1)
    operator = csr_array((np.ones(len(sources)), sources, pointer), shape=(len(sources), len(mesh.vertices)))
    return _Piece("lashes", operator, np.concatenate(triangles), np.concatenate(mirror), np.concatenate(surface))


def _lash_grid(mesh: BaseMesh, group: str) -> NDArray[np.intp]:
    """Return a left strip as (root to tip, inner to outer corner)."""
    grid = grid_of(mesh.quads[group])
    points = mesh.vertices[grid]
    grid = grid if points[0, :, 2].mean() < points[-1, :, 2].mean() else grid[::-1]
    return grid if points[0, 0, 0] < points[0, -1, 0] else grid[:, ::-1]


def _eye(part: str, source_vertices: int) -> _Piece:
    points, triangles, degrees = eyeball()
    surface = np.concatenate([degrees, np.zeros((len(points), 1))], 1)
    faces = triangles if part == "eye_left" else triangles[:, ::-1]
    return _Piece(part, csr_array((len(points), source_vertices)), faces, np.arange(len(points)), surface)


def _swap_eyes(mirror: NDArray[np.intp]) -> NDArray[np.intp]:
    """Let the eyeballs, the last two pieces, be each other's mirror image."""
    count = len(eyeball()[0])
    own = mirror[-2 * count :].copy()
    return np.concatenate([mirror[: -2 * count], own[count:], own[:count]])

"""From the bundled rig and the CC0 sources to `head.look`."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image
from scipy.ndimage import maximum_filter1d
from scipy.spatial import cKDTree

from emogen_core.rendering.composer import Composer
from emogen_core.rendering.look import HAIR_DEPTH, Layer, Look, save_look, style_of, topology_hash
from emogen_core.rigs.head_mesh import build_geometry
from emogen_core.rigs.look import wrinkles
from emogen_core.rigs.look.atlas import SKIN_PARTS, TONGUE, build_atlas
from emogen_core.rigs.look.bake import bake
from emogen_core.rigs.look.canvas import make_canvas, sample_mask, step
from emogen_core.rigs.look.eyes import LASH_REACH
from emogen_core.rigs.look.paint import make_paint, scalp
from emogen_core.rigs.look.presets import presets
from emogen_core.rigs.look.seen import seen_layers
from emogen_core.rigs.look.zones import skin_fields

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rigs.head_mesh import HeadGeometry
    from emogen_core.rigs.look.atlas import Atlas
    from emogen_core.rigs.look.canvas import Canvas
    from emogen_core.rigs.source import Source

PAINTED, SHIPPED = 2048, 1024
_FAR_FROM_LIDS = 0.2  # decimetres
# How far a lid's margin may lie from its inner rim: sideways, up and down, and forward, millimetres.
_COLUMN, _LEVEL, _MARGIN = 1.2, 1.3, 5.0
# From how many millimetres of its way down a lid's skin counts as rolled up, and how much of its shadow that takes.
_ROLLED, _UNROLLED = (0.3, 2.5), 0.75


def build_look(  # noqa: PLR0913 - the last three by keyword
    rig: Rig,
    source: Source,
    path: Path,
    *,
    only: Sequence[str] | None = None,
    painted: int = PAINTED,
    progress: Callable[[str], None] = lambda _: None,
) -> Look:
    """Paint and bake the bundled head's look and store it.

    Args:
        rig: the bundled rig.
        source: the CC0 data that the rig was built from.
        path: the file to write.
        only: identities to bake light for; all by default. Identities left out wear the first one's style.
        painted: size at which layers are painted before they are reduced.
        progress: is told what is being done.

    Returns:
        The look as stored, with its hash.
    """
    progress("laying out")
    geometry = build_geometry(source)
    lips, ears = (_mask(source, name) for name in ("lips", "ears"))
    atlas = build_atlas(geometry, _gloss(geometry, lips))
    progress("painting")
    canvas = make_canvas(geometry, atlas, painted)
    lids, occlusion = _lid_distances(geometry, atlas, canvas, rig), _canvas_occlusion(rig, atlas, canvas)
    paint = make_paint(canvas, skin_fields(canvas, lips, ears, lids, occlusion), ears, min(painted, SHIPPED))
    place = (geometry.positions[atlas.layers["skin"].source] / 100).astype(np.float32)
    on_skin = atlas.layers["skin"].surface[:, 0] == 1
    layers, left = seen_layers(rig, atlas.layers)
    kept = left["skin"]
    paint["scalp"] = scalp(place, sample_mask(ears, atlas.body_uv), on_skin)[kept]
    chosen = {name: look for name, look in presets().items() if only is None or name in only}
    styles, baked = {}, {}
    composer = Composer(paint)
    for name, appearance in chosen.items():
        progress(f"tracing light on {name}")
        light = _relaxed(_unrolled(bake(rig, name), rig), atlas, geometry, lips)[kept]
        baked[name] = np.column_stack([light, composer.hair(appearance) / HAIR_DEPTH])
        styles[name] = style_of(name, appearance, composer.tone(appearance))
    look = Look(
        name="emogen head",
        topology=topology_hash(rig),
        layers=layers,
        styles=styles,
        default=next(iter(chosen)),
        textures={"relief": _relief(canvas)},
        bakes=baked,
        wrinkle_masks=(wrinkles.masks(place) * on_skin[:, None])[kept],
        wrinkle_drivers=wrinkles.drivers(),
        wrinkle_rest=wrinkles.rests(),
        edges=_edges(geometry, rig),
        paint=paint,
    )
    return replace(look, hash=save_look(path, look))


def _mask(source: Source, name: str) -> NDArray[np.float32]:
    with Image.open(io.BytesIO(source.read(f"mpfb2/textures/mpfb_{name}.jpg"))) as picture:
        return np.asarray(picture.convert("L"), np.float32) / np.float32(255)


def _relief(canvas: Canvas) -> NDArray[np.uint8]:
    """Return the relief of all expression lines as the bytes of a PNG file."""
    buffer = io.BytesIO()
    grey = Image.fromarray(wrinkles.relief(canvas)).resize((SHIPPED, SHIPPED), Image.Resampling.BOX)
    grey.save(buffer, "PNG", optimize=True)
    return np.frombuffer(buffer.getvalue(), np.uint8)


def _vertex_uv(geometry: HeadGeometry) -> NDArray[np.float32]:
    """Return (N, 2): one of the texture coordinates in base.obj's layout of every skin vertex."""
    rows = slice(*geometry.parts["skin"])
    uv = np.zeros((len(geometry.positions), 2), np.float32)
    uv[geometry.triangles[rows].ravel()] = geometry.corner_uv[rows].reshape(-1, 2)
    return uv


def _gloss(geometry: HeadGeometry, lips: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (N,): lips, nose and forehead shine, the scalp and the neck hardly."""
    x, y, z = (geometry.positions / 100).T
    nose = np.exp(-((x / 0.14) ** 2 + ((y + 0.30) / 0.20) ** 2))
    forehead = np.exp(-((x / 0.40) ** 2 + ((y - 0.42) / 0.22) ** 2))
    cheek = np.exp(-(((np.abs(x) - 0.42) / 0.20) ** 2 + ((y + 0.22) / 0.16) ** 2))
    face = 0.42 + 0.22 * nose + 0.12 * forehead + 0.10 * cheek
    gloss = np.where(z > -0.6, face, 0.35) * step(y, -1.5, -1.1)
    lip = sample_mask(lips, _vertex_uv(geometry)) * (y < -0.4)
    gloss = np.maximum(gloss, 0.72 * lip)
    inside = geometry.part_vertices(*(name for name in SKIN_PARTS if name != "skin"))
    only_inside = np.setdiff1d(inside, geometry.part_vertices("skin"))
    gloss[only_inside] = 1.0
    return np.asarray(gloss.clip(0, 1), np.float32)


def _unrolled(light: NDArray[np.float32], rig: Rig) -> NDArray[np.float32]:
    """Return (N, 3) baked light, lifted on skin that is rolled up above an open eye and spread over a closed one."""
    closing = sum(np.abs(rig.offsets[rig.shape_names.index(f"lidsClose.{side}")]) for side in "LR")[:, 1]
    lift = _UNROLLED * step(closing, *_ROLLED)
    lifted = light.copy()
    lifted[:, :2] += (1 - light[:, :2]) * lift[:, None]
    return lifted


def _relaxed(
    light: NDArray[np.float32], atlas: Atlas, geometry: HeadGeometry, lips: NDArray[np.float32]
) -> NDArray[np.float32]:
    """Return (R, 3) baked light, lifted where it would look like dirt or make-up: lips, upper lids, teeth."""
    source = atlas.layers["skin"].source
    x, y, z = (geometry.positions[source] / 100).T
    light = light[source].copy()
    skin = atlas.layers["skin"].surface[:, 0] == 1
    lip = sample_mask(lips, atlas.body_uv) * skin
    sulcus = np.exp(-(((np.abs(x) - 0.27) / 0.18) ** 2 + ((y - 0.105) / 0.085) ** 2)) * skin * (z > -0.3)
    for column, of_lips, of_sulcus in ((0, 0.60, 0.80), (1, 0.60, 0.86)):
        lift = 1 - (1 - of_lips * lip) * (1 - of_sulcus * sulcus)
        light[:, column] += (1 - light[:, column]) * lift
    kind = atlas.layers["skin"].surface[:, 0]
    deep, teeth = kind < 0.85, kind < 0.2
    light[deep, 0] = 0.22 + 0.78 * light[deep, 0]
    light[teeth, 0] = 0.74 + 0.26 * light[teeth, 0]
    light[kind == TONGUE, 0] = 0.45 + 0.55 * light[kind == TONGUE, 0]
    light[deep, 1] = np.maximum(light[deep, 1], 0.62 * light[deep, 0])
    return light


def _lid_distances(geometry: HeadGeometry, atlas: Atlas, canvas: Canvas, rig: Rig) -> NDArray[np.float32]:
    """Return (3, M) decimetres to the inner edge of the lids, to the roots of upper and of lower lashes.

    They are measured on open eyes, where texels are; skin that is rolled up there near the lashes, but far from them
    when the eye is shut, is as far as then.
    """
    opened = geometry.positions
    shut = opened + sum(rig.offsets[rig.shape_names.index(f"lidsClose.{side}")] for side in "LR")
    source = atlas.layers["skin"].source
    before, after = (_to_lids(geometry, positions, positions[source] / 100) for positions in (opened, shut))
    more = _spread(atlas, canvas, np.maximum(after - before, 0).T).T
    return np.asarray(np.minimum(_to_lids(geometry, opened, canvas.place) + more, np.float32(_FAR_FROM_LIDS)))


def _to_lids(
    geometry: HeadGeometry, positions: NDArray[np.floating], places: NDArray[np.floating]
) -> NDArray[np.float32]:
    """Return (3, n) decimetres from (n, 3) places to rims and lashes of a head whose vertices are at ``positions``."""
    rim = np.intersect1d(geometry.part_vertices("skin"), geometry.part_vertices("sockets"))
    ways = [positions[rim], *(_lash_roots(geometry, positions, strips) for strips in ((0, 1), (2, 3)))]
    trees = [cKDTree(way / 100) for way in ways]
    apart = [tree.query(places, distance_upper_bound=_FAR_FROM_LIDS, workers=-1)[0] for tree in trees]
    return np.minimum(np.asarray(apart, np.float32), np.float32(_FAR_FROM_LIDS))


def _lash_roots(geometry: HeadGeometry, positions: NDArray[np.floating], strips: Sequence[int]) -> NDArray[np.float64]:
    """Return (n, 3) places close together along the lower edge of strips of lashes, as far as lashes grow."""
    vertices = geometry.part_vertices("lashes")
    strip, along, up = geometry.surface[vertices].T
    dense = np.linspace(*LASH_REACH, 80)
    lines = []
    for number in strips:
        edge = np.flatnonzero((strip == number) & (up < 1e-6))
        edge = edge[np.argsort(along[edge])]
        line = positions[vertices[edge]]
        lines.append(np.stack([np.interp(dense, along[edge], line[:, axis]) for axis in range(3)], 1))
    return np.concatenate(lines)


def _canvas_occlusion(rig: Rig, atlas: Atlas, canvas: Canvas) -> NDArray[np.float32]:
    """Return (M,) occlusion of the default identity at the texels, by the nearest of the layer's vertices."""
    light = _unrolled(bake(rig, rig.identities[0]), rig)[atlas.layers["skin"].source, :1]
    return _spread(atlas, canvas, light)[:, 0]


def _spread(atlas: Atlas, canvas: Canvas, values: NDArray[np.floating]) -> NDArray[np.float32]:
    """Return (M, c) at the texels of (R, c) values at the skin layer's vertices, from the nearest three."""
    layer: Layer = atlas.layers["skin"]
    uv = np.column_stack([canvas.at % canvas.size + 0.5, canvas.size - canvas.at // canvas.size - 0.5]) / canvas.size
    distance, nearest = cKDTree(layer.uv).query(uv, k=3, workers=-1)
    weight = 1 / np.maximum(distance, 1e-5)
    return np.asarray((values[nearest] * weight[..., None]).sum(1) / weight.sum(1)[:, None], np.float32)


def _edges(geometry: HeadGeometry, rig: Rig) -> dict[str, NDArray[np.int32]]:
    """Return the edges of lids and lips, by x: lips where skin becomes mouth, lids where they end towards the light."""
    lids, lips = (
        np.intersect1d(geometry.part_vertices("skin"), geometry.part_vertices(part)) for part in ("sockets", "mouth")
    )
    x = geometry.positions[:, 0]
    return {
        **_margins(geometry, rig, _split(geometry, "left", lids[x[lids] > 0])),
        **_margins(geometry, rig, _split(geometry, "right", lids[x[lids] < 0])),
        **_split(geometry, "mouth", lips),
    }


def _margins(geometry: HeadGeometry, rig: Rig, rims: dict[str, NDArray[np.int32]]) -> dict[str, NDArray[np.int32]]:
    """Return for each inner rim of a lid, which rests on the eyeball, the margin in front of it, which moves."""
    skin, place = geometry.part_vertices("skin"), geometry.positions
    closing = sum(np.abs(rig.offsets[rig.shape_names.index(f"lidsClose.{side}")]) for side in "LR")[:, 1]
    margins = {}
    for name, rim in rims.items():
        upper = name.endswith("upper")
        chosen = []
        for vertex in rim:
            away = place[skin] - place[vertex]
            near = skin[(np.abs(away[:, 0]) < _COLUMN) & (np.abs(away[:, 1]) < _LEVEL) & (np.abs(away[:, 2]) < _MARGIN)]
            chosen.append(near[(closing if upper else place[:, 2])[near].argmax()])
        found = np.unique(chosen)
        found = found[np.argsort(place[found, 0], kind="stable")]
        # Where the mesh has no vertex on the margin, something behind it was found: its neighbours move more.
        moved = closing[found]
        margins[name] = found[2 * moved >= maximum_filter1d(moved, 3) * upper].astype(np.int32)
    return margins


def _split(geometry: HeadGeometry, name: str, rim: NDArray[np.intp]) -> dict[str, NDArray[np.int32]]:
    """Cut a closed rim at the line between its corners."""
    places = geometry.positions[rim]
    ends = places[[places[:, 0].argmin(), places[:, 0].argmax()]]
    level = np.interp(places[:, 0], ends[:, 0], ends[:, 1])
    order = np.argsort(places[:, 0], kind="stable")
    halves = {"upper": places[:, 1] >= level - 1e-9, "lower": places[:, 1] <= level + 1e-9}
    return {f"{name}_{half}": rim[order][chosen[order]].astype(np.int32) for half, chosen in halves.items()}

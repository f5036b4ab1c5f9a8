"""The look as a value: what a rig's head looks like. Colour, occlusion, wrinkles; never its shape.

Heads share layers of paint; what an identity wears is composed from them by its `Appearance` when it is asked for.

A look dresses one topology: its layers say for every vertex that is drawn (a *render vertex*) which vertex of the rig
it follows, so a rig vertex on a texture seam becomes several render vertices. Layers are drawn in order: the skin with
all that lies in the mouth, the eyeballs, the lashes.

Symbols: ``R`` render vertices of a layer, ``G`` wrinkle groups.
"""

from __future__ import annotations

import hashlib
import io
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.appearance import Appearance
from emogen_core.face.arrays import integers
from emogen_core.face.container import read_as, write_container
from emogen_core.rendering.composer import Composer
from emogen_core.rendering.look_check import check_look

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

KIND = "look"
VERSION = 2
LAYERS = ("skin", "eyes", "lashes")
HAIR_DEPTH = 32.0  # millimetres


@dataclass(frozen=True)
class Layer:
    """One mesh that is drawn.

    Attributes:
        source: (R,) int32, the rig vertex that a render vertex follows.
        uv: (R, 2) float32 texture coordinates, origin at the lower left.
        triangles: (t, 3) int32 into the render vertices.
        surface: (R, 3) float32 in [0, 1]: how much it is skin, how glossy, how deep inside the mouth.
    """

    source: NDArray[np.int32]
    uv: NDArray[np.float32]
    triangles: NDArray[np.int32]
    surface: NDArray[np.float32]


@dataclass(frozen=True)
class Style:
    """What one identity wears.

    Attributes:
        skin, eyes, lashes: names of textures: stored ones, or ``skin-NAME``, ``eyes-NAME``, ``lashes-NAME``, which are
            composed from the appearance of the style NAME.
        bake: name of the baked light.
        tone: mean sRGB colour of the skin, 0 to 1; shine is broken up where the texture departs from it.
        lash: sRGB colour of the lashes.
        wrinkles: how strongly expression lines show, 0 to 1.
        lines: how much of them is there at rest, 0 to 1.
        shine: strength of the skin's highlights.
        appearance: what its textures are composed from; none where they are stored.
    """

    skin: str
    eyes: str
    lashes: str
    bake: str
    tone: tuple[float, float, float]
    lash: tuple[float, float, float] = (0.1, 0.07, 0.06)
    wrinkles: float = 0.55
    lines: float = 0.0
    shine: float = 1.0
    appearance: Appearance | None = None


@dataclass(frozen=True)
class Look:
    """How a head of one topology is dressed.

    Attributes:
        name: short name.
        hash: SHA-256 of its content, hexadecimal.
        topology: `topology_hash` of the rigs that it fits.
        layers: layer name -> mesh, in drawing order.
        styles: identity -> what it wears.
        default: the identity whose style is worn by heads that the look does not know.
        textures: name -> bytes (uint8) of a WebP or PNG file; ``relief`` is the grey wrinkle relief of the skin.
        bakes: name -> (R, 4) float32 in [0, 1] of the skin layer: ambient occlusion, sight of the key light,
            translucency, and the hair's thickness in units of `HAIR_DEPTH`.
        wrinkle_masks: (R, G) float32, where each wrinkle group shows on the skin layer.
        wrinkle_drivers: for each group, shape name -> gain.
        wrinkle_rest: for each group, how much of `Style.lines` shows there, 0 to 1; all of it where this is empty.
        edges: ``left_upper``, ``left_lower``, ``right_upper``, ``right_lower`` (lids), ``mouth_upper``, ``mouth_lower``
            (inner edges of the lips) -> rig vertices, by x. May be empty: then eyes and mouth have no moving shadow.
        paint: layers that textures are composed from, see `emogen_core.rendering.composer`; empty where all are stored.
    """

    name: str
    topology: str
    layers: Mapping[str, Layer]
    styles: Mapping[str, Style]
    default: str
    textures: Mapping[str, NDArray[np.uint8]]
    bakes: Mapping[str, NDArray[np.float32]]
    wrinkle_masks: NDArray[np.float32]
    wrinkle_drivers: tuple[Mapping[str, float], ...] = ()
    wrinkle_rest: tuple[float, ...] = ()
    edges: Mapping[str, NDArray[np.int32]] = field(default_factory=dict)
    paint: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    hash: str = ""

    def style(self, identity: str) -> Style:
        """Return what an identity wears; an identity unknown to the look wears the default's style."""
        return self.styles.get(identity, self.styles[self.default])

    def texture(self, name: str, mode: str = "RGB") -> NDArray[np.uint8]:
        """Return a texture as (h, w) or (h, w, channels) uint8, in one of Pillow's modes.

        A composed one takes a fraction of a second each time: whoever draws keeps it.

        Raises:
            InvalidInputError: there is no such texture.
        """
        if name in self.textures:
            with Image.open(io.BytesIO(self.textures[name].tobytes())) as picture:
                return np.asarray(picture.convert(mode))
        return np.asarray(Image.fromarray(self._composed(name)).convert(mode))

    @cached_property
    def composer(self) -> Composer:
        """What composes textures from this look's paint. Raises `RigFileError` where paint is missing."""
        return Composer(self.paint)

    def with_style(self, name: str, appearance: Appearance, bake: str | None = None) -> Look:
        """Return this look with one more identity in it, dressed in an appearance.

        The hash stays that of the file: whoever names portraits has to put the appearance into the identity's name.

        Args:
            name: the identity.
            appearance: its skin, eyes and hair.
            bake: name of the baked light that it borrows: that of the head nearest in shape; by default the default's.

        Raises:
            InvalidInputError: there is no such bake.
            RigFileError: this look has no paint.
        """
        bake = self.styles[self.default].bake if bake is None else bake
        if bake not in self.bakes:
            raise InvalidInputError(f"bake: {expected(f'one of {sorted(self.bakes)}', bake)}")
        hair = self.composer.hair(appearance)[:, np.newaxis] / np.float32(HAIR_DEPTH)
        light = np.hstack([self.bakes[bake][:, :3], hair])
        style = style_of(name, appearance, self.composer.tone(appearance))
        return self.changed(styles={**self.styles, name: style}, bakes={**self.bakes, name: light})

    def changed(self, **fields: Any) -> Look:
        """Return this look with some fields changed, the paint not among them: what was decoded is shared."""
        look = replace(self, **fields)
        if "composer" in self.__dict__:
            look.__dict__["composer"] = self.composer
        return look

    def _composed(self, name: str) -> NDArray[np.uint8]:
        kind, _, identity = name.partition("-")
        style = self.styles.get(identity)
        if kind not in LAYERS or style is None or style.appearance is None:
            raise InvalidInputError(f"texture: {expected(f'one of {sorted(self.textures)} or of a style', name)}")
        compose = {"skin": self.composer.skin, "eyes": self.composer.eye, "lashes": self.composer.lashes}[kind]
        return compose(style.appearance)

    def check(self, rig: Rig) -> None:
        """Raise `InvalidInputError` unless this look fits the rig."""
        vertices = 1 + max(int(layer.source.max(initial=-1)) for layer in self.layers.values())
        if topology_hash(rig) != self.topology or vertices > rig.offsets.shape[1]:
            raise InvalidInputError(f"look: {expected(f'one made for the rig {rig.name!r}', self.name)}")


def style_of(name: str, appearance: Appearance, tone: tuple[float, float, float]) -> Style:
    """Return the style of an identity that wears an appearance; ``tone`` is the mean colour of its cheeks, 0 to 1."""
    look = appearance
    lash = tuple(round(0.72 * (c + (165 - c) * 0.5 * look.grey) / 255, 4) for c in look.brow_colour)
    return Style(
        skin=f"skin-{name}",
        eyes=f"eyes-{name}",
        lashes=f"lashes-{name}",
        bake=name,
        tone=tone,
        lash=(lash[0], lash[1], lash[2]),
        # Young skin folds nearly as deeply as old skin while it moves; on deep skin the same fold shows less.
        wrinkles=round(min(1.0, 0.84 + 0.16 * look.lines + 0.16 * look.skin_depth), 4),
        lines=round(0.30 * look.lines, 4),
        shine=round(1.0 - 0.20 * look.lines, 4),
        appearance=appearance,
    )


def topology_hash(rig: Rig) -> str:
    """Return the SHA-256 of a rig's triangles and parts: what a look has to know of a rig."""
    digest = hashlib.sha256(np.ascontiguousarray(rig.triangles, "<i4").tobytes())
    digest.update(repr(sorted((name, *map(int, rows)) for name, rows in rig.parts.items())).encode())
    return digest.hexdigest()


def save_look(path: Path, look: Look) -> str:
    """Store a look in a container and return its hash; masks are kept in 8 bits, texture coordinates in 16."""
    document: dict[str, Any] = {
        "name": look.name,
        "topology": look.topology,
        "default": look.default,
        "styles": {name: _style_document(style) for name, style in look.styles.items()},
        "wrinkle_drivers": [dict(drivers) for drivers in look.wrinkle_drivers],
        "wrinkle_rest": list(look.wrinkle_rest),
    }
    arrays: dict[str, NDArray[Any]] = {"wrinkle_masks": _bytes(look.wrinkle_masks)}
    for name, layer in look.layers.items():
        arrays[f"layers/{name}/source"] = layer.source
        arrays[f"layers/{name}/uv"] = np.round(layer.uv * 65535).astype(np.uint16)
        arrays[f"layers/{name}/triangles"] = layer.triangles
        arrays[f"layers/{name}/surface"] = _bytes(layer.surface)
    arrays |= {f"textures/{name}": data for name, data in look.textures.items()}
    arrays |= {f"bakes/{name}": _bytes(bake) for name, bake in look.bakes.items()}
    arrays |= {f"edges/{name}": rows for name, rows in look.edges.items()}
    arrays |= {f"paint/{name}": layer for name, layer in look.paint.items()}
    return write_container(path, KIND, VERSION, document, arrays)


def load_look(path: Path) -> Look:
    """Read a look and verify it.

    Raises:
        RigFileError: damaged, foreign, of another version, or its content contradicts itself.
    """
    look = read_as(path, KIND, VERSION, _look)
    check_look(look)
    return look


def _look(document: dict[str, Any], arrays: dict[str, NDArray[Any]], digest: str) -> Look:
    return Look(
        name=document["name"],
        topology=document["topology"],
        default=document["default"],
        layers={name: _layer(arrays, name) for name in LAYERS if f"layers/{name}/source" in arrays},
        styles={name: _style(values) for name, values in document["styles"].items()},
        textures={n: integers(arrays, f"textures/{n}", 1, np.uint8) for n in _folder(arrays, "textures")},
        bakes={n: _floats(integers(arrays, f"bakes/{n}", 2, np.uint8)) for n in _folder(arrays, "bakes")},
        wrinkle_masks=_floats(integers(arrays, "wrinkle_masks", 2, np.uint8)),
        wrinkle_drivers=tuple(dict(drivers) for drivers in document["wrinkle_drivers"]),
        # Files from before this was told apart have none.
        wrinkle_rest=tuple(document.get("wrinkle_rest", ())),
        edges={n: integers(arrays, f"edges/{n}", 1, np.int32) for n in _folder(arrays, "edges")},
        paint=_folder(arrays, "paint"),
        hash=digest,
    )


def _style_document(style: Style) -> dict[str, Any]:
    values = {name: getattr(style, name) for name in Style.__dataclass_fields__}
    return {**values, "appearance": style.appearance and style.appearance.to_document()}


def _style(values: dict[str, Any]) -> Style:
    worn = values["appearance"]
    appearance = None if worn is None else Appearance.from_document(worn)
    return Style(**{**values, "tone": tuple(values["tone"]), "lash": tuple(values["lash"]), "appearance": appearance})


def _layer(arrays: Mapping[str, NDArray[Any]], name: str) -> Layer:
    place = f"layers/{name}"
    return Layer(
        source=integers(arrays, f"{place}/source", 1, np.int32),
        uv=(integers(arrays, f"{place}/uv", 2, np.uint16) / 65535).astype(np.float32),
        triangles=integers(arrays, f"{place}/triangles", 2, np.int32),
        surface=_floats(integers(arrays, f"{place}/surface", 2, np.uint8)),
    )


def _folder(arrays: Mapping[str, NDArray[Any]], folder: str) -> dict[str, NDArray[Any]]:
    start = f"{folder}/"
    return {name.removeprefix(start): array for name, array in arrays.items() if name.startswith(start)}


def _bytes(values: NDArray[np.float32]) -> NDArray[np.uint8]:
    return np.round(np.clip(values, 0, 1) * 255).astype(np.uint8)


def _floats(values: NDArray[np.uint8]) -> NDArray[np.float32]:
    return np.divide(values, 255, dtype=np.float32)

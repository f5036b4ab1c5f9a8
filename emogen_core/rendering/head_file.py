"""Head files: a fitted head, to the bit, kept once it has been made.

The algebra of another processor fits the same point of the space otherwise by tenths of a millimetre at the lips, and
what collides follows from there. What was measured on a head has to stay on that head, wherever the data goes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import RigFileError, expected
from emogen_core.face.appearance import Appearance
from emogen_core.face.container import read_as, write_container
from emogen_core.face.rig import Adjustment
from emogen_core.rendering.worn import WornHead

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

KIND = "head"
VERSION = 1


def save_head(head: WornHead, rig: Rig, path: Path) -> None:
    """Store a head that was fitted to a rig.

    Raises:
        RigFileError: it does not fit the rig, or the file cannot be written.
    """
    _check(head, rig)
    document = {"name": head.name, "rig": rig.hash, "like": head.like, "appearance": dict(head.appearance)}
    arrays: dict[str, NDArray[Any]] = {"neutral": head.neutral}
    if head.adjustment is not None:
        arrays |= {"shapes": head.adjustment.shapes.astype(np.int32), "offsets": head.adjustment.offsets}
    write_container(path, KIND, VERSION, document, arrays)


def load_head(path: Path, rig: Rig) -> WornHead:
    """Read a head back.

    Raises:
        RigFileError: not a head file of this version, damaged, or of a head that was fitted to another rig.
    """
    document, head = read_as(path, KIND, VERSION, lambda document, arrays, _: (document, _head(document, arrays)))
    _need(document["rig"] == rig.hash, f"one that was fitted to the rig {rig.hash}", document["rig"])
    _check(head, rig)
    return head


def _head(document: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> WornHead:
    look = Appearance.from_document(document["appearance"]).to_document() if document["appearance"] else {}
    adjustment = Adjustment(arrays["shapes"].astype(np.intp), arrays["offsets"]) if "shapes" in arrays else None
    return WornHead(str(document["name"]), arrays["neutral"], adjustment, look, str(document["like"]))


def _check(head: WornHead, rig: Rig) -> None:
    mesh = rig.offsets.shape[1:]
    _check_lengths("a neutral mesh", head.neutral, mesh)
    _need(head.like in rig.neutrals, f"the light of one of {sorted(rig.neutrals)}", head.like)
    if head.adjustment is None:
        return
    shapes = head.adjustment.shapes
    known = shapes.ndim == 1 and set(shapes.tolist()) <= set(range(len(rig.shape_names)))
    _need(known and len(np.unique(shapes)) == len(shapes), "shapes of the rig, each once", shapes.tolist())
    _check_lengths("offsets", head.adjustment.offsets, (len(shapes), *mesh))


def _check_lengths(what: str, lengths: NDArray[Any], shape: tuple[int, ...]) -> None:
    good = lengths.dtype == np.float32 and lengths.shape == shape and bool(np.isfinite(lengths).all())
    _need(good, f"{what} {shape} of finite float32", f"{lengths.dtype} {lengths.shape}")


def _need(condition: bool, what: str, got: object) -> None:
    if not condition:
        raise RigFileError(f"head: {expected(what, got)}")

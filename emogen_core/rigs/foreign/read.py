"""From a folder or a file of somebody else to a checked head, with all that was found out about it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.rigs.foreign.check import check_model
from emogen_core.rigs.foreign.frame import placed
from emogen_core.rigs.foreign.gltf import read_gltf
from emogen_core.rigs.foreign.halves import with_halves
from emogen_core.rigs.foreign.model import Findings
from emogen_core.rigs.foreign.obj_folder import read_obj_folder
from emogen_core.rigs.foreign.pairs import find_pairs
from emogen_core.rigs.foreign.parts import say_roles
from emogen_core.rigs.foreign.regions import find_regions

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.model import HeadModel
    from emogen_core.rigs.foreign.pairs import Pairs

ENDINGS = (".glb", ".gltf")


@dataclass(frozen=True, eq=False)
class ReadHead:
    """What a rig can be made of.

    Attributes:
        model: in millimetres and the product's axes.
        pairs: which expressions belong together.
        regions: name -> int32 vertices, as far as found.
        findings: what was found, guessed and missing.
    """

    model: HeadModel
    pairs: Pairs
    regions: Mapping[str, NDArray[np.int32]]
    findings: Findings


def read_head(path: Path, unit: str = "", neutral: str = "") -> ReadHead:
    """Read a foreign head and find out what it offers.

    Args:
        path: an ICT-FaceKit folder, a folder of OBJ files, or a ``.glb`` or ``.gltf`` file.
        unit: of its lengths, one of `frame.UNITS`; by default inferred from its height.
        neutral: the neutral's file in a folder of OBJs; by default the one that is called so.

    Raises:
        InvalidInputError: it cannot become a rig; the message names the file, the part or the shape, and what to do.
    """
    findings = Findings()
    # Numbers beyond single precision become infinite, and are refused with their place.
    with np.errstate(over="ignore", invalid="ignore"):
        model = _read(path, findings, neutral)
    check_model(model, findings)
    model = placed(model, findings, unit)
    say_roles(model, findings)
    model = with_halves(model, findings)
    return ReadHead(model, find_pairs(model, findings), find_regions(model, findings), findings)


def _read(path: Path, findings: Findings, neutral: str) -> HeadModel:
    if path.is_dir():
        return read_obj_folder(path, findings, neutral)
    if path.suffix.lower() not in ENDINGS:
        wanted = "a folder of OBJ files, or a file that ends in .glb or .gltf"
        raise InvalidInputError(f"head: {expected(wanted, str(path))}; export one of these")
    return read_gltf(path, findings)

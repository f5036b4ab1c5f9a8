"""What `emogen landmarks fit` writes: weights as JSON and CSV, and the parts of a study file that use them."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import yaml

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from emogen_core.face.rig import Gene
    from emogen_core.landmarks.head import DrivenHead

    Floats = NDArray[np.float64]

POPULATION = 10
"""Faces of a fixed beginning (docs/study-options.md, `fixed_population`)."""
MOST_NAMED = 100
_BELOW_ONE = 0.9999
_DIGITS = 4
SINGLE = (".json", ".csv", ".yaml")
"""Endings of --out that mean one file in the place of a folder."""


@dataclass(frozen=True, eq=False)
class Face:
    """One frame that was fitted.

    Attributes:
        name: of the frame.
        core: (C,) weights of the core shapes in [0, 1].
        told: measures of the fit, plain values.
    """

    name: str
    core: Floats
    told: dict[str, float]


@dataclass(frozen=True, eq=False)
class Fit:
    """All frames on one head.

    Attributes:
        head: whose they are.
        faces: one a frame.
        facts: plain values that say how they came about.
        known_as: what a study calls the head.
    """

    head: DrivenHead
    faces: tuple[Face, ...]
    facts: dict[str, Any]
    known_as: str

    @cached_property
    def genes(self) -> Floats:
        """(frames, G) genes, to `_DIGITS` digits."""
        return np.stack([self.head.genes(face.core) for face in self.faces]).round(_DIGITS)

    @cached_property
    def shapes(self) -> Floats:
        """(frames, K) weights of all shapes, correctives included, to `_DIGITS` digits."""
        return self.head.faces(np.stack([face.core for face in self.faces])).astype(np.float64).round(_DIGITS)

    def document(self) -> dict[str, Any]:
        """Return everything as plain data; weights of 0 are left out."""
        rows = zip(self.faces, self.genes, self.shapes, strict=True)
        rig = self.head.rig
        frames = [
            {
                "frame": face.name,
                **face.told,
                "asymmetry": round(self.head.asymmetry(face.core), _DIGITS),
                "genes": _active(rig.gene_names, genes),
                "shapes": _active(rig.shape_names, shapes),
            }
            for face, genes, shapes in rows
        ]
        return {"rig": rig.hash, "identity": self.head.identity, **self.facts, "frames": frames}

    def files(self, out: Path) -> dict[str, str]:
        """Return the text of the files to write, by name: one, or those of a folder."""
        if out.suffix in SINGLE:
            return {out.name: self._text(out.suffix)}
        return {
            "genes.csv": _table([face.name for face in self.faces], self.head.rig.gene_names, self.genes),
            "shapes.csv": _table([face.name for face in self.faces], self.head.rig.shape_names, self.shapes),
            "study.yaml": self.study(),
            "weights.json": self._text(".json"),
        }

    def study(self) -> str:
        """Return a study file that begins with these faces and asks about them: whole, and to be cut up."""
        sideways = any("lateral" in gene.flags for gene, on in self._used() if on)
        plain = {
            "title": "Fitted faces",
            "emotions": [{"adjective": "happy", "noun": "happiness"}],
            "identities": [self.known_as],
            "search": {
                "initialisation": "fixed",
                **({"lateral": True} if sideways else {}),
                "fixed_population": population(self.genes),
            },
            "blocks": [
                {"name": "made", "kind": "evolve"},
                {"name": "judged", "kind": "rate", "faces": {"sources": ["named"], "named": self._named()}},
            ],
        }
        return yaml.safe_dump(plain, sort_keys=False, width=120, default_flow_style=None)

    def _used(self) -> Iterable[tuple[Gene, bool]]:
        return zip(self.head.rig.genes, [bool(column.any()) for column in self.genes.T], strict=True)

    def _named(self) -> list[dict[str, Any]]:
        names = self.head.rig.gene_names
        rows = spread(len(self.faces), MOST_NAMED)
        return [{"name": f"frame-{row + 1}", "genes": _active(names, self.genes[row])} for row in rows]

    def _text(self, suffix: str) -> str:
        if suffix == ".csv":
            return _table([face.name for face in self.faces], self.head.rig.gene_names, self.genes)
        return self.study() if suffix == ".yaml" else json.dumps(self.document(), indent=2, allow_nan=False) + "\n"


def population(genes: Floats) -> list[list[float]]:
    """Return ten genomes for `fixed_population`: (k, G) faces, or ten of them from first to last if there are more.

    With fewer than ten, rounds of the same faces follow at strengths that fall in equal steps towards 0.
    """
    rounds = -(-POPULATION // len(genes))
    strengths = [1 - number / rounds for number in range(rounds)]
    faces = [row * strength for strength in strengths for row in genes[spread(len(genes), POPULATION)]]
    return [np.minimum(row, _BELOW_ONE).round(_DIGITS).tolist() for row in faces[:POPULATION]]


def spread(count: int, most: int) -> list[int]:
    """Return at most ``most`` rows of ``count``, as evenly from the first to the last as whole numbers allow."""
    rows: list[int] = np.linspace(0, count - 1, min(count, most)).round().astype(int).tolist()
    return rows


def _active(names: Sequence[str], weights: Floats) -> dict[str, float]:
    return {name: float(weight) for name, weight in zip(names, weights, strict=True) if weight > 0}


def _table(frames: list[str], names: Sequence[str], weights: Floats) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["frame", *names])
    writer.writerows([frame, *row] for frame, row in zip(frames, weights.tolist(), strict=True))
    return text.getvalue()

"""The rig as a value.

A rig is a blendshape model (EmoGen 2021, section III-A): a neutral mesh an identity, ``K`` shapes given as offsets
from it, and the genes by which the search moves the core shapes. Shapes stand in a fixed order: core, then
combinational correctives, then collision correctives. Lengths are millimetres; x points to the head's left, y up, z out
of the face; the origin is the midpoint between the eyes.

Symbols: ``G`` genes, ``C`` core shapes, ``K`` shapes, ``N`` vertices, ``T`` triangles.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.geometry import Geometry, gene_geometry

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

FLAGS = frozenset({"gaze", "lids", "lateral", "disabled"})
REGIONS = ("brow", "lid", "gaze", "cheek", "nose", "mouth", "jaw", "neck")


@dataclass(frozen=True, slots=True)
class Gene:
    """One degree of freedom of the search: a core shape, or a left/right pair moved together.

    ``action_units`` are FACS codes (Ekman, Friesen & Hager 2002) where one fits, as the rig's maker read the shape.
    """

    name: str
    members: tuple[str, ...]
    action_units: tuple[str, ...]
    region: str
    flags: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Combination:
    """A combinational corrective, driven by the product of its parents' weights.

    ``parents`` are genes. Correctives that share a ``family`` are damped together when more than two of the family's
    genes are high.
    """

    name: str
    parents: tuple[str, ...]
    family: str | None = None


@dataclass(frozen=True, slots=True)
class EmotionSet:
    """The genes that build one emotion, with the published source of the choice.

    ``strengths`` has one weight in (0, 1] a gene: at these the face shows the emotion's prototype at full strength.
    """

    genes: tuple[str, ...]
    strengths: tuple[float, ...]
    action_units: tuple[str, ...]
    source: str


@dataclass(frozen=True, slots=True)
class Adjustment:
    """What one identity adds to some shapes' offsets.

    Attributes:
        shapes: (S,) indices of shapes.
        offsets: (S, N, 3) float32, millimetres, added to the rig's offsets of those shapes.
    """

    shapes: NDArray[np.intp]
    offsets: NDArray[np.float32]


# Compared and hashed by identity: arrays have no single truth value, and models of a rig are cached under it.
@dataclass(frozen=True, eq=False)
class Rig:
    """A face model that a study can use.

    Attributes:
        name: short name of the model.
        hash: SHA-256 of its content, hexadecimal; empty for a rig that was never stored.
        genes: the ``G`` genes, in the order of the genome.
        core_shapes: names of the ``C`` core shapes.
        combinations: the combinational correctives, in shape order after the core shapes.
        collision_shapes: names of the collision correctives, last in shape order.
        emotion_sets: emotion name -> genes.
        offsets: (K, N, 3) float32, millimetres: shape minus neutral, at weight 1.
        neutrals: identity name -> (N, 3) float32 neutral mesh.
        triangles: (T, 3) int32 vertex indices, counter-clockwise seen from outside.
        parts: part name -> (first, last + 1) row of ``triangles``.
        regions: name -> int32 vertex indices (lips, lids, teeth) for the correctives.
        mirror: (N,) int32 mirror image of every vertex; empty for a rig that is not symmetric.
        adjustments: identity name -> how that head's shapes differ from ``offsets`` (lids of another height).
    """

    name: str
    genes: tuple[Gene, ...]
    core_shapes: tuple[str, ...]
    combinations: tuple[Combination, ...]
    collision_shapes: tuple[str, ...]
    emotion_sets: Mapping[str, EmotionSet]
    offsets: NDArray[np.float32]
    neutrals: Mapping[str, NDArray[np.float32]]
    triangles: NDArray[np.int32]
    parts: Mapping[str, tuple[int, int]]
    regions: Mapping[str, NDArray[np.int32]] = field(default_factory=dict)
    mirror: NDArray[np.int32] = field(default_factory=lambda: np.zeros(0, np.int32))
    adjustments: Mapping[str, Adjustment] = field(default_factory=dict)
    hash: str = ""

    @property
    def shape_names(self) -> tuple[str, ...]:
        """Names of all ``K`` shapes, in the order of a weight vector."""
        return (*self.core_shapes, *(c.name for c in self.combinations), *self.collision_shapes)

    @property
    def gene_names(self) -> tuple[str, ...]:
        """Names of the ``G`` genes, in the order of a genome."""
        return tuple(gene.name for gene in self.genes)

    @property
    def identities(self) -> tuple[str, ...]:
        """Names of the heads that can wear this rig."""
        return tuple(self.neutrals)

    def shape_offsets(self, identity: str) -> NDArray[np.float32]:
        """Return the (K, N, 3) offsets as an identity wears them; ``offsets`` itself where nothing is adjusted."""
        adjustment = self.adjustments.get(identity)
        if adjustment is None:
            return self.offsets
        worn = self.offsets.copy()
        worn[adjustment.shapes] += adjustment.offsets
        return worn

    @cached_property
    def combination_parents(self) -> tuple[NDArray[np.intp], ...]:
        """Indices of the parent genes of every combinational corrective."""
        return tuple(self.gene_indices(combination.parents) for combination in self.combinations)

    @cached_property
    def gene_to_core(self) -> NDArray[np.float32]:
        """(G, C) matrix of zeros and ones: which core shapes a gene drives."""
        index = {name: i for i, name in enumerate(self.core_shapes)}
        matrix = np.zeros((len(self.genes), len(self.core_shapes)), np.float32)
        for row, gene in enumerate(self.genes):
            matrix[row, [index[member] for member in gene.members]] = 1
        return matrix

    @cached_property
    def geometry(self) -> Geometry:
        """The genes as movements of the mesh, as the rig itself has them; the same for all heads."""
        return gene_geometry(self.gene_to_core, self.offsets)

    def emotion_genes(self, emotion: str, strength: float = 1.0) -> NDArray[np.float64]:
        """Return the (G,) genome of an emotion's prototype, all its weights times ``strength`` in [0, 1].

        Raises:
            InvalidInputError: the rig has no such emotion, or a strength outside [0, 1].
        """
        if emotion not in self.emotion_sets:
            raise InvalidInputError(f"emotion: {expected(f'one of {sorted(self.emotion_sets)}', emotion)}")
        if not 0 <= strength <= 1:
            raise InvalidInputError(f"strength: {expected('a number in [0, 1]', strength)}")
        kit = self.emotion_sets[emotion]
        genes = np.zeros(len(self.genes))
        genes[self.gene_indices(kit.genes)] = strength * np.array(kit.strengths)
        return genes

    def neutral(self, identity: str) -> NDArray[np.float32]:
        """Return the (N, 3) neutral mesh of an identity.

        Raises:
            InvalidInputError: the rig has no such identity.
        """
        if identity not in self.neutrals:
            raise InvalidInputError(f"identity: {expected(f'one of {sorted(self.neutrals)}', identity)}")
        return self.neutrals[identity]

    def gene_indices(self, names: tuple[str, ...]) -> NDArray[np.intp]:
        """Return where the named genes stand in a genome.

        Raises:
            InvalidInputError: a name is not a gene of this rig.
        """
        index = {name: i for i, name in enumerate(self.gene_names)}
        unknown = [name for name in names if name not in index]
        if unknown:
            raise InvalidInputError(f"genes: {expected(f'names among {sorted(index)}', unknown)}")
        return np.array([index[name] for name in names], np.intp)

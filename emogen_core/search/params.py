"""What a study fixes about the search, with the paper's defaults (EmoGen 2021, sections III-B and III-C)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from collections.abc import Collection

    from emogen_core.face.geometry import Geometry
    from emogen_core.face.rig import Rig

POPULATION = 10
BLENDS = 3
"""Slots 1 to 3: the elite and the two averages."""
RANDOM_GENES = 6
"""x of the paper."""
MOST_STOP_AT = 0.5
STOPS = f"None, or above 0 and at most {MOST_STOP_AT}"
INITIAL_EMOTIONS = ("happy", "sad", "angry", "fearful")

Genome = tuple[float, ...]
Check = tuple[str, bool, str, object]
"""A field, whether it is as it has to be, what was expected, and what it is."""


@dataclass(frozen=True, slots=True)
class FaceSet:
    """A named set of genes from which a face of the initial population draws its active ones."""

    name: str
    genes: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class SearchParams:
    """The search space and the options of the algorithm.

    Attributes:
        gene_count: G, length of a genome.
        active: indices of the genes that the search may move; all others stay 0.
        initial_sets: gene sets of the protocol initialisation.
        generations: G of the paper; the trial ends with the elite of this generation.
        stop_at: the trial ends earlier once the search expects to be this near to what is meant, as a cosine distance;
            None: it does not. Only for strategies that know how sure they are.
        least_generations: then the first generation that may be the last one.
        minimum, maximum: how many faces a choice may hold.
        mutations: m, gene indices drawn a bred face.
        random_genes: x, genes drawn a random face.
        random_faces: how many of the last slots are random.
        activation: least and most active genes of a face of the initial population.
        initialisation: "protocol", or "fixed": `fixed_population` as it stands.
        reset: a reset keeps the initial population, redraws it, or is not offered.
        fixed_population: ten genomes, only with "fixed".
        fixed_name: which one it is, where there are several; stands in the origin of its faces.
        geometry: the genes as movements of the mesh, for strategies that compare faces; None without a rig.
    """

    gene_count: int
    active: tuple[int, ...]
    initial_sets: tuple[FaceSet, ...]
    generations: int = 10
    stop_at: float | None = None
    least_generations: int = 3
    minimum: int = 1
    maximum: int = POPULATION
    mutations: int = 2
    random_genes: int = RANDOM_GENES
    random_faces: int = 4
    activation: tuple[int, int] = (3, 8)
    initialisation: Literal["protocol", "fixed"] = "protocol"
    reset: Literal["keep", "redraw", "off"] = "keep"
    fixed_population: tuple[Genome, ...] = ()
    fixed_name: str = ""
    geometry: Geometry | None = None

    def __post_init__(self) -> None:
        """Refuse settings that the algorithm cannot run with."""
        genes = range(self.gene_count)
        fixed = np.array(self.fixed_population, float) if self.fixed_population else None
        checks: tuple[Check, ...] = (
            (
                "active",
                bool(self.active) and all(i in genes for i in self.active),
                "gene indices",
                self.active,
            ),
            ("initial_sets", all(s.genes for s in self.initial_sets), "sets with genes", self.initial_sets),
            ("initial_sets", bool(self.initial_sets) or fixed is not None, "at least one set", ()),
            ("generations", self.generations >= 1, "at least 1", self.generations),
            *self._ending(),
            ("minimum", 1 <= self.minimum <= self.maximum, "1 up to the maximum", self.minimum),
            ("maximum", self.maximum <= POPULATION, f"at most {POPULATION}", self.maximum),
            ("mutations", self.mutations >= 0, "0 or more", self.mutations),
            (
                "random_genes",
                1 <= self.random_genes <= len(self.active),
                "1 up to the genes",
                self.random_genes,
            ),
            ("random_faces", 0 <= self.random_faces <= POPULATION - BLENDS, "0 to 7", self.random_faces),
            (
                "activation",
                1 <= self.activation[0] <= self.activation[1],
                "1 <= least <= most",
                self.activation,
            ),
            (
                "fixed_population",
                (fixed is None) == (self.initialisation == "protocol") and self._is_population(fixed),
                f"{POPULATION} genomes of {self.gene_count} values in [0, 1) with fixed initialisation only",
                None if fixed is None else fixed.shape,
            ),
        )
        for name, holds, want, got in checks:
            if not holds:
                raise InvalidInputError(f"{name}: {expected(want, got)}")

    def limited(self, genes: Collection[int]) -> SearchParams:
        """Return the same search over some of its genes; sets that lose all of theirs go.

        Raises:
            InvalidInputError: too few are left.
        """
        kept = frozenset(genes)
        sets = (FaceSet(one.name, tuple(i for i in one.genes if i in kept)) for one in self.initial_sets)
        return replace(
            self,
            active=tuple(i for i in self.active if i in kept),
            initial_sets=tuple(one for one in sets if one.genes),
        )

    def _ending(self) -> tuple[Check, ...]:
        """Return what has to hold of a trial that may end early."""
        if self.stop_at is None:
            return ()
        least = 1 <= self.least_generations <= self.generations
        return (
            ("stop_at", 0 < self.stop_at <= MOST_STOP_AT, STOPS, self.stop_at),
            ("least_generations", least, "1 up to the generations", self.least_generations),
        )

    def _is_population(self, fixed: np.ndarray | None) -> bool:
        if fixed is None:
            return True
        return fixed.shape == (POPULATION, self.gene_count) and bool(((fixed >= 0) & (fixed < 1)).all())


def search_params(
    rig: Rig,
    *,
    gaze: bool = True,
    lids: bool = True,
    lateral: bool = False,
    excluded: Collection[str] = (),
    **options: object,
) -> SearchParams:
    """Return the search over a rig's genes.

    Args:
        rig: the face model.
        gaze, lids: whether genes that turn the eyes, or close them, take part.
        lateral: whether genes that move the face sideways take part.
        excluded: names of further genes to leave out.
        **options: fields of `SearchParams`. Without `random_genes`, a search over fewer genes draws all of them.

    Raises:
        InvalidInputError: an unknown gene, or settings that the algorithm cannot run with.
    """
    rig.gene_indices(tuple(excluded))
    off = {flag for flag, on in (("gaze", gaze), ("lids", lids), ("lateral", lateral)) if not on} | {"disabled"}
    active = tuple(
        i for i, gene in enumerate(rig.genes) if not gene.flags & off and gene.name not in frozenset(excluded)
    )
    usable = frozenset(active)
    sets = (
        FaceSet(name, tuple(int(i) for i in rig.gene_indices(rig.emotion_sets[name].genes) if i in usable))
        for name in INITIAL_EMOTIONS
        if name in rig.emotion_sets
    )
    filled = tuple(face_set for face_set in sets if face_set.genes)
    options.setdefault("random_genes", min(RANDOM_GENES, len(active)))
    return SearchParams(len(rig.genes), active, filled, geometry=rig.geometry, **options)  # type: ignore[arg-type]

"""Every metric by its name, with what there is to know about it; docs/metrics.md is made from here."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Protocol

from emogen_core.errors import InvalidInputError, expected
from emogen_core.similarity.cosine import cosine_distance
from emogen_core.similarity.empirical import fit_pca, pca_euclidean, pca_standardised, vertex_mahalanobis
from emogen_core.similarity.linear import euclidean_genes, genes_of, vertex_rms

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

Need = Literal["offsets", "training"]
DIRECTION = "0 alike, larger less alike"
REFERENCES = {
    "EmoGen 2021": "N. Roubtsova, M. Parsons, N. Binetti, I. Mareschal, E. Viding and D. Cosker: EmoGen: Quantifiable"
    " Emotion Generation and Analysis for Experimental Psychology. arXiv:2107.00480, 2021."
    " doi:10.48550/arXiv.2107.00480",
    "Jolliffe 2002": "I. T. Jolliffe: Principal Component Analysis, 2nd edition. Springer, 2002. doi:10.1007/b98835",
    "Mahalanobis 1936": "P. C. Mahalanobis: On the generalised distance in statistics. Proceedings of the National"
    " Institute of Sciences of India 2 (1), 1936, 49-55",
}
"""Where the metrics come from, by the names that entries use."""


class Metric(Protocol):
    """A distance of weight vectors."""

    def __call__(self, weights: NDArray[np.floating], target: NDArray[np.floating], /) -> NDArray[np.float64]:
        """Return the (...,) distances of (..., K) weights to a (K,) target, or one that broadcasts to them."""
        ...


@dataclass(frozen=True, eq=False)
class Material:
    """What metrics are made from.

    Attributes:
        gene_to_core: (G, C) which core shapes a gene drives.
        shapes: K.
        offsets: returns the (K, N, 3) offsets of the shapes as one head wears them, in millimetres; called only
            for metrics of meshes.
        training: returns (M, K) weights of recorded or simulated faces; None where there are none.
    """

    gene_to_core: NDArray[np.floating]
    shapes: int
    offsets: Callable[[], NDArray[np.floating]]
    training: Callable[[], NDArray[np.floating]] | None = None


@dataclass(frozen=True, slots=True)
class Entry:
    """A metric as the catalogue has it. All are distances: 0 for the same face, more for less alike."""

    name: str
    title: str
    formula: str
    range: str
    unit: str
    reference: str
    kind: Literal["theoretical", "empirical"]
    needs: tuple[Need, ...]
    intensity: bool
    """Whether a stronger face of the same composition is another face."""
    help: str
    make: Callable[[Material], Metric]
    direction: str = DIRECTION


@dataclass(frozen=True, eq=False)
class CosineGenes:
    """Cosine distance in the (K, G) image of the genes; a class, as laboratories are sent to processes."""

    genes: NDArray[np.float64]

    def __call__(self, weights: NDArray[np.floating], target: NDArray[np.floating], /) -> NDArray[np.float64]:
        """Return the (...,) distances of (..., K) weights to a (K,) target, or one that broadcasts to them."""
        return cosine_distance(weights @ self.genes, target @ self.genes)


def _trained(material: Material) -> NDArray[np.floating]:
    if material.training is None:
        raise InvalidInputError(f"training: {expected('faces to learn this metric from', None)}")
    return material.training()


CATALOGUE: dict[str, Entry] = {
    entry.name: entry
    for entry in (
        Entry(
            "cosine", "Cosine distance", "1 - a.b / (|a| |b|)", "[0, 1]", "none", "EmoGen 2021, eq. 12",
            "theoretical", (), False,
            "Compares composition: which shapes are at work and in which ratio. The distance to the neutral face is 1."
            " The paper's choice for simulation and analysis.",
            lambda _: cosine_distance,
        ),
        Entry(
            "cosine_genes", "Cosine distance of genes", "1 - a'.b' / (|a'| |b'|)", "[0, 1]", "none",
            "EmoGen 2021, eq. 12 on genes",
            "theoretical", (), False,
            "The same on one value a gene: a symmetrical pair counts once, correctives do not count.",
            lambda material: CosineGenes(genes_of(material.gene_to_core, material.shapes)),
        ),
        Entry(
            "euclidean_genes", "Euclidean distance of genes", "|a' - b'|", "[0, sqrt G]", "none", "EmoGen 2021, eq. 11",
            "theoretical", (), True,
            "`G` is the number of genes. The naive baseline; sees intensity, and takes the neutral face for near to"
            " everything.",
            lambda material: euclidean_genes(material.gene_to_core, material.shapes),
        ),
        Entry(
            "vertex_rms", "RMS vertex distance", "sqrt(1/N sum_n |v_n,a - v_n,b|^2)", "[0, inf)", "mm",
            "EmoGen 2021, eq. 13",
            "theoretical", ("offsets",), True,
            "`N` is the number of vertices. Distance of the meshes. Ruled by the largest movement: an open jaw hides a"
            " wrinkled nose.",
            lambda material: vertex_rms(material.offsets()),
        ),
        Entry(
            "pca_euclidean", "Euclidean distance of components", "|beta_a - beta_b|", "[0, inf)", "none",
            "EmoGen 2021, section IV-B-2; Jolliffe 2002", "empirical", ("training",), True,
            "`beta` is a face along the principal components of recorded faces, as many as explain 99 % of"
            " their variance.",
            lambda material: pca_euclidean(fit_pca(_trained(material))),
        ),
        Entry(
            "pca_standardised", "Standardised distance of components", "sqrt(sum_i (beta_a,i - beta_b,i)^2 / s_i^2)",
            "[0, inf)", "standard deviations", "EmoGen 2021, eqs. 14, 15; Jolliffe 2002",
            "empirical", ("training",), True,
            "`s_i^2` is the variance of recorded faces along component i. Every component counts the same, the rare"
            " ones too.",
            lambda material: pca_standardised(fit_pca(_trained(material))),
        ),
        Entry(
            "vertex_mahalanobis", "Mahalanobis distance of vertices",
            "sqrt((dV_a - dV_b)^T (S + lambda I)^-1 (dV_a - dV_b))", "[0, inf)", "standard deviations",
            "EmoGen 2021, eq. 16; Mahalanobis 1936", "empirical", ("offsets", "training"), True,
            "`S` is the (3N, 3N) covariance of the offsets `dV` of recorded faces' meshes, `I` the unit matrix,"
            " `lambda` a thousandth of the mean variance of the directions in which shapes can move the mesh: without"
            " it `S` has no inverse. In units of how recorded meshes vary.",
            lambda material: vertex_mahalanobis(material.offsets(), _trained(material)),
        ),
    )
}  # fmt: skip


def metric(name: str, material: Material) -> Metric:
    """Return a metric of the catalogue.

    Raises:
        InvalidInputError: there is none of this name, or its training faces are missing or alike.
    """
    if name not in CATALOGUE:
        raise InvalidInputError(f"metric: {expected(f'one of {sorted(CATALOGUE)}', name)}")
    return CATALOGUE[name].make(material)


def page() -> str:
    """Return the table of docs/metrics.md."""
    head = ("name", "distance", "range", "direction", "unit", "reference", "sees intensity")
    lines = [f"| {' | '.join(head)} |", "| --- " * len(head) + "|"]
    lines += [
        f"| `{one.name}` | `{one.formula.replace('|', chr(92) + '|')}` | {one.range} | {one.direction} | {one.unit} |"
        f" {one.reference} | {'yes' if one.intensity else 'no'} |"
        for one in CATALOGUE.values()
    ]
    for one in CATALOGUE.values():
        made = f" Made from {' and '.join(one.needs)}." if one.needs else ""
        lines += ["", f"**{one.title}** (`{one.name}`, {one.kind}; {one.reference}). {one.help}{made}"]
    lines += ["", "## References", "", *(f"- **{name}**: {full}" for name, full in REFERENCES.items())]
    return "\n".join(lines)


def write(path: Path) -> None:
    """Make the tables of a page anew: everything below its mark."""
    head = path.read_text("utf-8").split(MARK)[0]
    path.write_text(f"{head}{MARK}\n\n{page()}\n", "utf-8")


MARK = "<!-- metrics -->"

if __name__ == "__main__":
    for name in sys.argv[1:]:
        write(Path(name))

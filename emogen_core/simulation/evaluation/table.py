"""What a table of the evaluation is: its numbers, what the paper found and whether that holds, what can be drawn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Agreement = Literal["agrees", "agrees in trend", "does not agree", "new"]
Numbers = tuple[float | None, ...]


@dataclass(frozen=True, slots=True)
class Column:
    """A column: its name, how many decimals people need, and what it is, where the name does not say."""

    name: str
    digits: int = 3
    help: str = ""


@dataclass(frozen=True, slots=True)
class Row:
    """One row: what the paper has, where it has anything, beside ours; None where there is no number."""

    label: str
    ours: Numbers
    paper: Numbers = ()


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that the paper found.

    Attributes:
        says: what it found, as a sentence.
        here: the numbers here, as a sentence.
        holds: whether they say the same.
    """

    says: str
    here: str
    holds: bool


@dataclass(frozen=True, eq=False)
class Heat:
    """Where on the face an average result is off: two weight vectors whose meshes are compared."""

    label: str
    mean: NDArray[np.floating]
    target: NDArray[np.floating]


@dataclass(frozen=True, eq=False)
class Cluster:
    """Finished faces on two components, and the Gaussian that was fitted to them.

    Attributes:
        points: (R, 2).
        mean: (2,).
        covariance: (2, 2).
    """

    points: NDArray[np.float64]
    mean: NDArray[np.float64]
    covariance: NDArray[np.float64]

    def outline(self, deviations: float = 2.0, corners: int = 48) -> NDArray[np.float64]:
        """Return the (corners + 1, 2) ellipse at a number of standard deviations, closed."""
        turn = np.linspace(0, 2 * np.pi, corners + 1)
        circle = np.stack([np.cos(turn), np.sin(turn)], 1)
        return np.asarray(self.mean + deviations * circle @ np.linalg.cholesky(self.covariance).T)


@dataclass(frozen=True, eq=False)
class PlaneMap:
    """A map of finished faces: a cluster a target, and the share of the variance that each of the two axes has."""

    clusters: Mapping[str, Cluster]
    explained: tuple[float, float]


@dataclass(frozen=True, slots=True)
class Whisker:
    """Two columns that are drawn as a dot and a line to both sides, one a row: a mean and a standard deviation."""

    name: str
    mean: int
    sd: int


@dataclass(frozen=True, eq=False)
class Table:
    """One table or figure of the evaluation.

    Attributes:
        name: for files and the command line.
        title: for people.
        source: where it stands in the paper; empty for what the paper does not have.
        columns: of the numbers of a row.
        rows: the numbers.
        findings: what the paper found, and whether it holds; none for what the paper does not have.
        why: one sentence: why we think that some of them do not hold, or what a table says that the paper lacks.
        doubt: the same, said only where some of them do not hold.
        notes: what has to be known to read the numbers, a sentence each.
        errors: label -> (R, generations + 1) cosine distances to the target, for distributions a generation.
        curves: label -> one value a generation.
        heats: average results beside their targets.
        maps: label -> finished faces on two components.
        whiskers: columns that are drawn against each other.
    """

    name: str
    title: str
    source: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    findings: tuple[Finding, ...] = ()
    why: str = ""
    doubt: str = ""
    notes: tuple[str, ...] = ()
    errors: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    curves: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    heats: tuple[Heat, ...] = ()
    maps: Mapping[str, PlaneMap] = field(default_factory=dict)
    whiskers: tuple[Whisker, ...] = ()

    @property
    def agreement(self) -> Agreement:
        """Whether ours say what the paper's say: in everything, in at least half of it, or in less."""
        if not self.findings:
            return "new"
        share = np.mean([one.holds for one in self.findings])
        return "agrees" if share == 1 else "agrees in trend" if share >= 0.5 else "does not agree"

    @property
    def verdict(self) -> str:
        """One sentence: agrees, agrees in trend, or does not, and why we think so."""
        if not self.findings:
            return self.why
        held, of = sum(one.holds for one in self.findings), len(self.findings)
        every = "all" if held == of > 2 else "both" if held == of else f"{held} of the {of}"
        counted = f"{every} findings of the paper hold" if of > 1 else f"the paper's finding {_holds(held)}"
        reasons = [one for one in (self.doubt if held < of else "", self.why) if one]
        return f"{self.agreement.capitalize()}: {'; '.join([f'{counted} here', *reasons])}."

    def shown(self, values: Numbers) -> tuple[str, ...]:
        """Return numbers of a row as people read them; what is not there as a dash."""
        return tuple(
            "–" if one is None else f"{one:,.{column.digits}f}"
            for one, column in zip(values, self.columns, strict=False)
        )


def _holds(held: int) -> str:
    return "holds" if held else "does not hold"

"""Which expressions belong together: left and right, eyes that look the same way, correctives of an open jaw."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from emogen_core.landmarks.arkit import TABLE
from emogen_core.rigs.foreign.mirror import centre_of, mirrored
from emogen_core.rigs.foreign.model import counted
from emogen_core.rigs.foreign.names import ONE_SIDED, SIDEWAYS, WHOLE, meaning

if TYPE_CHECKING:
    from collections.abc import Iterable

    from emogen_core.rigs.foreign.mirror import Mirror
    from emogen_core.rigs.foreign.model import Findings, HeadModel

GAZE = {
    "left": ("eyeLookOut_L", "eyeLookIn_R"),
    "right": ("eyeLookIn_L", "eyeLookOut_R"),
    "up": ("eyeLookUp_L", "eyeLookUp_R"),
    "down": ("eyeLookDown_L", "eyeLookDown_R"),
}
CORRECTIVES = {"mouthClose": ("jawOpen",)}
"""Shapes that only make sense on top of others: mouthClose brings the lips together again under an open jaw."""

# Below the first, shapes without known names are taken for mirror images; above the second, named ones are doubted.
_ALIKE = 0.2
_UNLIKE = 0.5


@dataclass(frozen=True)
class Pairs:
    """Names of expressions that belong together.

    Attributes:
        sides: (left, right) of one movement of both sides, the eyes' sideways looks left out.
        sideways: (to the left, to the right) of the whole mouth: never made together.
        gaze: direction (``left``, ``right``, ``up``, ``down``; the head's own) -> shapes of the two eyes.
        correctives: shape -> what it corrects.
        standard: expression -> its name in ICT-FaceKit's vocabulary, for those that are known.
    """

    sides: tuple[tuple[str, str], ...]
    sideways: tuple[tuple[str, str], ...]
    gaze: dict[str, tuple[str, str]]
    correctives: dict[str, tuple[str, ...]]
    standard: dict[str, str]


def find_pairs(model: HeadModel, findings: Findings) -> Pairs:
    """Return what belongs together, by name, then by geometry; what is doubtful or lacks its half is said."""
    meanings = {name: meaning(name) for name in model.expressions}
    standard = {name: one.standard for name, one in meanings.items() if one.known}
    called = {one.standard: name for name, one in meanings.items()}
    pairs = Pairs(
        sides=_sides(model, called, {*standard}, findings),
        sideways=_both(called, SIDEWAYS),
        gaze={way: (called[one], called[other]) for way, (one, other) in GAZE.items() if {one, other} <= called.keys()},
        correctives={
            called[name]: tuple(called[parent] for parent in parents)
            for name, parents in CORRECTIVES.items()
            if {name, *parents} <= called.keys()
        },
        standard=standard,
    )
    _say_found(pairs, findings)
    _say_own([name for name in model.expressions if name not in standard], findings)
    _say_missing(called, findings)
    return pairs


def _both(called: dict[str, str], asked: Iterable[tuple[str, str]]) -> tuple[tuple[str, str], ...]:
    """Return what the file calls the pairs of standard names of which it has both."""
    return tuple((called[one], called[other]) for one, other in asked if {one, other} <= called.keys())


def _sides(
    model: HeadModel, called: dict[str, str], known: set[str], findings: Findings
) -> tuple[tuple[str, str], ...]:
    lefts = [name for name in called if name.endswith("_L") and not name.startswith(("eyeLookIn", "eyeLookOut"))]
    named = _both(called, [(left, _other(left)) for left in lefts])
    mirror = mirrored(model.vertices)
    _say_doubts(model, mirror, named, findings)
    return (*named, *_by_geometry(model, mirror, known.union(*named), findings))


def _by_geometry(model: HeadModel, mirror: Mirror, taken: set[str], findings: Findings) -> list[tuple[str, str]]:
    """Pair what has no known name: each with its nearest mirror image, unless it is its own."""
    rest = {name: offsets for name, offsets in model.expressions.items() if name not in taken}
    lone = [name for name, offsets in rest.items() if mirror.unlike(offsets, offsets) > _UNLIKE]
    likeness = sorted((mirror.unlike(rest[a], rest[b]), a, b) for a, b in combinations(lone, 2))
    pairs: list[tuple[str, str]] = []
    for unlike, one, other in likeness:
        if unlike < _ALIKE and not any({one, other} & set(pair) for pair in pairs):
            first_left = centre_of(model.vertices, rest[one])[0] > 0
            pairs.append((one, other) if first_left else (other, one))
            findings.guessed.append(f"{one} and {other} are left and right of one movement, by their shape.")
    return pairs


def _say_doubts(model: HeadModel, mirror: Mirror, sides: tuple[tuple[str, str], ...], findings: Findings) -> None:
    for left, right in sides:
        unlike = mirror.unlike(model.expressions[left], model.expressions[right])
        if unlike > _UNLIKE:
            findings.guessed.append(
                f"{left} and {right} are a pair by name, though they differ by {unlike:.0%} from mirror images."
            )


def _say_found(pairs: Pairs, findings: Findings) -> None:
    findings.found.append(f"{len(pairs.sides)} left and right pairs.")
    gaze = ", ".join(f"{way} ({one}, {other})" for way, (one, other) in pairs.gaze.items())
    if gaze:
        findings.found.append(f"Eyes look together {gaze}.")
    findings.found += [f"{name} is a corrective of {', '.join(of)}." for name, of in pairs.correctives.items()]


def _say_own(names: list[str], findings: Findings) -> None:
    if names:
        findings.found.append(f"{len(names)} expressions have names of their own: {counted(names)}.")


def _say_missing(called: dict[str, str], findings: Findings) -> None:
    sided = [f"{stem}_{side}" for stem in ONE_SIDED for side in "LR"]
    half = [called[name] for name in sided if name in called and _other(name) not in called]
    if half:
        findings.missing.append(f"The other side of {counted(half)}.")
    # Some movements are one-sided here and whole there.
    movements = dict.fromkeys((*ONE_SIDED, *WHOLE))
    absent = [name for name in movements if called.keys().isdisjoint((name, f"{name}_L", f"{name}_R", *_parts(name)))]
    if absent:
        findings.missing.append(f"{len(absent)} of ARKit's movements: {counted(absent)}.")


def _parts(name: str) -> tuple[str, ...]:
    """Return the bundled rig's shapes that make up one of ARKit's, where it takes several."""
    shapes = TABLE.get(name, ())
    return shapes if len(shapes) > 1 else ()


def _other(name: str) -> str:
    return name[:-1] + ("R" if name[-1] == "L" else "L")

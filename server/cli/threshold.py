"""`emogen evaluate threshold`: the noise of a study's own search."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.simulation.evaluation.threshold import LEARNING_SEARCHES, SEARCHES, saving, threshold

from ..reporting.noise import laboratory, search_key
from ..services.trials.evolve import may_end_early
from .common import plainly
from .housed import read_file

if TYPE_CHECKING:
    from emogen_core.simulation.evaluation.threshold import Threshold

    from ..services.config import StudyConfig

File = Annotated[Path, typer.Option("--study", help="A study's file, YAML or JSON.")]
Searches = Annotated[
    int | None,
    typer.Option(
        min=100,
        max=5000,
        help=f"Searches for each kind of participant; {SEARCHES}, or {LEARNING_SEARCHES} with a strategy that learns.",
    ),
]
Seed = Annotated[int, typer.Option(min=0, help="The same seed gives the same numbers.")]
Json = Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")]


def threshold_(study: File, searches: Searches = None, seed: Seed = 1, json_: Json = False) -> None:
    """Simulate the noise of a study's own search: how far from what was meant its results are by chance alone."""
    with plainly():
        rig = load_bundled_rig()
        found = [
            (names, config, threshold(laboratory(rig, config, seed), searches))
            for names, config in _searches(read_file(study))
        ]
    if json_:
        told = [{"conditions": names, **asdict(one)} for names, _, one in found]
        typer.echo(json.dumps({"rig": rig.hash, "seed": seed, "searches": told}, indent=2, allow_nan=False))
        return
    for names, config, one in found:
        who = [f"{', '.join(names)}:"] if len(found) > 1 else []
        typer.echo("\n".join([*who, *_sentences(one), *_early(config, one)]))


def _searches(config: StudyConfig) -> list[tuple[list[str], StudyConfig]]:
    """Return the different searches of a study, with the names of the conditions that have each."""
    made: dict[str, tuple[list[str], StudyConfig]] = {}
    for name, own in zip([one.name for one in config.conditions] or [""], config.whole, strict=True):
        made.setdefault(search_key(own), ([], own))[0].append(name)
    return list(made.values())


def _early(config: StudyConfig, found: Threshold) -> list[str]:
    """Return what ending early saves, where trials may."""
    if not may_end_early(config):
        return []
    ends, noisy = found.faithful.generations, found.noisy.generations
    return [
        f"Trials end with generation {ends:.1f} of at most {config.generations} on average, which saves"
        f" {saving(ends, config.generations):.0f} % of the choices; with a noise of .1 with generation {noisy:.1f},"
        f" {saving(noisy, config.generations):.0f} %."
    ]


def _sentences(found: Threshold) -> list[str]:
    faithful, noisy = found.faithful, found.noisy
    return [
        f"A search ends {faithful.error} from the face in mind (cosine distance; mean and standard deviation of"
        f" {found.searches} searches of people who never err), 19 of 20 below {faithful.error.most:.3f}; two searches"
        f" for the same face end {faithful.apart} apart, 19 of 20 below {faithful.apart.most:.3f}.",
        f"With a noise of .1 on every judged distance, which marks the nearest face as best in"
        f" {100 * noisy.right:.0f} % of choices, it is {noisy.error}, below {noisy.error.most:.3f},"
        f" and {noisy.apart}, below {noisy.apart.most:.3f}.",
        f"Choosing at random ends {found.random.error.mean:.3f} away; with no answer at all, the face whose"
        f" genes are all the same is {found.no_answer:.3f} away.",
        f"For the two faces of the paper's threshold (0.230 ± 0.066 there) it is {found.paper}.",
    ]

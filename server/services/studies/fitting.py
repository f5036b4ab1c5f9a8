"""Whether a study fits the face model: its heads, the genes that it names, the populations that it brings along."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from emogen_core.search.params import POPULATION

from ..config import Categorise, Problem, Rate
from ..errors import InvalidError
from ..faces.face_model import name_of
from ..trials.evolution import params_of

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from emogen_core.face.rig import Rig

    from ..config import StudyConfig
    from ..config.search import Population


def require_fit(rig: Rig, config: StudyConfig) -> None:
    """Refuse a study that a face model cannot run.

    Raises:
        InvalidError: names the first thing that does not fit; `problems` has them all.
    """
    problems = misfits(rig, config)
    if not problems:
        return
    first = problems[0]
    refusal = InvalidError(
        f"The study does not fit the face model: {first.sentence}",
        field=first.field,
        expected=first.expected,
        got=first.got,
    )
    refusal.problems = problems
    raise refusal


def misfits(rig: Rig, config: StudyConfig) -> tuple[Problem, ...]:
    """Return everything that this face model cannot do, in the study and in each of its conditions."""
    found = list(_misfits(rig, config, ""))
    for place, condition in enumerate(config.conditions):
        if condition.changes:
            own = _misfits(rig, config.in_condition(condition.name), f"conditions.{place}.changes.")
            found.extend(one for one in own if _first(one.field.split(".")[3:]) in condition.changes)
    return tuple(found)


def _misfits(rig: Rig, config: StudyConfig, where: str) -> Iterator[Problem]:
    own = name_of(rig.identities)
    for place, head in enumerate(config.identities):
        field = f"{where}identities.{place}"
        if isinstance(head, str) and head not in rig.identities:
            yield Problem(field, f"expected one of {', '.join(rig.identities)}", repr(head))
        elif not isinstance(head, str) and head.get("model", "") != own:
            yield Problem(
                field, f"expected heads of one face model, {own or 'the bundled one'}", "a document of another"
            )
    found = [*_genes(rig, config), *_populations(rig, config)]
    if not found:
        found = [*_rest(rig, config)]
    yield from (Problem(f"{where}{one.field}", one.expected, one.got) for one in found)


def _genes(rig: Rig, config: StudyConfig) -> Iterator[Problem]:
    known = set(rig.gene_names)
    for place, name in enumerate(config.search.excluded_genes):
        if name not in known:
            yield _strange(f"search.excluded_genes.{place}", name, known)
    for block, step in enumerate(config.blocks):
        for face, named in enumerate(step.faces.named if isinstance(step, Rate | Categorise) else ()):
            for name in named.genes:
                if name not in known:
                    yield _strange(f"blocks.{block}.faces.named.{face}.genes.{name}", name, known)


def _populations(rig: Rig, config: StudyConfig) -> Iterator[Problem]:
    search = config.search
    if search.initialisation == "protocol":
        return
    if search.fixed_population and search.fixed_options:
        yield Problem("search.fixed_population", "expected one population or several, not both", "both")
    if not search.fixed_population and not search.fixed_options:
        yield Problem("search.fixed_population", "expected ten faces where the first ten are fixed", "nothing")
    if search.fixed_option and search.fixed_option > len(search.fixed_options):
        allowed = f"expected a population among the {len(search.fixed_options)} that are given"
        yield Problem("search.fixed_option", allowed, str(search.fixed_option))
    if search.fixed_population:
        yield from _population(rig, "search.fixed_population", search.fixed_population)
    for place, population in enumerate(search.fixed_options):
        yield from _population(rig, f"search.fixed_options.{place}", population)


def _population(rig: Rig, field: str, population: Population) -> Iterator[Problem]:
    if len(population) != POPULATION:
        yield Problem(field, f"expected {POPULATION} faces", str(len(population)))
    for row, face in enumerate(population):
        if len(face) != len(rig.genes):
            yield Problem(f"{field}.{row}", f"expected {len(rig.genes)} values, one a gene", str(len(face)))


def _rest(rig: Rig, config: StudyConfig) -> Iterator[Problem]:
    """Whatever else the search cannot run with: it names its own field first."""
    try:
        params_of(rig, config)
    except InvalidError as error:
        field, _, said = str(error.__cause__).partition(": ")
        expected, _, got = said.partition(", got ")
        yield Problem(f"search.{field}" if said else "search", expected or field, got or "nothing")


def _strange(field: str, name: str, known: Collection[str]) -> Problem:
    near = get_close_matches(name, known, 3, 0.5) or sorted(known)[:3]
    return Problem(field, f"expected a gene of the face model, for example {', '.join(near)}", repr(name))


def _first(parts: Sequence[str]) -> str:
    return parts[0] if parts else ""

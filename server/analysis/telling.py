"""Numbers in sentences for a paper, as the APA writes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from typing import TypeVar

    from emogen_core.analysis.enough import Result

    T = TypeVar("T")

NAMED = 4
"""Results that are told one by one at most; of more, it is told what range they have."""


def p_is(p: float, name: str = "p") -> str:
    """Return a probability, without the 0 before its point."""
    if p < 0.001:
        return f"{name} < .001"
    return f"{name} = {p:.3f}".replace("0.", ".", 1)


def bounded(value: float, digits: int = 2) -> str:
    """Return a number that cannot be above 1, without the 0 before its point."""
    return f"{value:.{digits}f}".replace("0.", ".", 1)


def interval(low: float | None, high: float | None, digits: int = 3) -> str:
    """Return a 95 % interval after what it is of; nothing where there is none."""
    return "" if low is None or high is None else f", 95 % CI [{low:.{digits}f}, {high:.{digits}f}]"


def span(values: Iterable[float | None], digits: int = 3) -> str:
    """Return the least and the greatest of numbers, one where they look the same; those that are not told are not."""
    told = [value for value in values if value is not None]
    low, high = f"{min(told):.{digits}f}", f"{max(told):.{digits}f}"
    return low if low == high else f"{low} to {high}"


def p_range(values: Iterable[float | None]) -> str:
    """Return the least and the greatest of probabilities."""
    told = [value for value in values if value is not None]
    return " to ".join(dict.fromkeys([p_is(min(told)), p_is(max(told))]))


def cells(people: Sequence[int]) -> str:
    """Return how many cells there are, and how many participants in each."""
    return f"{counted(len(people), 'cell')} (n = {span(people, 0)})"


def listed(words: Sequence[str]) -> str:
    """Return words as a list in a sentence."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if words[1:] else words)


def counted(count: int, what: str) -> str:
    """Return a number of things; of several words the first has the plural's s where the second is "of"."""
    first, of, rest = what.partition(" of ")
    return f"{count:,} {first}{'' if count == 1 else 's'}{of}{rest}"


def each_or_all(
    results: Sequence[T], each: Callable[[T], str], together: Callable[[Sequence[T]], str]
) -> tuple[str, ...]:
    """Return a sentence for each of a few results, or one for all of many; none of none."""
    if len(results) <= NAMED:
        return tuple(map(each, results))
    return (together(results),)


def lacking(results: Iterable[tuple[str, Result]], what: str) -> tuple[str, ...]:
    """Return what is lacking for something, a sentence for all that lack the same."""
    missing: dict[str, dict[str, None]] = {}
    labels: set[str] = set()
    for label, result in results:
        labels.add(label)
        if result.lacks is not None:
            missing.setdefault(str(result.lacks), {})[label] = None
    return tuple(
        f"{f'All {len(these)}' if len(these) == len(labels) > NAMED else '; '.join(these)}: {what} {lacks}."
        for lacks, these in missing.items()
    )


def reasons(results: Iterable[Result]) -> str:
    """Return why results cannot be told: each reason once, nothing where all can."""
    return ", or ".join(dict.fromkeys(one.lacks.reason for one in results if one.lacks))


def untold(results: Sequence[Result], what: str, of: str = "cell") -> tuple[str, ...]:
    """Return the sentence that something is not told of cells, and why, where that is so."""
    missing = [one for one in results if not one.enough]
    if not missing:
        return ()
    some = "any" if len(missing) == len(results) else len(missing)
    return (f"No {what} is told for {some} of {counted(len(results), of)}: {reasons(missing)}.",)

"""New studies: from an example, from a file, or from nothing; and studies as files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ....assets import asset
from ...config import Emotion, StudyConfig, parse_config
from ...config.files import read_plain, write_study
from ...errors import InvalidError, NotFoundError

if TYPE_CHECKING:
    from ...config.files import Kind
    from ..life import StudyLife
    from ..studies import Studies

ORDER = ("default", "retest-and-categorise", "children")
EMPTY = "empty"


@dataclass(frozen=True, slots=True)
class Example:
    """A study to begin with."""

    name: str
    title: str
    about: str


ABOUT = {
    "default": Example("default", "EmoGen 2021", "Four emotions on two heads, ten generations each, with ratings."),
    "retest-and-categorise": Example(
        "retest-and-categorise", "Retest and categorise",
        "Each emotion twice, then naming one's own faces, those of others and mean faces.",
    ),
    "children": Example("children", "For children", "Two emotions, few choices, gaze and lids switched off."),
    EMPTY: Example(EMPTY, "Empty study", "One emotion, and the default of every option."),
}  # fmt: skip


@dataclass(frozen=True)
class Making:
    """Makes studies."""

    studies: Studies
    life: StudyLife

    @property
    def examples(self) -> tuple[Example, ...]:
        """What a study may begin with."""
        return tuple(ABOUT.get(name, Example(name, name, "")) for name in (*names(), EMPTY))

    def from_example(self, name: str, user: str | None) -> str:
        """Make a draft of an example; return its id.

        Raises:
            NotFoundError: there is no such example.
        """
        config = example(name)
        titles = {study.title for study in self.studies.all()}
        return self.from_config(config.model_copy(update={"title": _unlike(config.title, titles)}), user)

    def from_file(self, content: bytes, user: str | None) -> str:
        """Make a draft of a study file; return its id.

        Raises:
            InvalidError: it is not a study, or does not fit the face model; `problems` has all that is wrong.
        """
        plain = read_plain(content)
        try:
            return self.from_config(parse_config(plain), user)
        except InvalidError as error:
            known = {one.field for one in error.problems}
            more = [one for one in self.life.beyond(plain) if one.field not in known]
            error.problems = (*error.problems, *more)
            raise

    def from_config(self, config: StudyConfig, user: str | None, status: str = "draft") -> str:
        """Make a study; return its id.

        Raises:
            InvalidError: it does not fit the face model.
        """
        return self.studies.create(config, status, owner=user).id

    def as_file(self, study_id: str, number: int | None, kind: Kind) -> str:
        """Return a version of a study as a file, the newest unless one is named.

        Raises:
            NotFoundError: no such study or version.
        """
        return write_study(self.life.config(study_id, number), kind)


def _unlike(title: str, titles: set[str]) -> str:
    """Return a title that no study has yet: the demonstration study is called as the example that it is."""
    tries = (title, *(f"{title} ({number})" for number in range(2, len(titles) + 2)))
    return next(one for one in tries if one not in titles)


def names() -> tuple[str, ...]:
    """Return the names of the examples, the first to be offered first."""
    known = {path.stem for path in (asset("templates") / "studies").glob("*.yaml")}
    return (*(name for name in ORDER if name in known), *sorted(known - set(ORDER)))


def example_text(name: str) -> str:
    """Return an example as its file has it.

    Raises:
        NotFoundError: there is no such example.
    """
    if name not in names():
        raise NotFoundError(
            f"There is no example of this name: expected one of {', '.join(names())}, got {name}.",
            field="example", expected=f"one of {', '.join(names())}", got=name,
        )  # fmt: skip
    return (asset("templates") / "studies" / f"{name}.yaml").read_text(encoding="utf-8")


def example(name: str) -> StudyConfig:
    """Return an example, or a study with nothing but what every study has.

    Raises:
        NotFoundError: there is no such example.
    """
    if name == EMPTY:
        return StudyConfig(title="New study", emotions=(Emotion(adjective="happy", noun="happiness"),))
    return parse_config(read_plain(example_text(name)))

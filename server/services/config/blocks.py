"""Blocks: what a participation is a row of (docs/study.md). Each kind is one trial type."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from .base import Line, Name, OptionalLine, Part, Prose, misfit, option
from .parts import Question

Source = Literal["own", "others", "means", "named"]
Order = Literal["latin", "random", "fixed"]
Gene = Annotated[str, Field(max_length=100)]
Weight = Annotated[float, Field(ge=0, le=1)]


class _Block(Part):
    name: Name = option(..., "Name", "The block in the data, for example first.")


class Evolve(_Block):
    """The participant breeds a face for each emotion."""

    kind: Literal["evolve"]
    emotions: tuple[Line, ...] = option((), "Emotions", "Adjectives of the emotions. Empty: all of the study.")
    retest_of: Name | None = option(None, "Retest of", "The block whose emotions are asked for again.")
    order: Order | None = option(None, "Order", "latin, random or fixed. Empty: as the study has it.")


class NamedFace(Part):
    """A face that the study brings along."""

    name: Name = option(..., "Name", "The face in the data.")
    emotion: OptionalLine = option("", "Emotion", "What it is meant to show.")
    genes: dict[Gene, Weight] = option(dict, "Genes", "Weights of genes; all others are 0.")


class Faces(Part):
    """Which faces a block shows."""

    sources: tuple[Source, ...] = option(
        ("own",), "Faces", "own: the participant's finished faces. others: those of other people with the same head."
        " means: the mean face of each emotion so far. named: faces that the study brings along.", min_length=1,
    )  # fmt: skip
    of: Name | None = option(None, "From the block", "The block that made them. Empty: the first evolve block.")
    others: int = option(1, "Others an emotion", "How many faces of other people for each emotion.", ge=1, le=20)
    least: int = option(5, "Least for a mean", "Finished faces that a mean needs.", ge=2, le=1000)
    named: tuple[NamedFace, ...] = option((), "Named faces", "Faces that the study brings along.", max_length=100)


class Scale(Part):
    """A question with seven answers."""

    name: Name = option(..., "Name", "The question in the data.")
    text: Line = option(..., "Question", "What is asked; {emotion} is the emotion's noun.")
    low: Line = option(..., "Low end", "Words at 1.")
    high: Line = option(..., "High end", "Words at 7.")


class Rate(_Block):
    """The participant answers questions about faces."""

    kind: Literal["rate"]
    faces: Faces = option(Faces(), "Faces", "Which faces are shown, in random order.")
    questions: Annotated[tuple[Question | Scale, ...], Field(min_length=1, max_length=12)] = option(
        ("intensity",),
        "Questions",
        "intensity, satisfaction, or questions of your own. satisfaction asks how close a face is to what the person"
        " had in mind: it fits their own faces, not those of others.",
    )


class Categorise(_Block):
    """The participant names what faces express."""

    kind: Literal["categorise"]
    faces: Faces = option(Faces(sources=("own", "others", "means")), "Faces", "Which faces are shown, in random order.")
    labels: tuple[Line, ...] = option((), "Labels", "Words to choose from. Empty: the study's emotions.", max_length=20)
    none_of_these: bool = option(True, "None of these", "Whether 'none of these' is among the labels.")
    intensity: bool = option(True, "Intensity", "Whether the strength is asked for.")
    confidence: bool = option(True, "Confidence", "Whether it is asked how sure the participant is.")


class Attention(_Block):
    """The participant does what a sentence asks, to show that it was read."""

    kind: Literal["attention"]
    text: Prose = option(..., "Sentence", "What is asked, for example: choose 'sad' here.")
    options: Annotated[tuple[Line, ...], Field(min_length=2, max_length=12)] = option(..., "Answers", "To choose from.")
    right: Line = option(..., "Right answer", "One of the answers.")
    failing: Literal["record", "end"] = option(
        "record", "When failed", "record: the participant goes on. end: with the outcome failed_checks."
    )

    @model_validator(mode="after")
    def _right_is_an_answer(self) -> Self:
        if self.right not in self.options:
            raise misfit("right", expected=f"one of {', '.join(self.options)}", got=self.right)
        return self


class Item(Part):
    """One question of a questionnaire."""

    name: Name = option(..., "Name", "The question in the data.")
    kind: Literal["single", "multiple", "scale", "number", "text"] = option(
        ..., "Kind", "single or multiple choice, a scale from 1 to 7, a number, or a text."
    )
    text: Line = option(..., "Question", "What is asked.")
    options: tuple[Line, ...] = option((), "Answers", "To choose from, for single and multiple.", max_length=50)
    low: OptionalLine = option("", "Low end", "Words at 1 of a scale.")
    high: OptionalLine = option("", "High end", "Words at 7 of a scale.")
    least: float | None = option(None, "Least", "Smallest number.", allow_inf_nan=False)
    most: float | None = option(None, "Most", "Largest number.", allow_inf_nan=False)
    required: bool = option(True, "Required", "Whether there must be an answer.")

    @model_validator(mode="after")
    def _has_what_its_kind_needs(self) -> Self:
        if (self.kind in {"single", "multiple"}) != (len(self.options) >= 2):
            raise misfit("options", expected="at least two for single and multiple only", got=len(self.options))
        if self.kind == "scale" and not (self.low and self.high):
            raise misfit("high" if self.low else "low", expected="words at both ends of a scale", got="")
        if self.least is not None and self.most is not None and self.least > self.most:
            raise misfit("least", expected=f"at most {self.most}", got=self.least)
        return self


class ScreenOut(Part):
    """Ends the participation with the outcome screened_out when a question is answered like this."""

    item: Name = option(..., "Question", "Name of the question.")
    answers: tuple[Line, ...] = option(
        (), "Answers", "Of a single or multiple choice, those that end it.", max_length=50
    )
    below: float | None = option(None, "Below", "A number or point of a scale that is less than this.", later=True)
    above: float | None = option(None, "Above", "A number or point of a scale that is more than this.", later=True)

    def meets(self, value: float | str) -> bool:
        """Return whether an answer ends the participation."""
        if isinstance(value, str):
            return value in self.answers
        return (self.below is not None and value < self.below) or (self.above is not None and value > self.above)


class Questionnaire(_Block):
    """The participant answers questions of the study."""

    kind: Literal["questionnaire"]
    title: OptionalLine = option("", "Title", "Heading of the page.")
    items: Annotated[tuple[Item, ...], Field(min_length=1, max_length=60)] = option(..., "Questions", "In their order.")
    screen_out: tuple[ScreenOut, ...] = option((), "Screening", "Answers that end the participation.", max_length=20)

    @model_validator(mode="after")
    def _screens_by_its_items(self) -> Self:
        names = [item.name for item in self.items]
        for place, name in enumerate(names):
            if name in names[:place]:
                raise misfit("items", place, "name", expected="different names", got=name)
        for place, rule in enumerate(self.screen_out):
            if rule.item not in names:
                raise misfit("screen_out", place, "item", expected=f"one of {', '.join(names)}", got=rule.item)
            _screens(rule, place, self.items[names.index(rule.item)])
        return self


def _screens(rule: ScreenOut, place: int, item: Item) -> None:
    """Refuse a rule that no answer to its question can ever meet."""
    bounded = rule.below is not None or rule.above is not None
    if item.kind in {"single", "multiple"}:
        _screens_by_option(rule, place, item, bounded=bounded)
    elif item.kind == "text" or rule.answers or not bounded:
        raise misfit("screen_out", place, "below", expected="below or above, of a number or a scale", got=item.kind)


def _screens_by_option(rule: ScreenOut, place: int, item: Item, *, bounded: bool) -> None:
    strange = [answer for answer in rule.answers if answer not in item.options]
    if strange or bounded or not rule.answers:
        got = (strange or ["other fields" if bounded else "nothing"])[0]
        raise misfit("screen_out", place, "answers", expected=f"answers among {', '.join(item.options)}", got=got)


Block = Annotated[Evolve | Rate | Categorise | Attention | Questionnaire, Field(discriminator="kind")]

"""Options of the search (EmoGen 2021, section III); the defaults are the paper's."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from emogen_core.search.params import MOST_STOP_AT

from .base import Part, option

Probability = Annotated[float, Field(ge=0, lt=1)]
Population = tuple[tuple[Probability, ...], ...]


LEARNS_ONLY = "Only preference can do so: it knows how sure it is."
PAPER_ONLY = "Only the strategy of EmoGen 2021 has them."
BREEDING = ("mutations", "random_genes", "random_faces")
"""Options that only that strategy has."""
ENDING = ("stop_at", "least_generations")
"""Options of strategies that know how sure they are."""


class Search(Part):
    """How the next ten faces are made from a choice."""

    strategy: Literal["emogen", "preference"] = option(
        "emogen",
        "Strategy",
        "How a choice becomes the next ten faces. emogen: bred from the faces just chosen, as in EmoGen 2021."
        " preference: all choices of a trial together say which faces may be meant, and those are shown whose"
        " comparison tells most. Its own estimate of the face is stored beside the best one.",
    )
    stop_at: float | None = option(
        None, "Expected error that is enough",
        "A face is finished before its last generation once the strategy expects its own estimate to be within this"
        " cosine distance of what is meant; one more page of faces near to it is shown then. Empty: never."
        f" {LEARNS_ONLY}",
        later=True, gt=0, le=MOST_STOP_AT,
    )  # fmt: skip
    least_generations: int = option(
        3, "Least generations", "A face that may be finished early has at least so many generations.", later=True,
        ge=1, le=30,
    )  # fmt: skip
    mutations: int = option(
        2, "Mutations", f"m: how many genes of a bred face are drawn anew. {PAPER_ONLY}", paper="2", ge=0, le=20
    )
    random_genes: int = option(
        6, "Genes of a random face", f"x: how many genes a random face draws. {PAPER_ONLY}", paper="6", ge=1, le=50
    )
    random_faces: int = option(
        4, "Random faces", f"How many of the ten are drawn afresh each generation. {PAPER_ONLY}",
        paper="4", ge=0, le=7,
    )  # fmt: skip
    activation: tuple[int, int] = option(
        (3, 8),
        "Active genes at the start",
        "Least and most active genes of a face of the first ten.",
        paper="3 to 8",
    )
    initialisation: Literal["protocol", "fixed"] = option(
        "protocol",
        "First ten faces",
        "protocol: two faces from the genes of each of happy, sad, angry and fearful, one arbitrary, one neutral, in"
        " random order. fixed: populations that you give, the same for everybody.",
        paper="protocol",
    )
    fixed_population: Population = option((), "Fixed population", "Ten faces, each with one value a gene in [0, 1).")
    fixed_options: tuple[Population, ...] = option(
        (), "Fixed populations", "Several fixed populations to choose from, in the place of one.", later=True,
        max_length=50,
    )  # fmt: skip
    fixed_option: int | None = option(
        None, "Which of them", "Number of the population, from 1. Empty: drawn for each trial.", later=True, ge=1, le=50
    )
    reset: Literal["keep", "redraw", "off"] = option(
        "keep", "Start this face again", "keep: with the same first ten faces. redraw: with others. off: not offered."
    )
    gaze: bool = option(True, "Gaze", "Whether genes that turn the eyes take part.")
    lids: bool = option(True, "Lids", "Whether genes that close the eyes take part.")
    lateral: bool = option(False, "Sideways", "Whether genes that move jaw and mouth sideways take part.")
    excluded_genes: tuple[Annotated[str, Field(max_length=100)], ...] = option(
        (), "Genes left out", "Names of genes that stay at 0.", max_length=100
    )

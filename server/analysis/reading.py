"""An export as arrays: the finished faces that count, the way to each, and what people named."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.analysis.recorded import Faces

from ..reporting.noise import search_key
from ..services.errors import InvalidError
from .counted import PEOPLE, counted
from .named import judgements
from .shown import Shown
from .trials import finished, paths, ratings, repetitions

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from numpy.typing import NDArray

    from emogen_client import Export
    from emogen_core.analysis.matching import Judgements
    from emogen_core.analysis.recorded import Cell
    from emogen_core.face.rig import Rig
    from emogen_core.simulation.evaluation.specs import ResultName

    from ..services.config import StudyConfig
    from .counted import Counted

    Row = dict[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """What an export holds of the people who count.

    Attributes:
        title, study: of the study.
        faces: finished faces of evolve trials, sorted by emotion, head and condition as the study names them.
        face_ids, trials: (n,) of each face.
        searches: (n,) the key of the search that each face was found by.
        seeds: (n,) of the trial that each face is from, decimal.
        configs: search key -> a study that has that search.
        studies: the study as those who count had it, every version and condition once.
        config_hashes: of the versions that faces were made under.
        algorithms: name and version of the searches.
        counted: participations that count.
        simulated: how many of them are simulated.
        left_out: participations that do not, by reason.
        judgements: what people named; none without categorise trials.
        result: what `faces` are of every trial: the face last chosen as best, or the search's own estimate. On the way
            to an estimate are all best faces, and the estimate last.
        chosen: the faces last chosen as best, whatever `faces` are: those that people saw and may recognise.
    """

    title: str
    study: str
    faces: Faces
    face_ids: tuple[str, ...]
    trials: tuple[str, ...]
    searches: NDArray[np.str_]
    seeds: tuple[str, ...]
    configs: Mapping[str, StudyConfig]
    studies: tuple[StudyConfig, ...]
    config_hashes: tuple[str, ...]
    algorithms: tuple[str, ...]
    counted: int
    simulated: int
    left_out: Mapping[str, int]
    judgements: Judgements
    chosen: Faces
    result: ResultName = "elite"

    def searches_of(self, cell: Cell) -> list[str]:
        """Return the keys of the searches by which the faces of a cell were found, that of most faces first."""
        columns = zip(cell, (self.faces.emotions, self.faces.identities, self.faces.conditions), strict=True)
        mine = np.logical_and.reduce([column == value for value, column in columns])
        return [key for key, _ in Counter(self.searches[mine].tolist()).most_common()]


def read(
    export: Export,
    rig: Rig,
    kinds: Collection[str] = (PEOPLE,),
    *,
    flagged: bool = False,
    result: ResultName = "elite",
) -> Recording:
    """Return what an export holds of the people who completed.

    Args:
        export: a folder or zip, in any format.
        rig: the face model that it has to be of.
        kinds: who counts: people, pilot, simulated.
        flagged: whether those who failed an attention check count as well.
        result: which face of every trial is analysed.

    Raises:
        EmogenClientError: the export lacks a file, or one is not the one that its manifest tells of.
        NotFoundError: it was recorded on another face model.
        InvalidError: a configuration is none, or not the one that somebody's row names; or nobody counts; or estimates
            are asked for and a trial has none.
    """
    who = counted(export, rig, kinds, flagged=flagged)
    trials = finished(export, who)
    if not trials:
        raise _nothing(kinds, who)
    makers = _column(trials, "participation")
    searches = {name: search_key(who.configs[name]) for name in set(makers)}
    chosen = _faces(export, rig, trials, who)
    return Recording(
        title=str(export.manifest["title"]), study=str(export.manifest["study"]),
        faces=chosen if result == "elite" else _estimated(export, rig, trials, who, chosen), chosen=chosen,
        face_ids=_column(trials, "final_face") if result == "elite" else ("",) * len(trials), result=result,
        trials=_column(trials, "trial"), seeds=_column(trials, "seed"),
        searches=np.array([searches[name] for name in makers]),
        configs={searches[name]: who.configs[name] for name in makers},
        studies=tuple({id(config): config for config in who.configs.values()}.values()),
        config_hashes=_different(who, "config_hash"), algorithms=_different(who, "algorithm"),
        counted=len(who.people), simulated=sum(row["simulated"] for row in who.people.values()),
        left_out=who.left_out, judgements=judgements(export, rig, who.people),
    )  # fmt: skip


def _nothing(kinds: Collection[str], who: Counted) -> InvalidError:
    told = ", ".join(f"{count} {why}" for why, count in who.left_out.items()) or "no participations"
    return InvalidError(
        f"There is nothing to analyse: expected finished faces of {' or '.join(kinds)} who completed, got none"
        f" ({told} left out). Options --pilot, --simulated and --flagged count those as well."
    )


def _faces(export: Export, rig: Rig, trials: Sequence[Row], who: Counted) -> Faces:
    final, ways = _column(trials, "final_face"), paths(export, trials)
    shown = Shown(export, rig, (*final, *(face for way in ways for face in way)))
    return Faces(
        people=np.array(_column(trials, "participation")), emotions=np.array(_column(trials, "emotion")),
        identities=np.array(_column(trials, "identity")), conditions=np.array(_column(trials, "condition")),
        repetitions=repetitions(trials, who.configs), genes=shown.genes(final), weights=shown.weights(final),
        ratings=ratings(export, trials), elites=tuple(map(shown.weights, ways)),
    )  # fmt: skip


def _estimated(export: Export, rig: Rig, trials: Sequence[Row], who: Counted, chosen: Faces) -> Faces:
    """Return the estimates of trials, each after the best faces on the way to it.

    Raises:
        InvalidError: a trial has none.
    """
    names = _column(trials, "trial")
    if "estimates" not in export.tables:  # of a release that had none
        raise _no_estimate(0, trials, who)
    found = Shown(export, rig, names, "estimates", "trial")
    there = sum(name in found for name in names)
    if there < len(names):
        raise _no_estimate(there, trials, who)
    weights = found.weights(names)
    ways = (np.vstack([way, one]) if len(way) else way for way, one in zip(chosen.elites, weights, strict=True))
    return replace(chosen, genes=found.genes(names), weights=weights, elites=tuple(ways))


def _no_estimate(found: int, trials: Sequence[Row], who: Counted) -> InvalidError:
    return InvalidError(
        f"The search's own estimates cannot be analysed: expected one for each of {len(trials)} finished faces, got"
        f" {found} (searches: {', '.join(_different(who, 'algorithm'))}; only preference makes any). Analyse the faces"
        " chosen as best (--result elite), or an export of those conditions alone whose strategy is preference."
    )


def _column(rows: Sequence[Row], name: str) -> tuple[str, ...]:
    return tuple(row[name] for row in rows)


def _different(who: Counted, name: str) -> tuple[str, ...]:
    return tuple(dict.fromkeys(_column(tuple(who.people.values()), name)))

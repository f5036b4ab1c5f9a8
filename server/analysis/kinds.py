"""Maps of faces, kinds of faces, and neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.maps import face_map
from emogen_core.analysis.mixture import mixture
from emogen_core.analysis.nearest import nearest
from emogen_core.analysis.recorded import by_person
from emogen_core.similarity.cosine import cosine_distance

from ..charts import Caption, Panel, dots, drawn, exact_axis, grid, titles, uprights
from ..charts.legend import legend
from ..charts.map import LOOKS, look_of
from ..reporting.figures import Figure, framed
from .section import Column, Section, Sheet
from .telling import counted, lacking

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.maps import FaceMap
    from emogen_core.analysis.mixture import Mixture

    from ..charts import Frame
    from .context import Context
    from .section import Value

NEIGHBOURS = 5
SIZE = 340.0, 330.0
"""With it a step to the right is as long as one up."""
DOT = 2.6


def plane(context: Context) -> Section | None:
    """Return the map of all faces by their first two principal components, or nothing of a single face."""
    faces = context.faces
    if len(faces) < 2:
        return None
    found = face_map(faces.weights)
    rows = tuple(
        zip(
            faces.people.tolist(), faces.emotions.tolist(), faces.identities.tolist(), faces.conditions.tolist(),
            *found.places.T.tolist(), strict=True,
        )
    )  # fmt: skip
    names = ("participation", "emotion", "head", "condition", "component 1", "component 2")
    shares = " and ".join(f"{100 * share:.0f} %" for share in found.shares.tolist())
    return Section(
        "map", "A map of all faces",
        f"Principal components of the weights; the two explain {shares} of the variance. Where faces lie near"
        " each other"
        " here they may still differ in what the map leaves out.",
        Sheet(
            "map-axes", (Column("component"), Column("share of the variance")),
            tuple(enumerate(found.shares.tolist(), 1)),
        ),
        files=(Sheet("map", tuple(map(Column, names)), rows),), figures=(_map_figure(context, found),),
    )  # fmt: skip


def _map_figure(context: Context, found: FaceMap) -> Figure:
    """Return panels of at most as many emotions as there are looks, all in one frame."""
    frame = _square(found.places)
    groups = [context.emotions[at : at + LOOKS] for at in range(0, len(context.emotions), LOOKS)]
    panels = tuple(
        _map_panel(context, found, frame, identity, group) for identity in context.identities for group in groups
    )
    return Figure(
        "panels maps", "Finished faces on two components", "One mark a face.", panels,
        tuple(legend(context.emotions[:LOOKS])) if len(groups) == 1 else (),
    )  # fmt: skip


def _map_panel(context: Context, found: FaceMap, frame: Frame, identity: str, emotions: Sequence[str]) -> Panel:
    faces = context.faces
    marks = [uprights(), grid()]
    for at, emotion in enumerate(emotions):
        places = found.places[(faces.emotions == emotion) & (faces.identities == identity)]
        marks.append(dots([(x, y) for x, y in places.tolist()], look_of(at), DOT))
    marks.append(titles("component 1", "component 2"))
    words = ", ".join(emotions)
    caption = Caption(
        f"map-{identity}-{emotions[0]}", f"Finished faces, {context.head(identity)}", f"{words}.", "small cloud"
    )
    return Panel(context.head(identity), words, drawn(frame, marks, caption))


def _square(points: np.ndarray) -> Frame:
    """Return a frame in which both axes are as long, in pixels and in what they measure."""
    low, high = points.min(0), points.max(0)
    half = max((high - low).max() / 2, 1e-6) * 1.04
    across, up = (exact_axis(float(middle - half), float(middle + half), 5) for middle in (low + high) / 2)
    return framed(across, up, *SIZE)


def mixtures(context: Context) -> Section:
    """Return how many kinds of faces each emotion has, over heads and conditions, one face a person."""
    found = []
    for emotion in context.emotions:
        own = context.faces.only(emotion)
        found.append((emotion, mixture(by_person(own.weights, own.people)[1], context.seed)))
    columns = (
        Column("emotion"), Column("faces", help="One a person."),
        Column("components", help="The number of Gaussians that BIC prefers."),
        Column("advantage", 1, "How much better its BIC is than that of one; more than 10 is very strong."),
        Column("several kinds"), Column("sizes"),
    )  # fmt: skip
    rows: tuple[tuple[Value, ...], ...] = tuple(
        (emotion, context.faces.only(emotion).person_count, one.components, one.advantage, one.several,
         ", ".join(map(str, one.sizes)))
        for emotion, one in found
    )  # fmt: skip
    return Section(
        "kinds", "Are there several kinds of faces?",
        "Mixtures of Gaussians on two components of weights scaled to length 1. Kinds of faces are not yet kinds"
        " of people:"
        " a retest shows whether people stay in theirs.",
        Sheet("kinds", columns, rows),
        lacks=lacking(found, "a mixture"),
        methods=_kinds(found),
    )  # fmt: skip


def _kinds(found: Sequence[tuple[str, Mixture]]) -> tuple[str, ...]:
    """Return how many kinds each emotion has, and for how many that cannot be told."""
    told = [(emotion, one) for emotion, one in found if one.enough]
    counts = [
        f"{counted(one.components or 0, 'component')} for {emotion} (n = {sum(one.sizes)}, BIC lower by"
        f" {one.advantage:.1f} than that of one{', very strong evidence' if one.several else ''})"
        for emotion, one in told
    ]
    untold = [f"{emotion} ({one.lacks.reason})" for emotion, one in found if one.lacks]
    return (
        *([
            "Mixtures of Gaussians were fitted on the first two principal components of weights scaled to length 1, one"
            " face a participant; by BIC (more than 10: very strong evidence; Kass & Raftery, 1995) there were"
            f" {'; '.join(counts)}."
        ] if counts else []),
        *([f"No mixture was fitted for {', '.join(untold)}."] if untold else []),
    )  # fmt: skip


def neighbours(context: Context) -> Section:
    """Return the recorded faces that are nearest to each mean face, whatever they were made for."""
    faces, recording = context.faces, context.recording
    ids = [
        face for face, repetition in zip(recording.face_ids, recording.faces.repetitions, strict=True) if not repetition
    ]
    rows = tuple(
        (
            *context.key(one.cell), place, near.distance, str(faces.emotions[near.face]),
            str(faces.identities[near.face]), ids[near.face],
        )
        for one in context.summaries
        for place, near in enumerate(nearest(faces.weights, one.weights, cosine_distance, NEIGHBOURS), 1)
    )  # fmt: skip
    columns = (Column("place"), Column("cosine distance"), Column("made for"), Column("on head"), Column("face"))
    return Section(
        "nearest", "Which faces are nearest to the mean faces?",
        "Recorded faces by cosine distance, the nearest first: the most typical ones, and whether they were made"
        " for the"
        " same emotion.",
        Sheet("nearest", (*context.key_columns, *columns), rows),
    )  # fmt: skip

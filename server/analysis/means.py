"""Mean faces, how strong they are, and how far people are from them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from emogen_core.analysis.cells import lengths

from .section import Column, Section, Sheet
from .telling import NAMED, cells, counted, each_or_all, interval, span, untold

if TYPE_CHECKING:
    from collections.abc import Sequence

    from emogen_core.analysis.cells import Summary

    from .context import Context
    from .faces import Gallery

COLUMNS = (
    Column("people"),
    Column("intensity", help="Length |alpha| of the weights, mean over people."),
    Column("intensity low", help="Lower end of the 95 % interval (Student)."),
    Column("intensity high", help="Upper end of it."),
    Column("rated", 2, "Answer to the question of intensity, mean over people."),
    Column("rated low", 2),
    Column("rated high", 2),
    Column("spread", help="Mean cosine distance of people's faces from the mean face."),
)


def means(context: Context) -> Section:
    """Return every cell with its mean face."""
    rows = tuple(
        (
            *context.key(one.cell), one.people, one.intensity.mean, one.intensity.low, one.intensity.high,
            one.rated.mean, one.rated.low, one.rated.high, one.spread,
        )
        for one in context.summaries
    )  # fmt: skip
    return Section(
        "means", "Mean faces and how strong they are",
        "The mean face is the mean of people's genes, put through the corrections as any face that participants see."
        " A mean face of people who mean different things is a face that nobody meant: look at spread and kinds.",
        Sheet("means", (*context.key_columns, *COLUMNS), rows),
        lacks=context.lacking(((one.cell, one) for one in context.summaries), "a spread or an interval"),
        notes=_alike(context),
        files=(_mean_weights(context), _every_face(context)), gallery=_gallery(context),
        methods=(
            "Mean faces are means of genes over participants, corrected like every face that was shown."
            " The intensity of a face is the Euclidean length of its blendshape weights.",
            *_told(context), *untold(context.summaries, "spread or interval of intensity"), *_alike(context),
        ),
    )  # fmt: skip


def _told(context: Context) -> tuple[str, ...]:
    def each(one: Summary) -> str:
        return (
            f"For {context.label(one.cell)}, mean intensity was {one.intensity.mean:.2f} (n = {one.people}"
            f"{interval(one.intensity.low, one.intensity.high, 2)}), and faces were {one.spread:.3f} from the mean"
            " face."
        )

    def together(all_: Sequence[Summary]) -> str:
        return (
            f"In {cells([one.people for one in all_])}, mean intensity was"
            f" {span((one.intensity.mean for one in all_), 2)}, and faces were {span(one.spread for one in all_)} from"
            " the mean face (means.csv)."
        )

    return each_or_all([one for one in context.summaries if one.enough], each, together)


def _alike(context: Context) -> tuple[str, ...]:
    """Return of which cells all faces are the same: there is no interval of what does not vary."""
    same = [cell for cell, faces in context.cells if faces.person_count > 1 and not np.ptp(faces.weights, axis=0).any()]
    if not same:
        return ()
    named = "" if len(same) > NAMED else f" ({'; '.join(map(context.label, same))})"
    return (
        f"In {len(same)} of {counted(len(context.cells), 'cell')}{named} all faces are the same; how far those of"
        " other people may be cannot be said.",
    )


def _gallery(context: Context) -> Gallery | None:
    if context.studio is None:
        return None
    return context.studio.portraits(
        [
            (context.label(one.cell), f"mean of {one.people}", one.cell.identity, one.weights)
            for one in context.summaries
        ]
    )


def _mean_weights(context: Context) -> Sheet:
    columns = [f"gene_{name}" for name in context.rig.gene_names]
    columns += [f"weight_{name}" for name in context.rig.shape_names]
    rows = ((*context.key(one.cell), *one.genes.tolist(), *one.weights.tolist()) for one in context.summaries)
    return Sheet("mean-weights", (*context.key_columns, *map(Column, columns)), tuple(rows))


def _every_face(context: Context) -> Sheet:
    recording = context.recording
    faces = recording.faces
    rows = zip(
        (recording.result,) * len(faces), recording.face_ids, recording.trials, faces.people.tolist(),
        faces.emotions.tolist(),
        faces.identities.tolist(), faces.conditions.tolist(), faces.repetitions.tolist(),
        lengths(faces.weights).tolist(), recording.seeds, strict=True,
    )  # fmt: skip
    names = (
        "result", "face", "trial", "participation", "emotion", "head", "condition", "repetition", "intensity", "seed"
    )  # fmt: skip
    return Sheet("faces", tuple(map(Column, names)), tuple(rows))

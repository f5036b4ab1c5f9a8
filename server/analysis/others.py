"""How far people are from the mean of the others, in the end and on the way, beside as many simulated people."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from emogen_core.analysis.comparisons import controlled
from emogen_core.analysis.intervals import mean_interval
from emogen_core.analysis.proxy import convergence, proxy

from ..charts import Axis, Caption, Panel, Tick, band, drawn, grid, line, number_axis, titles
from ..charts.legend import bare_line, filled
from ..reporting.figures import Figure, framed
from .apart import NOISES
from .rows import NOISE, Span, spans_figure
from .section import Column, Section, Sheet
from .simulated import MOST, extents, learns
from .telling import cells, each_or_all, interval, span, untold

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from emogen_core.analysis.intervals import Interval
    from emogen_core.analysis.proxy import Convergence, Proxy
    from emogen_core.analysis.recorded import Cell

    from .context import Context
    from .section import Value
    from .simulated import Crowd

SIZES = (
    "Simulated groups have one face in mind and as many people as the cell, since the mean of fewer is rougher;"
    f" {MOST} where there are more."
)
ESTIMATE = "After the last generation stands the estimate, in the place of one more best face."


class Far(NamedTuple):
    """The distances of a cell to the mean of the others, their mean, and how many are beyond either simulation."""

    cell: Cell
    faithful: Proxy
    noisy: Proxy
    mean: Interval
    crowd: Crowd

    @property
    def noises(self) -> tuple[float, float]:
        """The means of both simulations."""
        return self.crowd.faithful[-1].mean, self.crowd.noisy[-1].mean


def proxies(context: Context) -> Section:
    """Return the distances of people to the mean of the others beside the simulated ones."""
    found = [_far(context, cell) for cell, _ in context.cells]
    told = [one for one in found if one.faithful.enough]
    q = controlled({one.cell: one.faithful.beyond for one in told})
    columns = (
        Column("people"), Column("mean", help="Cosine distance to the mean of the weights of the others."),
        Column("sd"), Column("mean low", help="Lower end of the 95 % interval of the mean (Student)."),
        Column("mean high"), *NOISES, Column("95th percentile", help="What 19 of 20 simulated people stay below."),
        Column("beyond", help="People beyond it."), Column("share"),
        Column("share low", help="Lower end of the exact 95 % interval of the share."), Column("share high"),
        Column("p", 4, "Of as many beyond by chance, one in twenty each; approximate."),
        Column("q", 4, "p adjusted for false discoveries over the cells."),
        Column("beyond with noise", help="People beyond the 95th percentile of people with noise."),
    )  # fmt: skip
    rows = tuple(
        (*context.key(one.cell), len(one.faithful.people), *(_row(one, q) if one in told else (None,) * 14))
        for one in found
    )
    spans = [Span(context.label(one.cell), one.mean.mean, one.mean.low, one.mean.high, one.noises) for one in told]
    title = "Distance to the mean of the others"
    return Section(
        "proxy", "Whose face is far from the others'?",
        "What somebody meant is not known; the mean face of the others stands for it (EmoGen 2021, section IV-C).",
        Sheet("proxy", (*context.key_columns, *columns), rows),
        lacks=context.lacking(((one.cell, one.faithful) for one in found), "a distance to the others' mean"),
        notes=_sizes(context),
        figures=(spans_figure("proxy", title, spans, "cosine distance", NOISE),) if spans else (),
        methods=(
            *_beyond(context, told),
            *untold([one.faithful for one in found], "distance to the mean of the others"),
        ),
    )  # fmt: skip


def _sizes(context: Context) -> tuple[str, ...]:
    """Return how large simulated groups are, and how many there are where a search learns."""
    configs = context.recording.configs
    learning = [one for key, one in extents(configs).items() if learns(configs[key])]
    shared = " Searches that learn share the time." if len(learning) > 1 else ""
    return SIZES, *(
        f"Of a search that learns, which takes long to simulate, there are {extent.minds} groups of a size, of at most"
        f" {most} people.{shared}"
        for extent, most in dict.fromkeys(learning)
    )


def _far(context: Context, cell: Cell) -> Far:
    faces, crowd = dict(context.cells)[cell], context.crowd(cell)
    faithful, noisy = proxy(faces, crowd.faithful[-1]), proxy(faces, crowd.noisy[-1])
    return Far(cell, faithful, noisy, mean_interval(faithful.distances), crowd)


def _row(one: Far, q: Mapping[Cell, float]) -> tuple[Value, ...]:
    beyond = one.faithful.beyond
    return (
        one.mean.mean, one.faithful.sd, one.mean.low, one.mean.high, *one.noises, one.crowd.faithful[-1].most,
        beyond.beyond, beyond.share, beyond.low, beyond.high, beyond.p, q.get(one.cell), one.noisy.beyond.beyond,
    )  # fmt: skip


def _beyond(context: Context, found: Sequence[Far]) -> tuple[str, ...]:
    def each(one: Far) -> str:
        share = one.faithful.beyond
        return (
            f"For {context.label(one.cell)}, participants were {one.mean.mean:.3f} from the mean of the others"
            f" (n = {share.count}{interval(one.mean.low, one.mean.high)}; simulated groups of this size:"
            f" {one.noises[0]:.3f}, with noise {one.noises[1]:.3f}); {share.beyond} were beyond the simulated 95th"
            f" percentile, {one.noisy.beyond.beyond} beyond the one with noise."
        )

    def together(all_: Sequence[Far]) -> str:
        beyond = sum(one.faithful.beyond.beyond for one in all_)
        noisy = sum(one.noisy.beyond.beyond for one in all_)
        return (
            f"In {cells([one.mean.count for one in all_])}, participants were {span(one.mean.mean for one in all_)}"
            f" from the mean of the others (simulated groups of the same sizes: {span(one.noises[0] for one in all_)},"
            f" with noise {span(one.noises[1] for one in all_)}); of {sum(one.faithful.beyond.count for one in all_)}"
            f" distances, {beyond} were beyond the simulated 95th percentile and {noisy} beyond the one with noise"
            " (proxy.csv)."
        )

    return each_or_all(found, each, together)


def converging(context: Context) -> Section:
    """Return how the best faces of the generations come nearer to the mean of the others."""
    found = [(cell, convergence(faces)) for cell, faces in context.cells]
    rows = tuple(
        (*context.key(cell), generation, point.count, point.mean, point.low, point.high,
         *_noise_at(context, cell, generation))
        for cell, one in found for generation, point in enumerate(one.points)
    )  # fmt: skip
    columns = (
        Column("generation"), Column("people"), Column("mean", help="Cosine distance to the others' mean face."),
        Column("low", help="Lower end of the 95 % interval (Student)."), Column("high", help="Upper end of it."),
        *NOISES,
    )  # fmt: skip
    told = [(cell, one) for cell, one in found if one.points]
    return Section(
        "convergence", "Do people come nearer to what the others found?",
        "Distance of the best face of every generation to the mean of the other people's finished faces.",
        Sheet("convergence", (*context.key_columns, *columns), rows), lacks=context.lacking(found, "convergence"),
        notes=(*_sizes(context), *((ESTIMATE,) if context.recording.result == "estimate" else ())),
        figures=(_courses(context, told),) if told else (),
        methods=(
            *_nearer(context, told), *untold([one for _, one in found], "convergence"),
        ),
    )  # fmt: skip


def _noise_at(context: Context, cell: Cell, generation: int) -> tuple[float | None, float | None]:
    crowd = context.crowd(cell)
    if generation >= len(crowd.faithful):
        return None, None
    return crowd.faithful[generation].mean, crowd.noisy[generation].mean


def _nearer(context: Context, found: Sequence[tuple[Cell, Convergence]]) -> tuple[str, ...]:
    def each(one: tuple[Cell, Convergence]) -> str:
        first, last = one[1].points[0], one[1].points[-1]
        return (
            f"For {context.label(one[0])}, the best face was {first.mean:.3f} from the mean of the others in the first"
            f" generation and {last.mean:.3f} in the last (n = {last.count}{interval(last.low, last.high)})."
        )

    def together(all_: Sequence[tuple[Cell, Convergence]]) -> str:
        return (
            f"In {cells([one.points[-1].count for _, one in all_])}, the best face was"
            f" {span(one.points[0].mean for _, one in all_)} from the mean of the others in the first generation and"
            f" {span(one.points[-1].mean for _, one in all_)} in the last (convergence.csv)."
        )

    return each_or_all(found, each, together)


def _courses(context: Context, found: list[tuple[Cell, Convergence]]) -> Figure:
    return Figure(
        "panels", "Distance to the others in each generation",
        "The line is the mean over people, the area around it its 95 % interval; the others are groups of simulated"
        " people with one face in mind.",
        tuple(_course(context, at, *one) for at, one in enumerate(found)),
        (bare_line("people"), filled("95 % interval", "band"),
         *(bare_line(name, look) for look, name in enumerate(NOISE, 2))),
    )  # fmt: skip


def _course(context: Context, at: int, cell: Cell, found: Convergence) -> Panel:
    crowd = context.crowd(cell)
    last = max(len(found.points), len(crowd.faithful)) - 1
    ticks = tuple(Tick(one, str(one)) for one in sorted({0, last // 2, last}))
    simulated = [[(at, one.mean) for at, one in enumerate(kind)] for kind in (crowd.faithful, crowd.noisy)]
    points = list(enumerate(found.points))
    marks = (
        band([(place, one.low, one.high) for place, one in points]), grid(),
        *(line(course, look) for look, course in enumerate(simulated, 2)),
        line([(place, one.mean) for place, one in points]), titles("generation", "cosine distance"),
    )  # fmt: skip
    ends = [one.mean for one in found.points if one.mean is not None]
    note = f"{ends[0]:.2f} at first, {ends[-1]:.2f} at last" if ends else ""
    caption = Caption(f"convergence-{at}", f"Distance to the others, {context.label(cell)}", f"{note}.", "small")
    axis = framed(Axis(0, max(last, 1), ticks), number_axis(0, 1, 5))
    return Panel(context.label(cell), note, drawn(axis, marks, caption))

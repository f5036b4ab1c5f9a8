"""Charts of the results: whether people settle, and the map of all finished faces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...charts import Caption, Frame, Panel, Table, dots, drawn, grid, line
from ...charts.map import LOOKS, Area, face_map, look_of
from ...charts.whiskers import whiskers
from .settling_charts import distance_axis, generation_axis, highest, short, simulated

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from ...charts import Mark, Markup
    from ...services.reports.results.noise import Settling
    from ...services.reports.results.numbers import Curve, Numbers


def panels(numbers: Numbers, settling: Settling | None) -> tuple[Panel, ...]:
    """Return for every emotion how its best faces come nearer to the finished ones, a line a condition."""
    heights = [high for curve in numbers.curves for _, mean, _, high in curve.points for high in (high or mean,)]
    most = max([*heights, highest(settling)], default=1.0)
    last = max((point[0] for curve in numbers.curves for point in curve.points), default=1)
    frame = Frame(generation_axis(range(last + 1)), distance_axis(most), left=34)
    return tuple(_panel(frame, numbers, emotion, noun, simulated(settling, last)) for emotion, noun in numbers.emotions)


def table(numbers: Numbers) -> Table:
    """Return the numbers behind the panels."""
    last = max((point[0] for curve in numbers.curves for point in curve.points), default=-1)
    nouns = dict(numbers.emotions)
    rows = tuple(
        (f"{nouns[curve.emotion].capitalize()}, {curve.condition}", *_cells(curve, last)) for curve in numbers.curves
    )
    return Table(("Emotion, condition", *(str(one) for one in range(last + 1))), rows)


def faces_map(numbers: Numbers, picture: Callable[[str], str | None]) -> Markup | None:
    """Return the map of all finished faces with the address of each emotion's mean face."""
    if numbers.plane is None:
        return None
    areas = [
        Area(noun.capitalize(), numbers.places[emotion], numbers.middles[emotion], picture(emotion))
        for emotion, noun in numbers.emotions
    ]
    shape = ("dots", "squares", "triangles", "crosses")
    told = ", ".join(f"{area.name} as {shape[index % LOOKS]}" for index, area in enumerate(areas))
    says = f"{numbers.faces} finished faces by their first two principal components: {told}."
    return face_map(areas, Caption("map", "Map of all finished faces", says, "map"))


def _panel(frame: Frame, numbers: Numbers, emotion: str, noun: str, under: Sequence[Mark]) -> Panel:
    names = [name for name, _ in numbers.conditions]
    marks = [*under, grid()]
    ends = []
    for curve in (one for one in numbers.curves if one.emotion == emotion):
        look = look_of(names.index(curve.condition))
        points = [(float(at), mean) for at, mean, _, _ in curve.points]
        marks += [whiskers([(at, low, high) for at, _, low, high in curve.points], look), line(points, look)]
        marks.append(dots(points, look))
        ends.append(f"{curve.condition}: {short(points[-1][1])}" if points else "")
    note = _settled(numbers, emotion)
    says = f"In the last generation before the finished face: {', '.join(filter(None, ends)) or 'no faces'}. {note}"
    title = f"Do people settle? {noun.capitalize()}"
    return Panel(
        noun.capitalize(), note, drawn(frame, marks, Caption(f"settle-{_word(emotion)}", title, says.strip(), "small"))
    )


def _settled(numbers: Numbers, emotion: str) -> str:
    shares = (one.settled for one in numbers.lines if one.emotion == emotion and one.settled is not None)
    return next((f"{round(100 * share)} % settled" for share in shares), "")


def _cells(curve: Curve, last: int) -> Sequence[str]:
    there: Mapping[int, str] = {at: short(mean) for at, mean, _, _ in curve.points}
    return [there.get(at, "") for at in range(last + 1)]


def _word(text: str) -> str:
    return "".join(letter if letter.isascii() and letter.isalnum() else "-" for letter in text)

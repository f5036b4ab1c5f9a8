"""What came out of a study: mean faces, the map, whether people settle, the numbers, and figures to keep."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated
from urllib.parse import urlencode

from fastapi import APIRouter, Depends, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import Response

from ...charts.legend import legend
from ...services.reports.results.data import Filters
from ...services.reports.results.noise import settling_of
from ..access import Services
from ..portraits import within
from . import figures
from .analysis import standing
from .desk import Me, study_page
from .results_charts import faces_map, panels, table
from .settling_charts import short

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...services.reports.results.results import Results

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)

Word = Annotated[str, Query(max_length=200)]
Version = Annotated[int, Query(ge=0, le=10**6)]


def _filters(  # noqa: PLR0913, PLR0917 - the filters of the address
    head: Word = "",
    condition: Word = "",
    since: Version = 0,
    block: Word = "",
    flagged: Word = "leave",
    who: Word = "people",
) -> Filters:
    return Filters(head, condition, since, block, flagged, who)


Wanted = Annotated[Filters, Depends(_filters)]


@router.get("/results", response_model=None)
def results(study: str, me: Me, house: Services, filters: Wanted) -> Response:
    """Show the results."""
    found = house.results.of(study, filters)
    numbers, settling = found.numbers, settling_of(found.noise)
    names = [name for name, _ in numbers.conditions]
    return study_page(
        "results", me, house, study, found=found, numbers=numbers, filters=filters, settling=settling,
        address=_address(filters), panels=panels(numbers, settling), table=table(numbers), legend=legend(names),
        map=faces_map(numbers, _picture(study, found)), short=short, server=house.settings.address,
        **standing(house, study),
    )  # fmt: skip


@router.get("/results/face.png", response_model=None)
async def face(  # noqa: PLR0913, PLR0917 - the face's address
    study: str,
    me: Me,  # noqa: ARG001
    house: Services,
    filters: Wanted,
    emotion: Word,
    cell: Word = "",
) -> Response:
    """Return the portrait of a mean face, of one condition or of all."""
    promise = await run(house.results.face, study, filters, emotion, cell)
    picture = await within(promise, house.settings.portrait_wait_seconds)
    return Response(picture, media_type="image/png", headers={"Cache-Control": "private, max-age=3600"})


@router.get("/results/figures.zip", response_model=None)
def download(study: str, me: Me, house: Services, filters: Wanted) -> Response:  # noqa: ARG001
    """Download the charts as SVG files."""
    found = house.results.of(study, filters)
    drawn = {f"settling-{one.name.lower()}": one.svg for one in panels(found.numbers, settling_of(found.noise))}
    plane = faces_map(found.numbers, lambda _: None)
    packed = figures.packed({**drawn, **({"map": plane} if plane else {})})
    name = f'attachment; filename="{study}-figures.zip"'
    return Response(packed, media_type="application/zip", headers={"Content-Disposition": name})


def _address(filters: Filters) -> str:
    """Return the filters as they stand in an address."""
    plain = Filters()
    given = {name: getattr(filters, name) for name in Filters.__slots__}
    return urlencode({name: value for name, value in given.items() if value != getattr(plain, name)})


def _picture(study: str, found: Results) -> Callable[[str], str]:
    """Return what gives the address of an emotion's mean face; it changes when somebody else has finished."""
    stamp = f"{found.numbers.faces}-{found.counted_at:%H%M%S}"
    path, rest = f"/admin/studies/{study}/results/face.png", _address(found.filters)
    return lambda emotion: f"{path}?{urlencode({'emotion': emotion, 'as': stamp})}&{rest}"

"""The people of a study: their list, one of them with the replay of what they did, and their withdrawal."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import urlencode

from fastapi import APIRouter, Path, Query
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response, StreamingResponse

from ...services.errors import InvalidError, NotFoundError, ServiceError
from ...services.naming import name_of
from ...services.reports.participants.roster import KINDS, STATUSES, Filters
from ..access import Services
from ..errors import status_of
from .desk import Me, WorkForm, study_page
from .settling_charts import one_trial

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)

Word = Annotated[str, Query(max_length=100)]
Number = Annotated[int, Path(ge=0, le=10**9)]
Place = Annotated[int | None, Query(ge=0, le=10**9)]


@router.get("/participants", response_model=None)
def participants(  # noqa: PLR0913, PLR0917 - the filters of the address
    study: str,
    me: Me,
    house: Services,
    status: Word = "",
    condition: Word = "",
    kind: Word = "",
    q: Word = "",
    below: Place = None,
    above: Place = None,
    erased: Place = None,
) -> Response:
    """List the people of a study."""
    filters = Filters(status, condition, kind, q, below, above)
    return _list(study, me, house, filters, erased=None if erased is None else name_of(erased))


@router.post("/withdrawals", response_model=None)
async def withdraw(study: str, me: Me, form: WorkForm, house: Services) -> Response:
    """Lead to the question whether the participant who has a withdrawal code is to be erased."""
    code = form.get("code", "")
    try:
        number = await run(house.withdrawals.number_of, study, code)
    except NotFoundError as error:
        return await run(_list, study, me, house, Filters(), problem=error, code=code)
    return RedirectResponse(f"/admin/studies/{study}/participants/{number}/erase", 303)


@router.get("/participants/{number}", response_model=None)
def participant(  # noqa: PLR0913, PLR0917 - the page's address
    study: str, number: Number, me: Me, house: Services, trial: Place = None, check: bool = False
) -> Response:
    """Show one participant and one of their trials; on demand, whether the record replays."""
    person = house.records.person(study, number, trial)
    checked, unchecked = house.replay.checked(person.id) if check else (None, None)
    chart = one_trial(person.strip.distances, person.settling) if person.strip and person.strip.distances else None
    return study_page(
        "participants", me, house, study,
        template="participant", person=person, chart=chart, checked=checked, unchecked=unchecked,
    )  # fmt: skip


@router.get("/participants/{number}/record.json", response_model=None)
def record(study: str, number: Number, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Download everything that is kept of one participant."""
    lines = house.exports.record(study, house.records.id_of(study, number))
    name = f'attachment; filename="{study}-{name_of(number)}.json"'
    return StreamingResponse(lines, media_type="application/json", headers={"Content-Disposition": name})


@router.get("/participants/{number}/erase", response_model=None)
def confirm(study: str, number: Number, me: Me, house: Services) -> Response:
    """Ask whether a participant is to be erased, with what that takes away."""
    try:
        erasure = house.withdrawals.preview(study, number)
    except InvalidError:
        return RedirectResponse(f"/admin/studies/{study}/participants/{number}", 303)
    return study_page("participants", me, house, study, template="erase", erasure=erasure)


@router.post("/participants/{number}/erase", response_model=None)
async def erase(study: str, number: Number, me: Me, form: WorkForm, house: Services) -> Response:  # noqa: ARG001
    """Erase a participant."""
    await run(house.withdrawals.erase, study, number, me.user)
    return RedirectResponse(f"/admin/studies/{study}/participants?erased={number}", 303)


def _list(  # noqa: PLR0913 - what the page shows
    study: str,
    me: Me,
    house: Services,
    filters: Filters,
    *,
    erased: str | None = None,
    problem: ServiceError | None = None,
    code: str = "",
) -> Response:
    given = {"status": filters.status, "condition": filters.condition, "kind": filters.kind, "q": filters.q}
    return study_page(
        "participants", me, house, study, status_of(problem) if problem else 200,
        people=house.roster.page(study, filters),
        filters=filters, address=urlencode({name: value for name, value in given.items() if value}), code=code,
        statuses=STATUSES, kinds=KINDS, erased=erased, problem=problem.message if problem else None,
    )  # fmt: skip

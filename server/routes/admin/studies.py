"""The list of studies, new ones, and what may be done with one as a whole."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any, Literal, get_args

from fastapi import APIRouter
from starlette.concurrency import run_in_threadpool as run
from starlette.responses import RedirectResponse, Response

from ...services.errors import ConflictError, InvalidError, ServiceError
from ...services.studies.life import Status
from ..access import Services
from ..errors import status_of
from . import words
from .desk import STUDIES, Experimenter, Me, WorkForm, page, study_page

if TYPE_CHECKING:
    from ...services.house import House
    from ...services.people.accounts import SignedIn
    from ...services.reports.monitor.overview import Listed

router = APIRouter(prefix="/admin/studies", include_in_schema=False)

Filter = Literal["all", "recruiting", "pilot", "draft", "paused", "closed"]
ORDER = ("recruiting", "pilot", "draft", "paused", "closed")


@router.get("", response_model=None)
def studies(me: Me, house: Services, status: Filter = "all") -> Response:
    """List the studies."""
    listing = house.overview.all()
    counted = Counter(study.status for study in listing.studies)
    statuses = {"all": len(listing.studies), **{name: counted[name] for name in ORDER}}
    return page(
        "studies",
        me=me,
        section="studies",
        say=words,
        detail=_detail,
        studies=[study for study in listing.studies if status in {"all", study.status}],
        warned=listing.warned,
        moment=listing.moment,
        chosen=status,
        statuses=statuses,
        total=len(listing.studies),
        finished=sum(study.complete for study in listing.studies),
    )


@router.post("/demo", response_model=None)
async def make_demo(me: Me, form: WorkForm, house: Services) -> Response:  # noqa: ARG001
    """Make another demonstration study."""
    made = await run(house.studies.demo, "draft", me.user)
    return RedirectResponse(f"/admin/studies/{made.id}", 303)


@router.get("/{study}", response_model=None)
def study(study: str, me: Me, house: Services) -> Response:  # noqa: ARG001
    """Lead to where a study is looked at."""
    return RedirectResponse(f"/admin/studies/{house.life.head(study).id}/monitor", 303)


@router.get("/{study}/status", response_model=None)
def ask(study: str, to: Status, me: Experimenter, house: Services) -> Response:
    """Say what a change of status means, and what is worth seeing to before it."""
    head = house.life.head(study)
    if to not in head.next:
        return RedirectResponse(f"/admin/studies/{head.id}", 303)
    return study_page("", me, house, study, template="status", to=to, outlook=house.starting.outlook(study, to))


@router.post("/{study}/status", response_model=None)
async def move(study: str, me: Me, form: WorkForm, house: Services) -> Response:
    """Let people join a study, or stop it."""
    await run(house.life.move, study, _status(form), me.user, form.get("note", ""))
    return RedirectResponse(f"/admin/studies/{study}", 303)


@router.get("/{study}/delete", response_model=None)
def ask_deletion(study: str, me: Experimenter, house: Services) -> Response:
    """Say what goes with a study, and ask for its title."""
    return _deletion(study, me, house)


@router.post("/{study}/delete", response_model=None)
async def delete(study: str, me: Experimenter, form: WorkForm, house: Services) -> Response:
    """Delete a study with everything that belongs to it."""
    title, erase = form.get("title", ""), form.get("erase") == "yes"
    try:
        await run(house.removal.delete, study, me.user, me.role, typed=title, erase=erase)
    except (InvalidError, ConflictError) as error:
        return await run(_deletion, study, me, house, error, typed=title, erase=erase)
    return RedirectResponse(STUDIES, 303)


@router.post("/{study}/copy", response_model=None)
async def copy(study: str, me: Me, form: WorkForm, house: Services) -> Response:  # noqa: ARG001
    """Make a draft like a study."""
    return RedirectResponse(f"/admin/studies/{await run(house.life.copy, study, me.user)}", 303)


def _deletion(  # noqa: PLR0913 - what the page shows
    study: str,
    me: SignedIn,
    house: House,
    error: ServiceError | None = None,
    *,
    typed: str = "",
    erase: bool = False,
) -> Response:
    status, problem, field = (status_of(error), error.message, error.field) if error else (200, None, None)
    return study_page(
        "", me, house, study, status, template="delete", problem=problem, field=field, typed=typed, erase=erase,
        has=house.removal.preview(study, me.user, me.role),
    )  # fmt: skip


def _detail(study: Listed) -> str:
    """Return what stands below a study's title: its emotions, and what else is worth knowing."""
    told = [words.listed(study.emotions)]
    if study.status == "paused" and study.note:
        return f"{told[0]} · paused for {study.note}" if study.note[:1].islower() else f"{told[0]} · {study.note}"
    if study.conditions > 1:
        told.append(f"{study.conditions} conditions")
    if study.languages > 1:
        told.append(f"{study.languages} languages")
    return " · ".join(told)


def _status(form: dict[str, str]) -> Status:
    known: dict[str, Any] = {name: name for name in get_args(Status)}
    found: Status | None = known.get(form.get("status", ""))
    if found is None:
        raise InvalidError(
            "Choose a status.", field="status", expected=f"one of {', '.join(known)}", got=form.get("status", "")
        )
    return found

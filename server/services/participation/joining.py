"""How somebody takes a place in a study."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from datetime import timedelta
from typing import TYPE_CHECKING, Any

from ...store import runs, studies
from ..clock import digest, new_token, now
from ..config import StudyConfig, offered_languages, preferred
from ..config.stored import parsed
from ..config.way_back import way_back
from ..errors import ClosedError, FullError, InvalidError, NotFoundError, ThrottledError
from .arrival import Browser, Entry, Joined
from .assignment import Cell, Place, assigned
from .devices import check_device
from .returning import known_token, new_proof, token_of
from .seating import new_participation, seat

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ...store.engine import Tx
    from ...store.runs_tables import Participation
    from ...store.studies_tables import Link, Study, StudyVersion
    from .arrival import Standing
    from .journal import Journal

OPEN = frozenset({"recruiting", "pilot"})
SHUT: dict[str, Standing] = {"draft": "draft", "paused": "paused"}
RETRY_SECONDS = 10
FORGOTTEN = timedelta(days=1)
"""How long after the end of their place those who did not consent are known, so that a page left open still works."""


@dataclass(frozen=True)
class Joining:
    """Links and the places behind them."""

    journal: Journal
    per_minute: int = 600

    def entry(self, link_id: str, recruiter: Mapping[str, str] | None = None, browser: Browser | None = None) -> Entry:
        """Return what a link has for whoever comes by it; nothing changes.

        Raises:
            NotFoundError: no such link.
        """
        with self.journal.database.read() as tx:
            came = browser or Browser()
            link, study, version = _behind(tx, link_id)
            config = parsed(version)
            kept = _kept(config, recruiter or {})
            known = _known(tx, link, config, kept, came)
            languages = (link.language,) if link.language else offered_languages(config)
            language = preferred(languages, came.languages)
            entry = Entry(study.id, config, "open", new_token(), language, languages)
            if known is not None and not known.may_return:
                return _again(link, study, entry, known)
            shut = _shut(link, study)
            arriving = new_participation(link, study, version, "")
            if shut is None and _is_free(tx, link, config, arriving):
                return entry
            if known is not None:  # nothing else is left for them here than what they have done
                return _again(link, study, entry, known)
            return self._full(entry, kept) if shut is None else replace(entry, standing=shut)

    def join(
        self,
        link_id: str,
        recruiter: Mapping[str, str] | None = None,
        *,
        simulated: bool = False,
        seed: str | None = None,
        browser: Browser | None = None,
    ) -> Joined:
        """Take a place; with the `place` of an entry page in `browser`, the same one however often it is asked for.

        Args:
            link_id: the link's last part.
            recruiter: parameters that came with it; those that the study names are kept.
            simulated: marks the participation as simulated; `seed` then makes its trials repeatable.
            seed: decimal text.
            browser: what came along.

        Raises:
            NotFoundError: no such link.
            ClosedError: the study takes nobody now.
            FullError: no place is left.
            DeviceError: the study does not admit this device.
            ThrottledError: too many came within a minute.
            InvalidError: the place or the seed is not one.
        """
        came = browser or Browser()
        offered = _checked_place(came.place) or new_token()
        with self.journal.database.write() as tx:
            link, study, version = _behind(tx, link_id, lock=True)
            config = parsed(version)
            kept = _kept(config, recruiter or {})
            token = offered if simulated else _token(tx, link, config, kept, came) or offered
            taken = runs.participation_by_token(tx, digest(token))
            if taken is not None:
                self._again(taken, config, kept, came)
                # Nothing is there to be erased yet: it may be the reply to the first try that was lost.
                return Joined(
                    token, taken.id, _proof(tx, link, _who(link, config, kept), token, wanted=_untouched(taken))
                )
            _check_open(link, study)
            if not simulated:
                self._check_rate(tx, link)
            participation = new_participation(link, study, version, token)
            participation.simulated, participation.recruiter = simulated, kept
            participation.seed = _checked_seed(seed) or participation.seed
            participation.language = _language(link, config, came)
            self._settle(tx, participation, config, link, came)
            proof = _proof(tx, link, _who(link, config, kept), token, wanted=not simulated)
        return Joined(token, participation.id, proof)

    def sweep(self) -> int:
        """Forget what came along with those who left before consent a while ago; return how many there were.

        Their rows stay as arrivals. Whoever comes back is taken for somebody new who has the same place.
        """
        with self.journal.database.write() as tx:
            left = runs.unconsented(tx, now() - FORGOTTEN)
            for one in left:
                one.recruiter, one.device = {}, {}
            return len(left)

    def study_of(self, link_id: str) -> str:
        """Return the study that a link leads to.

        Raises:
            NotFoundError: no such link.
        """
        with self.journal.database.read() as tx:
            return _behind(tx, link_id)[1].id

    def _again(self, taken: Participation, config: StudyConfig, kept: Mapping[str, str], came: Browser) -> None:
        """Let somebody who left before consent arrive again, at the same place."""
        if not _idle(taken):
            return
        own = config.in_condition(taken.condition)
        check_device(own.devices, came.device)
        taken.recruiter, taken.device = dict(kept), _device(own, came)
        taken.lease_until = now() + timedelta(minutes=own.lease_minutes)

    def _settle(self, tx: Tx, participation: Participation, config: StudyConfig, link: Link, came: Browser) -> None:
        """Give a participation its place in the design, and its trials."""
        place = assigned(config, _held(tx, participation), int(participation.seed), link.condition)
        own = config.in_condition(place.cell.condition)
        check_device(own.devices, came.device)
        participation.device = _device(own, came)
        participation.number = runs.joined(tx, participation.study_id)
        seat(tx, self.journal.rig_of(own), participation, own, place)

    def _full(self, entry: Entry, kept: Mapping[str, str]) -> Entry:
        code = entry.config.completion.codes.get("full")
        redirect = way_back(entry.config, "full", code, kept, self.journal.redirect_hosts)
        return replace(entry, standing="full", code=code, redirect=redirect)

    def _check_rate(self, tx: Tx, link: Link) -> None:
        came = runs.joined_since(tx, link.study_id, link.id, now() - timedelta(minutes=1))
        if came >= self.per_minute:
            raise ThrottledError("Many people are beginning just now. Try again in a moment.", RETRY_SECONDS)


def _behind(tx: Tx, link_id: str, *, lock: bool = False) -> tuple[Link, Study, StudyVersion]:
    link = studies.link(tx, link_id)
    study = None if link is None else studies.study(tx, link.study_id, lock=lock)
    version = None if study is None else studies.latest_version(tx, study.id)
    if link is None or study is None or version is None:
        raise NotFoundError("This link leads to no study. Check that it was copied as a whole.")
    return link, study, version


@dataclass(frozen=True, slots=True)
class _Known:
    token: str
    over: bool
    by_name: bool
    """Known by a personal link or a recruiter's id, so that there is one participation for ever."""
    may_return: bool
    """Finished, by a link that takes anybody any number of times."""


def _known(tx: Tx, link: Link, config: StudyConfig, kept: Mapping[str, str], came: Browser) -> _Known | None:
    """Return whoever comes, if they have been here; without a name the cookie tells."""
    who = _who(link, config, kept)
    token = known_token(tx, link.study_id, who) if who else came.known
    found = runs.participation_by_token(tx, digest(token)) if token else None
    if token is None or found is None or found.study_id != link.study_id or _idle(found):
        return None
    over = found.outcome is not None
    return _Known(token, over, who is not None, over and who is None and link.kind == "general_multiple")


def _again(link: Link, study: Study, entry: Entry, known: _Known) -> Entry:
    standing: Standing = "taken" if known.over else "running"
    anew = link.kind == "general_multiple" and not known.by_name and _shut(link, study) is None
    return replace(entry, standing=standing, address=f"/p/{known.token}", anew=anew)


def _token(tx: Tx, link: Link, config: StudyConfig, kept: Mapping[str, str], came: Browser) -> str | None:
    """Return the token that whoever comes has, or will have: a known person's own, or that of an earlier visit."""
    who = _who(link, config, kept)
    if who is not None:
        return token_of(tx, link.study_id, who)
    known = _known(tx, link, config, kept, came) if link.kind == "general_single" else None
    return None if known is None else known.token


def _proof(tx: Tx, link: Link, who: str | None, token: str, *, wanted: bool) -> str | None:
    named = wanted and link.kind != "personal" and who is not None
    return new_proof(tx, token) if named else None


def _device(own: StudyConfig, came: Browser) -> dict[str, Any]:
    """Return what is kept of a device."""
    device: dict[str, Any] = came.device.plain() if came.device else {}
    if own.user_agent and came.user_agent:
        device["user_agent"] = came.user_agent[:300]
    return device


def _idle(found: Participation) -> bool:
    """Return whether somebody left before consent and gave the place back; what came along is or will be forgotten."""
    waits = found.step == "consent" and found.outcome is None
    return waits and (found.lease_until is None or found.lease_until <= now())


def _untouched(taken: Participation) -> bool:
    return taken.outcome is None and taken.last_answer_at is None


def _shut(link: Link, study: Study) -> Standing | None:
    if link.closed_at is not None:
        return "link_closed"
    return None if study.status in OPEN else SHUT.get(study.status, "closed")


def _check_open(link: Link, study: Study) -> None:
    shut = _shut(link, study)
    if shut is not None:
        raise ClosedError(shut)


def _is_free(tx: Tx, link: Link, config: StudyConfig, arriving: Participation) -> bool:
    try:
        assigned(config, _held(tx, arriving), int(arriving.seed), link.condition)
    except FullError:
        return False
    return True


def _held(tx: Tx, arriving: Participation) -> list[tuple[Place, int]]:
    held = runs.held_places(tx, arriving.study_id, arriving, now())
    return [(Place(Cell(condition, head), row), count) for condition, head, row, count in held]


def _language(link: Link, config: StudyConfig, came: Browser) -> str:
    return link.language or preferred(offered_languages(config), came.languages)


def _who(link: Link, config: StudyConfig, kept: Mapping[str, str]) -> str | None:
    """Return who comes, where that is known: the person of a personal link, or whom the recruiter names."""
    if link.kind == "personal":
        return f"link {link.id}"
    named = kept.get(config.recruiter_parameters[0]) if config.recruiter_parameters else None
    return f"{config.recruiter_parameters[0]} {named}" if named else None


def _checked_place(place: str | None) -> str | None:
    if place is not None and not (len(place) == len(new_token()) and re.fullmatch(r"[\w-]+", place, re.ASCII)):
        raise InvalidError(
            "This start page is not complete. Load it again.", field="place", expected="32 letters, digits, - or _"
        )
    return place


def _checked_seed(seed: str | None) -> str | None:
    if seed is not None and not (seed.isascii() and seed.isdigit() and len(seed) <= 39):
        raise InvalidError("The seed is not a number.", field="seed", expected="up to 39 decimal digits", got=seed)
    return seed


def _kept(config: StudyConfig, recruiter: Mapping[str, str]) -> dict[str, str]:
    return {name: recruiter[name][:200] for name in config.recruiter_parameters if name in recruiter}

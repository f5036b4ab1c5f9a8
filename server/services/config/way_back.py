"""Where a participant is sent when it is over: only to hosts that the server lists (EMOGEN_REDIRECT_HOSTS)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any
from urllib.parse import quote, urlsplit

from ..errors import InvalidError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from . import StudyConfig

SETTING = "EMOGEN_REDIRECT_HOSTS"
# What browsers read otherwise than this server would (a backslash, white space, a user before the host) is no address.
_ADDRESS = re.compile(r"https://[A-Za-z0-9.-]+(:\d{1,5})?([/?#][^\s\\\x00-\x1f\x7f]*)?")
_PLACE = re.compile(r"\{(\w+)\}")


def host_list(setting: str) -> tuple[str, ...]:
    """Return the hosts of the setting."""
    return tuple(host.strip().lower() for host in setting.split(",") if host.strip())


def allowed(address: str, hosts: Sequence[str]) -> bool:
    """Return whether participants may be sent to an address."""
    if not _ADDRESS.fullmatch(address):
        return False
    host = _host(address)
    return any(host.endswith(one) if one.startswith(".") else host == one for one in hosts)


def check_redirects(config: StudyConfig, hosts: Sequence[str]) -> None:
    """Refuse a study that sends participants where this server does not, or fills in what nobody knows.

    Raises:
        InvalidError: names the outcome, the host and the setting.
    """
    for own in {id(one): one for one in (config, *config.whole)}.values():
        known = {"code", *own.recruiter_parameters}
        for outcome, address in own.completion.redirects.items():
            field = f"completion.redirects.{outcome}"
            _check_host(field, address, hosts)
            _check_places(field, address, known)


def way_back(
    config: StudyConfig, outcome: str | None, code: str | None, recruiter: Mapping[str, Any], hosts: Sequence[str]
) -> str | None:
    """Return the address for an outcome with its places filled; None without one, or where a value is missing."""
    redirects: dict[Any, str] = dict(config.completion.redirects)
    values = {**recruiter, "code": code}
    template = redirects.get(outcome)
    if template is None or any(not values.get(name) for name in _PLACE.findall(template)):
        return None
    filled = _PLACE.sub(lambda found: quote(str(values[found[1]]), safe=""), template)
    return filled if allowed(filled, hosts) else None


def _host(address: str) -> str:
    return (urlsplit(address).hostname or "").lower()


def _check_host(field: str, address: str, hosts: Sequence[str]) -> None:
    if not allowed(address, hosts):
        host = urlsplit(address).netloc or address
        raise InvalidError(
            f"Participants may not be sent to {host}. Use another address for this outcome, or have {SETTING} name"
            " this host.",
            field=field,
            expected=f"https:// and a host of {SETTING}: {', '.join(hosts) or 'none'}",
            got=host,
        )


def _check_places(field: str, address: str, known: set[str]) -> None:
    strange = [name for name in _PLACE.findall(address) if name not in known]
    if strange:
        raise InvalidError(
            "The address names a value that nobody knows.",
            field=field,
            expected=f"only {', '.join(f'{{{name}}}' for name in sorted(known))}",
            got=f"{{{strange[0]}}}",
        )

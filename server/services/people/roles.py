"""Who may do what: three roles, each with the rights of the one below it (docs/study.md)."""

from __future__ import annotations

from typing import Literal

from ..errors import ForbiddenError, InvalidError

Role = Literal["analyst", "experimenter", "owner"]
Right = Literal["look", "work", "rule"]
"""To look at studies, results and data; to make and change studies; to decide who works here."""
RIGHTS: dict[str, frozenset[Right]] = {
    "analyst": frozenset({"look"}),
    "experimenter": frozenset({"look", "work"}),
    "owner": frozenset({"look", "work", "rule"}),
}


def require(role: str, right: Right) -> None:
    """Refuse what a role may not do.

    Raises:
        ForbiddenError: names the roles that may.
    """
    able = [name for name, rights in RIGHTS.items() if right in rights]
    if role not in able:
        raise ForbiddenError(
            f"This needs the role {' or '.join(able)}; yours is {role}. Ask an owner.",
            field="role",
            expected=" or ".join(able),
            got=role,
        )


def checked_role(role: str) -> Role:
    """Return a role that there is.

    Raises:
        InvalidError: there is none of this name.
    """
    for known in RIGHTS:
        if known == role:
            return known  # type: ignore[return-value]
    raise InvalidError("Choose a role.", field="role", expected=f"one of {', '.join(RIGHTS)}", got=role)

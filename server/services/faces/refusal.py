"""What the core refuses of a head, as an error of a field of a request."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from emogen_core.errors import IdentityError

from ..errors import InvalidError

if TYPE_CHECKING:
    from emogen_core.errors import EmogenError


def refusal(where: str, error: EmogenError) -> InvalidError:
    """Return an error of the core as one of a field of a request."""
    found = re.fullmatch(r"(?:(.*?): )?expected (.*), got (.*)", str(error), re.DOTALL)
    if found is None or not isinstance(error, IdentityError | ValueError):
        return InvalidError(f"{where}: {error}.", field=where)
    part, wanted, got = found.groups()
    field = ".".join([where, *([] if part in {None, "identity"} else part.split(": "))])
    return InvalidError(
        f"The head cannot be used: {field}: expected {wanted}, got {got}.", field=field, expected=wanted, got=got
    )

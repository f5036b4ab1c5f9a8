"""How somebody who is known comes back on any browser: the token of a known person follows from a secret of the server.

Only a token's hash is stored, so a forgotten token cannot be looked up. Whoever has a personal link, or comes with the
same recruiter's id, is given the same token each time instead. A recruiter's id is no secret, so it does not suffice to
have everything erased: that takes the browser in which the place was taken, which has a proof, or the withdrawal code.
"""

from __future__ import annotations

import base64
import hmac
from typing import TYPE_CHECKING

from ...store import keys, studies
from ..clock import new_token, now

if TYPE_CHECKING:
    from ...store.engine import Tx
    from ...store.runs_tables import Participation
    from ..config import StudyConfig

KEY = "returning"


def token_of(tx: Tx, study_id: str, who: str) -> str:
    """Return the token of a known person in a study; the first call of a server makes its secret."""
    return _token(keys.shared(tx, KEY, new_token(), now()), study_id, who)


def known_token(tx: Tx, study_id: str, who: str) -> str | None:
    """Return the token of a known person; None where nobody was known to this server yet. Nothing is stored."""
    secret = keys.known(tx, KEY)
    return None if secret is None else _token(secret, study_id, who)


def new_proof(tx: Tx, token: str) -> str:
    """Return what the browser in which a place is taken keeps, so that it may erase what was given under a token."""
    return _proof(keys.shared(tx, KEY, new_token(), now()), token)


def wanted_proof(tx: Tx, token: str, participation: Participation, config: StudyConfig) -> str | None:
    """Return the proof without which nothing is erased; None where the token itself is a secret."""
    names = config.recruiter_parameters[:1]
    link = studies.link(tx, participation.link_id)
    by_id = any(participation.recruiter.get(name) for name in names) and link is not None and link.kind != "personal"
    if not by_id or participation.simulated or participation.preview:
        return None
    secret = keys.known(tx, KEY)
    return None if secret is None else _proof(secret, token)


def proven(wanted: str | None, shown: str | None) -> bool:
    """Return whether a browser has the proof that is wanted."""
    return wanted is None or hmac.compare_digest(wanted, shown or "")


def _proof(secret: str, token: str) -> str:
    return hmac.digest(secret.encode(), f"proof {token}".encode(), "sha256").hex()


def _token(secret: str, study_id: str, who: str) -> str:
    # Lengths keep two pairs that read the same when joined apart.
    message = f"{len(study_id)} {study_id} {who}".encode()
    digest = hmac.digest(secret.encode(), message, "sha256")
    return base64.urlsafe_b64encode(digest).decode()[: len(new_token())]

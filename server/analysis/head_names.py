"""What people call the heads that a study brought along, whose names in the data are hashes."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ..services.config import StudyConfig


def head_names(studies: Iterable[StudyConfig], heads: Sequence[str]) -> dict[str, str]:
    """Return the names in the identity documents of those heads that have one, by their names in the data.

    Where two heads would be called the same, the name in the data stands with it.
    """
    known = {head: str(document["name"]) for study in studies for head, document in study.documents.items()}
    called = Counter(known.get(head, head) for head in heads)
    return {
        head: known[head] if called[known[head]] == 1 else f"{known[head]} ({head})" for head in heads if head in known
    }

"""Planning a study: what to expect of its settings with each strategy, before anybody has taken part."""

from __future__ import annotations

from fastapi import APIRouter
from starlette.responses import Response

from emogen_core.simulation.evaluation.participants import EFFECTS

from ...services.studies.editing.leaves import label
from ..access import Services
from .desk import Me, study_page
from .settling_charts import short

router = APIRouter(prefix="/admin/studies/{study}", include_in_schema=False)


@router.get("/planning", response_model=None)
def planning(study: str, me: Me, house: Services) -> Response:
    """Show error, noise and number of participants with each strategy; what is not known yet is being simulated."""
    expected = house.planning.of(study)
    return study_page(
        "design", me, house, study, template="planning", expected=expected, label=label, short=short,
        effects=EFFECTS, waiting=any(one.noise is None for one in expected),
    )  # fmt: skip

"""Whether this process lives, and whether it can work."""

from __future__ import annotations

from fastapi import APIRouter

from .access import Services

router = APIRouter(prefix="/health")


@router.get("/live")
async def live() -> dict[str, str]:
    """Answer as long as the process runs."""
    return {"status": "alive"}


@router.get("/ready")
def ready(house: Services) -> dict[str, str]:
    """Answer when the database does."""
    house.ready()
    return {"status": "ready"}

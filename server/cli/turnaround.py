"""How long a participant waits between a choice and ten new faces."""

from __future__ import annotations

import asyncio
import io
import time
import uuid
from typing import Any

import httpx2
import numpy as np
from PIL import Image

from ..services.simulation import checked


async def measure(address: str, link: str, rounds: int, pause: float) -> dict[str, Any]:
    """Take part like one browser with six connections; choose at random after a pause.

    Returns:
        Milliseconds from sending a choice to its answer, and to ten decoded portraits.
    """
    limits = httpx2.Limits(max_connections=6)
    async with httpx2.AsyncClient(base_url=address, limits=limits, timeout=60) as client:
        walk = _Walk(client, link)
        answered: list[float] = []
        decoded: list[float] = []
        while len(decoded) < rounds:
            state = await walk.to_faces()
            await walk.decode(state)
            await asyncio.sleep(pause)
            begun = time.perf_counter()
            state = await walk.choose(state)
            answered.append((time.perf_counter() - begun) * 1000)
            if "trial" in state:
                await walk.decode(state)
                decoded.append((time.perf_counter() - begun) * 1000)
    return {"rounds": rounds, "pause_s": pause, "answer_ms": _told(answered), "decoded_ms": _told(decoded)}


class _Walk:
    def __init__(self, client: httpx2.AsyncClient, link: str) -> None:
        self._client = client
        self._link = link
        self._address = ""
        self._random = np.random.Generator(np.random.PCG64(0))

    async def to_faces(self) -> dict[str, Any]:
        """Go on, with new participants where one is done, until faces are shown."""
        if not self._address:
            reply = await self._client.post(f"/s/{self._link}", headers={"Accept": "application/json"})
            self._address = checked(reply)["address"]
        state: dict[str, Any] = checked(await self._client.get(f"{self._address}/state"))
        match state["step"]:
            case "consent":
                await self._send(kind="consent", given=True)
            case "instructions":
                await self._send(kind="instructions")
            case "rating":
                rating = state["rating"]
                values = dict.fromkeys(rating["questions"], 4)
                await self._send(kind="rating", trial=rating["trial"], values=values)
            case "debrief" | "ended":
                self._address = ""
            case _:
                return state
        return await self.to_faces()

    async def choose(self, state: dict[str, Any]) -> dict[str, Any]:
        """Choose three faces."""
        trial = state["trial"]
        ids = [face["id"] for face in trial["faces"]]
        chosen = [ids[i] for i in np.argsort(self._random.random(len(ids)))[:3]]
        named = {name: trial[name] for name in ("attempt", "generation")}
        return await self._send(kind="choice", trial=trial["id"], **named, selected=chosen, elite=chosen[0])

    async def decode(self, state: dict[str, Any]) -> None:
        """Fetch and decode all ten portraits."""
        await asyncio.gather(*(self._portrait(face["portrait"]) for face in state["trial"]["faces"]))

    async def _portrait(self, address: str) -> None:
        reply = await self._client.get(address)
        reply.raise_for_status()
        Image.open(io.BytesIO(reply.content)).load()

    async def _send(self, **body: Any) -> dict[str, Any]:
        reply = await self._client.post(f"{self._address}/answers", json={"id": str(uuid.uuid4()), **body})
        state: dict[str, Any] = checked(reply)
        return state


def _told(values: list[float]) -> dict[str, float]:
    median, p95 = np.quantile(values, [0.5, 0.95])
    return {"median": round(float(median), 1), "p95": round(float(p95), 1), "max": round(max(values), 1)}

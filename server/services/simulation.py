"""Participants who are programs: each has a face in mind, judges by cosine, and answers through the real interface.

The page never learns the weights of a face; a simulated participant asks for them with a token for simulations.
"""

from __future__ import annotations

import asyncio
import statistics
import time
import uuid
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.search.params import search_params
from emogen_core.simulation.participant import SimulatedParticipant, random_target, selection_count

from .errors import ConflictError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from emogen_core.face.rig import Rig

AT_ONCE = 4
RATING = 4
PATIENCE = 20


class Reply(Protocol):
    """What an HTTP client gives back."""

    @property
    def status_code(self) -> int:
        """Return the status."""
        ...

    @property
    def headers(self) -> Mapping[str, str]:
        """Return the headers."""
        ...

    @property
    def text(self) -> str:
        """Return the body as text."""
        ...

    def json(self) -> Any:
        """Return the body as data."""
        ...


class Client(Protocol):
    """The part of an HTTP client that is used here."""

    async def get(self, url: str, *, params: Any = None, headers: Any = None) -> Any:
        """Send a GET."""
        ...

    async def post(self, url: str, *, params: Any = None, json: Any = None, headers: Any = None) -> Any:
        """Send a POST."""
        ...


@dataclass(frozen=True, slots=True)
class Outcome:
    """How near one trial came to the face in mind."""

    participant: int
    emotion: str
    choices: int
    distance: float


@dataclass
class Report:
    """What a simulation did."""

    seed: int
    participants: int
    trials: list[Outcome] = field(default_factory=list)
    answer_ms: list[float] = field(default_factory=list)

    def plain(self) -> dict[str, Any]:
        """Return the report as data."""
        distances = [trial.distance for trial in self.trials]
        ordered = sorted(self.answer_ms)
        return {
            "seed": self.seed,
            "participants": self.participants,
            "choices": sum(trial.choices for trial in self.trials),
            "mean_final_cosine_distance": statistics.fmean(distances) if distances else None,
            "answer_ms": {"median": _quantile(ordered, 0.5), "p95": _quantile(ordered, 0.95)},
            "trials": [asdict(trial) for trial in self.trials],
        }

    def text(self) -> str:
        """Return the report as a few lines."""
        told = self.plain()
        mean = told["mean_final_cosine_distance"]
        near = "no trial" if mean is None else f"mean cosine distance to the face in mind {mean:.3f}"
        times = told["answer_ms"]
        return (
            f"{self.participants} simulated participants, {told['choices']} choices, {near}.\n"
            f"An answer took {times['median']:.1f} ms (median), {times['p95']:.1f} ms (95th percentile)."
        )


@dataclass
class Simulation:
    """Sends participants to one link."""

    client: Client
    link: str
    token: str
    seed: int
    rig: Rig

    async def run(self, participants: int) -> Report:
        """Send participants; they join in order, so that the same seed meets the same conditions.

        Raises:
            ConflictError: the server refused a step.
        """
        report = Report(self.seed, participants)
        addresses = [await self._join(number) for number in range(participants)]
        turns = asyncio.Semaphore(AT_ONCE)

        async def one(number: int, address: str) -> list[Outcome]:
            async with turns:
                return await _Person(self, number, address, report.answer_ms).take_part()

        for outcomes in await asyncio.gather(*(one(n, address) for n, address in enumerate(addresses))):
            report.trials.extend(outcomes)
        return report

    async def _join(self, number: int) -> str:
        entropy = np.random.SeedSequence(self.seed, spawn_key=(number,)).generate_state(4)
        seed = str(int.from_bytes(entropy.astype("<u4").tobytes(), "little"))
        headers = {**self.bearer, "Accept": "application/json"}
        reply = await self.client.post(f"/s/{self.link}", params={"seed": seed}, headers=headers)
        return str(checked(reply)["address"])

    @property
    def bearer(self) -> dict[str, str]:
        """The header that carries the token."""
        return {"Authorization": f"Bearer {self.token}"}


@dataclass
class _Person:
    simulation: Simulation
    number: int
    address: str
    times: list[float]
    outcomes: list[Outcome] = field(default_factory=list)
    minds: dict[str, SimulatedParticipant] = field(default_factory=dict)
    choices: dict[str, int] = field(default_factory=dict)

    async def take_part(self) -> list[Outcome]:
        state = checked(await self.simulation.client.get(f"{self.address}/state"))
        while state["step"] not in {"debrief", "ended"}:
            state = await self._send(await self._answer(state))
        return self.outcomes

    async def _send(self, body: Mapping[str, Any]) -> dict[str, Any]:
        begun = time.perf_counter()
        reply = await self._posted({"id": str(uuid.uuid4()), **body})
        self.times.append((time.perf_counter() - begun) * 1000)
        state: dict[str, Any] = checked(reply)
        return state

    async def _posted(self, body: Mapping[str, Any]) -> Reply:
        """Send an answer, again for as long as a head is still being made: the server knows its id."""
        for _ in range(PATIENCE):
            reply: Reply = await self.simulation.client.post(f"{self.address}/answers", json=body)
            if reply.status_code != 503:
                break
            await asyncio.sleep(float(reply.headers.get("retry-after", 1)))
        return reply

    async def _answer(self, state: dict[str, Any]) -> dict[str, Any]:
        match state["step"]:
            case "consent":
                return {"kind": "consent", "given": True}
            case "instructions":
                return {"kind": "instructions"}
            case "rating":
                rating = state["rating"]
                return {
                    "kind": "rating",
                    "trial": rating["trial"],
                    "values": dict.fromkeys(rating["questions"], RATING),
                }
            case _:
                return await self._choice(state["trial"])

    async def _choice(self, trial: dict[str, Any]) -> dict[str, Any]:
        ids = [face["id"] for face in trial["faces"]]
        reply = await self.simulation.client.get(
            "/api/v1/faces", params={"ids": ",".join(ids)}, headers=self.simulation.bearer
        )
        weights = checked(reply)
        known = np.array([weights[face] for face in ids])
        mind = self._mind(trial)
        last = -1 if trial["practice"] else trial["generations"]
        count = min(max(selection_count(trial["generation"], last), trial["minimum"]), trial["maximum"])
        chosen = mind.choose(known, 1 if trial["final"] else count)
        self.choices[trial["id"]] = self.choices.get(trial["id"], 0) + 1
        if trial["final"] and not trial["practice"]:
            distance = float(mind.distances(known)[chosen.elite - 1])
            self.outcomes.append(Outcome(self.number, trial["emotion"], self.choices[trial["id"]], distance))
        return {
            "kind": "choice",
            **{name: trial[name] for name in ("attempt", "generation")},
            "trial": trial["id"],
            "selected": [ids[slot - 1] for slot in chosen.selected],
            "elite": ids[chosen.elite - 1],
        }

    def _mind(self, trial: dict[str, Any]) -> SimulatedParticipant:
        if trial["id"] not in self.minds:
            rig = self.simulation.rig
            key = (self.number, len(self.minds))
            stream = np.random.Generator(np.random.PCG64(np.random.SeedSequence(self.simulation.seed, spawn_key=key)))
            target = random_target(search_params(rig), stream)
            # The browser, and so this participant, is not told the identity; on any head the target is nearly the same.
            imagined = face_weights(rig, rig.identities[0], target[np.newaxis]).weights[0]
            self.minds[trial["id"]] = SimulatedParticipant(imagined)
        return self.minds[trial["id"]]


def checked(reply: Reply) -> Any:
    """Return the body of a reply that went well.

    Raises:
        ConflictError: it did not.
    """
    if reply.status_code >= 400:
        raise ConflictError(f"The server answered {reply.status_code}: {reply.text[:300]}")
    return reply.json()


def _quantile(ordered: list[float], share: float) -> float:
    return ordered[min(int(len(ordered) * share), len(ordered) - 1)] if ordered else 0.0

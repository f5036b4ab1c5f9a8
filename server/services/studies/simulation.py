"""Participants who are programs: each has a face in mind, judges by cosine, and answers through the real interface.

The page never learns the weights of a face; a simulated participant asks for them with a token for simulations.
"""

from __future__ import annotations

import asyncio
import statistics
import time
import uuid
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from emogen_core.correctives.pipeline import face_weights
from emogen_core.search.params import SearchParams, search_params
from emogen_core.simulation.observer import FAITHFUL, Observer
from emogen_core.simulation.participant import SimulatedParticipant, permitted, random_target, selection_count

from ..errors import ConflictError
from ..trials import TYPES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig

AT_ONCE = 4
PATIENCE = 20
RIG = "Emogen-Rig"
"""Header with the hash of the rig of which weights are."""


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
    """What a simulation did; trials in the order in which they ended."""

    seed: int
    participants: int
    finished: int = 0
    trials: list[Outcome] = field(default_factory=list)
    answer_ms: list[float] = field(default_factory=list)

    def plain(self) -> dict[str, Any]:
        """Return the report as data."""
        distances = [trial.distance for trial in self.trials]
        median, slow = np.quantile(self.answer_ms or [0.0], [0.5, 0.95], method="inverted_cdf").tolist()
        return {
            "seed": self.seed,
            "participants": self.participants,
            "choices": sum(trial.choices for trial in self.trials),
            "mean_final_cosine_distance": statistics.fmean(distances) if distances else None,
            "answer_ms": {"median": median, "p95": slow},
            "trials": [asdict(trial) for trial in sorted(self.trials, key=lambda trial: trial.participant)],
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
    """Sends participants to one link.

    Attributes:
        client: reaches the participant's interface.
        link: last part of its address.
        token: for simulations.
        seed: of the participants, 0 or more.
        rig: that the study uses.
        observer: how well they judge.
        params: the study's search, so that nobody looks for a face out of its reach; where it is not known, as on
            another server, that of all genes.
    """

    client: Client
    link: str
    token: str
    seed: int
    rig: Rig
    observer: Observer = FAITHFUL
    params: SearchParams | None = None

    @cached_property
    def reach(self) -> SearchParams:
        """The search that faces in mind are within reach of."""
        return self.params or search_params(self.rig)

    async def run(self, participants: int, report: Report | None = None) -> Report:
        """Send participants; they join in order, so that the same seed meets the same conditions.

        A `report` that is handed in is filled as their trials and they themselves come to an end, so it has what
        was done when one of them fails.

        Raises:
            ConflictError: the server refused a step.
        """
        report = report or Report(self.seed, participants)
        addresses = [await self._join(number) for number in range(participants)]
        turns = asyncio.Semaphore(AT_ONCE)

        async def one(number: int, address: str) -> None:
            async with turns:
                await _Person(self, number, address, report).take_part()
                report.finished += 1

        await asyncio.gather(*(one(number, address) for number, address in enumerate(addresses)))
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
    report: Report
    minds: dict[str, _Mind] = field(default_factory=dict)
    choices: dict[str, int] = field(default_factory=dict)

    async def take_part(self) -> None:
        state = checked(await self.simulation.client.get(f"{self.address}/state"))
        while state["step"] not in {"debrief", "ended"}:
            state = await self._send(await self._answer(state))

    async def _send(self, body: Mapping[str, Any]) -> dict[str, Any]:
        begun = time.perf_counter()
        reply = await self._posted({"id": str(uuid.uuid4()), **body})
        self.report.answer_ms.append((time.perf_counter() - begun) * 1000)
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
        return await self._choice(state["trial"]) if "trial" in state else plain_answer(state)

    async def _choice(self, trial: dict[str, Any]) -> dict[str, Any]:
        ids = [face["id"] for face in trial["faces"]]
        reply = await self.simulation.client.get(
            "/api/v1/faces", params={"ids": ",".join(ids)}, headers=self.simulation.bearer
        )
        weights = checked(reply)
        _check_rig(reply.headers.get(RIG), self.simulation.rig)
        known = np.array([weights[face] for face in ids])
        mind = self._mind(trial)
        count = permitted(selection_count(trial["generation"]), trial["minimum"], trial["maximum"])
        places = np.array([face["place"] for face in trial["faces"]]) - 1
        chosen = mind.participant.choose(known, 1 if trial["final"] else count, places)
        self.choices[trial["id"]] = self.choices.get(trial["id"], 0) + 1
        if trial["final"] and not trial["practice"]:
            distance = float(mind.participant.distances(known)[chosen.elite - 1])
            self.report.trials.append(Outcome(self.number, trial["emotion"], self.choices[trial["id"]], distance))
        mind.drift(self.simulation)
        return {
            "kind": "choice",
            **{name: trial[name] for name in ("attempt", "generation")},
            "trial": trial["id"],
            "selected": [ids[slot - 1] for slot in chosen.selected],
            "elite": ids[chosen.elite - 1],
        }

    def _mind(self, trial: dict[str, Any]) -> _Mind:
        if trial["id"] not in self.minds:
            simulation = self.simulation
            key = (self.number, len(self.minds))
            stream = np.random.Generator(np.random.PCG64(np.random.SeedSequence(simulation.seed, spawn_key=key)))
            genes = random_target(simulation.reach, stream)
            participant = SimulatedParticipant(_imagined(simulation.rig, genes), stream, simulation.observer)
            self.minds[trial["id"]] = _Mind(genes, participant)
        return self.minds[trial["id"]]


@dataclass
class _Mind:
    """The face that somebody looks for in one trial."""

    genes: NDArray[np.float64]
    participant: SimulatedParticipant

    def drift(self, simulation: Simulation) -> None:
        """Let the face in mind take a step, where this observer's does."""
        observer, rng = simulation.observer, self.participant.rng
        if observer.drift:
            self.genes = observer.drifted(self.genes[np.newaxis], simulation.reach.active, rng)[0]
            self.participant = replace(self.participant, target=_imagined(simulation.rig, self.genes))


def _check_rig(told: str | None, rig: Rig) -> None:
    """Refuse faces of another rig than the one that faces in mind are of; a server of an older release tells none."""
    if told and told != rig.hash:
        raise ConflictError(
            f"The faces are of the rig {told[:12]}: expected {rig.hash[:12]}. Name the rig file of the study's heads"
            " with --rig.",
            field="rig", expected=rig.hash, got=told,
        )  # fmt: skip


def _imagined(rig: Rig, genes: NDArray[np.float64]) -> NDArray[np.float32]:
    # The browser, and so this participant, is not told the identity; on any head the target is nearly the same.
    made: NDArray[np.float32] = face_weights(rig, rig.identities[0], genes[np.newaxis]).weights[0]
    return made


def plain_answer(state: Mapping[str, Any]) -> dict[str, Any]:
    """Return an acceptable answer to a step that needs no face in mind."""
    match state["step"]:
        case "consent":
            return {"kind": "consent", "given": True}
        case "calibration" | "instructions" as step:
            return {"kind": step}
        case step:
            return next(made for made in TYPES.values() if step in made.ANSWERS).played(state)


def checked(reply: Reply) -> Any:
    """Return the body of a reply that went well.

    Raises:
        ConflictError: it did not, or is none of this program's.
    """
    if reply.status_code >= 400:
        raise ConflictError(f"The server answered {reply.status_code}: {reply.text[:300]}")
    try:
        return reply.json()
    except ValueError as error:
        raise ConflictError(f"Expected an answer of an Emogen server, got: {reply.text[:300]!r}.") from error

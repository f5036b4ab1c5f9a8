"""A study with people in it, made through the real services on a clock of its own.

`python -m tests.browser.populated var` fills the database of a folder, on the bundled rig.

About sixty people come over a working day: most finish, some leave at different places, some are in the middle when
the day ends, one is away, one came back after the lease had run out, one was erased. They decide as simulated
participants do, but count as people. The same seed makes the same day.
"""

from __future__ import annotations

import heapq
import sys
import uuid
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from sqlalchemy import select, update  # noqa: TID251

from emogen_core.search.params import search_params
from emogen_core.simulation.participant import SimulatedParticipant, permitted, random_target, selection_count
from server.services.clock import now, told_by
from server.services.config import DEMO, StudyConfig
from server.services.faces.sketch import unpack_weights
from server.services.opening import open_house
from server.services.trials.answer_bodies import ANSWER, EventBody
from server.settings import Settings
from server.store import runs
from server.store.runs_tables import ChoiceRecord, Face, Generation, Participation, Trial

TITLE = "Picturing four emotions, adults 18–65"
DAY = timedelta(hours=9)
MINUTES = 22
"""How long it takes who finishes, about."""


@dataclass(frozen=True)
class Device:
    kind: str
    viewport: tuple[int, int]
    ratio: float
    touch: bool
    wait_ms: float
    browser: str


DEVICES = (
    Device("computer", (1280, 720), 1, False, 260, "Chrome"),
    Device("computer", (1536, 864), 1.25, False, 240, "Firefox"),
    Device("computer", (1440, 900), 2, False, 280, "Edge"),
    Device("phone", (390, 844), 3, True, 660, "Safari"),
    Device("phone", (412, 915), 2.6, True, 720, "Chrome"),
    Device("tablet", (820, 1180), 2, True, 430, "Safari"),
)
AGENTS = {"Chrome": "Chrome/140", "Firefox": "Firefox/140", "Edge": "Chrome/140 Edg/140", "Safari": "Safari/26"}
SHARES = (0.34, 0.14, 0.1, 0.2, 0.14, 0.08)
SLOW = (0.55, 0.75)
"""The part of the day in which phones wait long."""


@dataclass
class Populated:
    """What was made: the study, its link, when the day ended, and who came to what end."""

    study: str
    link: str
    moment: datetime
    people: list[_Person] = field(default_factory=list)

    def who(self, fate):
        return [person for person in self.people if person.fate == fate]


def study_for(rig, generations=3, **changes):
    """Return the study: four emotions, two conditions, two heads."""
    rng = np.random.default_rng(3)
    genes = len(rig.genes)
    start = [
        [round(float(rng.uniform(0.1, 0.7)), 3) if rng.random() < 0.3 else 0.0 for _ in range(genes)] for _ in range(10)
    ]
    fixed = {"search": {"initialisation": "fixed", "fixed_population": start}}
    small = {"random_genes": 3, "activation": (2, 3)} if genes < 20 else {}
    plain = {
        "title": TITLE, "generations": generations, "identities": rig.identities[:2], "quota": 96, "search": small,
        "conditions": ({"name": "Protocol start", "quota": 48}, {"name": "Fixed start", "quota": 48, "changes": fixed}),
        "texts": {**DEMO.texts.model_dump(), "organisation": "University of Westbrook"},
    }  # fmt: skip
    return StudyConfig.model_validate({**DEMO.model_dump(), **plain, **changes})


def populate(house, until, *, people=60, seed=7, owner=None, config=None, events=True):
    """Fill the house's database with a day that ends at `until`; return what was made.

    Few people (not below 24), `study_for(rig, generations=1)` and `events=False` make it quick.
    """
    config = config or study_for(house.journal.rig)
    time = _Clock(until - DAY - timedelta(days=1))
    with told_by(time), _undrawn(house):
        made = house.studies.create(config, "recruiting", owner=owner)
        day = Populated(made.id, made.links[0], until)
        day.people = [_Person(house, made.links[0], number, people, seed) for number in range(people)]
        for person in day.people:
            person.tells = events
        _play(day, time)
    _drawing_times(house, day, seed)
    return day


class _Clock:
    def __init__(self, moment):
        self.moment = moment

    def __call__(self):
        return self.moment


@contextmanager
def _undrawn(house):
    """Nobody looks at these faces: they are drawn when a page asks for them."""
    house.portraits.after = lambda *_: None
    try:
        yield
    finally:
        del house.portraits.after


def _play(day, clock):
    """Let everybody act in the order of time, since who comes next is placed by who is there."""
    ties = count()
    begin = day.moment - DAY
    turns = [(person.arrives(begin, day.moment), next(ties), person.life(day.moment)) for person in day.people]
    heapq.heapify(turns)
    while turns:
        moment, _, life = heapq.heappop(turns)
        if moment > day.moment:
            continue
        clock.moment = moment
        pause = next(life, None)
        if pause is not None:
            heapq.heappush(turns, (moment + timedelta(seconds=pause), next(ties), life))
    clock.moment = day.moment


FATES = ("consent", "quiet-1", "quiet-2", "stop-2", "quiet-3", "no", "erased", "stop-4", "quiet-2", "quiet-1")
NOW = ("now",) * 9 + ("away", "back", "now")


class _Person:
    """One participant: where they come to, on what, and what they have in mind."""

    def __init__(self, house, link, number, people, seed):
        self.house, self.link, self.number = house, link, number
        self.rng = np.random.default_rng([seed, number])
        self.share = number / people
        self.device = DEVICES[int(self.rng.choice(len(DEVICES), p=SHARES))]
        late = people - number - 1
        every = max((people - len(NOW)) // len(FATES), 1)
        fated = number % every == every // 2 and number // every < len(FATES)
        self.fate = NOW[late] if late < len(NOW) else FATES[number // every] if fated else "complete"
        if self.fate == "quiet-2":
            self.device = DEVICES[3]
        self.minds: dict[str, SimulatedParticipant] = {}
        self.page_ms = 0.0
        self.waited = 0.0
        self.token = self.participation = None
        self.tells = True

    def arrives(self, begin, end):
        """Most come in two waves; those who are to be there at the end come within the last minutes."""
        if self.fate == "away":
            return end - timedelta(minutes=13)
        if self.fate == "back":
            return end - timedelta(minutes=66)
        if self.fate == "now":
            return end - timedelta(seconds=float(40 + 1150 * self.rng.random()))
        spread = self.share + 0.06 * np.sin(4 * np.pi * self.share) + 0.01 * self.rng.standard_normal()
        return begin + timedelta(seconds=float(np.clip(spread, 0.01, 0.98) * (DAY.total_seconds() - 1900)))

    def life(self, end):
        """Act step by step; yields how many seconds pass until the next."""
        self.join()
        yield self.rng.uniform(8, 25)
        state = self.house.participations.state(self.token)
        for step in count():
            if state["step"] in {"debrief", "ended"}:
                break
            gone = self.leaves(state, step, end)
            if gone is None:
                return
            if gone:
                yield gone
            state = self.house.answers.take(self.token, ANSWER.validate_python(self.answer(state)))
            yield self.pause(state)
        if self.fate == "erased":
            yield 600.0
            number = self.house.withdrawals.number_of(self.study, state["completion"]["withdrawal_code"])
            self.house.withdrawals.erase(self.study, number, None)

    def join(self):
        joined = self.house.joining.join(self.link, {"PROLIFIC_PID": f"{self.rng.integers(2**60):024x}"})
        self.token, self.participation = joined.token, joined.participation
        with self.house.database.write() as tx:
            row = runs.participation(tx, joined.participation)
            row.device = {
                "viewport": list(self.device.viewport), "pixel_ratio": self.device.ratio, "touch": self.device.touch,
                "kind": self.device.kind, "user_agent": f"Mozilla/5.0 {AGENTS[self.device.browser]}",
            }  # fmt: skip
            self.study, self.cell = row.study_id, (row.condition, row.head)

    def leaves(self, state, step, end):
        """Return None when this person goes away for good, else how many seconds they are away before going on."""
        kind, _, place = self.fate.partition("-")
        at = state["progress"]["trial"]
        halfway = state["step"] == "evolve" and at == int(place or 0) and state["trial"]["generation"] >= 1
        if kind == "consent":
            return None
        if kind == "stop" and halfway:
            self.house.participations.stop(self.token, erase=False)
            return None
        if kind == "quiet" and halfway:
            return None
        if kind == "away" and now() > end - timedelta(minutes=7):
            return None
        return 45 * 60.0 if kind == "back" and step == 5 else 0.0

    def pause(self, state):
        """Return how long this person takes for what is asked next, in seconds."""
        if state["step"] in {"practice", "evolve"}:
            self.waited = self.wait()
            each = MINUTES * 60 / (4 * (state["trial"]["generations"] + 1.6) + 2)
            return each * self.rng.lognormal(0, 0.35) + self.waited / 1000
        return {"consent": 25, "instructions": 40, "rating": 9}.get(state["step"], 5) * self.rng.lognormal(0, 0.3)

    def wait(self):
        """Return how many milliseconds pass until all ten faces are shown."""
        slow = 2.6 if self.device.kind == "phone" and SLOW[0] < self.share < SLOW[1] else 1.0
        return float(self.device.wait_ms * slow * self.rng.lognormal(0, 0.28))

    def answer(self, state):
        match state["step"]:
            case "consent":
                body = {"kind": "consent", "given": self.fate != "no"}
            case "instructions":
                body = {"kind": "instructions"}
            case "rating":
                rating = state["rating"]
                values = {name: int(self.rng.integers(3, 8)) for name in rating["questions"]}
                body = {"kind": "rating", "trial": rating["trial"], "values": values}
            case _:
                body = self.choice(state["trial"])
        return {"id": str(uuid.UUID(bytes=self.rng.bytes(16), version=4)), **body}

    def weights(self, ids):
        """By id. No interface tells the weights of faces that people are offered."""
        with self.house.database.read() as tx:
            return {face.id: unpack_weights(face.weights) for face in tx.query(Face).filter(Face.id.in_(ids))}

    def choice(self, trial):
        ids = [face["id"] for face in trial["faces"]]
        known = self.weights(ids)
        count = permitted(selection_count(trial["generation"]), trial["minimum"], trial["maximum"])
        chosen = self.mind(trial).choose(np.array([known[one] for one in ids]), 1 if trial["final"] else count)
        selected, elite = [ids[slot - 1] for slot in chosen.selected], ids[chosen.elite - 1]
        timing = self.times(len(selected))
        where = {name: trial[name] for name in ("attempt", "generation")} | {"trial": trial["id"]}
        if self.tells:
            self.house.participations.events(self.token, self.events(where, selected, elite, timing))
        size = {"viewport": self.device.viewport, "pixel_ratio": self.device.ratio, "tile": [234, 280]}
        client = {**size, "input": "touch" if self.device.touch else "mouse"}
        return {"kind": "choice", **where, "selected": selected, "elite": elite, "timing": timing, "client": client}

    def times(self, selected):
        requested = self.page_ms
        decoded = requested + self.waited
        thought = (3.0 + 2.2 * selected) * 1000 * self.rng.lognormal(0, 0.4)
        self.page_ms = decoded + 12 + thought + 200
        times = {"requested_ms": requested, "decoded_ms": decoded, "onset_ms": decoded + 12, "chosen_ms": self.page_ms}
        return {**{name: round(value) for name, value in times.items()}, "hidden_ms": 0}

    def events(self, where, selected, elite, timing):
        step = (timing["chosen_ms"] - timing["onset_ms"]) / (len(selected) + 2)
        told = [("onset", None), *(("select", face) for face in selected), ("best", elite)]
        return [
            EventBody.model_validate({
                "id": str(uuid.UUID(bytes=self.rng.bytes(16), version=4)), **where, "type": kind, "face": face,
                "at_ms": round(timing["onset_ms"] + step * number),
            })
            for number, (kind, face) in enumerate(told)
        ]  # fmt: skip

    def imagined(self, emotion):
        """A face that this person has in mind for an emotion: most of its prototype, and something of their own."""
        rig = self.house.journal.rig
        genes = rig.emotion_genes(emotion) * (self.rng.random(len(rig.genes)) < 0.75) * self.rng.uniform(0.5, 1)
        own = self.rng.permutation(search_params(rig).active)[: self.rng.integers(2, 8)]
        genes[own] = np.maximum(genes[own], 0.5 * self.rng.random(len(own)))
        return genes

    def mind(self, trial):
        if trial["id"] not in self.minds:
            rig = self.house.journal.rig
            params = search_params(rig)
            known = trial["emotion"] in rig.emotion_sets
            genes = self.imagined(trial["emotion"]) if known else random_target(params, self.rng)
            weights = self.house.journal.correction.faces(rig.identities[0], [genes])[0].weights
            self.minds[trial["id"]] = SimulatedParticipant(weights, self.rng.spawn(1)[0])
        return self.minds[trial["id"]]


def _drawing_times(house, day, seed):
    """Say of every choice how long the server drew, as if it had."""
    rng = np.random.default_rng([seed, 99])
    mine = select(ChoiceRecord.id).join(Generation, Generation.id == ChoiceRecord.generation_id)
    mine = mine.join(Trial, Trial.id == Generation.trial_id).join(
        Participation, Participation.id == Trial.participation_id
    )
    with house.database.write() as tx:
        ids: list[Any] = list(
            tx.scalars(mine.where(Participation.study_id == day.study).order_by(ChoiceRecord.arrived_at))
        )
        drawn = [{"id": one, "drawn_ms": round(float(190 * rng.lognormal(0, 0.15)), 1)} for one in ids]
        tx.execute(update(ChoiceRecord), drawn)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "var")
    house = open_house(Settings(data_dir=folder), drawing=False)
    try:
        day = populate(house, now())
        print(f"study {day.study}, {len(day.people)} people, link /s/{day.link}")
    finally:
        house.close()


if __name__ == "__main__":
    main()

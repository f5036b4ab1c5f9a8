"""Whatever two clients send in whatever order, with repeats and stale answers: the record is that of one sequence."""

import random
import uuid

import pytest
from sqlalchemy import func, select  # noqa: TID251

from server.store.runs_tables import Answer, ChoiceRecord, Generation, Rating
from tests.conftest import BOTH, small_study
from tests.server.dump import dump
from tests.server.walker import Walker


class Tab:
    """One window: it knows the state that it was told last, and all that it ever sent."""

    def __init__(self, walker, stream):
        self.walker, self.random = walker, stream
        self.state = walker.state()
        self.sent = []

    def act(self):
        return self.random.choice([self.answer, self.answer, self.repeat, self.forge, self.look])()

    def look(self):
        self.state = self.walker.state()

    def answer(self):
        if self.state["step"] in {"debrief", "ended"}:
            return
        body = self._body()
        reply = self.walker.post(body)
        assert reply.status_code in {200, 409}, reply.text
        self.state = reply.json() if reply.status_code == 200 else reply.json()["state"]
        if reply.status_code == 200:
            self.sent.append((body, self.state))

    def repeat(self):
        """An accepted answer again: the stored reply, and nothing changes."""
        if self.sent:
            body, told = self.random.choice(self.sent)
            before = dump(self.walker.house.database)
            reply = self.walker.post(body)
            assert (reply.status_code, reply.json()) == (200, told)
            assert dump(self.walker.house.database) == before

    def forge(self):
        """An id that was used, for another content: refused, and nothing changes."""
        if self.sent:
            body, _ = self.random.choice(self.sent)
            other = {"id": body["id"], "kind": "consent", "given": body["kind"] == "consent" and not body["given"]}
            before = dump(self.walker.house.database)
            reply = self.walker.post(other)
            assert (reply.status_code, reply.json()["error"]["code"]) == (409, "answer_conflict")
            assert dump(self.walker.house.database) == before

    def _body(self):
        match self.state["step"]:
            case "practice" | "evolve":
                if self.state["trial"]["reset"] and self.random.random() < 0.15:
                    return self.walker.body(self.state, kind="reset")
                count = self.random.randint(1, 4)
                return self.walker.body(self.state, count, self.random.randrange(count))
            case "rating":
                rating = self.state["rating"]
                values = {question: self.random.randint(1, 7) for question in rating["questions"]}
                body = {"kind": "rating", "trial": rating["trial"], "values": values}
            case "consent":
                body = {"kind": "consent", "given": True}
            case step:
                body = {"kind": step}
        return {"id": str(uuid.UUID(int=self.random.getrandbits(128), version=4)), **body}


def count(house, table):
    with house.database.read() as tx:
        return tx.scalar(select(func.count()).select_from(table))


@BOTH
@pytest.mark.parametrize("seed", range(6))
def test_two_tabs_in_any_order_are_one_sequence(client, house, seed):
    study = house.studies.create(small_study())
    stream = random.Random(seed)
    walker = Walker(client, study.links[0])
    walker.house = house
    tabs = [Tab(walker, stream), Tab(walker, stream)]
    for _ in range(60):
        stream.choice(tabs).act()
    with house.database.read() as tx:
        per_generation = select(func.count()).select_from(ChoiceRecord).group_by(ChoiceRecord.generation_id)
        assert set(tx.scalars(per_generation)) <= {1}
        offered = {(row.trial_id, row.attempt, row.number) for row in tx.scalars(select(Generation))}
    assert len(offered) == count(house, Generation)
    for trial, attempt, number in offered:
        assert number == 0 or (trial, attempt, number - 1) in offered, "no gap"
    accepted = {body["id"] for tab in tabs for body, _ in tab.sent}
    assert count(house, Answer) == len(accepted)
    kinds = [body["kind"] for tab in tabs for body, _ in tab.sent]
    assert count(house, ChoiceRecord) == kinds.count("choice")
    assert count(house, Rating) == 2 * kinds.count("rating")
    assert house.replay.study(study.id).difference is None
    assert tabs[0].walker.state() == max((tab.sent[-1][1] for tab in tabs if tab.sent), key=_position)


def _position(state):
    """How far a state is: the steps of a participation only ever go forward."""
    steps = ["consent", "instructions", "practice", "evolve", "rating", "debrief", "ended"]
    trial = state.get("trial", {})
    place = state["progress"]["trial"]
    last = state["step"] in {"debrief", "ended"}
    return last, place, steps.index(state["step"]), trial.get("attempt", 0), trial.get("generation", 0)

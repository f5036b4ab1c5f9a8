"""Takes a participation through the interface, the way a page does."""

from __future__ import annotations

import time
import uuid

PATIENCE = 24
"""How often it comes again where it is asked to, as on a machine that is busy with heads."""


def respond(item, **said):
    """An acceptable response to an item; `said` names other values."""
    values = {}
    for field in item["questions"]:
        values[field["name"]] = {
            "single": lambda f: f["options"][0], "multiple": lambda f: f["options"][:1], "scale": lambda f: 4,
            "number": lambda f: f["least"] or 0, "text": lambda f: "words",
        }[field["kind"]](field)  # fmt: skip
    return {"kind": "response", "trial": item["trial"], "item": item["item"], "values": values | said}


class Walker:
    def __init__(self, client, link, **parameters):
        self.client = client
        reply = client.post(f"/s/{link}", params=parameters, headers={"accept": "application/json"})
        assert reply.status_code == 201, reply.text
        self.address = reply.json()["address"]
        self.sent = []

    @property
    def token(self):
        return self.address.rsplit("/", 1)[-1]

    def state(self):
        reply = self.client.get(f"{self.address}/state")
        assert reply.status_code == 200, reply.text
        return reply.json()

    def post(self, body):
        self.sent.append(body)
        return self.client.post(f"{self.address}/answers", json=body)

    def answer(self, kind, **body):
        reply = self.post({"id": str(uuid.uuid4()), "kind": kind, **body})
        for _ in range(PATIENCE):
            if "retry-after" not in reply.headers:
                break
            time.sleep(int(reply.headers["retry-after"]))
            reply = self.client.post(f"{self.address}/answers", json=self.sent[-1])
        assert reply.status_code == 200, reply.text
        return reply.json()

    def start(self):
        self.answer("consent", given=True)
        return self.answer("instructions")

    def body(self, state, count=2, best=0, kind="choice"):
        trial = state["trial"]
        named = {"trial": trial["id"], "attempt": trial["attempt"], "generation": trial["generation"]}
        if kind == "reset":
            return {"id": str(uuid.uuid4()), "kind": "reset", **named}
        chosen = [face["id"] for face in trial["faces"][:count]]
        return {
            "id": str(uuid.uuid4()), "kind": "choice", **named, "selected": chosen, "elite": chosen[best],
            "timing": {"requested_ms": 0, "decoded_ms": 412, "onset_ms": 430.5, "chosen_ms": 9120, "hidden_ms": 0},
            "client": {"viewport": [1280, 800], "pixel_ratio": 1, "tile": [234, 280], "input": "mouse"},
        }  # fmt: skip

    def step(self, state, count=2):
        """Answer whatever the state asks for; return the next state."""
        match state["step"]:
            case "consent":
                return self.answer("consent", given=True)
            case "calibration" | "instructions" as step:
                return self.answer(step)
            case "practice" | "evolve":
                reply = self.post(self.body(state, count))
                assert reply.status_code == 200, reply.text
                return reply.json()
            case "rating":
                rating = state["rating"]
                return self.answer("rating", trial=rating["trial"], values=dict.fromkeys(rating["questions"], 4))
            case _:
                return self.answer(**respond(state["item"]))

    def finish(self, steps=None):
        state = self.state()
        while state["step"] not in {"debrief", "ended"} and steps != 0:
            state = self.step(state)
            steps = None if steps is None else steps - 1
        return state

"""The server as a process: it greets, it survives a power cut, it ends when asked."""

import json
import re
import time

import pytest

from server.services.people.tokens import Tokens
from server.store.engine import Database
from tests.server.cli.running import Server, emogen
from tests.server.walker import Walker


@pytest.fixture
def data_dir(tmp_path):
    return tmp_path / "var"


def test_nothing_acknowledged_is_lost_to_kill_9(data_dir):
    with Server(data_dir) as first:
        walker = Walker(first.client, first.link)
        acknowledged = []
        state = walker.state()
        for _ in range(9):
            state = walker.step(state)
            acknowledged.append((walker.sent[-1], state))
        assert state["step"] == "evolve"
        first.kill()

    with Server(data_dir) as second:
        assert second.link == first.link, "the demonstration study was kept, not made again"
        walker.client = second.client
        assert walker.state() == state
        for body, reply in acknowledged:
            assert walker.client.post(f"{walker.address}/answers", json=body).json() == reply
        for _ in range(3):
            state = walker.step(state)
        assert state["trial"]["generation"] == acknowledged[-1][1]["trial"]["generation"] + 3
        assert second.portrait(state["trial"]["faces"][0]["portrait"]).content.startswith(b"\x89PNG")
        assert second.stop() in {0, -15}


def test_the_first_start_prints_a_link_and_a_one_time_set_up_link(data_dir):
    with Server(data_dir) as server:
        key = re.search(r"/admin/setup\?key=([0-9A-Z-]+)", server.said).group(1)
        assert len(key) == 19
        assert server.client.get(f"/admin/setup?key={key}").status_code == 200


def test_a_taken_port_is_one_sentence(data_dir):
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        done = emogen(data_dir, "serve", "--port", str(taken.getsockname()[1]))
    assert done.returncode == 1
    assert "EMOGEN_PORT" in done.stderr
    assert "Traceback" not in done.stderr


def test_a_wrong_setting_is_one_sentence(data_dir):
    done = emogen(data_dir, "serve", EMOGEN_RENDERER="crayons")
    assert done.returncode == 1
    assert done.stderr.startswith("EMOGEN_RENDERER: ")
    assert "Traceback" not in done.stderr


def test_simulated_participants_visit_a_running_server(data_dir):
    with Server(data_dir) as server:
        database = Database(f"sqlite:///{data_dir}/emogen.db")
        token = Tokens(database).create("simulation", ["simulate"])
        database.close()
        there = ["--url", server.base, "--link", server.link]
        done = emogen(data_dir, "simulate", *there, "--token", token, "--json")
        assert done.returncode == 0, done.stderr
        assert len(json.loads(done.stdout)["trials"]) == 4
        refused = emogen(data_dir, "simulate", *there, "--token", "emg_guess")
        assert refused.returncode == 1
        assert "401" in refused.stderr


def test_open_streams_do_not_hold_up_the_end(data_dir):
    with Server(data_dir) as server:
        address, key = server.base, re.search(r"/admin/setup\?key=([0-9A-Z-]+)", server.said)[1]
        form = {"key": key, "name": "Ines", "email": "i@example.org", "password": "four unrelated quiet words"}
        form["csrf"] = re.search(r'name="csrf" value="([^"]+)"', server.client.get("/admin/setup").text)[1]
        assert server.client.post("/admin/setup", data=form).status_code == 303
        with server.client.stream("GET", f"{address}/admin/studies/demo/monitor/stream") as reply:
            assert reply.headers["content-type"].startswith("text/event-stream")
            lines = reply.iter_lines()
            assert next(line for line in lines if line.startswith("data: "))
            begun = time.monotonic()
            server.process.terminate()
            assert not [line for line in lines if line.startswith("event: end")], "it ends by itself"
        server.process.wait(30)
        assert time.monotonic() - begun < 8, "without waiting for the ten seconds after which all is cut off"

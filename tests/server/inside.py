"""A house served by a thread of the tests, for those that look into it while a browser looks at it."""

from __future__ import annotations

import socket
import threading
from contextlib import contextmanager

import uvicorn

from server.app import create_app
from server.cli.serve import HouseServer


@contextmanager
def serving(house):
    """Serve a house on a free port and give its address."""
    listening = socket.socket()
    listening.bind(("127.0.0.1", 0))
    server = HouseServer(uvicorn.Config(create_app(house), log_config=None, access_log=False), house)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    while not server.started:
        thread.join(0.02)
    try:
        yield f"http://127.0.0.1:{listening.getsockname()[1]}"
    finally:
        server.should_exit = True
        thread.join(10)
        listening.close()

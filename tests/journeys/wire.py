"""A connection that can fail: a small TCP proxy between the browser and the server."""

from __future__ import annotations

import re
import socket
import struct
import threading
from contextlib import contextmanager, suppress

ANSWER = b"/answers HTTP/1.1"
AT_ONCE = struct.pack("ii", 1, 0)


class Wire:
    """Passes everything on until it is told otherwise.

    `lose`: so many answers reach the server, and their replies do not come back. `hang`: so many answers get nowhere
    and no reply, over a connection that stays open. `cut`: every connection is reset.
    """

    def __init__(self, target):
        self.target = target
        self.lose = self.hang = 0
        self.cut = False
        self.lost = []
        self._lock = threading.Lock()
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.address = f"http://127.0.0.1:{self._listening.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self):
        self._listening.close()

    def _accept(self):
        with suppress(OSError):
            while True:
                client, _ = self._listening.accept()
                threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client):
        with suppress(OSError), client:
            if self.cut:
                return _reset(client)
            with socket.create_connection(self.target, timeout=30) as server:
                threading.Thread(target=self._back, args=(server, client), daemon=True).start()
                while data := client.recv(65536):
                    if self.cut:
                        return _reset(client)
                    if not self._fails(data, client):
                        server.sendall(data)
        return None

    def _fails(self, data, client):
        """Whether this request was dealt with as a failing connection would."""
        if ANSWER not in data:
            return False
        with self._lock:
            hang = self.hang > 0
            lose = self.lose > 0 and not hang
            self.lose -= lose
            self.hang -= hang
        if not hang and not lose:
            return False
        # A body may come after its head; alone, the server would take it for a request that is none, and answer.
        request = _whole(data, client)
        if lose:
            self.lost.append(self._alone(request))
            _reset(client)
        return True

    def _alone(self, data):
        """Send a request over a connection of its own and return the status of its reply, which nobody gets."""
        with socket.create_connection(self.target, timeout=30) as server:
            server.sendall(data.replace(b"keep-alive", b"close"))
            reply = b""
            while part := server.recv(65536):
                reply += part
            return int(reply.split(b" ", 2)[1])

    def _back(self, server, client):
        with suppress(OSError):
            while data := server.recv(65536):
                if self.cut:
                    return _reset(client)
                client.sendall(data)
            client.shutdown(socket.SHUT_RDWR)
        return None


def _whole(data, client):
    """A request with all of its body."""
    head, _, body = data.partition(b"\r\n\r\n")
    length = int(re.search(rb"content-length: (\d+)", head, re.IGNORECASE)[1])
    while len(body) < length:
        body += client.recv(65536)
    return head + b"\r\n\r\n" + body


def _reset(client):
    with suppress(OSError):
        client.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, AT_ONCE)
        client.close()


@contextmanager
def wired(address):
    """A wire to a server."""
    host, port = address.removeprefix("http://").split(":")
    wire = Wire((host, int(port)))
    try:
        yield wire
    finally:
        wire.close()

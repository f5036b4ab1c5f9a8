"""A PostgreSQL of our own, in a temporary folder, reached through a socket there."""

from __future__ import annotations

import getpass
import os
import shutil
import subprocess
import tempfile
import uuid
from contextlib import contextmanager
from pathlib import Path

import psycopg
import pytest


def binaries():
    """The folder of PostgreSQL's server programs, if there is one."""
    found = shutil.which("initdb")
    if found:
        return Path(found).parent
    return next(iter(sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)), None)


def as_somebody():
    """PostgreSQL refuses to run as root."""
    if os.geteuid() != 0:
        return [], getpass.getuser()
    import pwd

    names = {entry.pw_name for entry in pwd.getpwall()}
    user = next((name for name in ("postgres", "nobody") if name in names), None)
    if user is None or shutil.which("runuser") is None:
        pytest.skip("running as root, with no other user to run PostgreSQL as")
    return ["runuser", "-u", user, "--"], user


@contextmanager
def running():
    folder = binaries()
    if folder is None:
        pytest.skip("PostgreSQL's server programs (initdb, pg_ctl) are not installed")
    prefix, user = as_somebody()
    place = Path(tempfile.mkdtemp(prefix="emg", dir="/tmp"))
    shutil.chown(place, user)

    def call(program, *arguments):
        command = [*prefix, str(folder / program), "-D", str(place / "data"), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, cwd=place, check=False)
        assert done.returncode == 0, done.stdout + done.stderr

    try:
        call("initdb", "-U", "emogen", "--auth=trust", "--no-sync", "-E", "UTF8")
        options = f"-c listen_addresses= -c unix_socket_directories={place} -c fsync=off -c max_connections=60"
        call("pg_ctl", "-w", "-l", str(place / "log"), "-o", options, "start")
        try:
            yield place
        finally:
            call("pg_ctl", "-w", "-m", "immediate", "stop")
    finally:
        shutil.rmtree(place, ignore_errors=True)


def fresh(place):
    """The URL of an empty database."""
    name = f"test_{uuid.uuid4().hex}"
    with psycopg.connect(host=str(place), user="emogen", dbname="postgres", autocommit=True) as connection:
        connection.execute(f'CREATE DATABASE "{name}"')
    return f"postgresql+psycopg://emogen@/{name}?host={place}"

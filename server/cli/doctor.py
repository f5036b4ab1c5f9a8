"""`emogen doctor`: where everything comes from, and what is missing."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import emogen_core
from emogen_core.errors import EmogenError
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.rendering.setup import look_for

from ..assets import asset
from ..services.diagnosis import database_report
from .common import Json, load_settings

if TYPE_CHECKING:
    from ..settings import Settings

app = typer.Typer()

# In a process of its own: opening GL can end a process that has no driver, and its environment has to be set first.
_DRAW = """
import json, numpy as np
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer
renderer, rig = make_renderer("pyrender")[:2]
weights = np.zeros((1, len(rig.shape_names)), np.float32)
picture = renderer.draw(rig.identities[0], weights, RenderSettings(100, 120))
from OpenGL.GL import GL_RENDERER, GL_VENDOR, GL_VERSION, glGetString
names = {"vendor": GL_VENDOR, "renderer": GL_RENDERER, "version": GL_VERSION}
print(json.dumps({**{k: glGetString(v).decode() for k, v in names.items()}, "drew": list(picture.shape)}))
"""

Report = dict[str, Any]


@app.command()
def doctor(json_: Json = False) -> None:
    """Say where both packages come from, whether this machine draws, and how the database stands."""
    settings = load_settings()
    report = {
        "packages": _packages(),
        "drawing": _drawing(),
        "rig": _rig(),
        "database": _database(settings),
    }
    problems = [f"{part}: {told['problem']}" for part, told in report.items() if told.get("problem")]
    typer.echo(json.dumps({**report, "problems": problems}, indent=2) if json_ else _text(report))
    if problems:
        raise typer.Exit(1)


def _packages() -> Report:
    return {
        "python": sys.version.split()[0],
        "server": str(Path(__file__).resolve().parents[1]),
        "emogen_core": str(Path(emogen_core.__file__).resolve().parent),
        **{name: str(asset(name)) for name in ("static", "templates", "migrations")},
    }


def _drawing() -> Report:
    environment = {**os.environ, "PYOPENGL_PLATFORM": "egl", "LP_NUM_THREADS": "0"}
    try:
        done = subprocess.run(  # noqa: S603 - our own interpreter and program
            [sys.executable, "-c", _DRAW], env=environment, capture_output=True, text=True, timeout=120, check=False
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return {"problem": "drawing one face took more than two minutes"}
    if done.returncode == 0:
        return dict(json.loads(done.stdout.splitlines()[-1]))
    last = (done.stderr.strip() or f"the process ended with status {done.returncode}").splitlines()[-1]
    return {"problem": f"{last} (apt-get install libegl1 libgl1 libgl1-mesa-dri)"}


def _rig() -> Report:
    try:
        rig = load_bundled_rig()
        look = look_for(rig)
    except EmogenError as error:
        return {"problem": str(error)}
    return {
        "name": rig.name,
        "hash": rig.hash,
        "look_hash": look.hash,
        "genes": len(rig.genes),
        "shapes": len(rig.shape_names),
        "identities": list(rig.identities),
    }


def _database(settings: Settings) -> Report:
    folder = settings.data_dir.absolute()
    if not settings.database_url and not folder.is_dir():
        return {"url": settings.url, "migration": None, "note": "will be made at the first start"}
    free = shutil.disk_usage(folder).free if folder.is_dir() else None
    return {**database_report(settings.url), "free_bytes": free}


def _text(report: dict[str, Report]) -> str:
    lines = [
        f"{part}\n" + "\n".join(f"  {name}: {value}" for name, value in told.items()) for part, told in report.items()
    ]
    return "\n".join(lines)

"""The wheel works outside the checkout, and the deployment files say what the program understands."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]


def run(*command: str | Path, cwd: Path, **env: str) -> str:
    done = subprocess.run(
        [str(part) for part in command],
        cwd=cwd,
        env={**os.environ, **env},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, f"{command} failed:\n{done.stdout}\n{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh environment that holds the wheel; only the dependencies come from the environment of the tests."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = (sys.executable, "-m", "pip")
    run(*pip, "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, ROOT, cwd=folder)
    venv.create(folder / "env", with_pip=False, symlinks=True)
    (wheel,) = folder.glob("emogen_study-*.whl")
    target = next((folder / "env").glob("lib/python*/site-packages"))
    run(*pip, "--python", folder / "env", "install", "--quiet", "--no-deps", wheel, cwd=folder)
    # A plain path line: the editable install of the checkout, itself a .pth file there, is not followed.
    (target / "dependencies.pth").write_text(sysconfig.get_path("purelib"))
    return folder / "env"


def test_the_wheel_runs_outside_the_checkout(installed: Path, tmp_path: Path) -> None:
    report = json.loads(
        run(installed / "bin" / "emogen", "doctor", "--json", cwd=tmp_path, EMOGEN_DATA_DIR=str(tmp_path))
    )
    text = json.dumps(report)
    assert str(installed) in text
    assert str(ROOT) not in text.replace(sysconfig.get_path("purelib"), "")


def test_pages_styles_and_migrations_are_in_the_wheel(installed: Path) -> None:
    assets = next(installed.glob("lib/python*/site-packages/server/_assets"))
    for folder in ("static", "templates", "migrations"):
        ours = {p.relative_to(ROOT) for p in (ROOT / folder).rglob("*") if p.is_file() and p.suffix != ".pyc"}
        theirs = {p.relative_to(assets) for p in (assets / folder).rglob("*") if p.is_file() and p.suffix != ".pyc"}
        assert ours == theirs


def test_compose_names_only_settings_that_exist() -> None:
    compose = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
    used = {*compose["services"]["app"]["environment"], *re.findall(r"EMOGEN_\w+", (ROOT / "Dockerfile").read_text())}
    documented = set(re.findall(r"EMOGEN_\w+", (ROOT / "docs" / "settings.md").read_text()))
    assert used <= documented
    assert set(compose["services"]) == {"app", "database", "proxy"}
    assert "USER emogen" in (ROOT / "Dockerfile").read_text()


def test_every_health_check_exists() -> None:
    compose = yaml.safe_load((ROOT / "docker-compose.yml").read_text())
    assert all("healthcheck" in service for name, service in compose["services"].items() if name != "app")
    assert "/health/ready" in (ROOT / "Dockerfile").read_text()

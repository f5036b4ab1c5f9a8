"""What commands share: the settings, and errors as one sentence instead of a stack trace."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer
from pydantic import ValidationError

from emogen_core.errors import EmogenError, expected

from ..services.drawing import open_house
from ..services.errors import ServiceError
from ..settings import Settings

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from ..services.house import House


def load_settings(**given: object) -> Settings:
    """Return the settings of the environment, with what the command line gave on top."""
    try:
        return Settings.model_validate({**Settings().model_dump(exclude_unset=True), **_set(given)})
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        name = "_".join(str(part) for part in first["loc"]).upper()
        raise stop(f"EMOGEN_{name}: {first['msg']}, got {first['input']!r}") from error


@contextmanager
def opened(settings: Settings, *, drawing: bool = True) -> Iterator[House]:
    """Open the house for a command, with or without drawing processes, and close it whatever happens."""
    with plainly():
        house = open_house(settings, drawing=drawing)
    try:
        with plainly():
            yield house
    finally:
        house.close()


@contextmanager
def plainly() -> Iterator[None]:
    """Turn the errors of the house into one sentence and an exit status of 1."""
    try:
        yield
    except (EmogenError, ServiceError) as error:
        raise stop(str(error)) from error


def made_folder(path: Path) -> Path:
    """Return a folder to write to, made if need be; end the command if there cannot be one."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise stop(f"--out: {expected('a folder to write to', f'{path} ({error.strerror})')}") from error
    return path


def stop(message: str) -> typer.Exit:
    """Print a message to standard error and return what ends the command."""
    typer.echo(message, err=True)
    return typer.Exit(1)


def _set(given: dict[str, object]) -> dict[str, object]:
    return {name: value for name, value in given.items() if value is not None}

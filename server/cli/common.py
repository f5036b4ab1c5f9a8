"""What all commands share: options, the settings, reports, and errors as one sentence instead of a stack trace."""

from __future__ import annotations

import json
import resource
import sys
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Any

import typer
from pydantic import ValidationError

from emogen_core.errors import EmogenError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.rig_file import load_rig

from ..services.errors import InvalidError, ServiceError
from ..settings import Settings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from emogen_core.face.rig import Rig


Json = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Backend = Annotated[str, typer.Option(help="pyrender or software.")]


def load_settings(**given: object) -> Settings:
    """Return the settings of the environment, with what the command line gave on top."""
    try:
        return Settings.model_validate({**Settings().model_dump(exclude_unset=True), **_set(given)})
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        name = "_".join(str(part) for part in first["loc"]).upper()
        raise stop(f"EMOGEN_{name}: {first['msg']}, got {first['input']!r}") from error


@contextmanager
def plainly() -> Iterator[None]:
    """Turn the errors of the house into one sentence, or one a problem of a study, and an exit status of 1."""
    try:
        yield
    except InvalidError as error:
        raise stop("\n".join(one.sentence for one in error.problems) or error.message) from error
    except (EmogenError, ServiceError) as error:
        raise stop(str(error)) from error


def rig_of(file: Path | None) -> Rig:
    """Return the rig of a file, or the bundled one where no file is named.

    Raises:
        RigFileError: no rig file of this version, or damaged.
    """
    return load_bundled_rig() if file is None else load_rig(file)


def report_text(report: Mapping[str, Any], *, as_json: bool) -> str:
    """Return a report as it is printed: JSON, or a line for each of its entries."""
    return json.dumps(report, indent=2) if as_json else "\n".join(f"{name}: {value}" for name, value in report.items())


@contextmanager
def progress(label: str) -> Iterator[Callable[[int, int], None]]:
    """Show on standard error how many of how many are done, as often as what is yielded is told."""
    with typer.progressbar(length=1, label=label, file=sys.stderr) as bar:

        def done(count: int, of: int) -> None:
            bar.length = of
            bar.update(count - bar.pos)

        yield done


def made_folder(path: Path) -> Path:
    """Return a folder to write to, made if need be; end the command if there is none, or nothing can be written."""
    try:
        path.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(prefix=".new-", dir=path):
            pass
    except OSError as error:
        raise unwritable(path, error) from error
    return path


def unwritable(path: Path, error: OSError) -> typer.Exit:
    """Say why nothing can be written to a folder, and return what ends the command."""
    return stop(f"--out: {expected('a folder to write to', f'{path} ({error.strerror})')}")


def stop(message: str) -> typer.Exit:
    """Print a message to standard error and return what ends the command."""
    typer.echo(message, err=True)
    return typer.Exit(1)


def _set(given: dict[str, object]) -> dict[str, object]:
    return {name: value for name, value in given.items() if value is not None}


def peak_mib() -> float:
    """Return the most memory that this process has had since it was started, in MiB."""
    status = Path("/proc/self/status")
    if not status.exists():
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) / 1024

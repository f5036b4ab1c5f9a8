"""`emogen rig pack`: as few expressions as possible that show every shape of a rig, as cards for artists and actors."""

from __future__ import annotations

import json
import shlex
from contextlib import closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from threadpoolctl import threadpool_limits

from emogen_core.errors import RenderingError
from emogen_core.rendering.setup import BACKENDS, load_dressed
from emogen_core.rigs.target_head import target_head
from emogen_core.transfer.packing.pack import ORDERS, Options

from ..packing.facts import Facts, document, proof, told
from ..packing.files import PAGE, write
from ..packing.making import make
from ..packing.studio import studio
from ..release import release
from .common import Json, made_folder, plainly, unwritable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.look import Look

    from ..packing.studio import Studio

RigFile = Annotated[Path | None, typer.Argument(metavar="[RIG]", help="A rig file; the bundled one if left out.")]
Out = Annotated[Path, typer.Option("--out", help="Folder to write to.")]
Mu = Annotated[
    float, typer.Option(help="From which share of its greatest displacement on a shape counts: 0.25 to 0.4.")
]
Alpha = Annotated[float, typer.Option(help="Share of displacement in the importance; the rest is distortion.")]
Beta = Annotated[float, typer.Option(help="Weight of uniqueness in the importance.")]
Most = Annotated[int | None, typer.Option("--max", help="How many expressions at most: the first ones.")]
Symmetry = Annotated[bool, typer.Option("--symmetry/--no-symmetry", help="Wear mirror images together.")]
Poseability = Annotated[
    bool, typer.Option("--poseability/--no-poseability", help="Keep to what eyes, jaw and lips can do.")
]
Order = Annotated[str, typer.Option(help=f"{' or '.join(ORDERS)}: as published, or the fewest expressions.")]
Target = Annotated[str, typer.Option(help="Who is on the cards: a head of the rig, or an OBJ file of its mesh.")]
Backend = Annotated[str, typer.Option(help=f"What draws: {' or '.join(BACKENDS)}.")]


def pack(  # noqa: PLR0913, PLR0917 - typer reads the options from the signature
    rig: RigFile = None, out: Out = Path("expressions"), mu: Mu = 0.33, alpha: Alpha = 0.5, beta: Beta = 0.0,
    most: Most = None, symmetry: Symmetry = True, poseability: Poseability = True, order: Order = "greedy",
    target: Target = "", backend: Backend = "pyrender", json_: Json = False,
) -> None:  # fmt: skip
    """Choose as few expressions as possible that show every shape of a rig, and draw a card of each."""
    options = Options(mu, alpha, beta, most, symmetry, poseability, order)
    with plainly(), threadpool_limits(1):
        own, look = load_dressed(rig)
        model, head = target_head(own, target)
        made = make(model, head, options)
        with _studio(model, look, head, backend) as draws:
            folder = made_folder(out)
            cards = made.drawn(draws) if draws else made.cards
        facts = Facts(_command(rig, options, target), release(), model.name, model.hash, head)
        found = document(made, options, facts)
        try:
            write(folder, made, cards, found, proof(made.packing))
        except OSError as error:
            raise unwritable(folder, error) from error
    typer.echo(json.dumps(found, indent=2) if json_ else f"{told(made)}\n{folder / PAGE}")


@contextmanager
def _studio(rig: Rig, look: Look, head: str, backend: str) -> Iterator[Studio | None]:
    """Open what draws; without OpenGL there is a sheet all the same, without faces."""
    try:
        opened = studio(rig, look, head, backend)
    except RenderingError as error:
        typer.echo(f"The cards will have no faces: {error}", err=True)
        yield None
        return
    with closing(opened):
        yield opened


def _command(rig: Path | None, options: Options, target: str) -> str:
    """Return what makes the same packing again, wherever the rig lies and the cards go."""
    words = [
        "emogen",
        "rig",
        "pack",
        *([rig.name] if rig else []),
        f"--mu={options.mu:g}",
        f"--alpha={options.alpha:g}",
    ]
    words += [f"--beta={options.beta:g}", f"--order={options.order}"]
    words += [f"--max={options.most}"] if options.most else []
    words += [] if options.symmetric else ["--no-symmetry"]
    words += [] if options.poseable else ["--no-poseability"]
    words += [f"--target={Path(target).name}"] if target else []
    return shlex.join(words)

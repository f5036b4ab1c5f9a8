"""How fast faces are drawn: weights to PNG, as a participant waits for them, and where the time goes."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.cores import cores
from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.png import encode_png
from emogen_core.rendering.pool import RenderPool
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import look_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer

    Correct = Callable[[Rig, str, NDArray[np.float64]], NDArray[np.float32]]
    Batch = tuple[NDArray[np.float64], NDArray[np.float32]]

STEPS = ("correct", "blend", "normals", "attributes", "upload", "draw", "read", "encode")
# As the search's random faces: so many of the enabled genes, each uniform in [0, 1].
_RANDOM_GENES = 6
_OFF = frozenset({"disabled", "lateral", "gaze"})
_WARM_UP = 2
# Enough to leave the nearest cache, as drawing does.
_YARDSTICK_NUMBERS = 1 << 18
_YARDSTICK_RUNS = 15


def bench_render(  # noqa: PLR0913, PLR0917 - all have defaults but the first
    correct: Correct, faces: int = 10, size: int = 384, rounds: int = 15, workers: int = 2, identity: str = ""
) -> dict[str, Any]:
    """Measure drawing on this machine.

    Args:
        correct: (rig, identity, (B, G) genes) -> (B, K) weights; the collision stage is part of it.
        faces: how many are asked for at once.
        size: width and height of a portrait, pixels.
        rounds: how often; two more are drawn before and not counted.
        workers: drawing processes.
        identity: who is drawn; by default the rig's first.

    Returns:
        ``pool_ms``: min, median, p95 and max of the wall time from weights to PNG for all faces through a pool;
        ``step_core_ms``: for each of `STEPS` and their ``sum``, processor time a face in one process, the median over
        the rounds (``correct`` is done before faces are asked for, so it is not in ``pool_ms``); ``png_bytes``; and
        what was measured on, with the machine's load before and after and ``yardstick_ms``: what a fixed piece of
        work took just then. Figures of two runs can be compared where their yardsticks agree.

    Raises:
        InvalidInputError: a number is below 1, or an unknown identity.
        MissingGLError: this machine cannot draw.
    """
    if min(faces, size, rounds, workers) < 1:
        raise InvalidInputError(f"bench: {expected('positive numbers', (faces, size, rounds, workers))}")
    rig, load, speed = load_bundled_rig(), _load(), _yardstick()
    who, settings = identity or rig.identities[0], RenderSettings(size, size)
    rig.neutral(who)
    genomes = [_random_genomes(rig, faces, seed) for seed in range(rounds + _WARM_UP)]
    steps, pictures, renderer, weights = _steps(rig, who, genomes, correct, settings)
    return {
        "faces": faces,
        "size": size,
        "rounds": rounds,
        "workers": workers,
        "identity": who,
        "cores": cores(),
        "renderer": renderer,
        "pool_ms": _pool(who, weights, settings, workers),
        "step_core_ms": steps,
        "png_bytes": pictures,
        "load": {"before": load, "after": _load()},
        "yardstick_ms": {"before": speed, "after": _yardstick()},
    }


def _random_genomes(rig: Rig, count: int, seed: int) -> NDArray[np.float64]:
    """Return (count, G) genes with a few set."""
    rng = np.random.default_rng(seed)
    enabled = [i for i, gene in enumerate(rig.genes) if not gene.flags & _OFF]
    genes = np.zeros((count, len(rig.genes)))
    for row in genes:
        chosen = rng.choice(enabled, min(_RANDOM_GENES, len(enabled)), replace=False)
        row[chosen] = rng.random(len(chosen))
    return genes


def _pool(
    identity: str, batches: list[NDArray[np.float32]], settings: RenderSettings, workers: int
) -> dict[str, float]:
    times = []
    with RenderPool(workers) as pool:
        for batch in batches:
            start = time.perf_counter()
            futures = [pool.submit(identity, row, settings) for row in batch]
            for future in futures:
                future.result()
            times.append((time.perf_counter() - start) * 1000)
    counted = np.array(times[_WARM_UP:])
    named = {"min": counted.min(), "median": np.median(counted), "p95": np.percentile(counted, 95)}
    return {name: _ms(value) for name, value in {**named, "max": counted.max()}.items()}


def _steps(
    rig: Rig, identity: str, genomes: list[NDArray[np.float64]], correct: Correct, settings: RenderSettings
) -> tuple[dict[str, float], int, str, list[NDArray[np.float32]]]:
    """Return processor time a face for each step, a PNG's mean size, the GL renderer's name, and the weights."""
    # As in the pool's workers; read when GL is opened.
    os.environ.setdefault("LP_NUM_THREADS", "0")
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer, gl_renderer  # noqa: PLC0415

    renderer = PyrenderRenderer(rig, look_for(rig))
    laps: list[NDArray[np.floating]] = []
    sizes: list[int] = []
    batches: list[NDArray[np.float32]] = []
    for genes in genomes:
        start = time.process_time()
        batches.append(correct(rig, identity, genes))
        corrected = (time.process_time() - start) / len(genes)
        *spent, size = zip(*_laps(renderer, rig, identity, batches[-1], settings), strict=True)
        laps.append(np.array([corrected, *np.mean(spent, axis=1)]) * 1000)
        sizes += size
    renderer.close()
    medians = dict(zip(STEPS, np.median(laps[_WARM_UP:], axis=0).tolist(), strict=True))
    rounded = {name: _ms(value) for name, value in {**medians, "sum": sum(medians.values())}.items()}
    return rounded, round(float(np.mean(sizes))), gl_renderer(), batches


def _laps(
    renderer: PyrenderRenderer, rig: Rig, identity: str, batch: NDArray[np.float32], settings: RenderSettings
) -> Iterator[tuple[float, ...]]:
    """Yield for each face the seconds of processor time of all `STEPS` but the first, and the bytes of its PNG."""
    start = time.process_time()
    meshes = vertices(rig, identity, batch)
    blend = (time.process_time() - start) / len(batch)
    for mesh, row in zip(meshes, batch, strict=True):
        marks = [time.process_time()]
        normals = renderer.surface.normals(mesh)
        marks.append(time.process_time())
        rows = renderer.surface.dress(identity, row, mesh, normals)
        marks.append(time.process_time())
        renderer.upload(rows)
        marks.append(time.process_time())
        renderer.paint(identity, settings)
        marks.append(time.process_time())
        picture = renderer.read()
        marks.append(time.process_time())
        png = encode_png(picture)
        marks.append(time.process_time())
        yield (blend, *np.diff(marks).tolist(), len(png))


def _yardstick() -> float:
    """Return the processor milliseconds that a fixed piece of work takes: median of some runs."""
    numbers = np.arange(_YARDSTICK_NUMBERS, dtype=np.float32)
    order = np.random.default_rng(0).permutation(len(numbers))
    # Written in place: fresh memory costs what it costs, not what the processor does.
    mixed, spent = np.ones_like(numbers), []
    for _ in range(_YARDSTICK_RUNS):
        start = time.process_time()
        numbers.take(order, out=mixed, mode="clip")
        np.sqrt(np.multiply(mixed, numbers, out=mixed), out=mixed)
        spent.append(time.process_time() - start)
    return _ms(1000 * np.median(spent))


def _load() -> float:
    return round(os.getloadavg()[0], 2)


def _ms(value: float | np.floating[Any]) -> float:
    return round(float(value), 2)

"""How fast faces are drawn: weights to PNG, as a participant waits for them, and where the time goes."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import InvalidInputError, expected
from emogen_core.face.bundled import load_bundled_rig
from emogen_core.face.evaluate import vertices
from emogen_core.rendering.png import encode_png
from emogen_core.rendering.pool import RenderPool
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import look_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer

STEPS = ("blend", "normals", "shade", "upload", "draw and read", "encode")


def bench_render(faces: int = 10, size: int = 384, rounds: int = 15, workers: int = 2) -> dict[str, Any]:
    """Measure drawing on this machine.

    Args:
        faces: how many are asked for at once.
        size: width and height of a portrait, pixels.
        rounds: how often; the first two are not counted.
        workers: drawing processes.

    Returns:
        ``pool_ms``: median, min and max of the wall time for all faces through a pool; ``step_core_ms``: for each of
        `STEPS` and their ``sum``, processor time a face in one process, the median over the rounds; ``png_bytes``; and
        what was measured on.

    Raises:
        InvalidInputError: an argument is below 1.
        MissingGLError: this machine cannot draw.
    """
    if min(faces, size, rounds, workers) < 1:
        raise InvalidInputError(f"bench: {expected('positive numbers', (faces, size, rounds, workers))}")
    rig = load_bundled_rig()
    settings = RenderSettings(size, size)
    batches = [_random_faces(rig, faces, seed) for seed in range(rounds + 2)]
    steps, pictures, renderer = _steps(rig, batches, settings)
    return {
        "faces": faces,
        "size": size,
        "rounds": rounds,
        "workers": workers,
        "cores": len(os.sched_getaffinity(0)),
        "load": round(os.getloadavg()[0], 2),
        "renderer": renderer,
        "pool_ms": _pool(rig, batches, settings, workers),
        "step_core_ms": steps,
        "png_bytes": pictures,
    }


def _random_faces(rig: Rig, count: int, seed: int) -> NDArray[np.float32]:
    """Return (count, K) weights with six shapes set, as the search's random faces have."""
    rng = np.random.default_rng(seed)
    weights = np.zeros((count, len(rig.shape_names)), np.float32)
    for row in weights:
        row[rng.choice(len(rig.core_shapes), min(6, len(rig.core_shapes)), replace=False)] = rng.random(6)
    return weights


def _pool(rig: Rig, batches: list[NDArray[np.float32]], settings: RenderSettings, workers: int) -> dict[str, float]:
    times = []
    with RenderPool(workers) as pool:
        for batch in batches:
            start = time.perf_counter()
            futures = [pool.submit(rig.identities[0], row, settings) for row in batch]
            for future in futures:
                future.result()
            times.append((time.perf_counter() - start) * 1000)
    return {"median": _ms(np.median(times[2:])), "min": _ms(min(times[2:])), "max": _ms(max(times[2:]))}


def _steps(rig: Rig, batches: list[NDArray[np.float32]], settings: RenderSettings) -> tuple[dict[str, float], int, str]:
    """Return processor time a face for each step, the mean size of a PNG, and the GL renderer's name."""
    from emogen_core.rendering.pyrender_backend import PyrenderRenderer, gl_renderer  # noqa: PLC0415

    # As in the pool's workers; read when GL is opened.
    os.environ.setdefault("LP_NUM_THREADS", "0")
    renderer = PyrenderRenderer(rig, look_for(rig))
    laps: list[list[float]] = []
    sizes: list[int] = []
    for batch in batches:
        *spent, size = zip(*_laps(renderer, rig, batch, settings), strict=True)
        laps.append([sum(step) / len(batch) * 1000 for step in spent])
        sizes += size
    renderer.close()
    medians = dict(zip(STEPS, np.median(laps[2:], axis=0).tolist(), strict=True))
    rounded = {name: _ms(value) for name, value in {**medians, "sum": sum(medians.values())}.items()}
    return rounded, round(float(np.mean(sizes))), gl_renderer()


def _laps(
    renderer: PyrenderRenderer, rig: Rig, batch: NDArray[np.float32], settings: RenderSettings
) -> Iterator[tuple[float, ...]]:
    """Yield for each face the seconds of processor time of `STEPS` and the bytes of its PNG."""
    identity = rig.identities[0]
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
        picture = renderer.shoot(identity, settings)
        marks.append(time.process_time())
        png = encode_png(picture)
        marks.append(time.process_time())
        yield (blend, *np.diff(marks).tolist(), len(png))


def _ms(value: float | np.floating[Any]) -> float:
    return round(float(value), 2)

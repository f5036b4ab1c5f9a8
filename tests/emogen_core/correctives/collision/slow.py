"""The paper's rules once more, written to be read and not to be fast: what the quick ones are held against."""

import numpy as np

from emogen_core.correctives.collision.regions import LIPS

UP, OUT = np.array([0.0, 1, 0]), np.array([0.0, 0, 1])


def shoot(point, direction, patch, triangles):
    """Every crossing of one ray: (distance, whether it leaves the flesh, face, barycentric), nearest first."""
    found = []
    for face, corners in enumerate(patch[triangles]):
        a, b, c = corners
        # a + s (b - a) + t (c - a) = point + d * direction
        system = np.stack([b - a, c - a, -direction], axis=1)
        if abs(np.linalg.det(system)) < 1e-12:
            continue
        s, t, distance = np.linalg.solve(system, point - a)
        if s >= 0 and t >= 0 and s + t <= 1 and distance > 0:
            leaving = np.cross(b - a, c - a) @ direction > 0
            found.append((distance, bool(leaving), face, np.array([1 - s - t, s, t])))
    return sorted(found, key=lambda hit: hit[0])


def is_within(point, patch, triangles):
    sides, odd = [], []
    for axis in (UP, OUT):
        ahead, back = (shoot(point, sign * axis, patch, triangles) for sign in (1, -1))
        leaves = [bool(ray) and ray[0][1] for ray in (ahead, back)]
        sides.append(all(leaves))
        odd.append(leaves[0] and len(ahead) % 2 == 1)
    return any(sides) or all(odd)


def contacts(anchors, kind, wanted, patch, triangles, *, tolerance=0.1):
    """Pairs (anchor, face, barycentric, depth) of one type, and the greatest depth of an anchor within."""
    direction = UP if wanted == LIPS else -OUT
    within, through, worst = [], [], 0.0
    for anchor in np.flatnonzero(kind == wanted):
        ray = shoot(anchors[anchor], direction, patch, triangles)
        if ray and ray[0][1] and is_within(anchors[anchor], patch, triangles):
            within.append((anchor, ray[0][2], ray[0][3], ray[0][0]))
            worst = max(worst, ray[0][0])
        elif len(ray) == 2 and not ray[0][1] and ray[1][1]:
            through.append((anchor, ray[1][2], ray[1][3], ray[1][0]))
    if worst <= tolerance:
        return [], worst
    return [pair for pair in within + through if pair[3] > tolerance], worst

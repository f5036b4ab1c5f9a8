"""The nodes of a glTF scene: which meshes it shows, and where (chapter 3.5)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation

from emogen_core.errors import InvalidInputError, expected

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from emogen_core.rigs.foreign.accessors import Accessors

    Matrix = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Placed:
    """One mesh at one place: index of the mesh, name and number of its node, and the (4, 4) matrix to the scene."""

    mesh: int
    name: str
    number: int
    matrix: Matrix


def placed_meshes(document: dict[str, Any], accessors: Accessors, file: str) -> list[Placed]:
    """Return the meshes of the scene that a file shows, in the order of its nodes.

    A mesh on a skeleton stands where its joints put it in their rest pose, as the specification wants it.

    Raises:
        InvalidInputError: a node is its own ancestor, or has two parents.
    """
    nodes = document.get("nodes", [])
    matrices = _world(nodes, _roots(document, nodes), file)
    placed = []
    for number, matrix in sorted(matrices.items()):
        node = nodes[number]
        if "mesh" in node:
            place = _bound(document, accessors, node, matrices) if "skin" in node else matrix
            placed.append(Placed(node["mesh"], node.get("name", ""), number, place))
    return placed


def _roots(document: dict[str, Any], nodes: list[dict[str, Any]]) -> list[int]:
    scenes = document.get("scenes", [])
    if scenes:
        return list(scenes[document.get("scene", 0)].get("nodes", []))
    children = {child for node in nodes for child in node.get("children", ())}
    return [i for i in range(len(nodes)) if i not in children]


def _world(nodes: list[dict[str, Any]], roots: list[int], file: str) -> dict[int, Matrix]:
    matrices: dict[int, Matrix] = {}
    waiting = [(root, np.eye(4)) for root in roots]
    while waiting:
        number, above = waiting.pop()
        if number in matrices:
            raise InvalidInputError(f"{file}: nodes: {expected('a tree', f'node {number} twice')}")
        matrices[number] = above @ _local(nodes[number])
        waiting += [(child, matrices[number]) for child in nodes[number].get("children", ())]
    return matrices


def _local(node: dict[str, Any]) -> Matrix:
    """Return the (4, 4) matrix of a node: given by columns, or as translation times rotation times scale."""
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    matrix = np.eye(4)
    turned = Rotation.from_quat(node.get("rotation", (0, 0, 0, 1))).as_matrix()
    matrix[:3, :3] = turned * np.array(node.get("scale", (1, 1, 1)), np.float64)
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def _bound(document: dict[str, Any], accessors: Accessors, node: dict[str, Any], matrices: dict[int, Matrix]) -> Matrix:
    skin = document["skins"][node["skin"]]
    joint = matrices.get(skin["joints"][0], np.eye(4))
    if "inverseBindMatrices" not in skin:
        return joint
    inverse: Matrix = accessors.read(skin["inverseBindMatrices"], "MAT4")[0].reshape(4, 4).T
    return joint @ inverse

"""A head made by hand: a ball with eyes, teeth and a jaw, and files of it in every dialect."""

import json
import struct

import numpy as np
import trimesh

from emogen_core.rigs.foreign.model import HeadModel

EYES = ((31.0, 0.0, 0.0), (-31.0, 0.0, 0.0))


def made_head(**changes):
    """In millimetres and the product's axes; 250 mm high."""
    pieces = {
        "Face": _ball(3, (80, 125, 95), (0, -30, -80)),
        "EyeLeft": _ball(2, (12, 12, 12), EYES[0]),
        "EyeRight": _ball(2, (12, 12, 12), EYES[1]),
        "TeethUpper": _ball(1, (20, 4, 8), (0, -76, -8)),
        "TeethLower": _ball(1, (20, 4, 8), (0, -90, -8)),
    }
    parts, triangles, points, row = {}, [], [], 0
    for name, (vertices, faces) in pieces.items():
        parts[name] = (row, row + len(faces))
        triangles.append(faces + sum(map(len, points)))
        points.append(vertices)
        row += len(faces)
    vertices = np.concatenate(points).astype(np.float32)
    values = {
        "name": "made", "vertices": vertices, "triangles": np.concatenate(triangles).astype(np.int32), "parts": parts,
        "expressions": _expressions(vertices, len(points[0]), len(vertices) - len(points[-1])),
    }  # fmt: skip
    return HeadModel(**values | changes)


def _ball(subdivisions, radii, centre):
    ball = trimesh.creation.icosphere(subdivisions)
    return ball.vertices * radii + centre, np.asarray(ball.faces)


def _expressions(vertices, skin, teeth):
    def bump(centre, radius, way, rows=slice(0, skin)):
        offsets = np.zeros_like(vertices)
        gap = np.linalg.norm(vertices[rows] - centre, axis=1)
        offsets[rows] = np.maximum(1 - gap / radius, 0)[:, None] * np.array(way)
        return offsets

    jaw = np.zeros_like(vertices)
    jaw[:skin, 1] = -20 * np.clip((-80 - vertices[:skin, 1]) / 10, 0, 1)
    jaw[teeth:, 1] = -20
    sided = {}
    for side, x in (("L", 31), ("R", -31)):
        sided[f"eyeBlink_{side}"] = bump((x, 14, 0), 25, (0, -9, 0)) + bump((x, -14, 0), 18, (0, 6, 0))
        sided[f"browInnerUp_{side}"] = bump((x / 2, 35, 0), 30, (0, 6, 1))
        sided[f"mouthSmile_{side}"] = bump((x, -80, 0), 30, (3 if x > 0 else -3, 7, -2))
        sided[f"eyeLookIn_{side}"] = bump((x, 0, 5), 25, (-1 if x > 0 else 1, 0, 0))
        sided[f"eyeLookOut_{side}"] = bump((x, 0, 5), 25, (1 if x > 0 else -1, 0, 0))
    return sided | {
        "jawOpen": jaw,
        "mouthClose": bump((0, -95, 0), 40, (0, 18, 0)),
        "mouthFunnel": bump((0, -80, 10), 40, (0, 0, 9)),
    }


def obj_text(vertices, triangles, parts=(), corner="{}"):
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices]
    starts = {first: name for name, (first, _) in dict(parts).items()}
    for i, triangle in enumerate(triangles):
        if i in starts:
            lines.append(f"usemtl {starts[i]}")
        lines.append("f " + " ".join(corner.format(v + 1) for v in triangle))
    return "\n".join(lines) + "\n"


def write_folder(folder, model, neutral="neutral", scale=1.0):
    folder.mkdir(parents=True, exist_ok=True)
    shapes = {neutral: 0, **model.expressions, **model.identity_modes}
    for name, offsets in shapes.items():
        text = obj_text((model.vertices + offsets) * scale, model.triangles, model.parts)
        (folder / f"{name}.obj").write_text(text)
    return folder


class Gltf:
    """Builds a glTF document by hand, right or wrong."""

    def __init__(self):
        self.data = b""
        self.document = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "Head"}],
            "meshes": [], "accessors": [], "bufferViews": [], "materials": [],
        }  # fmt: skip

    def view(self, data, **more):
        self.data += b"\0" * (-len(self.data) % 4)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **more}
        self.document["bufferViews"].append(view)
        self.data += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values, kind="VEC3", component=5126, dtype="<f4", **more):
        values = np.asarray(values, dtype)
        accessor = {
            "bufferView": self.view(values.tobytes()),
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        return self.raw(accessor | more)

    def raw(self, accessor):
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def indices(self, triangles):
        return self.accessor(np.asarray(triangles).ravel(), "SCALAR", 5125, "<u4")

    def mesh(self, *primitives, names=None, **more):
        extras = {} if names is None else {"extras": {"targetNames": list(names)}}
        self.document["meshes"].append({"primitives": list(primitives), **extras, **more})

    def glb(self):
        document = self.document | {"buffers": [{"byteLength": len(self.data)}]}
        return glb(json.dumps(document).encode(), self.data)


def glb(text, data):
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def gltf_of(model, scale=1.0):
    made = Gltf()
    made.document["materials"] = [{"name": name} for name in model.parts]
    points = made.accessor(model.vertices * scale)
    targets = [{"POSITION": made.accessor(offsets * scale)} for offsets in model.expressions.values()]
    made.mesh(
        *(
            {
                "attributes": {"POSITION": points}, "indices": made.indices(model.triangles[a:b]), "material": i,
                "targets": targets,
            }
            for i, (a, b) in enumerate(model.parts.values())
        ),
        names=model.expressions,
    )  # fmt: skip
    return made

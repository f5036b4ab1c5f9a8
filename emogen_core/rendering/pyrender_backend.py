# ruff: noqa: ARG002 - pyrender decides what its hooks are given.
"""The fast renderer: pyrender, kept alive with its own shaders and passes. Only this file touches pyrender or OpenGL.

pyrender used as its manual says makes a renderer, a scene and four-fold multisampling for every picture: about 500 ms
a face on software OpenGL. Kept alive, lit in the vertex shader, drawn at twice the size without multisampling and
averaged down, the same face takes about 20. The hooks that this needs are private members of pyrender 0.1.45, hence
the exact pin.

Notes on its traps: terminating the EGL display of one renderer kills every other in the process, so a thread keeps
one context for good; textures that are not in the scene are dropped by `_update_context`, so only additions happen
here; lights are kept in a set without order, so they live in the shader; `Scene.bounds` fails with numpy 2, so the
camera is ours.
"""

from __future__ import annotations

import ctypes
import os
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.errors import MissingGLError, RenderingError
from emogen_core.rendering.camera import FAR, FIELD_OF_VIEW, NEAR, frame_head
from emogen_core.rendering.recent import HEADS, Recent
from emogen_core.rendering.shrink import halved
from emogen_core.rendering.surface import COLUMNS, LIGHT, NORMAL, POSITION, TEXTURE, TINT, Surface

os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
_NO_GL = (
    "Faces cannot be drawn: this machine offers no OpenGL through EGL ({reason}); "
    "install it, on Debian or Ubuntu with: apt-get install libegl1 libgl1 libgl1-mesa-dri"
)
try:
    import pyrender
    from OpenGL import GL
    from pyrender.constants import RenderFlags
    from pyrender.platforms import egl
    from pyrender.renderer import Renderer as _PyrenderRenderer
    from pyrender.shader_program import ShaderProgramCache
except Exception as error:
    # PyOpenGL reports a missing library as ImportError, OSError, AttributeError or TypeError, by version and library.
    raise MissingGLError(_NO_GL.format(reason=f"{type(error).__name__}: {error}")) from error

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from emogen_core.face.rig import Rig
    from emogen_core.rendering.camera import Camera
    from emogen_core.rendering.look import Layer, Look, Style
    from emogen_core.rendering.protocol import RenderSettings
    from emogen_core.rendering.worn import WornHead

_KINDS = {"skin": {}, "eyes": {"KIND_EYE": 1}, "lashes": {"KIND_LASH": 1}}
_SUPERSAMPLING = 2
# From so many drawn rows on, a texel of the face is larger than a pixel.
_MAGNIFIED = 600
_contexts = threading.local()


class PyrenderRenderer:
    """Draws faces with pyrender on EGL. Use it only in the thread that made it; several may live side by side."""

    def __init__(self, rig: Rig, look: Look, turn: float = 0.0) -> None:
        """Open a GL context (or share the thread's) and prepare the meshes of a rig in a look, see `Surface`.

        Raises:
            MissingGLError: no usable OpenGL on this machine.
            InvalidInputError: the look does not fit the rig.
        """
        self._context = _context()
        self.surface = Surface(rig, look, turn)
        # A texture that goes is never one in use: every head that is drawn asks for all of its own first.
        self._textures: Recent[tuple[str, str], Any] = Recent(HEADS * len(look.layers), self._free)
        self._cameras: Recent[str, Camera] = Recent()
        self._framed: Recent[str, NDArray[np.int32]] = Recent()
        self._scene = pyrender.Scene(ambient_light=np.zeros(3), bg_color=np.ones(4))
        self._eye = self._scene.add(pyrender.PerspectiveCamera(FIELD_OF_VIEW, znear=NEAR, zfar=FAR))
        self._meshes = [self._add(name, layer) for name, layer in look.layers.items()]
        self._pass: _Pass | None = _Pass(self._meshes)

    def draw(self, identity: str, weights: NDArray[np.float32], settings: RenderSettings) -> NDArray[np.uint8]:
        """Draw a (B, K) batch: (B, height, width, 3) uint8 sRGB. See `emogen_core.rendering.protocol.Renderer`."""
        pictures = np.empty((len(weights), settings.height, settings.width, 3), np.uint8)
        for picture, rows in zip(pictures, self.surface.faces(identity, weights), strict=True):
            self.upload(rows)
            self.paint(identity, settings)
            picture[:] = self.read()
        return pictures

    def wear(self, head: WornHead) -> None:
        """Take one more head in."""
        self.surface.wear(head)

    def drop(self, name: str) -> None:
        """Let a head go."""
        self.surface.drop(name)

    def upload(self, rows: dict[str, NDArray[np.float32]]) -> None:
        """Send the (R, 14) rows of each layer to the card."""
        if self._pass is None:
            raise RenderingError("this renderer is closed")
        self._context.make_current()
        for mesh in self._meshes:
            primitive, data = mesh.primitives[0], rows[mesh.name]
            if primitive._vaid is None:
                primitive._add_to_context()
            GL.glBindBuffer(GL.GL_ARRAY_BUFFER, primitive._buffers[0])
            GL.glBufferSubData(GL.GL_ARRAY_BUFFER, 0, data.nbytes, data)

    def paint(self, identity: str, settings: RenderSettings) -> None:
        """Draw what was uploaded last, in the identity's style and camera."""
        if self._pass is None:
            raise RenderingError("this renderer is closed")
        self._context.make_current()
        style = self.surface.look.style(identity)
        self._dress(style)
        camera = self.camera(identity)
        self._frame(identity, camera)
        self._pass.aim(camera, style, settings)
        pose = np.eye(4)
        pose[1:3, 3] = camera.height, camera.distance
        self._scene.set_pose(self._eye, pose)
        self._scene.bg_color = np.array([*settings.background, 255], np.float64) / 255
        self._pass.render(self._scene, RenderFlags.NONE)

    def read(self) -> NDArray[np.uint8]:
        """Return the picture (height, width, 3) that was painted last."""
        if self._pass is None:
            raise RenderingError("this renderer is closed")
        return self._pass.read()

    def camera(self, identity: str) -> Camera:
        """Return the camera that frames this identity."""
        return self._cameras.get(identity, lambda: frame_head(self.surface.neutral_skin(identity)))

    def close(self) -> None:
        """Free the buffers and textures; the thread's context stays, since others may share it."""
        if self._pass is not None:
            self._context.make_current()
            self._pass.delete()
            self._pass = None
            self._textures.clear()

    def _add(self, name: str, layer: Layer) -> Any:
        rows = np.zeros((len(layer.source), COLUMNS), np.float32)
        rows[:, TINT] = 1  # any other alpha would mark the mesh as transparent for good
        primitive = pyrender.Primitive(
            positions=rows[:, POSITION], normals=rows[:, NORMAL], texcoord_0=rows[:, TEXTURE],
            texcoord_1=rows[:, LIGHT], color_0=rows[:, TINT], indices=layer.triangles, mode=4,
            material=pyrender.MetallicRoughnessMaterial(
                name=name, alphaMode="BLEND" if name == "lashes" else "OPAQUE", doubleSided=name == "lashes"
            ),
        )  # fmt: skip
        mesh = pyrender.Mesh([primitive], name=name)
        self._scene.add(mesh)
        return mesh

    def _frame(self, identity: str, camera: Camera) -> None:
        """Draw only what shows of this identity's skin: a tenth of the pixels would be shoulders that faded out."""
        primitive = next(mesh for mesh in self._meshes if mesh.name == "skin").primitives[0]
        triangles = self._framed.get(identity, lambda: self.surface.framed_skin(identity, camera))
        if primitive.indices is not triangles:
            primitive.indices = triangles
            primitive._bind()
            data = np.ascontiguousarray(triangles, np.uint32)
            GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, data.nbytes, data, GL.GL_STATIC_DRAW)
            primitive._unbind()

    def _dress(self, style: Style) -> None:
        for mesh in self._meshes:
            texture = self._texture(mesh.name, getattr(style, mesh.name))
            mesh.primitives[0].material.baseColorTexture = texture

    def _texture(self, kind: str, name: str) -> Any:
        return self._textures.get((kind, name), lambda: self._painted(kind, name))

    def _painted(self, kind: str, name: str) -> Any:
        look = self.surface.look
        sampler = pyrender.Sampler(magFilter=GL.GL_LINEAR, minFilter=GL.GL_LINEAR_MIPMAP_LINEAR)
        pixels = look.texture(name, "RGBA").copy()
        if kind == "skin" and "relief" in look.textures:
            pixels[..., 3] = look.texture("relief", "L")
        return pyrender.Texture(source=pixels, source_channels="RGBA", sampler=sampler)

    def _free(self, texture: Any) -> None:
        if self._pass is not None:
            self._pass.free(texture)


class _Pass(_PyrenderRenderer):
    """pyrender's renderer without multisampling, depth reading and lights; our shaders, our order of drawing."""

    def __init__(self, meshes: list[Any]) -> None:
        super().__init__(1, 1)
        self._order = meshes
        self._program_cache = ShaderProgramCache(shader_dir=str(Path(__file__).parent / "shaders"))
        self._frames: dict[tuple[int, int], tuple[int, int, int]] = {}
        self._drawn = np.empty((0, 0, 4), np.uint8)
        self._uniforms: dict[str, Any] = {}
        self._tones: dict[str, Any] = {}
        self._mesh_textures: set[Any] = set()

    def aim(self, camera: Camera, style: Style, settings: RenderSettings) -> None:
        """Take what the next faces share: view, colours of the head, size and background."""
        self.viewport_width, self.viewport_height = (_SUPERSAMPLING * n for n in (settings.width, settings.height))
        # Blending between mipmaps costs too much; where texels are magnified, even choosing one is a waste.
        large = self.viewport_height >= _MAGNIFIED
        self._reduced = GL.GL_LINEAR if large else GL.GL_LINEAR_MIPMAP_NEAREST
        self._tones = {"skin": np.array(style.tone), "eyes": np.ones(3), "lashes": np.array(style.lash)}
        self._uniforms = {
            "fade": np.array(camera.fade),
            "background": np.array(settings.background, np.float64) / 255,
            "shine_scale": float(style.shine),
            "breakup": 3.2 / max(style.tone[1], 0.05),
        }

    def free(self, texture: Any) -> None:
        """Free one texture that no head wears any more."""
        if texture in self._mesh_textures:
            self._mesh_textures.remove(texture)
            texture.delete()

    def delete(self) -> None:
        """Free the GL objects of this renderer; the shared display stays."""
        for texture in self._mesh_textures:
            texture.delete()
        for mesh in self._order:
            mesh.primitives[0].delete()
        for colour, depth, frame in self._frames.values():
            GL.glDeleteFramebuffers(1, [frame])
            GL.glDeleteRenderbuffers(2, [colour, depth])
        self._program_cache.clear()
        self._frames, self._mesh_textures = {}, set()

    def _update_context(self, scene: Any, flags: int) -> None:
        for mesh in self._order:
            for texture in mesh.primitives[0].material.textures - self._mesh_textures:
                texture._add_to_context()
                self._mesh_textures.add(texture)

    def _sorted_mesh_nodes(self, scene: Any) -> list[Any]:
        nodes = {node.mesh.name: node for node in scene.mesh_nodes}
        return [nodes[mesh.name] for mesh in self._order]

    def _get_primitive_program(self, primitive: Any, flags: int, program_flags: int) -> Any:
        program = self._program_cache.get_program("mesh.vert", "mesh.frag", defines=_KINDS[primitive.material.name])
        if not program._in_context():
            program._add_to_context()
            program.set_uniform = _remembering(program.set_uniform)
        return program

    def _bind_lighting(self, scene: Any, program: Any, node: Any, flags: int) -> None:
        for name, value in self._uniforms.items():
            program.set_uniform(name, value)
        program.set_uniform("tone", self._tones[node.mesh.name])

    def _bind_and_draw_primitive(self, primitive: Any, pose: Any, program: Any, flags: int) -> None:
        """Draw with one texture and no other material: pyrender's own sets some twenty uniforms that we do not have."""
        material = primitive.material
        primitive._bind()
        self._bind_texture(material.baseColorTexture, "material.base_color_texture", program)
        if material.name == "skin":
            GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, self._reduced)
        for kind, on in ((GL.GL_BLEND, material.alphaMode == "BLEND"), (GL.GL_CULL_FACE, not material.doubleSided)):
            (GL.glEnable if on else GL.glDisable)(kind)
        GL.glBlendFunc(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA)
        GL.glDrawElements(GL.GL_TRIANGLES, primitive.indices.size, GL.GL_UNSIGNED_INT, None)
        primitive._unbind()

    def _configure_forward_pass_viewport(self, flags: int) -> None:
        frame = self._frame(self.viewport_width, self.viewport_height)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, frame)
        GL.glViewport(0, 0, self.viewport_width, self.viewport_height)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_LESS)

    def read(self) -> NDArray[np.uint8]:
        """Return the picture averaged down, colour only."""
        width, height = self.viewport_width, self.viewport_height
        if self._drawn.shape[:2] != (height, width):
            self._drawn = np.empty((height, width, 4), np.uint8)
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self._frame(width, height))
        GL.glReadPixels(0, 0, width, height, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, self._drawn)
        return halved(self._drawn)

    def _frame(self, width: int, height: int) -> int:
        if (width, height) not in self._frames:
            self._frames[width, height] = self._make_frame(width, height)
        return self._frames[width, height][2]

    @staticmethod
    def _make_frame(width: int, height: int) -> tuple[int, int, int]:
        colour, depth = GL.glGenRenderbuffers(2)
        frame = GL.glGenFramebuffers(1)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, frame)
        for buffer, kind, place in (
            (colour, GL.GL_RGBA8, GL.GL_COLOR_ATTACHMENT0),
            (depth, GL.GL_DEPTH_COMPONENT24, GL.GL_DEPTH_ATTACHMENT),
        ):
            GL.glBindRenderbuffer(GL.GL_RENDERBUFFER, buffer)
            GL.glRenderbufferStorage(GL.GL_RENDERBUFFER, kind, width, height)
            GL.glFramebufferRenderbuffer(GL.GL_DRAW_FRAMEBUFFER, place, GL.GL_RENDERBUFFER, buffer)
        return int(colour), int(depth), int(frame)


def _remembering(send: Callable[..., None]) -> Callable[..., None]:
    """Return a `set_uniform` that skips what its program knows: pyrender tells everything again for every face."""
    known: dict[str, bytes] = {}

    def set_uniform(name: str, value: Any) -> None:
        """Tell a program a value that is new to it."""
        told = np.asarray(value).tobytes()
        if known.get(name) != told:
            known[name] = told
            send(name, value)

    return set_uniform


def _context() -> Any:
    """Return this thread's EGL context, made on first use and kept until the thread ends."""
    if not hasattr(_contexts, "platform"):
        try:
            device = egl.get_device_by_index(int(os.environ.get("EGL_DEVICE_ID", "0")))
            platform = egl.EGLPlatform(1, 1, device=device)
            platform.init_context()
        except Exception as error:
            # No vendor: ValueError("Invalid device ID (0)"); no driver: EGLError EGL_NOT_INITIALIZED.
            raise MissingGLError(_NO_GL.format(reason=f"{type(error).__name__}: {error}".splitlines()[0])) from error
        _contexts.platform = platform
    _contexts.platform.make_current()
    return _contexts.platform


def gl_renderer() -> str:
    """Return the name of the GL renderer that draws here, for `emogen doctor`.

    Raises:
        MissingGLError: no usable OpenGL on this machine.
    """
    _context()
    return ctypes.string_at(GL.glGetString(GL.GL_RENDERER)).decode()

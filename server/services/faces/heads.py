"""Heads to look at before a study has them: the presets' portraits, and any document's, drawn while it is made.

A preview is for the one who moves the sliders: a newer one of the same person takes the place of what is not fitted
yet. A neutral face needs no fitted shapes and comes in a second; one that moves takes as long as a study's head does,
once, and is then remembered.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from emogen_core.errors import IdentityError
from emogen_core.face.identity import parsed_document, signed_document, worn_as
from emogen_core.face.model_identity import MARK, is_of_model
from emogen_core.rendering.worn import WornHead, worn_rig
from emogen_core.rigs.default_look import appearance_of
from emogen_core.rigs.identities import IDENTITIES, preset

from ..errors import NotFoundError
from .expressions import LARGE, NEUTRAL, SMALL, check_emotion, emotion_weights
from .fitting_room import FittingRoom
from .model_desk import ModelDesk
from .refusal import refusal
from .sketch import Sketch

if TYPE_CHECKING:
    from concurrent.futures import Future

    from emogen_core.face.appearance import Appearance
    from emogen_core.face.identity import Identity
    from emogen_core.face.rig import Rig
    from emogen_core.face.space import IdentitySpace

    from .models import FaceModels
    from .portraits import Portraits
    from .wardrobe import Wardrobe

    Described: TypeAlias = Identity | dict[str, Any]
    """What a document describes: an identity, or the signed document of another face model's head."""


@dataclass(frozen=True)
class Heads:
    """The presets, and heads in the making."""

    rig: Rig
    wardrobe: Wardrobe
    portraits: Portraits
    models: FaceModels
    desk: ModelDesk = field(init=False)
    """Heads of other face models in the making."""
    _room: FittingRoom[tuple[WornHead, Rig]] = field(default_factory=FittingRoom)

    def __post_init__(self) -> None:
        object.__setattr__(self, "desk", ModelDesk(self.wardrobe, self.portraits, self.models))

    @property
    def space(self) -> IdentitySpace:
        """The space of heads."""
        return self.wardrobe.space

    @property
    def presets(self) -> tuple[str, ...]:
        """The named presets that the rig wears."""
        return tuple(name for name in IDENTITIES if name in self.rig.neutrals)

    @property
    def named(self) -> tuple[str, ...]:
        """The heads that a study may have by their names: the presets, and those of the other face models."""
        others = (f"{row.name}{MARK}{head}" for row in self.models.all() for head in row.heads)
        return (*self.presets, *others)

    @property
    def emotions(self) -> tuple[str, ...]:
        """Neutral, and the emotions that the rig has prototypes of."""
        return (NEUTRAL, *self.rig.emotion_sets)

    def emotions_of(self, name: str) -> tuple[str, ...]:
        """Return neutral, and the emotions that the rig of a named head has prototypes of; of others, the bundled."""
        return (NEUTRAL, *(self.wardrobe.rig(name) if MARK in name else self.rig).emotion_sets)

    def described(self, document: Any) -> Described:
        """Return what a document of either kind describes.

        Raises:
            InvalidError: it is no head of a face model that is here.
        """
        return self.wardrobe.signed(document) if is_of_model(document) else self.read(document)

    def start(self, name: str) -> Identity:
        """Return a preset to go on from.

        Raises:
            NotFoundError: there is no such preset.
        """
        if name not in self.presets:
            raise NotFoundError("There is no such head.", field="from", got=name)
        return preset(name)

    def read(self, document: object) -> Identity:
        """Return what a document describes; raises `InvalidError`, as a study would."""
        return self.wardrobe.read(document)

    def read_file(self, content: bytes) -> Identity:
        """Return what the document in a file describes; raises as `read`, also when the file is none."""
        return self.read(_parsed(content))

    def signed_file(self, content: bytes) -> dict[str, Any]:
        """Return the document in a file in its canonical form, of whichever face model; raises as `read_file`."""
        return self.wardrobe.signed(_parsed(content))

    def signed(self, identity: Identity) -> dict[str, Any]:
        """Return the canonical document of an identity with its hashes."""
        return signed_document(identity, self.space)

    def appearance(self, identity: Identity) -> Appearance:
        """Return the look of an identity: its own, or that of its sex, age and ancestry."""
        return appearance_of(identity, self.space)

    def portrait(self, name: str, *, large: bool = False, emotion: str = NEUTRAL) -> Future[bytes]:
        """Return the promise of a named head's portrait, neutral or with one of its rig's prototypes.

        Raises:
            NotFoundError: there is no such head.
            InvalidError: there is no such emotion.
        """
        rig = self.wardrobe.rig(name) if MARK in name else self.rig
        if name not in rig.neutrals or (rig is self.rig and name not in self.presets):
            raise NotFoundError("There is no such head.", field="name", got=name)
        check_emotion(rig, emotion)
        weights = emotion_weights(rig, name, emotion)
        return self.portraits.sketched(Sketch(name, weights, LARGE if large else SMALL))

    def preview(self, identity: Identity | Mapping[str, Any], emotion: str, user: str) -> Future[bytes]:
        """Return the promise of a portrait of an identity that no study need have.

        Args:
            identity: the head and its look, or the signed document of another face model's head.
            emotion: neutral, or one of the rig's prototypes at full strength.
            user: whose preview it is; a newer one of the same person goes first.

        Raises:
            InvalidError: there is no such emotion, or the head cannot be fitted.
            ConflictError: the same person has asked for a newer one.
            UnavailableError: other heads are being fitted for longer than anybody should wait.
        """
        if isinstance(identity, Mapping):
            return self.desk.preview(identity, emotion, user)
        check_emotion(self.rig, emotion)
        head, rig = self._worn(identity, user, moving=emotion != NEUTRAL)
        return self.portraits.sketched(Sketch(head.name, emotion_weights(rig, head.name, emotion), LARGE), head)

    def _worn(self, identity: Identity, user: str, *, moving: bool) -> tuple[WornHead, Rig]:
        wanted = self._room.turn(user)
        digest: str = self.signed(identity)["hash"]
        if ready := self.wardrobe.ready(worn_as(digest)):
            return ready

        def made() -> tuple[WornHead, Rig]:
            head = self.wardrobe.try_on(identity, wanted, moving=moving)
            return head, worn_rig(self.rig, head)

        # A head that moves can also stand still.
        return self._room.tried([digest] if moving else [f"{digest} still", digest], made)


def _parsed(content: bytes) -> Any:
    try:
        return parsed_document(content)
    except IdentityError as error:
        raise refusal("file", error) from error

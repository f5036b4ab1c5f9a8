"""Heads of a face model's identity modes in the making: a slider a mode, a portrait that follows, a document.

As `heads` does for the bundled space. A preview wears the very head that a study would have, its mouth put at rest.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from emogen_core.face.model_identity import FORMAT, MARK, VERSION
from emogen_core.face.modes import PLAUSIBLE
from emogen_core.rigs.imported.heads import random_weights

from ..errors import InvalidError, NotFoundError
from .expressions import LARGE, NEUTRAL, check_emotion, emotion_weights
from .fitting_room import FittingRoom
from .head_form import Control
from .sketch import Sketch

if TYPE_CHECKING:
    from collections.abc import Mapping
    from concurrent.futures import Future

    from emogen_core.face.modes import ModeSpace
    from emogen_core.face.rig import Rig
    from emogen_core.rendering.worn import WornHead

    from .models import FaceModels
    from .portraits import Portraits
    from .wardrobe import Wardrobe

PREFIX = "mode."
"""Before the name of a mode among the fields of the form."""
GROUP = 10
"""Sliders that stand together."""


@dataclass(frozen=True)
class ModelDesk:
    """What the editor of such heads needs."""

    wardrobe: Wardrobe
    portraits: Portraits
    models: FaceModels
    _room: FittingRoom[tuple[WornHead, Rig]] = field(default_factory=FittingRoom)

    def emotions(self, model: str) -> tuple[str, ...]:
        """Return neutral, and the emotions that a face model has prototypes of; raises `NotFoundError` as `start`."""
        self._space(model)
        return (NEUTRAL, *self._rig(model).emotion_sets)

    def start(self, model: str, seed: int | None = None) -> dict[str, Any]:
        """Return the signed document to go on from: all modes at 0, or at random for a seed.

        Raises:
            NotFoundError: no such face model, or one without identity modes.
        """
        space = self._space(model)
        weights = {} if seed is None else random_weights(space.modes, np.random.default_rng(seed))
        name = "custom" if seed is None else f"Random {seed}"
        return self._signed(model, name, weights)

    def document(self, model: str, form: Mapping[str, str]) -> dict[str, Any]:
        """Return the signed document that a form stands for.

        Raises:
            NotFoundError: as `start`.
            InvalidError: a field is no number, or none that a mode may have.
        """
        typed = {name: form[f"{PREFIX}{name}"] for name in self._space(model).modes if form.get(f"{PREFIX}{name}")}
        weights = {name: _number(name, text) for name, text in typed.items()}
        return self._signed(model, form.get("name", "").strip() or "custom", weights)

    def controls(self, model: str, document: Mapping[str, Any]) -> dict[str, list[Control]]:
        """Return the sliders of a face model in groups, set to a document."""
        names, found = list(self._space(model).modes), dict[str, list[Control]]()
        for first in range(0, len(names), GROUP):
            some = names[first : first + GROUP]
            found[f"{some[0]} to {some[-1]}"] = [
                Control(f"{PREFIX}{name}", name, "", f"{document['modes'].get(name, 0):g}", -PLAUSIBLE, PLAUSIBLE)
                for name in some
            ]
        return found

    def preview(self, document: Mapping[str, Any], emotion: str, user: str) -> Future[bytes]:
        """Return the promise of a portrait of a signed document's head.

        Args:
            document: of the head.
            emotion: neutral, or one of its rig's prototypes at full strength.
            user: whose preview it is; a newer one of the same person goes first.

        Raises:
            InvalidError: there is no such emotion, or the head cannot be made.
            ConflictError: the same person has asked for a newer one.
            UnavailableError: other heads are being made for longer than anybody should wait.
        """
        check_emotion(self._rig(document["model"]), emotion)
        head, rig = self._worn(document, user)
        return self.portraits.sketched(Sketch(head.name, emotion_weights(rig, head.name, emotion), LARGE), head)

    def _worn(self, document: Mapping[str, Any], user: str) -> tuple[WornHead, Rig]:
        wanted = self._room.turn(user)
        key = f"{document['model']} {document['hash']}"
        return self._room.tried([key], lambda: self.wardrobe.anew(document, wanted))

    def _signed(self, model: str, name: str, weights: Mapping[str, float]) -> dict[str, Any]:
        document = {"format": FORMAT, "version": VERSION, "name": name, "model": model, "modes": dict(weights)}
        return self.wardrobe.signed(document)

    def _rig(self, model: str) -> Rig:
        return self.wardrobe.rig(f"{model}{MARK}")

    def _space(self, model: str) -> ModeSpace:
        known = self.models.of(f"{model}{MARK}")
        if known is None or known.modes is None:
            raise NotFoundError("This face model has no identity modes to make heads of.", field="model", got=model)
        return known.modes


def _number(name: str, text: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        told = f"The head cannot be used: {name}: expected a number, got {text!r}."
        raise InvalidError(told, field=name, expected="a number", got=text) from error

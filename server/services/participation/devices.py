"""What a participant takes part on: what the page measured, whether the study admits it, how large a face has to be."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..config.parts import LEAST_HEIGHT, LEAST_WIDTH
from ..errors import DeviceError, InvalidError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..config import Devices

PHONE_WIDTH = 640
"""Widest window of a phone, in CSS pixels."""
NAMES = ("viewport", "screen", "pixel_ratio", "touch")
"""Fields of a form that say what was measured."""


@dataclass(frozen=True, slots=True)
class Device:
    """What a page measured: its window in CSS pixels, device pixels a CSS pixel, whether fingers are the pointer.

    `screen` is what the window can be made as large as. A page that is zoomed has a small window on a large screen.
    """

    width: int
    height: int
    pixel_ratio: float
    touch: bool
    screen: tuple[int, int] = (0, 0)

    @property
    def kind(self) -> str:
        """What the study calls it: phone, tablet or computer."""
        if self.width <= PHONE_WIDTH:
            return "phone" if self.touch else "narrow window"
        return "tablet" if self.touch else "computer"

    @property
    def room(self) -> tuple[int, int]:
        """Width and height that the window has, or could have."""
        return max(self.width, self.screen[0]), max(self.height, self.screen[1])

    @property
    def handheld(self) -> bool:
        """Whether this is a phone, or a screen as narrow as one; not a computer's window that is narrow or zoomed."""
        return self.width <= PHONE_WIDTH and (self.touch or self.room[0] <= PHONE_WIDTH)

    def plain(self) -> dict[str, Any]:
        """Return what is stored with a participation."""
        return {
            "viewport": [self.width, self.height],
            "pixel_ratio": self.pixel_ratio,
            "touch": self.touch,
            "kind": self.kind,
        }


def device_of(given: Mapping[str, str]) -> Device | None:
    """Return what the fields of a form say; None where nothing was measured, as without script.

    Raises:
        InvalidError: a field is not what a page would measure.
    """
    if not given.get("viewport"):
        return None
    width, height = _sides(given, "viewport")
    screen = _sides(given, "screen") if given.get("screen") else (0, 0)
    return Device(width, height, _ratio(given), given.get("touch") == "true", screen)


def _sides(given: Mapping[str, str], name: str) -> tuple[int, int]:
    try:
        width, height = (int(side) for side in given[name].split("x"))
    except ValueError:
        width, height = 0, 0
    if not (0 < width <= 100_000 and 0 < height <= 100_000):
        raise _unreadable(name, "width x height in pixels, such as 1280x800", given[name])
    return width, height


def _ratio(given: Mapping[str, str]) -> float:
    said = given.get("pixel_ratio", "1")
    try:
        ratio = float(said)
    except ValueError:
        ratio = 0.0
    if not 0 < ratio <= 20:
        raise _unreadable("pixel_ratio", "a number up to 20", said)
    return round(ratio, 3)


def _unreadable(name: str, expected: str, got: str) -> InvalidError:
    message = "The size of the window could not be read. Load the page again."
    return InvalidError(message, field=name, expected=expected, got=got)


def check_device(devices: Devices, device: Device | None) -> None:
    """Refuse a device that the study does not admit; what was not measured passes.

    Raises:
        DeviceError: says what is needed.
    """
    if device is None:
        return
    if not devices.phones and device.handheld:
        raise DeviceError("phone", f"a screen wider than {PHONE_WIDTH} pixels", f"{device.room[0]} pixels")
    asked = ((devices.least_width, LEAST_WIDTH), (devices.least_height, LEAST_HEIGHT))
    if any(side < least and least > always for side, (least, always) in zip(device.room, asked, strict=True)):
        wanted = f"{devices.least_width} x {devices.least_height} pixels"
        raise DeviceError("small", wanted, f"{device.room[0]} x {device.room[1]}")


def tile_height(degrees: float, px_per_mm: float, distance_mm: float) -> float:
    """Return the height of a picture, in CSS pixels, that spans a visual angle at a distance."""
    return round(2 * distance_mm * math.tan(math.radians(degrees) / 2) * px_per_mm, 1)

"""From an `Appearance` to what a head wears: textures of skin, eyes and lashes, and the thickness of the hair."""

from emogen_core.rendering.composer.compose import Composer

__all__ = ["Composer"]

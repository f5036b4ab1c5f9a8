"""The files of a packing: a page to print, a card for each expression, weights as a table, everything as JSON."""

from __future__ import annotations

import csv
import io
import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image

from ..reporting.files import replace
from ..reporting.page import template
from ..reporting.pictures import inline
from .cards import png

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from .cards import Card
    from .making import Made

PAGE = "sheet.html"
WEIGHTS = "weights.csv"
DOCUMENT = "packing.json"
_CARD = re.compile(r"expression-\d+\.png")
# Of a picture on the page, pixels: 28 mm at 300 dots an inch.
_WIDTH = 330


def write(folder: Path, made: Made, cards: Sequence[Card], document: Mapping[str, Any], proof: str) -> None:
    """Write a packing into a folder; an earlier one of the folder goes, with the cards that this one does not have.

    Args:
        folder: where it goes; made if need be.
        made: the packing.
        cards: those of the packing, with pictures or without.
        document: what the JSON file holds.
        proof: how good the number of expressions is.

    Raises:
        OSError: the files cannot be written; an earlier packing is as it was.
    """
    files: dict[str, str | bytes] = {f"{card.name}.png": png(card, document["head"]) for card in cards if card.views}
    files[WEIGHTS] = table(made)
    files[DOCUMENT] = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    files[PAGE] = page(cards, document, proof)
    earlier = [path.name for path in folder.iterdir() if _CARD.fullmatch(path.name)] if folder.is_dir() else []
    replace(folder, files, set(earlier) - set(files))


def table(made: Made) -> str:
    """Return the weights as CSV: an expression a row, a core shape a column."""
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(["expression", *made.shapes])
    for card, row in zip(made.cards, made.weights, strict=True):
        writer.writerow([card.name, *(f"{value:g}" for value in row)])
    return text.getvalue()


def page(cards: Sequence[Card], document: Mapping[str, Any], proof: str) -> str:
    """Return all cards as HTML for A4 paper, which fetches nothing; ``document`` says where they come from."""
    pictures = [
        [_inline(pixels) for pixels in (card.views.front, card.views.turned, card.views.moves)] if card.views else []
        for card in cards
    ]
    return template("packing/sheet.html").render(
        cards=list(zip(cards, pictures, strict=True)), facts=document, proof=proof,
        held=any(movement.held for card in cards for movement in card.movements),
    )  # fmt: skip


def _inline(pixels: NDArray[np.uint8]) -> str:
    height = round(_WIDTH * pixels.shape[0] / pixels.shape[1])
    return inline(Image.fromarray(pixels).resize((_WIDTH, height), Image.Resampling.LANCZOS))

"""What a drawing has: its words, and where its marks lie."""

from __future__ import annotations

import re
from xml.etree import ElementTree

SVG = "{http://www.w3.org/2000/svg}"


class Drawing:
    """A chart, read back."""

    def __init__(self, svg):
        self.tree = ElementTree.fromstring(svg.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1))
        self.width, self.height = float(self.tree.attrib["width"]), float(self.tree.attrib["height"])

    @property
    def words(self):
        """All that is written, from top to bottom as it stands in the markup."""
        return [node.text for node in self.tree.iter(f"{SVG}text")]

    def of(self, class_):
        """Return the paths of a class."""
        return [node.attrib["d"] for node in self.tree.iter(f"{SVG}path") if node.attrib.get("class") == class_]

    def corners(self, class_):
        """Return the (x, y) of the corners of the only line or area of a class."""
        (path,) = self.of(class_)
        numbers = list(map(float, re.findall(r"-?[\d.]+", path)))
        return list(zip(numbers[::2], numbers[1::2], strict=True))

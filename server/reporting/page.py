"""A page that fetches nothing: its template, and the styles of the admin pages with their font inside."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape

from ..assets import asset

if TYPE_CHECKING:
    from jinja2 import Template

STYLES = ("tokens", "page", "table", "chart")
"""Of the admin pages, so that a report looks as they do."""
FONT = "/static/fonts/inter-latin.woff2"
"""What those styles fetch; the page has it in itself."""


def template(name: str) -> Template:
    """Return a template of a report, which finds what it calls `style` there already."""
    environment = Environment(
        loader=FileSystemLoader(asset("templates")), autoescape=select_autoescape(["html"]), undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    return environment.get_template(name, globals={"style": _style()})


def _style() -> str:
    static = asset("static")
    font = base64.b64encode((static / FONT.removeprefix("/static/")).read_bytes()).decode()
    style = "\n".join((static / "admin" / f"{name}.css").read_text(encoding="utf-8") for name in STYLES)
    return style.replace(FONT, f"data:font/woff2;base64,{font}")

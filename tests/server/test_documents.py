"""The documents are contracts: what they do not say does not exist, and what they say is so."""

import re
from pathlib import Path

from server.services.reports.tables.columns import TABLES
from server.settings import Settings
from tests.server.routes import all_routes

DOCS = Path(__file__).parents[2] / "docs"


def test_every_setting_is_documented_with_its_default():
    text = (DOCS / "settings.md").read_text()
    sections = dict(re.findall(r"^## (EMOGEN_\w+)\n\n(.*)$", text, re.MULTILINE))
    for name, field in Settings.model_fields.items():
        told = sections.pop(f"EMOGEN_{name.upper()}")
        assert field.description in told
        default = str(field.default).lower() if isinstance(field.default, bool) else str(field.default)
        assert f"Default: `{default or '(empty)'}`" in told
    assert list(sections) == ["EMOGEN_TOKEN"]


def test_columns_are_declared_completely_and_once():
    for table in TABLES.values():
        names = [column.name for column in table.columns]
        assert len(set(names)) == len(names)
        assert {*table.key} <= {*names}
        assert all(column.help.endswith(".") and column.type for column in table.columns)


def test_every_route_of_the_participant_is_documented():
    text = (DOCS / "participant-interface.md").read_text()
    paths = {path for _, path in all_routes() if path.startswith(("/s/", "/p/", "/portraits/"))}
    assert len(paths) >= 8
    assert [path for path in paths if path not in text] == []


def test_every_route_of_the_analyst_is_documented():
    text = (DOCS / "export.md").read_text()
    assert [path for _, path in all_routes() if path.startswith("/api/") and path not in text] == []


def test_every_card_of_the_monitor_is_explained():
    text = (DOCS / "monitor.md").read_text().lower()
    pieces = Path(DOCS).parent / "templates" / "admin" / "study" / "monitor"
    figures = re.findall(r"<dt>(.*?)</dt>", (pieces / "figures.html").read_text())
    charts = (
        "Arrivals and completions",
        "Still taking part",
        "Wait until all ten faces are shown",
        "Time a generation",
    )
    assert len(figures) == 5
    assert [name for name in (*figures, *charts, "Places", "Simulated participants") if name.lower() not in text] == []

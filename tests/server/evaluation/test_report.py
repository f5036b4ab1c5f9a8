"""The page: every number and every sentence is on it, it fetches nothing, and it is built for everybody."""

import re
from collections import Counter
from itertools import pairwise

import pytest

from server.cli.chromium import chromium
from server.evaluation.numbers import cells
from server.evaluation.report import page
from tests.browser import checks
from tests.server.evaluation.tables import FACTS, Seen, every, noise, settings, studio, threshold


@pytest.fixture(scope="module")
def written():
    return page(every(), FACTS, studio())


@pytest.fixture(scope="module")
def seen(written):
    return Seen(written)


def test_every_number_of_every_row_is_on_the_page(seen):
    expected = [
        f"{ours} paper {paper}" if paper else ours
        for table in every()
        for row in table.rows
        for ours, paper in cells(table, row)
    ]
    assert seen.texts("td") == expected
    assert "1,234.568" in expected and "– paper 0.065" in expected
    rows = [one["text"] for one in seen.all("th") if one["attributes"]["scope"] == "row"]
    assert rows == [row.label for table in every() for row in table.rows]


def test_every_sentence_is_on_the_page(seen):
    text = " ".join(seen.all("main")[0]["text"].split())
    for table in every():
        assert text.count(table.verdict) >= 2, "in the summary and with the table"
        for sentence in (table.title, table.source, *table.notes, *(column.help for column in table.columns)):
            assert sentence in text
        for finding in table.findings:
            assert f"The paper: {finding.says}" in text
            assert f"Here: {finding.here}" in text
    assert [text for text in seen.texts("span", "pill") if "hold" in text] == ["✓holds", "✗does not hold", "✓holds"]


def test_the_summary_counts_and_leads_to_every_table(seen):
    assert "Of 4 tables: 1 agrees with the paper, 1 agrees in trend, 2 are not in the paper." in seen.texts("p")
    links = [one["attributes"]["href"] for one in seen.all("a")]
    assert links == ["#main", *(f"#{table.name}" for table in every())]
    ids = Counter(one["attributes"]["id"] for one in seen.elements if "id" in one["attributes"])
    assert set(ids.values()) == {1}
    assert {link[1:] for link in links} <= set(ids)


def test_what_to_cite_is_one_paragraph(seen):
    (cited,) = seen.texts("p", "citation")
    for part in (FACTS.command, FACTS.version, FACTS.rig_hash, FACTS.identity, f"seed {FACTS.seed}"):
        assert part in cited
    noise_to_cite = f" {threshold().verdict} {threshold().notes[0]}"
    assert cited.endswith(noise_to_cite)
    (without,) = Seen(page([noise()], FACTS, None)).texts("p", "citation")
    assert without == cited.removesuffix(noise_to_cite)


def test_how_many_searches_is_said_with_its_exceptions(seen):
    assert "1,200 simulated searches for every number, unless a note says otherwise." in seen.texts("p", "lead")[0]


def test_the_page_fetches_nothing(written, seen):
    addresses = [
        one["attributes"][name] for one in seen.elements for name in ("src", "href") if name in one["attributes"]
    ]
    addresses += re.findall(r"url\(\"?([^)\"]*)", written)
    assert [one for one in addresses if not one.startswith(("#", "data:"))] == []
    assert "http" not in re.sub(r"data:[^\"]+", "", written)
    assert "@import" not in written
    assert not {"script", "link", "iframe", "object"} & {one["tag"] for one in seen.elements}


def test_tables_and_figures_are_named(seen):
    tables = len(every())
    assert len(seen.all("caption")) == len(seen.all("table")) == tables
    assert [one["text"] for one in seen.all("th") if one["attributes"]["scope"] == "col"].count("Case") == tables
    assert all(one["text"].strip() for one in seen.all("th"))
    regions = [one["attributes"] for one in seen.all("div", "scroll")]
    assert all(one["tabindex"] == "0" and one["role"] == "region" and one["aria-label"] for one in regions)
    assert len({one["aria-label"] for one in regions}) == len(regions) == tables + 1
    levels = [int(one["tag"][1]) for one in seen.elements if re.fullmatch(r"h\d", one["tag"])]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))


def test_every_figure_is_there(seen):
    charts = [one for one in seen.all("svg", "chart") if one["attributes"].get("role") == "img"]
    assert len(charts) == 2 + 2 + 2 + 1, "distributions, curves, maps, and one comparison"
    names = [one["attributes"]["alt"] for one in seen.all("img")]
    assert names == [
        f"{label}: {what}"
        for label in ("target 1", "mean <happy>")
        for what in (
            "the face that was meant",
            "the mean of all finished faces",
            "how far apart the two are, as colour",
        )
    ]
    shown = [text.split(" (")[0] for text in seen.texts("span")]
    assert [text for text in shown if text in {"meant", "found on average", "apart"}] == [
        "meant", "found on average", "apart",
    ] * 2  # fmt: skip


def test_without_a_studio_the_page_says_so():
    assert "could not draw faces" in page([noise()], FACTS, None)
    assert "could not draw faces" not in page([settings()], FACTS, None)


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everybody_can_read_it(written, tmp_path, scheme):
    (tmp_path / "report.html").write_text(written, encoding="utf-8")
    with chromium() as browser:
        shown = browser.new_page(viewport={"width": 1280, "height": 800}, color_scheme=scheme)
        asked = []
        shown.on("request", lambda request: asked.append(request.url))
        shown.goto((tmp_path / "report.html").as_uri())
        checks.accessible(shown)
        checks.built(shown, direction="ltr")
        checks.focus_is_seen(shown)
        for width in (1280, 400, 320):
            checks.resized(shown, (width, 800))
            assert (width, shown.evaluate(checks.SIDEWAYS)) == (width, 0)
        assert shown.locator(".sideways").first.is_visible(), "where columns are cut off, it is said"
        assert [one for one in asked if not one.startswith(("file:", "data:"))] == []
        background = shown.evaluate("getComputedStyle(document.body).backgroundColor")
        shown.emulate_media(media="print")
        paper = shown.evaluate("getComputedStyle(document.body).backgroundColor")
        assert paper == "rgb(255, 255, 255)"
        assert (background == "rgb(18, 22, 24)") == (scheme == "dark")

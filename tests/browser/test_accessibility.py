"""States beside those that test_languages walks through, and what a page without sight or colour must still say."""

from __future__ import annotations

import re

import pytest

from tests.browser import checks
from tests.browser.player import Player

pytestmark = pytest.mark.browser


def must_be_accessible(page):
    checks.accessible(page)
    checks.built(page)


def test_paper_pages(stage, player):
    page = player.page
    page.goto(stage.link("pictures"))
    must_be_accessible(page)
    player.arrive(stage.link("pictures"))
    must_be_accessible(page)
    page.get_by_role("button", name="I agree, start").click()
    assert page.title().startswith("Error: ")
    assert page.evaluate("document.activeElement.id") == "summary"
    must_be_accessible(page)
    page.get_by_role("link", name="Say whether you have read this page").click()
    assert page.evaluate("document.activeElement.id") == "read"
    player.agree()
    must_be_accessible(page)
    page.get_by_role("link", name="Stop taking part").click()
    must_be_accessible(page)
    page.get_by_role("button", name="Stop and keep").click()
    page.get_by_role("heading", name="You have stopped taking part").wait_for()
    must_be_accessible(page)


def test_errors(stage, player):
    for address in (f"{stage.address}/s/nothing", stage.link("closed"), f"{stage.address}/p/nobody"):
        player.page.goto(address)
        must_be_accessible(player.page)


@pytest.mark.parametrize("study", ["small", "dark"])
def test_evolve_page_in_every_state(stage, player, study):
    page = player.begin(stage.link(study)).page
    must_be_accessible(page)
    player.choose(1, 3, 5, best=5)
    must_be_accessible(page)
    player.tile(2).hover()
    page.keyboard.press("ArrowRight")
    must_be_accessible(page)
    for opener in (".wide-link >> nth=0", ".wide-link >> nth=1"):
        page.locator(opener).click()
        must_be_accessible(page)
        page.keyboard.press("Escape")
    page.locator("#select-3").focus()
    page.keyboard.press("z")
    page.wait_for_selector("#enlarged[open]")
    must_be_accessible(page)
    page.keyboard.press("Escape")
    player.choose(1, 3, 5).next()
    must_be_accessible(page)


def test_panels_on_a_phone(stage, phone):
    page = phone.begin(stage.link("small")).page
    must_be_accessible(page)
    page.locator(".menu summary").tap()
    must_be_accessible(page)
    page.locator(".question").tap()
    phone.choose(1)
    page.context.set_offline(True)
    phone.next()
    page.wait_for_selector("#panel.offline:not([hidden])")
    page.context.set_offline(False)
    must_be_accessible(page)


def test_rating_and_completion(stage, player):
    page = player.begin(stage.link("small")).page
    for label in ("First faces", "Generation 1 of", "Generation 2 of"):
        player.wait_generation(label)
        player.choose(2).next()
    page.wait_for_selector(".rating")
    page.wait_for_load_state()
    must_be_accessible(page)
    page.get_by_role("button", name="Next").click()
    assert page.locator(".summary a").all_inner_texts() == [
        "Say how strong the anger is",
        "Say how close it is to the anger you had in mind",
    ]
    must_be_accessible(page)
    player.rate(3, 4)
    page.wait_for_selector(".code")
    must_be_accessible(page)
    page.emulate_media(media="print")
    assert page.locator(".code.main code").is_visible()
    assert page.locator(".copy").first.is_hidden()


def test_names_say_where_and_never_what(stage, player):
    page = player.begin(stage.link("small")).page
    assert page.get_by_role("checkbox", name="Face 4 of 10").count() == 1
    assert page.get_by_role("group", name="Which faces look most like").count() == 1
    player.choose(3)
    assert page.get_by_role("radio", name=re.compile("Best match.*face 4")).is_checked()
    assert page.get_by_role("button", name="Enlarge face 4").count() == 1
    assert page.locator(".tile img").evaluate_all("images => images.map(image => image.alt)") == [""] * 10


def test_forced_colours_and_reduced_motion(stage, browser):

    context = browser.new_context(forced_colors="active", reduced_motion="reduce")
    player = Player(context.new_page())
    page = player.begin(stage.link("small")).page
    player.choose(1)
    ring = page.locator(".tile .ring").nth(1)
    assert ring.evaluate("node => getComputedStyle(node).borderTopWidth") == "7px"
    assert ring.evaluate("node => getComputedStyle(node).transitionDuration") == "0s"
    context.close()


def test_devices_dark_mode_changes_nothing(stage, browser):
    context = browser.new_context(color_scheme="dark")
    page = context.new_page()
    page.goto(stage.link("small"))
    background = page.evaluate("getComputedStyle(document.documentElement).backgroundColor")
    assert background == "rgb(184, 184, 184)"
    context.close()

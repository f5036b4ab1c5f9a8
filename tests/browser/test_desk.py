"""Every admin page: accessible, narrow enough for a phone, nothing from elsewhere, usable without script."""

from __future__ import annotations

import pytest

from .desk import ACCOUNT
from .stage import running
from .test_accessibility import must_be_accessible

PAGES = ("studies", "heads", "models", "tokens", "team", "account", "server", "trail")
TABS = ("monitor", "recruit", "participants", "results", "data")


@pytest.fixture(scope="module")
def desk(tmp_path_factory, browser):
    """Return a server, and the sign-in of its owner."""
    with running(tmp_path_factory.mktemp("desk"), {"small": {}}) as stage:
        context = browser.new_context()
        page = context.new_page()
        page.goto(stage.setup)
        must_be_accessible(page)
        for label, value in ACCOUNT.items():
            page.get_by_label(label).fill(value)
        page.get_by_role("button", name="Create the account").click()
        page.wait_for_url("**/admin/studies")
        yield stage, context.storage_state()
        context.close()


def addresses(stage):
    study = stage.one("SELECT id FROM studies")
    pages = (*TABS, "versions", "status?to=closed", "delete")
    return [*(f"/admin/{name}" for name in PAGES), *(f"/admin/studies/{study}/{page}" for page in pages)]


@pytest.mark.parametrize("script", [True, False], ids=["script", "no-script"])
def test_every_page_is_accessible_and_fits_a_phone(desk, browser, script):
    stage, signed_in = desk
    context = browser.new_context(
        storage_state=signed_in, viewport={"width": 360, "height": 740}, java_script_enabled=script
    )
    page = context.new_page()
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    for address in addresses(stage):
        assert page.goto(stage.address + address).status == 200, address
        assert page.locator("h1").count() == 1, address
        if script:
            must_be_accessible(page)
            wide = page.evaluate("document.documentElement.scrollWidth")
            assert wide <= 360, f"{address} is {wide} px wide"
    assert {url.split("/")[2] for url in asked if not url.startswith(("data:", "blob:"))} == {
        stage.address.split("/")[2]
    }
    context.close()


def test_somebody_invited_makes_an_account_and_looks(desk, browser):
    stage, signed_in = desk
    context = browser.new_context(storage_state=signed_in)
    page = context.new_page()
    page.goto(f"{stage.address}/admin/team")
    page.get_by_label("Email address").fill("t.okafor@westbrook.example")
    page.get_by_label("Analyst").check()
    page.get_by_role("button", name="Make the invitation").click()
    link = page.locator("#link").inner_text()
    must_be_accessible(page)
    other = browser.new_page()
    other.goto(link)
    must_be_accessible(other)
    other.get_by_label("Your name").fill("T. Okafor")
    other.get_by_label("Password").fill(ACCOUNT["Password"])
    other.get_by_role("button", name="Create the account").click()
    other.wait_for_url("**/admin/studies")
    must_be_accessible(other)
    assert other.get_by_role("link", name="Team").count() == 0
    other.get_by_role("link", name="Exports").focus()
    other.close()
    context.close()


def test_whoever_is_not_let_in_reads_an_accessible_page(desk, browser):
    stage, signed_in = desk
    out, within = browser.new_page(), browser.new_page(storage_state=signed_in)
    for page, path, status in ((out, "login", 200), (out, "invitation?key=none", 404), (within, "studies/none", 404)):
        assert page.goto(f"{stage.address}/admin/{path}").status == status
        must_be_accessible(page)
    out.close()
    within.close()


def test_a_new_study_link_joins_and_its_address_is_copied(desk, browser):
    stage, signed_in = desk
    study = stage.one("SELECT id FROM studies")
    context = browser.new_context(storage_state=signed_in, permissions=["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.goto(f"{stage.address}/admin/studies/{study}/recruit")
    page.get_by_label("Labels, one a line").fill("P 1\nP 2")
    page.get_by_role("button", name="Make links").click()
    page.get_by_role("rowheader", name="P 2").wait_for()
    assert stage.one("SELECT count(*) FROM links WHERE kind = 'personal'") == 2
    page.bring_to_front()  # only a page in focus may copy
    page.get_by_role("button", name="Copy").first.click()
    page.get_by_role("button", name="Copied").wait_for()
    address = page.evaluate("navigator.clipboard.readText()")
    page.goto(address)
    assert page.get_by_role("button").first.is_visible()
    context.close()


def test_the_tab_of_this_page_is_in_view_on_a_phone(desk, browser):
    stage, signed_in = desk
    study = stage.one("SELECT id FROM studies")
    context = browser.new_context(storage_state=signed_in, viewport={"width": 360, "height": 740})
    page = context.new_page()
    for tab in ("data", "design"):
        page.goto(f"{stage.address}/admin/studies/{study}/{tab}")
        box = page.locator(".tabs [aria-current]").bounding_box()
        assert box["x"] >= 0 and box["x"] + box["width"] <= 360, tab
    context.close()


def test_a_study_is_closed_and_deleted_on_purpose(desk, browser):
    stage, signed_in = desk
    context = browser.new_context(storage_state=signed_in)
    page = context.new_page()
    page.goto(f"{stage.address}/admin/studies/new")
    page.get_by_label("Empty study").check()
    page.get_by_role("button", name="Create draft").click()
    page.get_by_role("link", name="Start recruiting").click()
    must_be_accessible(page)
    page.get_by_role("link", name="Change ethics approval").click()
    page.get_by_label("Ethics approval").first.wait_for()  # seen, so the fold that it stands in is open
    page.go_back()
    page.get_by_role("button", name="Start recruiting anyway").click()
    page.get_by_role("link", name="Close study").click()
    page.get_by_role("button", name="Close study").click()
    page.goto(f"{stage.address}/admin/studies")
    page.locator("summary", has_text="More for New study").click()
    page.get_by_role("link", name="Delete").click()
    must_be_accessible(page)
    page.get_by_label("Title of the study").fill("New study")
    page.get_by_role("button", name="Delete the study").click()
    page.wait_for_url("**/admin/studies")
    assert page.get_by_role("link", name="New study", exact=True).count() == 1, "the button that makes one"
    context.close()

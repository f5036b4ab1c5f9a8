"""How people arrive: too late, on the wrong device, on another browser, in another language, or to look only."""

from __future__ import annotations

import pytest

from server.services.opening import open_house
from server.services.studies.life import NewLinks, StudyLife
from server.settings import Settings
from tests.browser.desk import ACCOUNT
from tests.browser.player import Player
from tests.browser.stage import SMALL, participation_of, running

pytestmark = pytest.mark.browser
PROLIFIC = "https://app.prolific.com/submissions/complete?cc={code}"
COMPLETION = {
    "codes": {"full": "FULL1", "screened_out": "YOUNG1", "complete": "DONE1"},
    "redirects": {"full": PROLIFIC, "screened_out": PROLIFIC},
}
YOUNG = {
    "kind": "questionnaire", "name": "about", "items": ({"name": "age", "kind": "number", "text": "How old are you?"},),
    "screen_out": ({"item": "age", "below": 18},),
}  # fmt: skip
SHORT = {**SMALL, "practice": None, "generations": 1, "ratings": ()}
STUDIES = {
    "full": {**SHORT, "quota": 1, "completion": COMPLETION},
    "closed": SHORT,
    "young": {**SHORT, "blocks": (YOUNG, {"kind": "evolve", "name": "first"}), "completion": COMPLETION},
    "desk": {**SHORT, "devices": {"phones": False}},
    "personal": {**SHORT, "completion": COMPLETION},
    "german": {
        **SHORT,
        "translations": {
            "de": {"title": "Gesichter", "emotions": {"angry": {"adjective": "wütend", "noun": "Wut"}}},
        },
    },
    "looked_at": SHORT,
}  # fmt: skip
TABLES = (
    "participations", "trials", "generations", "faces", "choices", "events", "ratings", "stimuli", "responses",
    "answers", "links", "studies", "study_versions", "rigs", "server_keys",
)  # fmt: skip


@pytest.fixture(scope="module")
def town(tmp_path_factory):
    folder = tmp_path_factory.mktemp("arrivals")
    with running(folder, STUDIES) as stage:
        house = open_house(Settings(data_dir=folder), drawing=False)
        study = next(one.id for one in house.studies.all() if stage.links["personal"] in one.links)
        stage.links["ada"] = StudyLife(house.journal, house.studies).add_links(
            study, NewLinks("personal", ["Ada"]), None
        )[0]  # fmt: skip
        house.close()
        yield stage


@pytest.fixture
def people(browser):
    """Return somebody new, on a browser of their own."""
    contexts, players = [], []

    def come(**options):
        contexts.append(browser.new_context(**{"viewport": {"width": 1280, "height": 800}, **options}))
        players.append(Player(contexts[-1].new_page()))
        return players[-1]

    yield come
    for context in contexts:
        context.close()
    assert [player.problems for player in players] == [[] for _ in players]


def people_in(stage, study):
    query = "SELECT count(*) FROM participations p JOIN links l ON l.study_id = p.study_id WHERE l.id = ?"
    return stage.one(query, stage.links[study])


def agree(player, button="I agree, start"):
    for label in player.page.locator(".statement label").all():
        label.click()
    player.page.get_by_role("button", name=button).click()
    player.page.locator("form[data-answer=instructions] button").click()
    return player


def finish(player):
    player.faces().choose(0).next().wait_generation("Generation 1").choose(2).next()
    player.page.get_by_role("heading", name="You have finished").wait_for()


def test_a_full_study(town, people):
    late = people().page
    late.goto(town.link("full"))
    people().arrive(town.link("full"))
    late.locator("main form button").click()
    late.get_by_role("heading", name="This study has enough participants now").wait_for()
    assert late.locator(".code.main code").inner_text() == "FULL1"
    back = late.get_by_role("link", name="Return to Prolific")
    assert back.get_attribute("href") == PROLIFIC.format(code="FULL1")
    assert people_in(town, "full") == 1


def test_a_closed_study(town, people):
    page = people().page
    page.goto(town.link("closed"))
    page.get_by_role("heading", name="This study is closed").wait_for()
    assert page.locator("form").count() == 0


def test_screened_out_on_any_browser_for_ever(town, people):
    player = agree(people().arrive(town.link("young", "?PROLIFIC_PID=kid")))
    player.page.get_by_label("How old are you?").fill("12")
    player.page.get_by_role("button", name="Next").click()
    for page in (player.page, people().page):
        if page is not player.page:
            page.goto(town.link("young", "?PROLIFIC_PID=kid"))
        page.get_by_role("heading", name="This study looks for other participants").wait_for()
        assert page.locator(".code.main code").inner_text() == "YOUNG1"
    who = participation_of(town, player.page)
    assert town.one("SELECT outcome FROM participations WHERE id = ?", who) == "screened_out"


def test_not_on_a_phone_but_by_the_same_link_on_a_computer(town, people):
    phone = people(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True).page
    phone.goto(town.link("desk", "?PROLIFIC_PID=ada"))
    assert "needs a computer or a tablet" in phone.locator("#too-little").inner_text()
    phone.locator("main form button").click()
    phone.get_by_role("heading", name="Please use a computer or a tablet for this study").wait_for()
    assert people_in(town, "desk") == 0
    desk = people().arrive(town.link("desk", "?PROLIFIC_PID=ada"))
    who = participation_of(town, desk.page)
    assert '"kind": "computer"' in town.one("SELECT device FROM participations WHERE id = ?", who)
    assert people_in(town, "desk") == 1


def test_a_personal_link_goes_on_in_a_second_browser(town, people):
    first = agree(people().arrive(town.link("ada"))).faces()
    first.choose(0).next().wait_generation("Generation 1")
    second = people()
    second.page.goto(town.link("ada"))
    second.page.get_by_role("link", name="Carry on where you were").click()
    second.wait_generation("Generation 1").choose(1).next()
    second.page.get_by_role("heading", name="You have finished").wait_for()
    third = people().page
    third.goto(town.link("ada"))
    assert "You have already taken part" in third.locator(".lead").inner_text()
    assert third.locator(".code.main code").inner_text() == "DONE1"
    assert people_in(town, "personal") == 1


def test_german_is_chosen(town, people):
    page = people().page
    page.goto(town.link("german"))
    page.locator(".languages a[hreflang=de]").click()
    page.get_by_role("heading", name="Gesichter", exact=True).wait_for()
    page.locator("main form button").click()
    page.wait_for_url("**/p/*")
    for label in page.locator(".statement label").all():
        label.click()
    page.locator("form[data-answer=consent] button[value=true]").click()
    page.locator("form[data-answer=instructions] button").click()
    page.wait_for_selector("#grid.shown")
    assert page.locator("h1 .target").inner_text().lower() == "wut"
    who = participation_of(town, page)
    assert town.rows("SELECT language, trial_order FROM participations WHERE id = ?", who) == [("de", '["angry"]')]


def test_the_browser_s_own_language_is_the_first(town, people):
    page = people(locale="de-DE").page
    page.goto(town.link("german"))
    assert page.locator("h1").inner_text() == "Gesichter"
    assert page.locator("html").get_attribute("lang") == "de"


def test_a_preview_leaves_nothing(town, people):
    owner = people()
    page = owner.page
    page.goto(town.setup)
    for label, value in ACCOUNT.items():
        page.get_by_label(label).fill(value)
    page.get_by_role("button", name="Create the account").click()
    page.wait_for_url("**/admin/studies")
    before = {table: town.rows(f"SELECT * FROM {table}") for table in TABLES}
    study = town.one("SELECT study_id FROM links WHERE id = ?", town.links["looked_at"])
    page.evaluate(
        """study => {
          const form = document.createElement("form");
          const csrf = document.querySelector("input[name=csrf]").cloneNode();
          Object.assign(form, { method: "post", action: `/admin/studies/${study}/preview` }).append(csrf);
          document.body.append(form);
          form.submit();
        }""",
        study,
    )
    page.wait_for_url("**/p/*")
    bar = page.get_by_text("Preview: nothing is kept")
    assert bar.is_visible()
    agree(owner).faces()
    assert bar.is_visible()
    assert page.evaluate("document.documentElement.scrollHeight <= innerHeight"), "ten faces still fit"
    owner.choose(0).next().wait_generation("Generation 1").choose(2).next()
    page.get_by_role("heading", name="You have finished").wait_for()
    assert bar.is_visible()
    page.wait_for_load_state("networkidle")
    assert {table: town.rows(f"SELECT * FROM {table}") for table in TABLES} == before
    page.get_by_role("link", name="Back to the study").click()
    page.wait_for_url(f"**/admin/studies/{study}/monitor")

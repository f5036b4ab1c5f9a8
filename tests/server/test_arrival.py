"""What a link has for whoever opens it, as a browser sees it: every standing, every way back, every language."""

import re
from datetime import timedelta

import pytest

from server.services.studies.life import NewLinks, StudyLife
from server.store import runs
from server.store.runs_tables import Participation
from tests.conftest import small_study
from tests.server.exported import text
from tests.server.walker import Walker

HTML = {"accept": "text/html"}
JSON = {"accept": "application/json"}
PROLIFIC = "https://app.prolific.com/submissions/complete?cc={code}"
SHORT = {"practice": None, "generations": 1, "ratings": ()}
GERMAN = {
    "title": "Kleine Studie",
    "emotions": {"angry": {"adjective": "wütend", "noun": "Wut"}},
    "words": {"Your age?": "Wie alt sind Sie?", "calm": "ruhig", "About you": "Über Sie"},
}
MOOD = {"name": "mood", "kind": "single", "text": "Your age?", "options": ["calm", "tense"]}
ABOUT = {"kind": "questionnaire", "name": "about", "title": "About you", "items": [MOOD]}


@pytest.fixture
def life(house):
    return StudyLife(house.journal, house.studies)


def general_single(life, study):
    return life.add_links(study.id, NewLinks("general_single", ["One each"]), "u")[0]


def expire(house):
    """Let the leases of all places run out."""
    with house.database.write() as tx:
        for one in tx.query(Participation):
            one.lease_until = one.arrived_at - timedelta(seconds=1)


def heading(page):
    return re.search(r"<h1>(.*?)</h1>", page.text)[1]


@pytest.mark.parametrize(("status", "title"), [
    ("draft", "This study has not begun yet"), ("paused", "This study is paused"), ("closed", "This study is closed"),
])  # fmt: skip
def test_a_study_that_takes_nobody_says_why(client, house, life, status, title):
    made = house.studies.create(small_study(), status)
    page = client.get(f"/s/{made.links[0]}", headers=HTML)
    assert (page.status_code, heading(page)) == (409, title)
    assert "<form" not in page.text
    refused = client.post(f"/s/{made.links[0]}", headers=JSON)
    assert (refused.status_code, refused.json()["error"]["code"]) == (409, "closed")
    back = client.post(f"/s/{made.links[0]}?PROLIFIC_PID=a", headers=HTML)
    assert (back.status_code, back.headers["location"]) == (303, f"/s/{made.links[0]}?PROLIFIC_PID=a")


def test_a_closed_link(client, life, study):
    life.close_link(study.id, study.links[0], "u")
    page = client.get(f"/s/{study.links[0]}", headers=HTML)
    assert (page.status_code, heading(page)) == (409, "This link is closed")


def test_a_full_study_says_so_before_consent_with_the_recruiter_s_code(client, house):
    completion = {"codes": {"full": "FULL1"}, "redirects": {"full": f"{PROLIFIC}&pid={{PROLIFIC_PID}}"}}
    made = house.studies.create(small_study(quota=1, completion=completion))
    Walker(client, made.links[0], PROLIFIC_PID="first")
    page = client.get(f"/s/{made.links[0]}?PROLIFIC_PID=a%26b", headers=HTML)
    assert (page.status_code, heading(page)) == (409, "This study has enough participants now")
    assert "FULL1" in page.text
    assert 'href="https://app.prolific.com/submissions/complete?cc=FULL1&amp;pid=a%26b"' in page.text
    assert "Return to Prolific" in page.text
    refused = client.post(f"/s/{made.links[0]}?PROLIFIC_PID=a", headers=JSON)
    assert refused.json()["error"]["code"] == "full"
    assert house.studies.summary(made.id).arrived == 1


def test_a_general_link_for_once_says_that_one_has_taken_part(client, house, life):
    made = house.studies.create(small_study(**SHORT, completion={"codes": {"complete": "DONE7"}}))
    link = general_single(life, made)
    walker = Walker(client, link)
    running = client.get(f"/s/{link}")
    assert f'href="{walker.address}"' in running.text
    assert "Begin anew" not in running.text
    assert Walker(client, link).address == walker.address, "the button of an older page leads to the same place"
    walker.finish()
    back = client.get(f"/s/{link}")
    assert (back.status_code, back.headers["location"]) == (303, f"{walker.address}?again")
    page = client.get(back.headers["location"])
    assert "You have already taken part in this study." in page.text
    assert "DONE7" in page.text
    client.cookies.clear()
    assert Walker(client, link).address != walker.address, "another browser is another person"


def test_a_general_link_for_many_leads_to_the_own_code_when_no_place_is_left(client, house, life):
    completion = {"codes": {"complete": "DONE1", "full": "FULL1"}}
    made = house.studies.create(small_study(quota=1, completion=completion, **SHORT))
    link = f"/s/{made.links[0]}"
    walker = Walker(client, made.links[0])
    walker.start()
    assert walker.finish()["completion"]["outcome"] == "complete"
    assert client.get(link, headers=HTML).headers["location"] == f"{walker.address}?again"
    tried = client.post(link, headers=HTML)
    assert (tried.status_code, tried.headers["location"]) == (303, link)
    life.move(made.id, "closed", "u")
    assert client.get(link, headers=HTML).headers["location"] == f"{walker.address}?again"
    assert "DONE1" in client.get(f"{walker.address}?again").text
    client.cookies.clear()
    assert heading(client.get(link, headers=HTML)) == "This study is closed"


def test_a_general_link_for_many_offers_to_go_on_or_to_begin_anew(client, study):
    link = study.links[0]
    walker = Walker(client, link)
    page = client.get(f"/s/{link}")
    assert f'href="{walker.address}"' in page.text
    assert "Begin anew" in page.text
    place = re.search(r'name="place" value="([^"]+)"', page.text)[1]
    anew = client.post(f"/s/{link}", data={"place": place})
    assert anew.headers["location"] == f"/p/{place}" != walker.address
    client.post(f"/p/{place}/stop", json={})
    assert "Begin anew" not in client.get(f"/s/{link}").text, "whoever comes next begins as if nobody had been here"


@pytest.mark.parametrize("kind", ["personal", "recruiter"])
def test_whoever_is_known_goes_on_and_finds_their_code_on_any_browser(client, house, life, kind):
    made = house.studies.create(small_study(**SHORT))
    link, query = (made.links[0], "?PROLIFIC_PID=ada") if kind == "recruiter" else (
        life.add_links(made.id, NewLinks("personal", ["Ada"]), "u")[0], "",
    )  # fmt: skip
    assert client.get(f"/s/{link}{query}").status_code == 200
    address = client.post(f"/s/{link}{query}", headers=JSON).json()["address"]
    walker = Walker(client, link, **({"PROLIFIC_PID": "ada"} if query else {}))
    assert walker.address == address
    client.cookies.clear()
    page = client.get(f"/s/{link}{query}")
    assert f'href="{address}"' in page.text
    assert "Begin anew" not in page.text
    code = walker.finish()["completion"]["code"]
    client.cookies.clear()
    life.move(made.id, "closed", "u")
    assert code in client.get(f"/s/{link}{query}", follow_redirects=True).text


def test_who_has_begun_goes_on_when_the_study_is_paused_and_the_link_closed(client, house, life, study):
    walker = Walker(client, study.links[0])
    life.move(study.id, "paused", "u")
    life.close_link(study.id, study.links[0], "u")
    page = client.get(f"/s/{study.links[0]}")
    assert page.status_code == 200
    assert f'href="{walker.address}"' in page.text
    assert "Begin anew" not in page.text


def test_declining_leads_back_and_keeps_no_device(client, house):
    completion = {"codes": {"no_consent": "NO1"}, "redirects": {"no_consent": PROLIFIC}}
    made = house.studies.create(small_study(completion=completion))
    client.post(f"/s/{made.links[0]}", data={"viewport": "1280x800", "pixel_ratio": "1", "touch": "false"})
    address = re.search(r'href="(/p/[^"]+)"', client.get(f"/s/{made.links[0]}").text)[1]
    client.post(f"{address}/answers/form", data={"id": "0" * 32, "kind": "consent", "given": "false"})
    page = client.get(address)
    assert heading(page) == "You have chosen not to take part"
    assert "cc=NO1" in page.text
    with house.database.read() as tx:
        assert tx.query(Participation).one().device == {}


@pytest.mark.parametrize(("outcome", "title"), [
    ("screened_out", "This study looks for other participants"), ("failed_checks", "Your participation ends here"),
])  # fmt: skip
def test_early_ends_have_a_page_of_their_own(client, house, outcome, title):
    check = {"kind": "attention", "name": "c", "text": "a", "options": ["b", "a"], "right": "a", "failing": "end"}
    young = {
        **ABOUT,
        "items": [{**MOOD, "kind": "number", "options": []}],
        "screen_out": [{"item": "mood", "below": 18}],
    }
    completion = {"codes": {outcome: "OUT1"}, "redirects": {outcome: PROLIFIC}}
    blocks = (young if outcome == "screened_out" else check, {"kind": "evolve", "name": "first"})
    made = house.studies.create(small_study(blocks=blocks, practice=None, completion=completion))
    walker = Walker(client, made.links[0])
    walker.start()
    assert walker.finish()["completion"]["outcome"] == outcome
    page = client.get(walker.address)
    assert heading(page) == title
    assert "cc=OUT1" in page.text


def test_a_device_that_is_not_admitted_is_told_what_to_use(client, house):
    made = house.studies.create(small_study(devices={"phones": False, "least_width": 800}, texts={"device": "A desk."}))
    link = f"/s/{made.links[0]}"
    entry = client.get(link).text
    assert all(words in entry for words in ("A desk.", "cannot be done on a phone", "800 by 300 pixels"))
    page = client.post(link, data={"viewport": "390x844", "pixel_ratio": "3", "touch": "true"}, headers=HTML)
    assert page.status_code == 422
    assert "Please use a computer or a tablet" in page.text
    assert "The same link works on another device." in page.text
    assert house.studies.summary(made.id).arrived == 0
    small = client.post(link, data={"viewport": "700x600", "pixel_ratio": "1", "touch": "false"}, headers=HTML)
    assert "Please use a larger screen" in small.text
    told = client.post(link, data={"viewport": "700x600"}, headers=JSON).json()["error"]
    assert (told["code"], told["expected"], told["got"]) == ("device", "800 x 300 pixels", "700 x 600")
    assert client.post(link, data={"viewport": "700x600", "screen": "tall"}, headers=JSON).status_code == 422
    wide = client.post(link, data={"viewport": "640x400", "screen": "1280x800", "pixel_ratio": "2"}, headers=HTML)
    assert wide.headers["location"].startswith("/p/")
    assert client.post(link, data={"viewport": "wide"}, headers=JSON).status_code == 422
    client.cookies.clear()
    assert client.post(link, headers=HTML).headers["location"].startswith("/p/"), "without script nothing is measured"


def test_languages_are_offered_as_links_and_kept(client, house):
    made = house.studies.create(small_study(translations={"de": GERMAN}, blocks=(ABOUT,), practice=None))
    link = f"/s/{made.links[0]}"
    page = client.get(f"{link}?PROLIFIC_PID=a").text
    assert "<h1>Small study</h1>" in page
    assert 'href="?PROLIFIC_PID=a&amp;lang=de" hreflang="de"' in page
    assert "<h1>Kleine Studie</h1>" in client.get(f"{link}?lang=de").text
    assert "<h1>Kleine Studie</h1>" in client.get(link, headers={"accept-language": "pt, de-AT;q=0.8, en;q=0.5"}).text
    assert "<h1>Small study</h1>" in client.get(f"{link}?lang=xx", headers={"accept-language": "*;q=2,,x y"}).text
    walker = Walker(client, made.links[0], lang="de")
    assert "<h1>Kleine Studie</h1>" in client.get(walker.address).text
    walker.start()
    page = client.get(walker.address).text
    for words in ("<h1>Über Sie</h1>", "Wie alt sind Sie?", ">ruhig<", 'value="calm"', ">tense<"):
        assert words in page, words
    assert walker.state()["study"]["language"] == "de"
    walker.finish()
    with house.database.read() as tx:
        assert tx.query(Participation).one().language == "de"
        answers = text(house, made.id, "responses")
    assert "calm" in answers
    assert "ruhig" not in answers


def test_emotions_are_asked_for_in_the_language_and_recorded_in_the_study_s_own(client, house):
    emotions = ({"adjective": "angry", "noun": "rage"},)
    made = house.studies.create(small_study(translations={"de": GERMAN}, emotions=emotions, practice=None))
    for language, noun in (("de", "Wut"), ("en", "rage")):
        client.cookies.clear()
        walker = Walker(client, made.links[0], lang=language)
        assert walker.start()["trial"]["emotion"] == "angry"
        assert f'<strong class="target">{noun}</strong>' in client.get(walker.address).text


def test_a_link_may_fix_the_language(client, house, life):
    made = house.studies.create(small_study(translations={"de": GERMAN}))
    (link,) = life.add_links(made.id, NewLinks("general_multiple", ["German"], "de"), "u")
    page = client.get(f"/s/{link}?lang=en", headers={"accept-language": "en"}).text
    assert "<h1>Kleine Studie</h1>" in page
    assert "hreflang" not in page
    assert Walker(client, link, lang="en").state()["study"]["language"] == "de"


def test_consent_shows_the_study_s_own_statements_and_what_is_true(client, house):
    texts = {"consents": ["I am <16>.", "I agree."], "purpose": "To know.\n\nMore.", "minutes": 0}
    made = house.studies.create(small_study(texts=texts, user_agent=True))
    walker = Walker(client, made.links[0])
    page = client.get(walker.address).text
    for words in (
        "I am &lt;16&gt;.",
        "<p>To know.</p><p>More.</p>",
        "version of your browser",
        "identifiers in your link",
    ):
        assert words in page, words
    assert "I am 18 or older" not in page
    assert "minutes" not in page.split("<main")[1].split("</main>")[0]
    form = {"id": "0" * 32, "kind": "consent", "given": "true", "agree": ["own-0"]}
    missing = client.post(f"{walker.address}/answers/form", data=form)
    assert missing.status_code == 422
    assert "Say whether you agree: I agree." in missing.text
    both = client.post(f"{walker.address}/answers/form", data={**form, "agree": ["own-0", "own-1"]})
    assert both.status_code == 303
    assert walker.state()["step"] == "instructions"


def test_instructions_say_what_comes(client, house):
    blocks = ({"kind": "evolve", "name": "one"}, {"kind": "evolve", "name": "two", "retest_of": "one"})
    made = house.studies.create(small_study(blocks=(*blocks, {"kind": "categorise", "name": "c"}), practice=None))
    walker = Walker(client, made.links[0])
    walker.answer("consent", given=True)
    page = client.get(walker.address).text
    for words in ("two generations", "You make two faces one after", "You make two faces a second time", "express"):
        assert words in page, words
    assert "<b>surprise</b>" in page


def test_calibration_without_script_goes_on(client, house):
    made = house.studies.create(small_study(devices={"face_degrees": 6}))
    walker = Walker(client, made.links[0])
    walker.answer("consent", given=True)
    page = client.get(walker.address).text
    assert "How large is your screen?" in page
    form = {"id": "0" * 32, "kind": "calibration", "given": "false"}
    assert client.post(f"{walker.address}/answers/form", data=form).status_code == 303
    assert walker.state()["step"] == "instructions"


def test_a_lease_is_told_and_renewed(client, house, study):
    walker = Walker(client, study.links[0])
    told = client.get(f"{walker.address}/lease").json()
    assert 1790 <= told["seconds"] <= 1800
    assert told["warning"] == 300
    assert re.search(r'data-lease="1[78]\d\d" data-warning="300"', client.get(walker.address).text)
    expire(house)
    assert client.get(f"{walker.address}/lease").json()["seconds"] == 0
    assert client.post(f"{walker.address}/lease").json()["seconds"] >= 1790
    expire(house)
    walker.finish()
    assert client.post(f"{walker.address}/lease").json()["seconds"] == 0
    assert client.post("/p/nobody/lease").status_code == 404
    assert "data-lease" not in client.get(walker.address).text


def test_a_place_that_was_given_away_does_not_stop_who_comes_back(client, house):
    made = house.studies.create(small_study(**SHORT, quota=1))
    first = Walker(client, made.links[0])
    first.start()
    expire(house)
    client.cookies.clear()
    second = Walker(client, made.links[0])
    assert first.finish()["completion"]["outcome"] == second.finish()["completion"]["outcome"] == "complete"


def test_pilots_are_marked_and_count_for_no_real_place(client, house, life):
    made = house.studies.create(small_study(**SHORT, quota=1), "pilot")
    Walker(client, made.links[0]).finish()
    client.cookies.clear()
    assert client.get(f"/s/{made.links[0]}").status_code == 409, "the pilot has a quota of its own"
    life.move(made.id, "recruiting", "u")
    Walker(client, made.links[0]).finish()
    client.cookies.clear()
    assert client.get(f"/s/{made.links[0]}").status_code == 409
    with house.database.read() as tx:
        people = [runs.participation(tx, one) for one in runs.participation_ids(tx, made.id)]
    assert [one.pilot for one in people] == [True, False]
    lines = text(house, made.id, "participations").splitlines()
    assert ['"pilot": true' in line.replace('":true', '": true') for line in lines] == [True, False]


def test_too_many_at_once_wait(client, house):
    object.__setattr__(house.joining, "per_minute", 2)
    made = house.studies.create(small_study(translations={"de": GERMAN}))
    link = f"/s/{made.links[0]}"
    for _ in range(2):
        Walker(client, made.links[0])
        client.cookies.clear()
    refused = client.post(link, headers=JSON)
    assert (refused.status_code, refused.headers["retry-after"]) == (429, "10")
    assert refused.json()["error"]["code"] == "throttled"
    place = re.search(r'name="place" value="([^"]+)"', client.get(link).text)[1]
    page = client.post(f"{link}?lang=de", data={"place": place, "viewport": "1280x800"}, headers=HTML)
    assert (page.status_code, page.headers["retry-after"]) == (429, "10")
    assert 'data-again="10"' in page.text
    assert f'name="place" value="{place}"' in page.text
    assert house.studies.summary(made.id).arrived == 2
    secret = house.tokens.create("sim", ["simulate"])
    assert client.post(link, headers={**JSON, "authorization": f"Bearer {secret}"}).status_code == 201
    object.__setattr__(house.joining, "per_minute", 3)
    again = client.post(link, data={"place": place}, headers=HTML)
    assert again.headers["location"] == f"/p/{place}"


def test_errors_speak_the_browser_s_language_where_it_is_known(client):
    page = client.get("/s/nothing", headers={**HTML, "accept-language": "xx, en;q=0.1"})
    assert (page.status_code, heading(page)) == (404, "This link does not lead to a study")

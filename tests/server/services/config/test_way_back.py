"""Nobody is sent to a host that the server does not list, whatever the address looks like."""

from urllib.parse import parse_qs, urlsplit

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.services.config.way_back import allowed, check_redirects, host_list, way_back
from server.services.errors import InvalidError
from server.services.studies.life import StudyLife
from server.settings import Settings
from tests.conftest import small_study
from tests.server.walker import Walker

HOSTS = ("app.prolific.com", ".sona-systems.com")
PROLIFIC = "https://app.prolific.com/submissions/complete?cc={code}&who={PROLIFIC_PID}"


def study(address, outcome="complete", **changes):
    return small_study(completion={"redirects": {outcome: address}, "codes": {outcome: "C0DE"}}, **changes)


@pytest.mark.parametrize(("address", "good"), [
    ("https://app.prolific.com/x", True), ("https://APP.prolific.com", True), ("https://app.prolific.com:443/x", True),
    ("https://uni.sona-systems.com/x?y=1", True), ("https://sona-systems.com", False),
    ("https://evilsona-systems.com", False), ("https://app.prolific.com.evil.example", False),
    ("https://app.prolific.com@evil.example", False), ("https://evil.example/app.prolific.com", False),
    ("https://evil.example\\@app.prolific.com", False), ("https://evil.example#@app.prolific.com", False),
    ("https:///app.prolific.com", False), ("http://app.prolific.com", False), ("https://app.prolific.com /x", False),
    ("https://{PROLIFIC_PID}.sona-systems.com", False), ("https://app.prolific.com/\t", False), ("", False),
])  # fmt: skip
def test_only_listed_hosts(address, good):
    assert allowed(address, HOSTS) is good


def test_the_setting_is_a_list_of_hosts():
    assert host_list(" A.example , .b.example,, ") == ("a.example", ".b.example")
    assert "app.prolific.com" in host_list(Settings().redirect_hosts)
    assert allowed("https://osu.sona-systems.com/webstudy_credit.aspx", host_list(Settings().redirect_hosts))


def test_a_study_with_another_host_is_refused_when_it_is_made_and_saved(house):
    made, life = house.studies.create(small_study()), StudyLife(house.journal, house.studies)
    for make in (house.studies.create, lambda config: life.save(made.id, config, "u")):
        with pytest.raises(InvalidError) as refused:
            make(study("https://evil.example/x", "full"))
        assert refused.value.field == "completion.redirects.full"
        assert refused.value.got == "evil.example"
        assert "EMOGEN_REDIRECT_HOSTS" in refused.value.message


def test_conditions_are_looked_at_as_well():
    changed = {"completion": {"redirects": {"complete": "https://evil.example"}}}
    with pytest.raises(InvalidError):
        check_redirects(small_study(conditions=({"name": "A"}, {"name": "B", "changes": changed})), HOSTS)


def test_a_value_that_nobody_knows_is_refused():
    with pytest.raises(InvalidError) as refused:
        check_redirects(study("https://app.prolific.com/{SESSION_ID}"), HOSTS)
    assert refused.value.got == "{SESSION_ID}"
    check_redirects(study(PROLIFIC), HOSTS)


@given(st.text(min_size=1, max_size=60))
def test_values_stay_values(text):
    address = way_back(study(PROLIFIC), "complete", text, {"PROLIFIC_PID": text}, HOSTS)
    parts = urlsplit(address)
    assert (parts.scheme, parts.netloc, parts.path, parts.fragment) == (
        "https", "app.prolific.com", "/submissions/complete", "",
    )  # fmt: skip
    assert parse_qs(parts.query, keep_blank_values=True) == {"cc": [text], "who": [text]}


def test_no_address_with_a_hole_in_it_and_none_for_other_outcomes():
    config = study(PROLIFIC)
    assert way_back(config, "complete", "C", {}, HOSTS) is None
    assert way_back(config, "complete", None, {"PROLIFIC_PID": "a"}, HOSTS) is None
    assert way_back(config, "stopped", "C", {"PROLIFIC_PID": "a"}, HOSTS) is None
    assert way_back(config, None, None, {}, HOSTS) is None


def test_a_host_that_was_taken_off_the_list_gets_nobody_any_more():
    assert way_back(study(PROLIFIC), "complete", "C", {"PROLIFIC_PID": "a"}, ("other.example",)) is None


@pytest.mark.parametrize(("outcome", "end"), [
    ("no_consent", lambda walker: walker.answer("consent", given=False)),
    ("stopped", lambda walker: walker.client.post(f"{walker.address}/stop", json={}).json()),
    ("complete", lambda walker: walker.finish()),
])  # fmt: skip
def test_every_outcome_has_its_code_and_way_back(client, house, outcome, end):
    made = house.studies.create(study(PROLIFIC, outcome, practice=None, generations=1))
    told = end(Walker(client, made.links[0], PROLIFIC_PID="ä b"))["completion"]
    assert (told["outcome"], told["code"]) == (outcome, "C0DE")
    assert told["redirect"] == "https://app.prolific.com/submissions/complete?cc=C0DE&who=%C3%A4%20b"

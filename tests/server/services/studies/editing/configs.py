"""Random studies, as a person could have typed them: every option, in every kind."""

from __future__ import annotations

from hypothesis import strategies as st

from server.services.config import StudyConfig, problems_of

LETTERS = st.characters(codec="utf-8", exclude_categories=("Cc", "Cs", "Zl", "Zp"), exclude_characters="\x85")
line = st.text(LETTERS, min_size=1, max_size=30).map(str.strip).filter(bool)
maybe_line = line | st.just("")
prose = st.lists(line, max_size=3).map("\n".join)
name = st.from_regex(r"[a-z][a-z0-9_-]{0,9}", fullmatch=True)
weight = st.floats(0, 1, exclude_max=True)


def sometimes(strategy):
    return st.none() | strategy


def part(**fields):
    """Some of the fields; what is left out has its default."""
    return st.fixed_dictionaries({}, optional=fields)


def lists(strategy, most=3, least=0, by=None):
    return st.lists(strategy, min_size=least, max_size=most, unique_by=by)


emotion = st.fixed_dictionaries({"adjective": line, "noun": line})
emotions = lists(emotion, 4, 1, lambda one: one["adjective"])
population = lists(lists(weight, 3, 1), 3, 1)
texts = part(
    organisation=maybe_line, contact=maybe_line, ethics=prose, minutes=st.integers(0, 600), about=prose, purpose=prose,
    consents=lists(line),
)  # fmt: skip
search = part(
    stop_at=sometimes(st.floats(0, 0.5)), least_generations=st.integers(1, 30),
    mutations=st.integers(0, 20), random_genes=st.integers(1, 50), random_faces=st.integers(0, 7),
    activation=st.tuples(st.integers(0, 9), st.integers(0, 9)).map(list), initialisation=st.sampled_from(["protocol"]),
    fixed_population=population | st.just([]), fixed_options=lists(population),
    fixed_option=sometimes(st.integers(1, 50)),
    reset=st.sampled_from(["keep", "redraw", "off"]), gaze=st.booleans(), lids=st.booleans(), lateral=st.booleans(),
    excluded_genes=lists(line),
)  # fmt: skip
named = st.fixed_dictionaries({"name": name}, optional={"emotion": maybe_line, "genes": st.dictionaries(line, weight)})
scale = st.fixed_dictionaries({"name": name, "text": line, "low": line, "high": line})
questions = lists(st.sampled_from(["intensity", "satisfaction"]) | scale, 3, 1)
number_item = {"kind": st.just("number"), "name": name, "text": line, "least": sometimes(st.floats(-9, 0)),
               "most": sometimes(st.floats(1, 9)), "required": st.booleans()}  # fmt: skip
item = st.one_of(
    st.fixed_dictionaries(number_item),
    st.fixed_dictionaries({"kind": st.just("scale"), "name": name, "text": line, "low": line, "high": line}),
    st.fixed_dictionaries({"kind": st.just("multiple"), "name": name, "text": line, "options": lists(line, 4, 2)}),
)


@st.composite
def questionnaires(draw):
    items = draw(lists(item, 3, 1, lambda one: one["name"]))
    rules = lists(st.fixed_dictionaries({"item": st.just(items[0]["name"]), "answers": lists(line, 2, 1)}), 2)
    return {"kind": "questionnaire", "title": draw(maybe_line), "items": items, "screen_out": draw(rules)}


@st.composite
def attention(draw):
    options = draw(lists(line, 4, 2))
    return {"kind": "attention", "text": draw(prose), "options": options, "right": options[-1], "failing": "end"}


@st.composite
def blocks(draw, words):
    own = lists(st.sampled_from(["own", "others", "means"]), 3, 1, lambda one: one)
    faces = part(sources=own, of=st.just("first"), others=st.integers(1, 20), least=st.integers(2, 1000))
    brought = st.fixed_dictionaries({"sources": st.just(["named", "own"]), "named": lists(named, 2, 1)})
    kinds = st.one_of(
        st.fixed_dictionaries({"kind": st.just("rate"), "faces": faces | brought, "questions": questions}),
        st.fixed_dictionaries({"kind": st.just("categorise"), "faces": faces, "labels": lists(line),
                               "none_of_these": st.booleans(), "confidence": st.booleans()}),
        st.fixed_dictionaries({"kind": st.just("evolve"), "retest_of": sometimes(st.just("first")),
                               "emotions": lists(st.sampled_from(words)),
                               "order": sometimes(st.sampled_from(["latin", "random", "fixed"]))}),
        questionnaires(), attention(),
    )  # fmt: skip
    found = draw(lists(kinds, 4))
    return [{"kind": "evolve", "name": "first"}, *({**one, "name": f"b{i}"} for i, one in enumerate(found))]


def studies():
    """Valid studies."""
    return _plain().filter(lambda plain: not problems_of(plain)).map(StudyConfig.model_validate)


@st.composite
def _plain(draw):
    chosen = draw(emotions)
    words = [one["adjective"] for one in chosen]
    outcome = st.sampled_from(["complete", "no_consent", "full", "stopped"])
    changes = part(generations=st.integers(1, 30), search=search, title=line, texts=texts)
    condition = st.fixed_dictionaries({"name": name, "quota": sometimes(st.integers(1, 99)), "changes": changes})
    known = st.dictionaries(st.sampled_from(words), emotion)
    translation = part(title=maybe_line, texts=texts, emotions=known, words=st.dictionaries(line, line))
    order = st.sampled_from(["latin", "random", "fixed"])
    rest = draw(part(
        language=st.sampled_from(["en", "no", "pt-BR"]), texts=texts, search=search, practice=sometimes(emotion),
        identities=lists(st.sampled_from(["female", "male", "on", "1"]), 3, 1), children=st.booleans(),
        head_assignment=st.sampled_from(["between", "within"]), generations=st.integers(1, 30),
        minimum=st.integers(1, 5), maximum=st.integers(5, 10), counterbalancing=order, none_is_close=st.booleans(),
        ratings=lists(st.sampled_from(["intensity", "satisfaction"]), 2, 0, lambda one: one), blocks=blocks(words),
        conditions=lists(condition, 2, 0, lambda one: one["name"]), assignment=st.sampled_from(["balanced", "random"]),
        quota=sometimes(st.integers(1, 999)), lease_minutes=st.integers(5, 999), user_agent=st.booleans(),
        translations=st.dictionaries(st.sampled_from(["de", "fr", "zh-Hans"]), translation, max_size=2),
        devices=part(phones=st.booleans(), face_degrees=sometimes(st.floats(1, 30))),
        completion=part(codes=st.dictionaries(outcome, line),
                        redirects=st.dictionaries(outcome, line.map(lambda one: f"https://{one}".replace(" ", "")))),
        recruiter_parameters=lists(st.from_regex(r"[A-Za-z0-9_]{1,9}", fullmatch=True)),
        places=st.sampled_from(["random", "fixed"]), pause_ms=st.integers(0, 10_000),
        surround=st.sampled_from(["light", "dark"]), portrait=part(width=st.integers(100, 1000)),
    ))  # fmt: skip
    return {"title": draw(line), "emotions": chosen, **rest}

"""What parts of the analysis are given."""

from emogen_core.analysis.recorded import Cell
from tests.server.analysis.made import context, crowd, made, template, threshold

MIND = template(1)


def test_retests_are_in_no_cell():
    told = context(made(MIND, 5), made(MIND, 5, seed=2, repetition=1))
    ((cell, faces),) = told.cells
    assert cell == Cell("happy", "female", "")
    assert len(faces) == 5 and not faces.repetitions.any()


def test_the_noise_of_a_cell_is_that_of_most_of_its_faces_and_several_searches_are_said():
    parts = [made(MIND, 4, name="a"), made(MIND, 6, name="b"), made(MIND, 5, emotion="angry")]
    told = context(*parts, searches=["one", "two", "one"], levels={"one": 0.1, "two": 0.3})
    happy, angry = (cell for cell, _ in told.cells)
    assert told.noise(happy) == threshold(0.3)
    assert told.noise(angry) == threshold(0.1)
    (sentence,) = told.mixed
    assert sentence.startswith("happy: faces were found by 2 different searches")


def test_a_crowd_is_as_large_as_the_first_faces_of_a_cell():
    told = context(made(MIND, 8), made(MIND, 9, name="q", repetition=1))
    assert told.crowd(Cell("happy", "female", "")) == crowd(8)


def test_random_numbers_depend_on_seed_and_place_only():
    told, other = context(made(MIND, 5)), context(made(MIND, 5), seed=2)
    first = told.rng(1, 2).random()
    told.rng(1, 3).random()
    assert told.rng(1, 2).random() == first
    assert len({first, told.rng(1, 3).random(), told.rng(2, 2).random(), other.rng(1, 2).random()}) == 4


def test_labels_name_only_what_differs_and_keys_name_the_condition_where_there_is_one():
    cell = Cell("happy", "female", "a")
    plain = context(made(MIND, 5))
    assert plain.label(plain.cells[0][0]) == "happy"
    assert [column.name for column in plain.key_columns] == ["emotion", "head"]
    heads = context(made(MIND, 5), made(MIND, 5, identity="male"))
    assert heads.label(heads.cells[1][0]) == "happy, male"
    groups = context(made(MIND, 5, condition="a"), made(MIND, 5, condition="b"))
    assert groups.label(cell) == "happy, a"
    assert groups.key(cell) == ("happy", "female", "a")
    assert [column.name for column in groups.key_columns] == ["emotion", "head", "condition"]

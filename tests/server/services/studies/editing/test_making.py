"""Studies to begin with."""

from tests.conftest import small_study


def test_a_study_of_an_example_is_not_called_as_another_one(house):
    made = [house.making.from_example("empty", None) for _ in range(3)]
    assert [house.life.head(one).title for one in made] == ["New study", "New study (2)", "New study (3)"]
    assert house.making.from_config(small_study(title="New study"), None), "a title that somebody chose stays"

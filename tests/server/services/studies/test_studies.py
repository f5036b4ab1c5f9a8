"""Making studies."""

import pytest

from server.services.errors import InvalidError
from tests.server.services.faces.test_heads import head


def test_a_study_is_made_with_the_document(house):
    made = house.studies.with_head(house.heads.signed(head("Ada")), children=False)
    (version,) = house.exports.configurations(made.id)
    (document,) = version["config"]["identities"]
    assert (document["name"], document["head"]["age"]) == ("Ada", 40)
    with pytest.raises(InvalidError, match="at least 18"):
        house.studies.with_head(house.heads.signed(head(age=12)), children=False)
    assert house.studies.with_head(house.heads.signed(head(age=12)), children=True).status == "draft"

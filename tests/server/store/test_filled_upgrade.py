"""A database of the first release, filled by people, comes to the present tables with everything that was in it."""

from datetime import timedelta

import pytest
from alembic import command
from sqlalchemy import MetaData, insert, select  # noqa: TID251
from starlette.testclient import TestClient

from server.app import create_app
from server.services.house import build_house
from server.store.engine import make_engine
from server.store.migrate import config, upgrade
from server.store.runs_tables import Participation
from server.store.studies_tables import Link, StudyVersion
from tests.conftest import BOTH, FakeDrawer, FakeTailor, small_study
from tests.server.postgres import fresh
from tests.server.walker import Walker

pytestmark = BOTH
PASSWORD = "four unrelated quiet words"


@pytest.fixture
def old_url(backend, tmp_path, request):
    return fresh(request.getfixturevalue("postgres")) if backend == "postgresql" else f"sqlite:///{tmp_path}/old.db"


@pytest.fixture
def walkers(house, client):
    """One finished, one in the middle, one who has just arrived, one erased; somebody who works here, and a key."""
    house.accounts.set_up(house.accounts.new_setup_key(), "Ines", "ines@example.org", PASSWORD)
    # As a study of the first release was: its condition is its head.
    study = house.studies.create(small_study(identities=("female",)))
    house.tokens.create("old", ["export"], study=study.id)
    people = [Walker(client, study.links[0], PROLIFIC_PID=f"p{number}") for number in range(4)]
    people[0].finish()
    people[1].step(people[1].start())
    people[3].finish()
    client.post(f"{people[3].address}/stop", json={"erase": True})
    return study, people


def reflected(url):
    engine = make_engine(url)
    tables = MetaData()
    tables.reflect(engine)
    return engine, tables


def rows(engine, tables):
    with engine.connect() as connection:
        return {
            table.name: sorted(map(repr, connection.execute(select(table)).all()))
            for table in tables.sorted_tables
            if table.name != "alembic_version"
        }


def filled(old_url, url):
    """Make a database of revision 0002 with the rows of another one, as far as it has tables and columns for them."""
    engine = make_engine(old_url)
    with engine.execution_options(write=True).begin() as connection:
        command.upgrade(config(connection), "0002")
    engine.dispose()
    (source, present), (target, past) = reflected(url), reflected(old_url)
    with source.connect() as reading, target.begin() as writing:
        for table in past.sorted_tables:
            if table.name != "alembic_version":
                columns = [present.tables[table.name].c[column.name] for column in table.columns]
                found = [dict(row) for row in reading.execute(select(*columns)).mappings()]
                if found:
                    writing.execute(insert(table), found)
    source.dispose()
    return target, past


def test_nothing_is_lost_and_everybody_goes_on(walkers, house, settings, old_url, rig):
    study, people = walkers
    old, past = filled(old_url, settings.url)
    before = rows(old, past)
    assert all(before[name] for name in ("participations", "answers", "faces", "choices", "users", "sessions", "audit"))
    upgrade(old_url)
    assert rows(old, past) == before, "every cell of the old tables is as it was"
    old.dispose()

    elsewhere = settings.model_copy(update={"data_dir": settings.data_dir / "new", "database_url": old_url})
    later = build_house(elsewhere, rig, FakeDrawer(rig), FakeTailor(rig))
    with later.database.read() as tx:
        everybody = tx.scalars(select(Participation).order_by(Participation.number)).all()
        assert [one.head for one in everybody] == [one.condition for one in everybody] == ["female"] * 4
        assert {(one.language, one.preview, one.order_row) for one in everybody} == {("en", False, None)}
        half_an_hour = timedelta(minutes=30)
        for one in everybody:
            seen = one.last_answer_at or one.arrived_at
            assert one.lease_until == (seen + half_an_hour if one.outcome is None else None)
        version, link = tx.scalars(select(StudyVersion)).one(), tx.scalars(select(Link)).one()
        assert (version.frozen_at, link.kind) == (version.created_at, "general_multiple")
    with TestClient(create_app(later), follow_redirects=False) as client:
        for one in people[:3]:
            state = one.state()
            one.client = client
            assert one.state() == state
            assert one.finish()["completion"]["outcome"] == "complete"
        assert people[3].state()["completion"]["outcome"] == "erased"
        Walker(client, study.links[0]).finish()
    assert later.replay.study(study.id).difference is None
    assert later.accounts.who(later.accounts.sign_in("ines@example.org", PASSWORD)).role == "owner"
    assert later.studies.summary(study.id).complete == 4
    later.close()

"""The migrations make exactly the tables that the models describe, on both databases."""

from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory

from server.store.check import database_report
from server.store.engine import make_engine
from server.store.migrate import config, upgrade
from server.store.tables import METADATA
from tests.conftest import BOTH

pytestmark = BOTH


def url_of(settings):
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    return settings.url


def test_migrations_equal_the_models(settings):
    url = url_of(settings)
    upgrade(url)
    engine = make_engine(url)
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, METADATA) == []
    engine.dispose()


def test_upgrading_twice_changes_nothing(settings):
    url = url_of(settings)
    upgrade(url)
    upgrade(url)
    assert database_report(url)["migration"] == ScriptDirectory.from_config(config()).get_current_head()


def test_an_unreachable_database_is_reported_without_its_password(backend):
    report = database_report("postgresql+psycopg://emogen:secret@127.0.0.1:1/none?connect_timeout=2")
    assert report["problem"]
    assert "secret" not in str(report)

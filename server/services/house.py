"""All services of one server process, built from the settings and the outside world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..store import studies
from ..store.engine import Database
from ..store.migrate import upgrade
from .accounts import Accounts
from .answers import Answers
from .export import Exports
from .heads import Heads
from .joining import Joining
from .journal import Journal
from .participation import Participations
from .portrait_files import PortraitFiles
from .portraits import Portraits
from .renewal import renew_portraits
from .replay import Replay
from .studies import Studies
from .tailor import HouseTailor
from .tokens import Tokens
from .wardrobe import Wardrobe

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

    from ..settings import Settings
    from .portraits import PortraitDrawer
    from .wardrobe import Tailor


@dataclass(frozen=True)
class House:
    """What routes and commands may call."""

    settings: Settings
    journal: Journal
    joining: Joining
    answers: Answers
    participations: Participations
    studies: Studies
    heads: Heads
    accounts: Accounts
    tokens: Tokens
    exports: Exports
    replay: Replay

    @property
    def database(self) -> Database:
        """The database."""
        return self.journal.database

    @property
    def portraits(self) -> Portraits:
        """The portraits."""
        return self.journal.portraits

    def ready(self) -> None:
        """Raise when the database does not answer."""
        with self.database.read() as tx:
            studies.all_studies(tx)

    def close(self) -> None:
        """Stop drawing and close the database."""
        self.journal.wardrobe.close()
        self.portraits.close()
        self.database.close()


def build_house(settings: Settings, rig: Rig, drawer: PortraitDrawer, tailor: Tailor | None = None) -> House:
    """Migrate the database and return all services."""
    database = open_database(settings)
    files = PortraitFiles(settings.data_dir / "portraits")
    wardrobe = Wardrobe(rig, tailor or HouseTailor(rig), settings.portrait_wait_seconds)
    portraits = Portraits(drawer, files, database, wardrobe, settings.portrait_memory_mb * 2**20)
    journal = Journal(database, rig, portraits, wardrobe)
    renew_portraits(journal)
    making = Studies(journal)
    return House(
        settings,
        journal,
        Joining(journal),
        Answers(journal),
        Participations(journal),
        making,
        Heads(journal, making),
        Accounts(database, settings.session_hours, settings.login_attempts),
        Tokens(database),
        Exports(database),
        Replay(journal),
    )


def open_database(settings: Settings) -> Database:
    """Return the database, brought to the present tables."""
    settings.data_dir.mkdir(parents=True, exist_ok=True)
    upgrade(settings.url)
    return Database(settings.url)

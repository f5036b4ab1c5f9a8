"""All services of one server process, built from the settings and the outside world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from emogen_core.rigs.foreign.archive import unpacked

from ..store import studies
from ..store.engine import Database
from ..store.opening import open_database
from .config.way_back import host_list
from .faces.heads import Heads
from .faces.import_note import ImportNote
from .faces.imports import MOST_SECONDS, HeadImporter, Imports
from .faces.kept_heads import StoredHeads
from .faces.model_drawers import ModelDrawers
from .faces.models import FaceModels
from .faces.portrait_files import PortraitFiles
from .faces.portraits import Portraits
from .faces.tailor import HouseTailor
from .faces.thumbnails import Thumbnails
from .faces.wardrobe import Wardrobe
from .housekeeping import Housekeeping
from .participation.answers import Answers
from .participation.joining import Joining
from .participation.journal import Journal
from .participation.participation import Participations
from .participation.previews import Previews
from .participation.replay.stored import Replay
from .participation.withdrawal import Withdrawals
from .people.accounts import Accounts
from .people.people import People
from .people.tokens import Tokens
from .people.trail import Trail
from .reports.analyses.analyses import Analyses
from .reports.analyses.analyst import Analyst
from .reports.monitor.monitor import Monitor
from .reports.monitor.overview import Overview
from .reports.participants.record import Records
from .reports.participants.roster import Roster
from .reports.results.noise import NoiseOfSearch
from .reports.results.planning import Planning
from .reports.results.results import StudyResults
from .reports.tables.export import Exports
from .studies.editing.editor import Editor
from .studies.editing.making import Making
from .studies.life import StudyLife
from .studies.recruiting import Recruiting
from .studies.removal import Removal
from .studies.simulations import Simulations
from .studies.starting import Starting
from .studies.studies import Studies
from .upkeep import Upkeep

if TYPE_CHECKING:
    from emogen_core.face.rig import Rig

    from ..settings import Settings
    from .faces.model_drawers import DrawerOf
    from .faces.portraits import PortraitDrawer
    from .faces.wardrobe import Tailor


@dataclass(frozen=True)
class House:
    """What routes and commands may call."""

    settings: Settings
    journal: Journal
    joining: Joining
    answers: Answers
    participations: Participations
    studies: Studies
    life: StudyLife
    starting: Starting
    removal: Removal
    recruiting: Recruiting
    heads: Heads
    models: FaceModels
    imports: Imports
    editor: Editor
    making: Making
    accounts: Accounts
    people: People
    trail: Trail
    upkeep: Upkeep
    tokens: Tokens
    exports: Exports
    replay: Replay
    previews: Previews
    roster: Roster
    records: Records
    noise: NoiseOfSearch
    planning: Planning
    results: StudyResults
    analyst: Analyst
    analyses: Analyses
    thumbnails: Thumbnails
    withdrawals: Withdrawals
    monitor: Monitor
    overview: Overview
    simulations: Simulations
    housekeeping: Housekeeping

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
        self.housekeeping.close()
        self.noise.close()
        self.imports.close()
        self.analyst.stop()
        self.analyses.close()
        self.monitor.close()
        self.simulations.close()
        self.journal.wardrobe.close()
        self.portraits.close()
        self.database.close()


def build_house(
    settings: Settings,
    rig: Rig,
    drawer: PortraitDrawer,
    tailor: Tailor | None = None,
    drawer_of: DrawerOf | None = None,
) -> House:
    """Migrate the database and return all services.

    Args:
        settings: of the server.
        rig: the bundled one.
        drawer: draws its faces.
        tailor: fits heads to it; with the methods that made the presets by default.
        drawer_of: makes what draws another face model; without it such faces are not drawn.
    """
    database = open_database(settings)
    models = FaceModels(database, settings.data_dir / "face-models")
    kept = StoredHeads(database)
    wardrobe = Wardrobe(tailor or HouseTailor(rig), settings.portrait_wait_seconds, models=models, kept=kept)
    drawers = ModelDrawers(drawer, models, settings.renderer, drawer_of)
    portraits = _portraits(settings, drawers, database, wardrobe)
    journal = Journal(database, rig, portraits, wardrobe, host_list(settings.redirect_hosts))
    previews = Previews(journal)
    noise = NoiseOfSearch(wardrobe.rig_of, settings.data_dir / "noise")
    making, tokens, joining = Studies(journal), Tokens(database), Joining(journal, settings.joins_per_minute)
    accounts = Accounts(database, settings.session_hours, settings.login_attempts)
    exports, analyst, life = Exports(database), Analyst(), StudyLife(journal, making)
    heads = Heads(rig, wardrobe, portraits, models)
    return House(
        settings=settings,
        journal=journal,
        joining=joining,
        answers=Answers(journal),
        participations=Participations(journal),
        studies=making,
        life=life,
        starting=Starting(database, settings.address),
        removal=Removal(journal),
        recruiting=Recruiting(database, settings.address),
        heads=heads,
        models=models,
        imports=_imports(settings, models),
        editor=Editor(life, heads),
        making=Making(making, life),
        accounts=accounts,
        people=People(database),
        trail=Trail(database),
        upkeep=Upkeep(settings, journal),
        tokens=tokens,
        exports=exports,
        replay=Replay(journal),
        previews=previews,
        roster=Roster(database),
        records=Records(journal, noise),
        noise=noise,
        planning=Planning(journal, noise),
        results=StudyResults(journal, noise),
        analyst=analyst,
        analyses=Analyses(database, exports, analyst, models),
        thumbnails=Thumbnails(portraits),
        withdrawals=Withdrawals(journal),
        monitor=Monitor(database),
        overview=Overview(database),
        simulations=Simulations(journal, tokens),
        housekeeping=Housekeeping(journal, (previews.sweep, accounts.sweep, joining.sweep)),
    )


def _imports(settings: Settings, models: FaceModels) -> Imports:
    note = ImportNote(settings.data_dir / "face-models" / "import.json", MOST_SECONDS)
    return Imports(models, HeadImporter(), unpacked, note)


def _portraits(settings: Settings, drawer: PortraitDrawer, database: Database, wardrobe: Wardrobe) -> Portraits:
    files = PortraitFiles(settings.data_dir / "portraits")
    return Portraits(drawer, files, database, wardrobe, settings.portrait_memory_mb * 2**20)

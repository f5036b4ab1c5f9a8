"""Reports of studies: one at a time, of who was asked for, kept until somebody is erased, never lost without a word."""

import io
import json
import threading
import zipfile
from datetime import timedelta

import pytest

from emogen_client import Export
from server.services.errors import ConflictError, InvalidError, NotFoundError, UnavailableError
from server.services.reports.analyses import analyses as module
from server.services.reports.analyses.analyses import Analyses
from server.store.admin_tables import AuditEntry
from server.store.analyses_tables import Analysis
from tests.conftest import BOTH, small_study
from tests.server.walker import Walker


class Maker:
    """Writes a report that only says whom it was made of; can be held, and can fail."""

    def __init__(self):
        self.options = []
        self.problem = None
        self.gate = threading.Event()
        self.gate.set()

    def __call__(self, export, out, options):
        assert self.gate.wait(30)
        self.options.append(tuple(options))
        if self.problem:
            raise self.problem
        out.mkdir()
        kept = Export(export)
        kept.verify()
        (out / "report.html").write_text(f"<p>{kept.manifest['participations']}</p>")
        (out / "about.json").write_text(json.dumps({"counted": f"{kept.manifest['participations']} who completed"}))


@pytest.fixture
def analyses(house):
    made = Analyses(house.database, house.exports, Maker())
    yield made
    made.make.gate.set()
    made.close()


@pytest.fixture
def people(client, house, study):
    Walker(client, study.links[0]).finish()
    Walker(client, study.links[0]).finish()
    house.joining.join(study.links[0], simulated=True, seed="1")


def make(analyses, study, who="people"):
    analyses.begin(study.id, who, "somebody")
    analyses.settle()
    return analyses.of(study.id)


@BOTH
def test_a_report_is_made_and_kept(house, study, people, analyses):
    assert analyses.of(study.id) is None
    with pytest.raises(NotFoundError, match="no report"):
        analyses.page(study.id)
    analyses.make.gate.clear()
    analyses.begin(study.id, "people", None)
    assert analyses.of(study.id).running
    assert analyses.of(study.id).made_at is None
    analyses.make.gate.set()
    analyses.settle()
    standing = analyses.of(study.id)
    assert (standing.running, standing.problem, standing.changed) == (False, None, False)
    assert (standing.counted, standing.made_at) == ("2 who completed", standing.begun_at)
    assert analyses.page(study.id) == b"<p>2</p>"
    with zipfile.ZipFile(io.BytesIO(analyses.archive(study.id))) as files:
        assert files.namelist() == ["about.json", "report.html"]
    with house.database.read() as tx:
        entry = tx.query(AuditEntry).filter_by(action="make report", subject=study.id).one()
        assert entry.detail == {"who": "people", "result": "elite"}


@pytest.mark.parametrize(
    ("who", "counted", "options"),
    [
        ("people", "2", ()),
        ("pilot", "0", ("--pilot",)),
        ("simulated", "1", ("--simulated",)),
        ("all", "3", ("--pilot", "--simulated")),
    ],
)
def test_who_was_asked_for_counts(study, people, analyses, who, counted, options):  # noqa: PLR0917
    assert make(analyses, study, who).who == who
    assert analyses.page(study.id) == f"<p>{counted}</p>".encode()
    assert analyses.make.options == [options]


def test_estimates_can_be_asked_for_where_a_search_makes_any(client, house, study, people, analyses):
    assert list(analyses.results(study.id)) == ["elite"]
    learning = house.studies.create(small_study(search={"strategy": "preference", "activation": (2, 3)}))
    assert list(analyses.results(learning.id)) == ["elite"]
    Walker(client, learning.links[0]).finish()
    assert list(analyses.results(learning.id)) == ["elite", "estimate"]
    analyses.begin(learning.id, "people", None, "estimate")
    analyses.settle()
    assert analyses.make.options == [("--result", "estimate")]
    standing = analyses.of(learning.id)
    assert (standing.result, standing.counted) == ("estimate", "1 who completed, the search’s own estimates")
    with pytest.raises(InvalidError, match="no such result"):
        analyses.begin(learning.id, "people", None, "odd")


def test_nonsense_is_refused_and_leaves_nothing(study, analyses):
    with pytest.raises(InvalidError, match="no such filter"):
        analyses.begin(study.id, "odd", None)
    with pytest.raises(NotFoundError):
        analyses.begin("none", "people", None)
    assert analyses.of(study.id) is None
    assert make(analyses, study).problem is None, "a refusal must not leave the maker busy"


@BOTH
def test_one_report_at_a_time(house, study, people, analyses):
    other = house.studies.create(small_study())
    analyses.make.gate.clear()
    analyses.begin(study.id, "people", None)
    for asked in (study, other):
        with pytest.raises(ConflictError, match="being made already"):
            analyses.begin(asked.id, "people", None)
    beside = Analyses(house.database, house.exports, analyses.make)  # another process of the same server
    with pytest.raises(ConflictError, match="of this study is being made"):
        beside.begin(study.id, "people", None)
    beside.begin(other.id, "people", None)
    analyses.make.gate.set()
    analyses.settle()
    beside.close()
    assert analyses.of(other.id).counted == "0 who completed"


def test_a_failure_says_why_and_keeps_the_report_before(study, people, analyses, caplog):
    first = make(analyses, study)
    for problem, told in ((UnavailableError("No faces."), "No faces."), (RuntimeError("odd"), "server's log")):
        analyses.make.problem = problem
        standing = make(analyses, study)
        assert told in standing.problem
        assert not standing.running
        assert (standing.made_at, analyses.page(study.id)) == (first.made_at, b"<p>2</p>")
    assert "odd" in caplog.text
    analyses.make.problem = None
    assert make(analyses, study).problem is None


def test_only_the_latest_is_kept(client, house, study, people, analyses):
    make(analyses, study)
    Walker(client, study.links[0]).finish()
    assert analyses.of(study.id).changed
    assert not make(analyses, study).changed
    assert analyses.page(study.id) == b"<p>3</p>"
    with house.database.read() as tx:
        assert tx.query(Analysis).count() == 1


@BOTH
def test_whoever_withdraws_takes_the_report_along(house, study, people, analyses):
    make(analyses, study)
    house.withdrawals.erase(study.id, 0, None)
    assert analyses.of(study.id) is None
    with pytest.raises(NotFoundError):
        analyses.archive(study.id)
    analyses.make.gate.clear()
    analyses.begin(study.id, "people", None)
    house.withdrawals.erase(study.id, 1, None)
    analyses.make.gate.set()
    analyses.settle()
    assert analyses.of(study.id) is None, "made of somebody who withdrew meanwhile"
    assert make(analyses, study).problem is None


def test_a_preview_that_is_erased_takes_nothing_along(house, study, people, analyses):
    make(analyses, study)
    joined = house.previews.begin(study.id, "u1")
    assert house.participations.stop(joined.token, erase=True, proof=joined.proof)["completion"]["outcome"] == "erased"
    assert analyses.of(study.id) is not None


def test_a_study_is_deleted_with_its_report(house, study, analyses):
    house.accounts.set_up(house.accounts.new_setup_key(), "Ines", "ines@example.org", "four unrelated quiet words")
    make(analyses, study)
    house.life.move(study.id, "closed", None)
    house.removal.delete(study.id, "nobody", "owner", typed=house.life.head(study.id).title, erase=True)
    with house.database.read() as tx:
        assert tx.query(Analysis).count() == 0


def test_a_report_whose_process_was_killed_can_be_made_again(house, study, people, analyses, monkeypatch):
    analyses.make.gate.clear()
    analyses.begin(study.id, "people", None)
    later = module.now() + module.LEASE + timedelta(seconds=1)
    monkeypatch.setattr(module, "now", lambda: later)
    assert (analyses.of(study.id).running, analyses.of(study.id).problem) == (False, "It was interrupted.")
    beside = Analyses(house.database, house.exports, Maker())
    assert make(beside, study).counted == "2 who completed"
    analyses.make.gate.set()
    analyses.settle()
    assert analyses.of(study.id).counted == "2 who completed"
    beside.close()

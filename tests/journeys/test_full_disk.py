"""The server's disk is full: it says when to come again, the page keeps the answer and goes on when there is room."""

import pytest
from sqlalchemy import event  # noqa: TID251

from server.store import engine
from tests.conftest import small_study
from tests.server.inside import serving

pytestmark = pytest.mark.browser


class Disk:
    """Lets the database grow, or not."""

    def __init__(self, house):
        self.full = False
        event.listen(house.database.engine, "checkout", self._limit)

    def _limit(self, connection, *_):
        connection.execute(f"PRAGMA max_page_count = {1 if self.full else 2**30}")


def test_the_answer_waits_until_there_is_room(house, player):
    page = player.page
    study = house.studies.create(small_study(practice=None, ratings=()))
    disk = Disk(house)
    statuses = []
    page.on("response", lambda reply: statuses.append((reply.url.rsplit("/", 1)[-1], reply.status, reply.headers)))
    with serving(house) as address:
        player.arrive(f"{address}/s/{study.links[0]}").agree().read()
        player.choose(1).next().wait_generation("Generation 1 of")
        disk.full = True
        # What is free inside the file takes a few rows more.
        with pytest.raises(engine.StorageError), house.database.write() as tx:
            tx.connection().exec_driver_sql("CREATE TABLE filler (data BLOB)")
            tx.connection().exec_driver_sql("INSERT INTO filler VALUES (zeroblob(10000000))")
        statuses.clear()
        player.choose(2, 3, best=3).next()
        page.get_by_role("heading", name="Your answer is safe on this device").wait_for()
        assert "It could not be taken just now." in page.locator("#panel").inner_text()
        refused = [reply for reply in statuses if reply[0] == "answers"]
        assert {status for _, status, _ in refused} == {503}
        assert refused[0][2]["retry-after"] == "5"
        disk.full = False
        page.get_by_role("button", name="Try now").click()
        player.wait_generation("Generation 2 of")
        assert "Your answer has arrived" in player.status()
    with house.database.read() as tx:
        count = "SELECT count(*) FROM choices"
        assert tx.connection().exec_driver_sql(count).scalar() == 2

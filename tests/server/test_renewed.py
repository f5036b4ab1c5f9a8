"""After the face model was exchanged, who was in the middle is told so instead of being sent in circles."""

from server.services.participation.seating import register_rig
from server.store.runs_tables import Participation
from server.store.studies_tables import RigRecord
from tests.server.walker import Walker


def test_a_participation_of_another_face_model_says_that_it_cannot_go_on(house, client, study):
    walker = Walker(client, study.links[0])
    begun = walker.start()
    with house.database.write() as tx:
        register_rig(tx, house.journal.rig)
        old = tx.get(RigRecord, house.journal.rig.hash)
        tx.add(RigRecord(hash="old", name="old", genes=old.genes, shapes=old.shapes, first_used_at=old.first_used_at))
        tx.flush()
        tx.query(Participation).update({"rig_hash": "old"})
    state = client.get(f"{walker.address}/state")
    assert (state.status_code, state.json()["error"]["code"]) == (409, "renewed")
    assert walker.post(walker.body(begun)).json()["error"]["code"] == "renewed"
    page = client.get(walker.address, headers={"accept": "text/html"})
    assert page.status_code == 409
    assert "This participation cannot go on" in page.text
    assert 'id="grid"' not in page.text
    assert client.post(f"{walker.address}/stop", json={"erase": False}).json()["completion"]["outcome"] == "stopped"

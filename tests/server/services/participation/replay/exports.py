"""Exports of a small study, whole and tampered with."""

import hashlib
import json
import shutil

from server.services.participation.replay.exported import ExportReplay
from server.services.reports.tables.package import write_folder
from server.services.reports.tables.sound_export import SoundExport


def exported(house, study, folder, form="jsonl"):
    """Write an export into a folder."""
    folder.mkdir(exist_ok=True)
    assert list(write_folder(house.exports.package(study.id, form).entries(), folder))
    return folder


def replayed(house, folder):
    """Replay an export with the rig and the heads of a house."""
    export = SoundExport(folder)
    export.verify()
    return ExportReplay(export, house.journal.wardrobe).everybody()


def tampered(folder, table, change):
    """Copy an export with changed rows and a manifest that fits them, as somebody would who knows how it is made."""
    other = folder.with_name(f"{folder.name}-tampered")
    shutil.copytree(folder, other, dirs_exist_ok=True)
    manifest = json.loads((other / "manifest.json").read_text())
    (told,) = (file for file in manifest["files"] if file.get("table") == table or file["path"].endswith(table))
    path = other / told["path"]
    whole = table.endswith(".json")
    rows = json.loads(path.read_text()) if whole else [json.loads(line) for line in path.read_text().splitlines()]
    change(rows)
    text = json.dumps(rows) if whole else "".join(f"{json.dumps(row)}\n" for row in rows)
    path.write_text(text)
    told |= {"bytes": len(text.encode()), "sha256": hashlib.sha256(text.encode()).hexdigest()}
    told |= {"rows": len(rows)} if "rows" in told else {}
    (other / "manifest.json").write_text(json.dumps(manifest))
    return other

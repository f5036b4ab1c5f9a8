"""Blocks, conditions, languages, leases, kinds of links, people with roles. What is there keeps its meaning."""

from datetime import timedelta
from typing import Any

import sqlalchemy as sa
from alembic import op

from server.store.base import UtcTime

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None

# Added and dropped one by one: SQLite copies no table, so references stay. Where a column must have a value, the rows
# that are there already get this one.
COLUMNS: dict[str, dict[str, tuple[Any, Any]]] = {
    "studies": {"owner_id": (sa.String(), None), "note": (sa.String(), "")},
    "study_versions": {"author_id": (sa.String(), None), "frozen_at": (UtcTime(), None)},
    "links": {
        "kind": (sa.String(), "general_multiple"),
        "language": (sa.String(), None),
        "condition": (sa.String(), None),
    },
    "participations": {
        "preview": (sa.Boolean(), sa.false()),
        "head": (sa.String(), ""),
        "order_row": (sa.Integer(), None),
        "language": (sa.String(), "en"),
        "device": (sa.JSON(), "{}"),
        "lease_until": (UtcTime(), None),
    },
    "trials": {"block": (sa.String(), "evolve")},
    "choices": {"drawn_ms": (sa.Double(), None), "none_is_close": (sa.Boolean(), None)},
    "users": {"disabled_at": (UtcTime(), None)},
    "sessions": {"browser": (sa.String(), ""), "seen_at": (UtcTime(), None)},
}


def upgrade() -> None:
    for table, columns in COLUMNS.items():
        for name, (kind, value) in columns.items():
            op.add_column(table, sa.Column(name, kind, nullable=value is None, server_default=value))
    # Until now the condition of a participation was its head, and a version was frozen as soon as it was there.
    op.execute("UPDATE participations SET head = condition")
    op.execute("UPDATE trials SET block = 'practice' WHERE practice")
    op.execute("UPDATE study_versions SET frozen_at = created_at")
    _keep_places()
    _tables()


def _keep_places() -> None:
    """Give who is running the half hour that everybody has from their last answer on."""
    table = sa.table(
        "participations", sa.column("id", sa.String()), sa.column("outcome", sa.String()),
        sa.column("arrived_at", UtcTime()), sa.column("last_answer_at", UtcTime()), sa.column("lease_until", UtcTime()),
    )  # fmt: skip
    connection = op.get_bind()
    running = connection.execute(
        sa.select(table.c.id, sa.func.coalesce(table.c.last_answer_at, table.c.arrived_at, type_=UtcTime())).where(
            table.c.outcome.is_(None)
        )
    ).all()
    for row, seen in running:
        connection.execute(sa.update(table).where(table.c.id == row).values(lease_until=seen + timedelta(minutes=30)))


def _tables() -> None:
    op.create_table(
        "invitations",
        sa.Column("id", sa.String(), nullable=False),
        sa.Column("token_hash", sa.String(), nullable=False),
        sa.Column("email", sa.String(), nullable=False),
        sa.Column("role", sa.String(), nullable=False),
        sa.Column("author_id", sa.String(), nullable=False),
        sa.Column("created_at", UtcTime(), nullable=False),
        sa.Column("expires_at", UtcTime(), nullable=False),
        sa.Column("used_at", UtcTime(), nullable=True),
        sa.Column("revoked_at", UtcTime(), nullable=True),
        sa.ForeignKeyConstraint(["author_id"], ["users.id"], name=op.f("fk_invitations_author_id_users")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_invitations")),
        sa.UniqueConstraint("token_hash", name=op.f("uq_invitations_token_hash")),
    )
    op.create_table(
        "server_keys",
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("value", sa.String(), nullable=False),
        sa.Column("created_at", UtcTime(), nullable=False),
        sa.PrimaryKeyConstraint("name", name=op.f("pk_server_keys")),
    )
    op.create_table(
        "stimuli",
        sa.Column("id", sa.String(), nullable=False),
        sa.Column("trial_id", sa.String(), nullable=False),
        sa.Column("item", sa.Integer(), nullable=False),
        sa.Column("source", sa.String(), nullable=False),
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("emotion", sa.String(), nullable=False),
        sa.Column("identity", sa.String(), nullable=False),
        sa.Column("made_from", sa.JSON(), nullable=False),
        sa.Column("genes", sa.LargeBinary(), nullable=False),
        sa.Column("weights", sa.LargeBinary(), nullable=False),
        sa.Column("portrait_key", sa.String(), nullable=False),
        sa.ForeignKeyConstraint(["trial_id"], ["trials.id"], name=op.f("fk_stimuli_trial_id_trials")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_stimuli")),
        sa.UniqueConstraint("trial_id", "item", name=op.f("uq_stimuli_trial_id_item")),
    )
    op.create_index(op.f("ix_stimuli_name"), "stimuli", ["name"])
    op.create_index(op.f("ix_stimuli_portrait_key"), "stimuli", ["portrait_key"])
    op.create_table(
        "responses",
        sa.Column("trial_id", sa.String(), nullable=False),
        sa.Column("item", sa.Integer(), nullable=False),
        sa.Column("question", sa.String(), nullable=False),
        sa.Column("stimulus_id", sa.String(), nullable=True),
        sa.Column("value", sa.JSON(), nullable=False),
        sa.Column("expected", sa.JSON(), nullable=True),
        sa.Column("arrived_at", UtcTime(), nullable=False),
        sa.Column("onset_ms", sa.Double(), nullable=True),
        sa.Column("answered_ms", sa.Double(), nullable=True),
        sa.Column("hidden_ms", sa.Double(), nullable=True),
        sa.ForeignKeyConstraint(["stimulus_id"], ["stimuli.id"], name=op.f("fk_responses_stimulus_id_stimuli")),
        sa.ForeignKeyConstraint(["trial_id"], ["trials.id"], name=op.f("fk_responses_trial_id_trials")),
        sa.PrimaryKeyConstraint("trial_id", "item", "question", name=op.f("pk_responses")),
    )


def downgrade() -> None:
    for table in ("responses", "stimuli", "server_keys", "invitations"):
        op.drop_table(table)
    for table, columns in COLUMNS.items():
        for name in columns:
            op.drop_column(table, name)

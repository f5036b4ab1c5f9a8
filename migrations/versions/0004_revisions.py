"""Which participations changed since when, and what a download consisted of."""

import sqlalchemy as sa
from alembic import op

from server.store.base import UtcTime

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("participations", sa.Column("revision", sa.BigInteger(), nullable=False, server_default="0"))
    op.create_table(
        "study_revisions",
        sa.Column("study_id", sa.String(), nullable=False),
        sa.Column("revision", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["study_id"], ["studies.id"], name=op.f("fk_study_revisions_study_id_studies")),
        sa.PrimaryKeyConstraint("study_id", name=op.f("pk_study_revisions")),
    )
    op.create_table(
        "export_receipts",
        sa.Column("id", sa.String(), nullable=False),
        sa.Column("study_id", sa.String(), nullable=False),
        sa.Column("file", sa.String(), nullable=False),
        sa.Column("rows", sa.BigInteger(), nullable=False),
        sa.Column("bytes", sa.BigInteger(), nullable=False),
        sa.Column("sha256", sa.String(), nullable=False),
        sa.Column("finished_at", UtcTime(), nullable=False),
        sa.ForeignKeyConstraint(["study_id"], ["studies.id"], name=op.f("fk_export_receipts_study_id_studies")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_export_receipts")),
    )
    op.create_index(op.f("ix_export_receipts_study_id"), "export_receipts", ["study_id"])
    op.create_index(op.f("ix_export_receipts_finished_at"), "export_receipts", ["finished_at"])


def downgrade() -> None:
    op.drop_table("export_receipts")
    op.drop_table("study_revisions")
    op.drop_column("participations", "revision")

"""Heads that were fitted for studies that bring their own."""

import sqlalchemy as sa
from alembic import op

from server.store.base import UtcTime

revision = "0007"
down_revision = "0006"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "fitted_heads",
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("rig_hash", sa.String(), nullable=False),
        sa.Column("fitted_at", UtcTime(), nullable=False),
        sa.Column("head", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("name", "rig_hash", name=op.f("pk_fitted_heads")),
    )


def downgrade() -> None:
    op.drop_table("fitted_heads")

"""Face models that were brought to this server."""

import sqlalchemy as sa
from alembic import op

from server.store.base import UtcTime

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "face_models",
        sa.Column("name", sa.String(), nullable=False),
        sa.Column("rig_hash", sa.String(), nullable=False),
        sa.Column("look_hash", sa.String(), nullable=False),
        sa.Column("heads", sa.JSON(), nullable=False),
        sa.Column("emotions", sa.JSON(), nullable=False),
        sa.Column("counts", sa.JSON(), nullable=False),
        sa.Column("findings", sa.JSON(), nullable=False),
        sa.Column("added_by", sa.String(), nullable=True),
        sa.Column("added_at", UtcTime(), nullable=False),
        sa.Column("rig", sa.LargeBinary(), nullable=False),
        sa.Column("look", sa.LargeBinary(), nullable=False),
        sa.PrimaryKeyConstraint("name", name=op.f("pk_face_models")),
        sa.UniqueConstraint("rig_hash", name=op.f("uq_face_models_rig_hash")),
    )


def downgrade() -> None:
    op.drop_table("face_models")

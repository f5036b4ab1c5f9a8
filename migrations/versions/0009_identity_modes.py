"""Identity modes of face models, of which heads are made."""

import sqlalchemy as sa
from alembic import op

revision = "0009"
down_revision = "0008"
branch_labels = None
depends_on = None


def upgrade() -> None:
    with op.batch_alter_table("face_models") as table:
        table.add_column(sa.Column("sliders", sa.JSON(), nullable=False, server_default="[]"))
        table.add_column(sa.Column("modes", sa.LargeBinary(), nullable=True))
    with op.batch_alter_table("face_models") as table:
        table.alter_column("sliders", server_default=None)


def downgrade() -> None:
    with op.batch_alter_table("face_models") as table:
        table.drop_column("modes")
        table.drop_column("sliders")

"""Which face of a trial a report is of: all reports before were of the faces chosen as best."""

import sqlalchemy as sa
from alembic import op

revision = "0010"
down_revision = "0009"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("analyses", sa.Column("result", sa.String(), nullable=False, server_default="elite"))


def downgrade() -> None:
    with op.batch_alter_table("analyses") as table:
        table.drop_column("result")

"""Where a trial ends whose search is sure enough early; all trials before went on to the study's last generation."""

import sqlalchemy as sa
from alembic import op

revision = "0011"
down_revision = "0010"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.add_column("trials", sa.Column("last_generation", sa.Integer(), nullable=True))


def downgrade() -> None:
    op.drop_column("trials", "last_generation")

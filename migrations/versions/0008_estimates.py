"""What searches that weigh all answers take for the face in mind: one row a finished trial."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None


def upgrade() -> None:
    op.create_table(
        "estimates",
        sa.Column("trial_id", sa.String(), nullable=False),
        sa.Column("identity", sa.String(), nullable=False),
        sa.Column("genes", sa.LargeBinary(), nullable=False),
        sa.Column("weights", sa.LargeBinary(), nullable=False),
        sa.Column("portrait_key", sa.String(), nullable=False),
        sa.Column("collided_lips", sa.Boolean(), nullable=True),
        sa.Column("collided_teeth", sa.Boolean(), nullable=True),
        sa.Column("depth_before", sa.Double(), nullable=True),
        sa.Column("depth_after", sa.Double(), nullable=True),
        sa.ForeignKeyConstraint(["trial_id"], ["trials.id"], name=op.f("fk_estimates_trial_id_trials")),
        sa.PrimaryKeyConstraint("trial_id", name=op.f("pk_estimates")),
    )
    op.create_index(op.f("ix_estimates_portrait_key"), "estimates", ["portrait_key"])


def downgrade() -> None:
    op.drop_table("estimates")

"""What the collision stage found on a face. Faces that are there already keep no value."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None

# Added and dropped one by one: no table is copied, so the choices' references to faces stay.
COLUMNS = {
    "collided_lips": sa.Boolean(),
    "collided_teeth": sa.Boolean(),
    "depth_before": sa.Double(),
    "depth_after": sa.Double(),
}


def upgrade() -> None:
    for name, kind in COLUMNS.items():
        op.add_column("faces", sa.Column(name, kind, nullable=True))


def downgrade() -> None:
    for name in COLUMNS:
        op.drop_column("faces", name)

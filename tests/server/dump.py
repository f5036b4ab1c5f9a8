from sqlalchemy import select  # noqa: TID251

from server.store.tables import METADATA


def dump(database):
    """Everything that the database holds, to compare before and after."""
    with database.read() as tx:
        return {table.name: sorted(map(repr, tx.execute(select(table)).all())) for table in METADATA.sorted_tables}

"""Which label was given to which face."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


def confusion(pairs: Sequence[tuple[str, str]], rows: Sequence[str], columns: Sequence[str]) -> NDArray[np.int64]:
    """Return the (rows, columns) table of how often a face meant as `rows[i]` was called `columns[j]`.

    Args:
        pairs: what each face was meant to show, and what it was called; other words are not counted.
        rows, columns: the words of the table, each once.
    """
    table = np.zeros((len(rows), len(columns)), np.int64)
    row_of, column_of = ({word: i for i, word in enumerate(words)} for words in (rows, columns))
    for meant, called in pairs:
        if meant in row_of and called in column_of:
            table[row_of[meant], column_of[called]] += 1
    return table

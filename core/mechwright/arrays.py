"""Arrays of numbers."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
GOLDEN = np.uint64(0x9E3779B97F4A7C15)
"""2⁶⁴ over the golden ratio: its multiples are spread evenly (Knuth, The Art of Computer Programming 6.4)."""


def first_of_each(rows: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Index (k,) of the first of each kind of row (n, m), and the kind (n,) of every row.

    Examples
    --------
    >>> first, kind = first_of_each(np.array([[7, 1], [5, 2], [7, 1]]))
    >>> sorted(first.tolist()), bool(kind[0] == kind[2] != kind[1])
    ([0, 1], True)
    """
    keys = rows.astype(np.uint64) @ (GOLDEN * np.arange(1, rows.shape[1] + 1, dtype=np.uint64) | np.uint64(1))
    _, index, kind = np.unique(keys, return_index=True, return_inverse=True)
    if (rows[index][kind] != rows).any():  # different rows with one key
        _, index, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return index, kind.reshape(-1)

"""A law given as a table: the smooth curve through its rows.

A quintic spline through the rows, at rest at both ends, so that the jerk is still continuous. Where the rows
show an acceleration right at an end, that acceleration is kept; else it starts and ends at 0. This module
imports scipy.
"""

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import PPoly, make_interp_spline

from mechwright.arrays import Array
from mechwright.mechanics.laws.law import UnbrokenLaw

DEGREE = 5
"""Of the spline: the lowest odd one with a continuous jerk."""

JUMP = 0.5
"""End acceleration d²s/du² of the rows that counts as one: a tenth of what a usual law reaches; less is what
a rounded table shows by chance."""


class Table(UnbrokenLaw):
    """The spline through rows of (u, s).

    Parameters
    ----------
    rows
        Ascending in u from (0, 0) to (1, 1), at least six; see
        :func:`mechwright.mechanics.laws.faults.table_faults`.
    """

    def __init__(self, rows: Sequence[tuple[float, float]]) -> None:
        self.name = "table"
        u, s = np.asarray(rows, dtype=float).T
        free = make_interp_spline(u, s, DEGREE)
        self.end_velocities = tuple(float(free(end, 1)) for end in (0.0, 1.0))
        # From rest a law can only speed up, and only slow down to rest: anything else is a ripple.
        bends = [sign * max(0.0, sign * float(free(end, 2))) for end, sign in ((0.0, 1), (1.0, -1))]
        conditions = tuple([(1, 0.0), (2, bend if abs(bend) > JUMP else 0.0)] for bend in bends)
        spline = make_interp_spline(u, s, DEGREE, bc_type=conditions)
        self._orders = [PPoly.from_spline(spline)]
        for _ in range(4):
            self._orders.append(self._orders[-1].derivative())

    def _turning(self, order: int) -> Array:
        """Values of a derivative at the rows and where it turns."""
        roots = self._orders[order + 1].roots(extrapolate=False)
        roots = roots[np.isfinite(roots) & (roots > 0) & (roots < 1)]
        values: Array = self._orders[order](np.concatenate((np.unique(self._orders[0].x), roots)))
        return values

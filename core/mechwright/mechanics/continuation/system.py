"""Systems of equations with parameters, in doubles for many points at once and in balls for one."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import acb, acb_mat
from numpy.typing import NDArray

from mechwright.mechanics.continuation.slopes import Slope
from mechwright.mechanics.planar import Plane

Balls = NDArray[np.object_]


@dataclass(frozen=True)
class System:
    """As many equations as unknowns, rational in unknowns and parameters.

    Parameters
    ----------
    equations
        Unknowns and parameters, two sequences, to the values that are to be 0. It adds, subtracts, multiplies
        and divides alone.
    """

    equations: Callable[[Sequence[Any], Sequence[Any]], Sequence[Any]]

    def at(self, unknowns: Plane, parameters: Plane, way: Plane) -> tuple[Plane, Plane, Plane]:
        """Values, slopes and rates at many points.

        Parameters
        ----------
        unknowns
            (n, m).
        parameters
            (n, k), moving at the rates ``way`` (k,).

        Returns
        -------
        values, slopes, along
            (n, m), (n, m, m), and (n, m) the rates of the values where the unknowns stand.
        """
        n, m = unknowns.shape
        unit = np.eye(m + 1, dtype=complex)[:, :, None]
        spread = np.ones(n)
        z = [Slope(unknowns[:, i], unit[i] * spread) for i in range(m)]
        p = [Slope(parameters[:, i], unit[m] * way[i] * spread) for i in range(way.size)]
        found = self.equations(z, p)
        values = np.stack([one.value for one in found], axis=1)
        slopes = np.stack([one.slopes for one in found], axis=0).transpose(2, 0, 1)
        return values, slopes[:, :, :m], slopes[:, :, m]

    def in_balls(self, unknowns: Balls, parameters: Balls) -> tuple[Balls, acb_mat]:
        """Values (m,) and slopes at unknowns (m,) and parameters (k,)."""
        m = len(unknowns)
        z = [
            Slope(one, np.array([acb(int(i == k)) for k in range(m)], dtype=object))
            for i, one in enumerate(unknowns)
        ]
        found = self.equations(z, list(parameters))
        values = np.array([one.value for one in found], dtype=object)
        return values, acb_mat(m, m, [entry for one in found for entry in one.slopes])

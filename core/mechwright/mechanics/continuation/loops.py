"""All solutions from one: closed loops of the parameters lead solutions to others (monodromy)."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from scipy.spatial import cKDTree

from mechwright.arrays import Array
from mechwright.mechanics.continuation.paths import newton, tracked
from mechwright.mechanics.continuation.system import System
from mechwright.mechanics.planar import Plane

SAME = 1e-6
"""Difference of keys below which two solutions are taken for one."""

SETTLED = 1e-9
"""Last step of Newton of what is kept, as a share of each unknown or of 1."""

SETTLING = 3
"""Steps of Newton at the end of a loop."""


def keys(z: Plane) -> Array:
    """(n, 2 m) solutions as real numbers of moderate size: equal ones lie near, far ones included."""
    size = np.abs(z)
    moderate = z * (np.arcsinh(size) / np.maximum(size, 1e-300))
    return np.concatenate((moderate.real, moderate.imag), axis=1)


def new_ones(z: Plane, known: Plane) -> Plane:
    """Those of the solutions (n, m) that are neither among the known ones (k, m) nor earlier ones."""
    found = keys(z)
    tree = cKDTree(np.concatenate((keys(known), found)))
    first = [min(near) for near in tree.query_ball_point(found, SAME, p=np.inf)]
    fresh: Plane = z[[i for i, near in enumerate(first) if near == len(known) + i]]
    return fresh


def settled(system: System, z: Plane, parameters: Plane, steps: int = SETTLING) -> Plane:
    """Those of the approximate solutions (n, m) from which Newton's steps converge, after them."""
    size = np.full(len(z), np.inf)
    for _ in range(steps):
        z, size = newton(system, z, np.broadcast_to(parameters, (len(z), parameters.size)))
    good: Plane = z[size < SETTLED]
    return good


def closed(
    system: System,
    known: Plane,
    parameters: Plane,
    elsewhere: Callable[[], Plane],
    quiet: int,
    heard: Callable[[int], None],
) -> Plane:
    """All solutions that loops lead to, until ``quiet`` loops in turn bring nothing new.

    Parameters
    ----------
    known
        (n, m) solutions at ``parameters`` (k,), one at least.
    elsewhere
        Draws other parameters (k,).
    heard
        Told the number after each loop.
    """
    idle = 0
    while idle < quiet:
        found = known
        for begin, end in pairwise((parameters, elsewhere(), elsewhere(), parameters)):
            found = tracked(system, found, begin, end).arrived
        fresh = new_ones(settled(system, found, parameters), known)
        idle = 0 if len(fresh) else idle + 1
        known = np.concatenate((known, fresh))
        heard(len(known))
    return known

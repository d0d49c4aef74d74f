"""Whether a linkage goes through its positions in their order and in one piece (rectification)."""

from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array
from mechwright.mechanics.linkage.passing import passing
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.reach import reach


@dataclass(frozen=True)
class Way:
    """How the crank goes through the positions.

    Parameters
    ----------
    bar
        The linkage on the branch of the positions.
    phi
        (n,) crank angles from X, rad, one way from the first to the last.
    full
        Whether the crank turns fully; else it swings from the first position to the last.
    """

    bar: FourBar
    phi: Array
    full: bool

    @property
    def least_angle(self) -> float:
        """Least transmission angle of the turn, or of the swing, rad."""
        if self.full:
            return self.bar.least_transmission_angle()
        start, end = self.phi[0] - self.bar.ground_angle, self.phi[-1] - self.bar.ground_angle
        return self.bar.transmission_range(float(start), float(end))[0]


def linkage(a0: complex, b0: complex, a: Plane, b: Plane) -> FourBar:
    """The linkage with these fixed pivots and joints (n,), on the branch of its first position."""
    ground = b0 - a0
    side = (np.conj(b0 - a[0]) * (b[0] - a[0])).imag
    return FourBar(
        float(np.abs(a - a0).mean()),
        float(np.abs(b - a).mean()),
        float(np.abs(b - b0).mean()),
        abs(ground),
        float(np.angle(ground)),
        1 if side > 0 else -1,
    )


def loosely(a0: complex, b0: complex, a: Plane, b: Plane) -> Way:
    """A linkage on the branch of most positions (n,), whatever its defects: where a fit begins."""
    bar = linkage(a0, b0, a, b)
    side = 1 if np.sign((np.conj(b0 - a) * (b - a)).imag).sum() >= 0 else -1
    return Way(replace(bar, branch=side), np.unwrap(np.angle(a - a0)), bar.kind.full_turn)


def way_through(a0: complex, b0: complex, a: Plane, b: Plane, ordered: bool = True) -> Way | str:
    """How the crank at ``a0`` goes through joints A and B (n,), mm; else the defect that keeps it from that.

    The defects are ``branch`` (positions on both sides of the line A-B0), ``circuit`` (positions in ranges
    of the crank that are not connected) and ``order``.
    """
    bar = linkage(a0, b0, a, b)
    sides = (np.conj(b0 - a) * (b - a)).imag
    if not ((sides > 0).all() or (sides < 0).all()):
        return "branch"
    phi = np.angle((a - a0) * np.exp(-1j * bar.ground_angle))
    full = bar.kind.full_turn
    passed = passing(phi, None if full else reach(bar), ordered)
    return passed if isinstance(passed, str) else Way(bar, passed + bar.ground_angle, full)

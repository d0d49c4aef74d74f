"""Masses of the parts of Geneva mechanisms over a table, as :mod:`mechwright_geneva.parts.parts` draws them.

Areas are integrals along outlines, 2 dA = Im(z̄ dz): of arcs in closed form, of walls and reliefs by Gauss'
quadrature between the breaks of the law.
"""

import math
from collections.abc import Callable
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from mechwright import Array, material
from mechwright.contracts.figure import PartMass
from mechwright.contracts.mass import KILOGRAMS
from mechwright.mechanics.linkage.areas import circle_area, hull_area
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Points
from mechwright_geneva.kinematics.mechanism import BLOCK, Mechanism
from mechwright_geneva.parts.crank_outline import boss_radius, hub_radius, pin_bore, pins, stud_diameter
from mechwright_geneva.parts.locking_disc import Half
from mechwright_geneva.parts.openings import opening_area
from mechwright_geneva.parts.slot_outline import Slot

NODES = 24
"""Of a piece of a wall or relief: what is left is 1e-9 of a plate, for all laws by name."""

_CUTS = (0.25, 0.5, 0.75)


def masses_of(m: Mechanism) -> dict[str, PartMass] | None:
    """Masses of the parts, but of slots on a backing plate and of wheels with a counterbore."""
    if m.given.slots_made == "backed" or np.any(np.asarray(m.params.counterbore_diameter) > 0):
        return None
    weights = Weights(m)
    hub = {"hub": PartMass(weights.hub)} if np.any(np.asarray(m.params.hub_diameter) > 0) else {}
    return {
        "wheel": PartMass(weights.wheel),
        **hub,
        "locking-disc": PartMass(weights.disc),
        "crank": PartMass(weights.crank),
        "roller": PartMass(weights.roller, m.params.rollers),
    }


class Weights:
    """Masses (n, 1) of the parts of designs of a table, kg."""

    def __init__(self, m: Mechanism) -> None:
        self.m, self.params = m, m.params
        self.density = KILOGRAMS * material(m.params.material).density
        self.has_hub = np.asarray(m.params.hub_diameter) > 0
        self.dowels = 2 * circle_area(np.asarray(m.params.fixing))

    @cached_property
    def _wheel_holes(self) -> Any:
        """Area of bore and dowels."""
        params = self.params
        opening = opening_area(params.bore, params.keyway_width, params.keyway_relief)
        return opening + np.where(self.has_hub, self.dowels, 0.0)

    @cached_property
    def _driver_holes(self) -> Any:
        """Area of bore and dowels."""
        params = self.params
        opening = opening_area(params.driver_bore, params.driver_keyway_width, params.keyway_relief)
        return opening + self.dowels

    def wheel(self) -> Any:
        """With its slots, cut through or blind."""
        m, thickness = self.m, self.params.thickness
        slots = m.slots * (_straight_slot(m) if m.straight else m.each(_curved_slot, BLOCK))
        deep = thickness if self.params.slots_made == "through" else self.params.groove_depth
        return self.density * ((_disc(m) - self._wheel_holes) * thickness - slots * deep)

    def hub(self) -> Any:
        """The plate under the wheel."""
        ring = circle_area(np.asarray(self.params.hub_diameter)) - self._wheel_holes
        return self.density * np.where(self.has_hub, ring * self.params.hub_height, 0.0)

    def disc(self) -> Any:
        """The locking disc."""
        area = self.m.each(_locking_disc, BLOCK) - self._driver_holes
        params = self.params
        return self.density * area * params.disc_thickness

    def crank(self) -> Any:
        """With a boss about each roller's pin."""
        m, centres = self.m, [np.ravel(pin) for pin in pins(self.m)]
        radii = [np.ravel(hub_radius(m)), *[np.ravel(boss_radius(m))] * len(centres)]
        bores = self._driver_holes + len(centres) * circle_area(pin_bore(m))
        area = hull_area([0j, *centres], radii, m.size)[:, None] - bores
        return self.density * area * self.params.crank_thickness

    def roller(self) -> Any:
        """With its stud; one that is pressed in is shown as it then is."""
        params = self.params
        stud = circle_area(stud_diameter(self.m)) * (params.axial_gap + params.crank_thickness)
        volume = circle_area(2 * self.m.roller) * params.roller_length + stud
        return KILOGRAMS * material(params.roller_material).density * volume


def _disc(m: Mechanism) -> Any:
    """The wheel without slots: rim and concave arcs."""
    bite = m.arc * m.axes * np.sin(m.arc_half) - m.arc_half * m.arc**2
    return m.slots * (m.rim**2 * (m.wheel_half - m.horn_angle) + bite)


def _straight_slot(m: Mechanism) -> Any:
    reach, r = Slot(m).reach, m.groove
    beyond = m.rim**2 * np.arcsin(r / m.rim) - r * reach
    return math.pi / 2 * r**2 + 2 * r * (reach - m.bottom) + beyond


def _curved_slot(m: Mechanism) -> Any:
    """Between both walls: what the one on the hub's side encloses with the rim, less the island."""
    return np.abs(_enclosed(m, LEFT) - _enclosed(m, RIGHT))


def _enclosed(m: Mechanism, side: int) -> Any:
    """Area (n, 1) between a wall of a curved slot and the rim."""
    slot, radius, axis = Slot(m), m.crank + side * m.groove, np.exp(1j * m.wheel_half)
    phi = slot.lead_angle(side)
    lead = radius**2 * (m.crank_half - phi) - radius * m.axes * (np.sin(m.crank_half) - np.sin(phi))
    found: Any = 0.0
    for end in m.ends:

        def wall(u: Array, end: int = end) -> Points:
            """The wall from an end on, the slot on +x, that of the way out in the mirror."""
            z: Points = slot.exact(side, np.abs(end - u)) * axis
            return np.conj(z) if end else z

        first = np.abs(end - slot.mouth(side, end))
        mouth = np.where(phi > m.crank_half, (m.axes - radius * np.exp(1j * phi)) * axis, wall(first))
        found = found + lead + _twice_swept(m, wall, first, 0.5) + m.rim**2 * np.angle(mouth)
    return np.abs(found) / len(m.ends)


def _locking_disc(m: Mechanism) -> Array:
    """Area (n, 1) inside of the locking disc's outline."""
    found = m.lock**2 * (m.pitch / 2 - m.crank_half)
    for end in m.ends:
        half = Half(m, leaving=end == 1)
        last = half.passing()
        s, t, _ = half.crossing(last)
        edge = _twice_swept(m, half.envelope, 0.0, s) - _twice_swept(m, half.horn, last, t)
        found = found + (edge - m.driver_radius**2 * np.angle(half.horn(last))) / len(m.ends)
    return np.asarray(m.params.rollers * found)


_NODES, _WEIGHTS = legendre.leggauss(NODES)

_SLOPES = legendre.legval(_NODES, legendre.legder(np.linalg.inv(legendre.legvander(_NODES, NODES - 1))))
"""Rates at the nodes (., j) of polynomials that are 1 at one node (i, .) and 0 at the others."""


def _twice_swept(m: Mechanism, curve: Callable[[Array], Points], first: Any, last: Any) -> Any:
    """Integral (n, 1) of Im(z̄ dz) along a curve, from one share (n, 1) of the stroke up to another one."""
    breaks = {round(abs(end - one), 12) for one in m.law.breaks for end in m.ends}
    found: Any = 0.0
    for one, two in pairwise(sorted({0.0, *_CUTS, *breaks, 1.0})):
        a, b = np.clip(one, first, last), np.clip(two, first, last)
        if (b > a).any():
            z = curve(a + (b - a) * (1 + _NODES) / 2)
            found = found + ((np.conj(z) * (z @ _SLOPES)).imag @ _WEIGHTS)[..., None]
    return found

"""Masses of the parts of many Geneva mechanisms, as :mod:`mechwright_geneva.parts.parts` draws them.

Areas are integrals along outlines, 2 dA = Im(z̄ dz): of arcs in closed form, of walls and reliefs by Gauss'
quadrature between the breaks of the law. A wall goes over the wheel as the roller does, V (1 ∓ κ r) for each
radian of the crank.
"""

import math
from collections.abc import Callable
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from mechwright import Array, material
from mechwright.contracts.figure import PartMass
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.mass import KILOGRAMS
from mechwright.mechanics.linkage.areas import circle_area, hull_area
from mechwright_geneva.kinematics.geometry import Points
from mechwright_geneva.kinematics.mechanism import BLOCK, Mechanism
from mechwright_geneva.parts.locking_disc import Half
from mechwright_geneva.parts.openings import opening_area

NODES = 24
"""Of a piece of a wall or relief: what is left is 1e-9 of a plate, for all laws by name."""

_GRID, _SECANTS = 129, 4
"""Samples of half a stroke among which a wall passes the rim, and steps from there: each gains the square of
a sample's distance, and areas feel the square of what is left."""

_CUTS = (0.25, 0.5, 0.75)


def masses_of(m: Mechanism) -> dict[str, PartMass] | None:
    """Of the parts that there are, for designs whose slots are not backed by a plate with islands."""
    if m.given.slots_made == "backed" or np.any(np.asarray(m.params.counterbore_diameter) > 0):
        return None
    weights = Weights(m)
    found = {"wheel": PartMass(weights.wheel)}
    if np.any(np.asarray(m.params.hub_diameter) > 0):
        found["hub"] = PartMass(weights.hub)
    return found | {
        "locking-disc": PartMass(weights.disc),
        "crank": PartMass(weights.crank),
        "roller": PartMass(weights.roller, m.params.rollers),
    }


class Weights:
    """Masses (m, 1) of the parts of designs that are alike but for sizes, kg."""

    def __init__(self, m: Mechanism) -> None:
        self.m = m
        self.density = KILOGRAMS * material(m.params.material).density

    @cached_property
    def _opening(self) -> Any:
        params = self.m.params
        return opening_area(params.bore, params.keyway_width, params.keyway_relief)

    @cached_property
    def _driver_opening(self) -> Any:
        params = self.m.params
        return opening_area(params.driver_bore, params.driver_keyway_width, params.keyway_relief)

    @cached_property
    def _dowels(self) -> Any:
        """Area of the holes for two dowels."""
        return 2 * circle_area(np.asarray(self.m.params.fixing))

    @property
    def _hub_dowels(self) -> Any:
        return np.where(np.asarray(self.m.params.hub_diameter) > 0, self._dowels, 0.0)

    def wheel(self) -> Any:
        """With its slots, cut through or blind."""
        m = self.m
        slots = m.slots * (self._straight_slot() if m.straight else self._curved_slot())
        plate = (self._round() - self._opening - self._hub_dowels) * m.params.thickness
        deep = m.params.thickness if m.params.slots_made == "through" else m.params.groove_depth
        return self.density * (plate - slots * deep)

    def hub(self) -> Any:
        """The plate under the wheel."""
        params = self.m.params
        ring = circle_area(np.asarray(params.hub_diameter)) - self._opening - self._hub_dowels
        return self.density * np.where(np.asarray(params.hub_diameter) > 0, ring * params.hub_height, 0.0)

    def _round(self) -> Any:
        """The wheel without slots: rim and concave arcs."""
        m = self.m
        bite = m.arc * m.axes * np.sin(m.arc_half) - m.arc_half * m.arc**2
        return m.slots * (m.rim**2 * (m.wheel_half - m.horn_angle) + bite)

    def _straight_slot(self) -> Any:
        m, r = self.m, self.m.groove
        reach = np.sqrt(m.rim**2 - r**2)
        beyond = m.rim**2 * np.arcsin(r / m.rim) - r * reach
        return math.pi / 2 * r**2 + 2 * r * (reach - m.bottom) + beyond

    def _curved_slot(self) -> Array:
        """Between both walls: what the one on the hub's side encloses with the rim, less the island."""
        sides = np.broadcast_to(np.asarray(self.m.side), (len(self.m), 1))
        found = np.empty((len(self.m), 1))
        for side in (-1, 1):
            rows = np.flatnonzero(sides[:, 0] == side)
            if rows.size:
                found[rows] = self.m.rows(rows).each(partial(_between_walls, side=side), BLOCK)
        return found

    def disc(self) -> Any:
        """The locking disc."""
        params = self.m.params
        area = self.m.each(_disc_area, BLOCK) - self._driver_opening - self._dowels
        return self.density * area * (params.thickness + params.axial_gap)

    def crank(self) -> Any:
        """With a boss about each roller's pin."""
        m, params = self.m, self.m.params
        inner, outer = m.driver_opening, m.driver_radius
        fixing = np.asarray(params.fixing)
        bare = inner + 2 * params.least_wall
        joined = np.maximum(bare, (inner + outer) / 2 + fixing / 2 + params.least_wall)
        hub = np.where(fixing > 0, joined, bare)
        boss = np.maximum(params.pin_diameter / 2 + params.least_wall, m.roller)
        turns = np.exp(1j * m.pitch * np.arange(params.rollers))
        places = [np.ravel(m.crank * turn) for turn in turns]
        area = hull_area([0j, *places], [np.ravel(hub), *[np.ravel(boss)] * len(places)], len(m))[:, None]
        area = area - self._driver_opening - self._dowels - params.rollers * circle_area(self._pin_bore)
        return self.density * area * params.crank_thickness

    @cached_property
    def _pin_bore(self) -> Any:
        """Diameter of the pins' bores in the crank, mm: the middle of their fit."""
        pin = np.asarray(self.m.params.pin_diameter, dtype=float)
        if self.m.params.pin_fit == "none":
            return pin
        sizes, which = np.unique(pin, return_inverse=True)
        middles = [hole_fit(size, self.m.params.pin_fit).middle for size in sizes.tolist()]
        return np.array(middles)[which].reshape(pin.shape)

    def roller(self) -> Any:
        """With its stud; one that is pressed in is shown as it then is."""
        params = self.m.params
        stud = circle_area(np.minimum(params.pin_diameter, self._pin_bore))
        volume = circle_area(2 * self.m.roller) * params.roller_length
        volume = volume + stud * (params.axial_gap + params.crank_thickness)
        return KILOGRAMS * material(params.roller_material).density * volume


_RULE = legendre.leggauss(NODES)


def _slopes() -> Array:
    """Rates at the nodes of a polynomial with given values there."""
    nodes = _RULE[0]
    basis = legendre.legvander(nodes, NODES - 1)
    rates = [legendre.legval(nodes, legendre.legder(one)) for one in np.eye(NODES)]
    return np.asarray(np.stack(rates, axis=1) @ np.linalg.inv(basis))


_SLOPES = _slopes()


def _pieces(m: Mechanism, first: Any, last: Any) -> list[tuple[Any, Any]]:
    """Ends (m, 1) of the smooth pieces from one share of the stroke up to another; empty ones between."""
    cuts = sorted({0.0, *_CUTS, *m.law.breaks, 1.0})
    return [(np.clip(a, first, last), np.clip(b, first, last)) for a, b in pairwise(cuts)]


def _along(m: Mechanism, curve: Callable[[Array], Points], first: Any, last: Any) -> Any:
    """Half the integral (m, 1) of Im(z̄ dz) along a curve from one share (m, 1) up to another one."""
    found: Any = 0.0
    for a, b in _pieces(m, first, last):
        if not (b > a).any():
            continue
        z = curve(a + (b - a) * (1 + _RULE[0]) / 2)
        found = found + ((np.conj(z) * (z @ _SLOPES.T)).imag @ _RULE[1])[..., None] / 2
    return found


def _between_walls(m: Mechanism, side: int) -> Array:
    return _enclosed(m, -side) - _enclosed(m, side)


def _enclosed(m: Mechanism, side: int) -> Array:
    """Area (m, 1) between a wall of a curved slot and the rim."""
    radius = m.crank + side * m.groove
    cosine = (m.axes**2 + radius**2 - m.rim**2) / (2 * m.axes * radius)
    phi = np.arccos(np.clip(cosine, -1.0, 1.0))
    inside = np.abs(m.stroke(np.array([0.0, 1.0])).wall(m.groove, side)) < m.rim
    lead, turn = m.axes - radius * np.exp(1j * phi), m.crank_half - phi
    arc = (radius**2 * turn - radius * m.axes * (np.sin(m.crank_half) - np.sin(phi))) / 2
    mirror = np.exp(-2j * m.wheel_half)

    def wall(u: Array) -> Points:
        return m.stroke(u).wall(m.groove, side)

    first = _mouth(m, side, 0, inside[:, :1])
    one = np.where(inside[:, :1], lead, wall(first))
    found = np.where(inside[:, :1], arc, 0.0)
    if m.law.symmetric:  # the way out is the way in, mirrored about the slot's axis
        two = np.conj(one) * mirror
        found = 2 * (found + _along(m, wall, first, np.full_like(first, 0.5)))
    else:
        last = _mouth(m, side, 1, inside[:, 1:])
        two = np.where(inside[:, 1:], np.conj(lead) * mirror, wall(last))
        found = found + np.where(inside[:, 1:], arc, 0.0) + _along(m, wall, first, last)
    return np.asarray(np.abs(found + m.rim**2 / 2 * np.angle(one * np.conj(two))))


def _mouth(m: Mechanism, side: int, end: int, inside: NDArray[np.bool_]) -> Array:
    """The share (m, 1) at which a wall begins or ends at the rim; of one inside of it there, that end."""
    found = np.full((len(m), 1), float(end))
    rows = np.flatnonzero(~inside[:, 0])
    if not rows.size:
        return found
    some = m.rows(rows)

    def away(u: Array) -> Any:
        return np.abs(some.stroke(u).wall(some.groove, side)) - some.rim

    grid = np.abs(end - np.linspace(0.0, 0.5, _GRID))
    place = np.maximum(np.argmax(away(grid) <= 0, axis=1), 1)[:, None]
    outer, inner = grid[place - 1], grid[place]
    far, near = away(outer), away(inner)
    for _ in range(_SECANTS):
        u = outer + (inner - outer) * far / (far - near)
        value = away(u)
        out = value > 0
        outer, far = np.where(out, u, outer), np.where(out, value, far)
        inner, near = np.where(out, inner, u), np.where(out, near, value)
    found[rows] = outer + (inner - outer) * far / (far - near)
    return found


def _disc_area(m: Mechanism) -> Array:
    """Area (m, 1) inside of the locking disc's outline."""
    deep = m.axes - m.rim - m.params.lock_clearance
    free = m.pitch - 2 * m.crank_half
    found = m.lock**2 / 2 * free
    for leaving in (False, not m.law.symmetric):
        half = Half(m, leaving=leaving)
        last = half.passing()
        s, t, _ = half.crossing(last)
        edge = _along(m, half.envelope, 0.0 * s, s) - _along(m, half.horn, last, t)
        found = found + edge - deep**2 / 2 * np.angle(half.horn(last))
    return np.asarray(m.params.rollers * found)

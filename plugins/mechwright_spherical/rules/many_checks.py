"""Errors of the links of many four-bars whose ground is outside of them, in the order of the check."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.defaults.preferred_sizes import CURED, NAMES, WALL, candidates, least_boss, left_out
from mechwright_spherical.parts.flat import SHARPEST
from mechwright_spherical.parts.frame import AIR
from mechwright_spherical.parts.stand import FLANGE_SCREWS, MOUNTING_SCREWS
from mechwright_spherical.rules.hardware_checks import LONGEST_GROUND

_EDGE = 1e-9
"""mm. A room that is so near to its limit is left to the check itself."""


_SIZES = ("standoff", "link_thickness", "boss_height", "fit", "gap", *NAMES)
"""Of the table hardware."""

Own = dict[str, Any]
"""Keys of that table to their values, one or (n,)."""


@dataclass(frozen=True)
class Rooms:
    """Least angles (n,), rad, from ends of crank and rocker to the other's arc and ends, and crossing."""

    arc: Array
    end: Array
    cross: NDArray[np.bool_]


@dataclass(frozen=True)
class Links:
    """Four-bars (n,) whose ground is outside of them.

    Parameters
    ----------
    some
        The designs.
    arcs
        (4, n) of ground, input, coupler and output, rad.
    near
        How near crank and rocker come.
    """

    some: Designs
    arcs: Array
    near: Rooms

    def own(self, sizes: Mapping[str, Any]) -> Own:
        """The table hardware with these sizes."""
        return {name: self.some[f"hardware.{name}"] for name in _SIZES} | dict(sizes)

    def shells(self, own: Own) -> tuple[Any, Any, Any, Any]:
        """Inner radii of coupler, crank and ground, mm, and the outer one of the ground."""
        thick = own["link_thickness"] + 2 * own["boss_height"]
        coupler = self.some["radius"] + own["standoff"]
        crank = coupler + thick + own["gap"]
        ground = crank + thick + own["gap"]
        return coupler, crank, ground, ground + thick

    def air(self, own: Own) -> Array:
        """Air, mm, as :func:`mechwright_spherical.kinematics.clearances.links_apart` has it."""
        radius, near = self.shells(own)[1], self.near
        arc, disc = np.arctan2(own["link_width"] / 2, radius), np.arctan2(own["boss_diameter"] / 2, radius)
        gaps = [np.where(near.cross, 0.0, near.arc) - 2 * arc, near.arc - arc - disc, near.end - 2 * disc]
        return np.asarray(radius * np.minimum.reduce(gaps))

    def errors(self, own: Own) -> Iterator[tuple[str, Any]]:
        """Codes of errors, and which designs have them, in the order of the check."""
        _, crank, _, outside = self.shells(own)
        boss, over = own["boss_diameter"], crank - own["gap"]
        yield "spherical.boss", _short(boss, least_boss(own["pin_diameter"], own["fit"]))
        yield "spherical.gap", own["gap"] <= np.hypot(over, boss / 2) - over
        yield from (("spherical.shafts", one) for one in self._shafts(own))
        yield "spherical.clearance", ~np.asarray(~(self.air(own) < AIR))
        yield from (("spherical.stand", one) for one in _stands(self.some, self.arcs, own, outside))
        if self.some["flat.make"] is True:
            yield from (("spherical.strip", one) for one in self._strips(own))

    def _shafts(self, own: Own) -> Iterator[Any]:
        coupler, crank, ground, _ = self.shells(own)
        some, arcs = self.some, self.arcs
        bored, bossed = own["pin_diameter"] + own["fit"] + WALL, own["boss_diameter"] + AIR
        kappa, eta = np.radians(some["four_bar.point_azimuth"]), np.radians(some["four_bar.point_elevation"])
        to_a, to_b = (np.arccos(np.clip(np.cos(eta) * np.cos(x), -1, 1)) for x in (kappa, kappa - arcs[2]))
        for angle, diameter, there in (
            (arcs[2], bossed, crank),
            (arcs[0], bored, ground),
            (arcs[1], bored, crank),
            (arcs[3], bored, crank),
            (to_a, bored, coupler),
            (to_b, bored, coupler),
        ):
            with np.errstate(divide="ignore"):  # a point on a pin needs a sphere without end
                needed = diameter / 2 / np.tan(angle / 2)
            yield exceeds(needed, there)

    def _strips(self, own: Own) -> Iterator[Any]:
        coupler, crank, ground, _ = self.shells(own)
        for angle, inner in zip(self.arcs, (ground, crank, coupler, crank), strict=True):
            bend = angle / np.ceil(angle / SHARPEST - 1e-9)
            leg = (inner + own["boss_height"] - self.some["flat.bend_radius"]) * np.tan(bend / 2)
            yield _short(leg, own["boss_diameter"] / 2)


def hardware_errors(
    found: Answer, designs: Designs, arcs: Array, rooms: Callable[[NDArray[np.intp]], Rooms]
) -> None:
    """Forbid what the check of links, pins, stand and strips forbids; doubt what may stand on both sides."""
    left = found.left
    if not left.size:
        return
    links = Links(designs.some(left), arcs[:, left], rooms(left))
    own, outside = _sized(links)
    found.doubt(np.abs(links.air(own) - AIR) < _EDGE, left)
    if designs.common.hardware.frame == "auto":
        found.doubt(~outside, left)
    for code, wrong in links.errors(own):
        found.forbid(code, np.broadcast_to(wrong, left.shape), left)
    if "flat.make" in designs.varied:
        found.doubt(np.ones(left.size, bool), left)


def _sized(links: Links) -> tuple[Own, NDArray[np.bool_]]:
    """The table hardware with the sizes that each design has by itself, and where usual ones pass outside."""
    some, size = links.some, links.near.arc.size
    common = some.common.hardware
    out = {name for name in left_out(common) if f"hardware.{name}" not in some.varied}
    given = {name: some[f"hardware.{name}"] for name in NAMES if name not in out}
    rows = [
        links.own({name: getattr(one, name) for name in NAMES})
        for one in candidates(given, some["hardware.fit"])
    ]
    outside = np.asarray(~(links.air(rows[0]) < AIR))
    wrong = list(links.errors(rows[0]))
    other = np.any([np.broadcast_to(one, size) for code, one in wrong if code not in CURED], axis=0)
    choice = np.zeros(size, np.intp)
    todo = np.any([np.broadcast_to(one, size) for _, one in wrong], axis=0) & ~other
    for number, row in enumerate(rows[1:] if out else (), start=1):
        if not todo.any():
            break
        sound = ~np.any([np.broadcast_to(one, size) for _, one in links.errors(row)], axis=0)
        choice[todo & sound] = number
        todo &= ~sound
    chosen = {
        name: np.choose(choice, [np.broadcast_to(row[name], size) for row in rows]) for name in sorted(out)
    }
    return links.own(given | chosen), outside


def _short(value: Any, limit: Any) -> Any:
    return np.asarray(falls_short(value, limit))


def _stands(some: Designs, arcs: Array, own: Own, outside: Any) -> Iterator[Any]:
    plate, screw, height, arc = (some[f"stand.{name}"] for name in ("plate", "screw", "height", "arc"))
    flange = 2 * (math.hypot(*FLANGE_SCREWS[0]) * plate + 1.5 * screw)
    wide = np.maximum(own["boss_diameter"], flange * outside / (outside + height))
    needed = np.arctan2(own["boss_diameter"] / 2 + AIR, outside) + np.arctan2(wide / 2, outside)
    rim = (0.5 - abs(MOUNTING_SCREWS[0][0])) * plate
    yield exceeds(np.degrees(arcs[0]) + arc, LONGEST_GROUND)
    yield _short(np.radians(arc), needed)
    yield _short(rim, screw) | exceeds(flange, plate)
    yield _short(height, own["link_thickness"])

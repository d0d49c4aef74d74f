"""The base plate, and the end of the crank's shaft below it.

A base with screw holes goes on legs: it reaches under all that moves, its holes lie beside that, and the
shaft's end has a bore in which couplings are sold. A circlip under the base holds the shaft, where there is
one of its diameter.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from mechwright import DesignError, Outline
from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.turned import Groove, Length, Step, Turned
from mechwright.mechanics.linkage import (
    PIN_MATERIAL,
    Boss,
    Mass,
    cylinder_mass,
    rectangle,
)
from mechwright.mechanics.linkage.turned import LENGTH, LIMIT
from mechwright.standards.circlips import Circlip, shaft_circlip
from mechwright.standards.couplings import BORES, couplings
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.dimensions import CORNER, Dimensions

TAIL_SHARE = 1.5
"""How far the shaft sticks out under a base without screw holes, over its diameter: room for a handle."""

EDGE_SHARE = 1.5
"""From a screw's axis to the base's rim, over the diameter of its hole."""

HEAD_SHARE, BESIDE = 1.5, 3.0
"""Diameter of a screw's head over its hole's, at most, and air between it and what moves, mm."""

UNDER = 1.5
"""From what stands out under the base to a coupling, mm: air of 1, and the break of an edge."""


WALL, LOADED = (0.0, 0.1), "upper end of the shaft to the loaded wall of the groove"
"""Limits of the length that decides the float of the shaft, mm, and its name."""

FLOAT = (0.1, 1.0)
"""Float of the shaft that is meant, mm, beside the gaps over and under the base."""


@dataclass(frozen=True)
class ShaftEnd:
    """The shaft below the base.

    Parameters
    ----------
    diameter, length
        Of its end, mm.
    neck
        Length between the base and that end, as thick as the shaft, mm.
    ring
        The circlip on the neck.
    """

    diameter: float
    length: float
    neck: float = 0.0
    ring: Circlip | None = None

    @property
    def whole(self) -> float:
        """Length below the base, mm."""
        return self.neck + self.length


def shaft_end(table: Mechanism) -> ShaftEnd:
    """As long as the longest coupling needs, where the base has holes for the screws of legs."""
    shaft = table.dimensions.shaft
    if table.given.screw_hole is None:
        return ShaftEnd(shaft, TAIL_SHARE * shaft)
    diameter = max((bore for bore in BORES if bore <= shaft), default=shaft)
    length = UNDER + max(one.length for one in couplings()) / 2
    try:
        ring = shaft_circlip(shaft)
    except DesignError:
        return ShaftEnd(diameter, length)
    return ShaftEnd(diameter, length, table.given.gap + ring.width + ring.edge, ring)


def shaft_form(table: Mechanism, length: float) -> Turned:
    """The shaft, ``length`` mm from the base's underside upwards."""
    shaft, end = table.dimensions.shaft, shaft_end(table)
    if end.diameter == shaft:
        steps: tuple[Step, ...] = (Step(shaft, length + end.whole),)
    else:
        steps = (Step(end.diameter, end.length), Step(shaft, length + end.neck))
    if end.ring is None:
        return Turned(steps)
    ring = end.ring
    # Its lower side is the ring's seat: the upper one has the base's air above it.
    groove = Groove(end.whole - table.given.gap - ring.width, ring.width, ring.groove, ring.tolerance)
    held = Length(LOADED, groove.at, length + end.whole, *WALL)
    return Turned(steps, grooves=(groove,), lengths=(held,))


def shaft_stacks(table: Mechanism, length: float) -> Iterator[AxialStack]:
    """The float of the shaft between crank and circlip; nothing without a circlip or under a high crank."""
    ring, given = shaft_end(table).ring, table.given
    if ring is None or abs(length - 2 * given.thickness - given.gap) > given.gap:
        return
    off, thick = general_length(given.thickness, "medium"), given.thickness
    if given.bushing > 0:
        base = StackLength(LENGTH, -1, thick + given.gap, -LIMIT, LIMIT, part="shaft-bushing")
    else:
        base = StackLength("base, ISO 2768-m", -1, thick, -off, off, part="base")
    yield AxialStack(
        "float of the shaft",
        (
            StackLength.of(shaft_form(table, length).length_of(LOADED), 1, "shaft"),
            StackLength("crank, ISO 2768-m", -1, thick, -off, off, part="crank"),
            base,
            StackLength("circlip", -1, ring.thickness, -ring.thinner, 0.0, True, ring.part_name),
        ),
        FLOAT[0],
        FLOAT[1] + 2 * given.gap,
        adjustable=LOADED,
    )


def shaft_masses(table: Mechanism, length: Any) -> list[Mass]:
    """The masses of the shaft and of the ring on it."""
    if table.given.screw_hole is None:
        end = shaft_end(table)
        return [cylinder_mass(end.diameter, length + end.whole, PIN_MATERIAL)]
    form, ring = shaft_form(table, length), shaft_end(table).ring
    found = [cylinder_mass(step.diameter, step.length, PIN_MATERIAL) for step in form.steps]
    if ring is None:
        return found
    cut = cylinder_mass(ring.size, ring.width, PIN_MATERIAL, bore=ring.groove)
    mass = ring.mass / 1000
    inertia = mass * (ring.groove**2 + ring.room**2) / 8
    return [*found, Mass(-cut.mass, 0j, -cut.inertia), Mass(mass, 0j, inertia)]


def hole_places(
    screw_offset: float | None,
    hole: float,
    swept: tuple[float, float, float, float],
    rim: tuple[complex, complex],
) -> tuple[complex, ...]:
    """Screw holes of this diameter in the base, counter-clockwise from the lower left one, x + i y, mm.

    Parameters
    ----------
    screw_offset
        Their least distance from the line of the slide, mm, where the design states it.
    swept
        Bounds x0, y0, x1, y1 of what moves, seen from the base.
    rim
        Least and greatest x + i y of what the base carries.
    """
    (x0, y0, x1, y1), (low, high) = swept, rim
    wide, beside = max(-low.imag, high.imag), HEAD_SHARE * hole / 2 + BESIDE
    if screw_offset is None:
        offset = float(math.ceil(max(-y0, y1, wide) + beside))
    else:
        offset = max(screw_offset, wide + beside)
    left, right = math.floor(min(x0, low.real)), math.ceil(max(x1, high.real))
    half = max((right - left) / 2 - EDGE_SHARE * hole, EDGE_SHARE * hole)
    middle = (left + right) / 2
    return tuple(complex(middle + a * half, b * offset) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)))


def base_outline(
    hole: float | None, rim: tuple[complex, complex], holes: Sequence[Boss], screws: Sequence[complex]
) -> Outline:
    """A rectangle about what it carries, and about its screw holes."""
    low, high = rim
    if hole is None:
        return rectangle(low, high, CORNER, holes)
    # The screws stand beside and beyond all that it carries.
    edge = EDGE_SHARE * hole * (1 + 1j)
    bores = [Boss(at, 0, hole, "screw") for at in screws]
    return rectangle(screws[0] - edge, screws[2] + edge, EDGE_SHARE * hole, (*holes, *bores))


def rim_of(sizes: Dimensions, rail: Outline, rails: Sequence[complex]) -> tuple[complex, complex]:
    """Least and greatest x + i y of the shaft's bore with its wall, and of the rails."""
    x0, y0, x1, y1 = rail.bounds
    reach = sizes.base_bore / 2 + sizes.wall
    xs = [-reach, reach, *(place.real + x for place in rails for x in (x0, x1))]
    ys = [-reach, reach, *(place.imag + y for place in rails for y in (y0, y1))]
    return complex(min(xs), min(ys)), complex(max(xs), max(ys))

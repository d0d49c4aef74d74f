"""The base plate on four feet, and the legs from it to the lower bearing plate, under the pillars."""

import math
from collections.abc import Sequence

from mechwright.contracts.bought import BlindThread, Bought
from mechwright.contracts.shape import Shape, ring
from mechwright.contracts.surroundings import Place
from mechwright.contracts.turned import EndThread, Length, Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.fixing import fixing, put_fixing
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import EDGE, NOTE, PILLAR, PITCH, SCREW, SPARE, Column, put_screw
from mechwright.machine.frame.plates import Hole, add_plate, stock_for
from mechwright.machine.frame.standing import Standing
from mechwright.mechanics.strength.allowed import allowed
from mechwright.mechanics.strength.tightening import bond_torque
from mechwright.standards.screws import Screw, screw

MARGIN = 16.0
"""By how much the base plate is larger than the bearing plates on every side, mm: it stands wider."""

LEAST, MOST, SLENDER = 10.0, 25.0, 15.0
"""Thickness of the base plate, mm, at least and at most, and its longer side in thicknesses between them.
With a foot beside every leg it carries little but itself."""

UNDER = 10.0
"""Between the motor and the base plate, mm: its cable, and air."""

FOOT = (20.0, 15.0, 6.0)
"""Diameter and height of a foot and the depth of its thread, mm: higher than a screw's head."""

LEG = 0.05
"""Limit deviations of the height of a leg, plus and minus, mm."""

HOLE = 6.0
"""Of the base plate's screws, mm: a drill, for mills of the clearance's size do not reach through."""

RUBBER = 1.2e-3
"""Density, g/mm³; handbook."""


def foot() -> Bought:
    """A rubber foot with a thread in its upper end; it stands on z = 0."""
    wide, high, deep = FOOT
    words = f"rubber buffer {wide:g} x {high:g} with thread M{SCREW:g} x {deep:g} inside"
    shape = Shape((ring(0.0, wide, high),), (ring(0.0, SCREW, deep, high - deep),))
    thread = BlindThread((0.0, 0.0), high, SCREW, deep, allowed("steel").shear, bond_torque(wide))
    return Bought(
        words,
        "",
        round(RUBBER * math.pi / 4 * wide**2 * high, 1),
        shape,
        "no standard fixes it; compare with the maker's sheet",
        (thread,),
    )


def add_foot(kit: Kit, name: str, point: Point, top: float, thickness: float) -> None:
    """A foot under a plate whose upper face is at ``top``, mm, and the screw that goes down into it.

    Raises DesignError where no screw that is sold goes deep enough into the foot, and not too deep.
    """
    (thread,) = foot().threads
    kit.places[name] = Place((*point, 0.0))
    try:
        found = fixing(thread.diameter, thickness, thread.depth)
    except DesignError as error:
        raise DesignError(f"machine.plates: {error}; leave it out") from error
    put_fixing(kit, found, name, top)
    kit.bought("foot", foot(), name, top - thickness - FOOT[1])


def base_stock(wanted: float, in_hand: Sequence[float] = ()) -> float:
    """The least plate that is at least so thick, mm, and whose feet have a screw that is sold.

    >>> base_stock(12, (16.6,)), base_stock(12, (16.6, 19))
    (12.0, 19.0)
    """
    return stock_for(wanted, [one for one in in_hand if _has_foot_screw(one)])


def _has_foot_screw(thickness: float) -> bool:
    (thread,) = foot().threads
    try:
        fixing(thread.diameter, thickness, thread.depth)
    except DesignError:
        return False
    return True


def thickness_for(standing: Standing, in_hand: Sequence[float] = ()) -> float:
    """Of the base plate, mm; of the plates in hand, if there are any."""
    longer = standing.longer + 2 * (EDGE + MARGIN)
    return base_stock(min(max(LEAST, longer / SLENDER), MOST), in_hand)


def leg_screw(thickness: float) -> Screw:
    """From below the base plate into a leg."""
    return screw(SCREW, thickness + SCREW)


def add_base(
    kit: Kit,
    standing: Standing,
    columns: list[Column],
    under: float,
    top: float,
    depth: float,
    material: str,
    in_hand: Sequence[float] = (),
) -> None:
    """Base plate, legs, feet, screws.

    Parameters
    ----------
    under, top
        Lower face of the bearing plate, and upper face of the base plate, mm.
    depth
        How deep the studs of the pillars go into the legs, mm.
    in_hand
        Thicknesses of plate, mm.
    """
    thickness = thickness_for(standing, in_hand)
    low = top - thickness
    fixing = leg_screw(thickness)
    leg = Turned(
        (Step(PILLAR, under - top),),
        note=NOTE.replace("pillars", "legs"),
        lengths=(Length("height of the legs", 0.0, under - top, -LEG, LEG),),
        threads=(
            EndThread("lower", SCREW, PITCH, fixing.length - thickness + SPARE),
            EndThread("upper", SCREW, PITCH, depth + SPARE),
        ),
    )
    holes = []
    for k, column in enumerate(columns, start=1):
        holes.append(Hole.through(f"leg-{k}", column.point, HOLE, thickness))
        kit.turned("leg", leg, column.name, top)
        put_screw(kit, fixing, f"{column.name}-below", -low)
    edge = EDGE + MARGIN
    inset = edge - FOOT[0] / 2 - 2.0
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    for k, ((x, y), (a, b)) in enumerate(zip(standing.corners, signs, strict=True), start=1):
        point = (x + a * inset, y + b * inset)
        holes.append(Hole.through(f"foot-{k}", point, HOLE, thickness))
        add_foot(kit, f"foot-{k}", point, top, thickness)
    kit.places["base-carrier"] = Place()
    add_plate(kit, "base-plate", standing, edge, thickness, material, holes, "base-carrier", low)

"""The base plate on four feet, and the legs from it to the lower bearing plate, under the pillars."""

import math
from collections.abc import Sequence

from mechwright.contracts.bought import BlindThread, Bought
from mechwright.contracts.materials import material
from mechwright.contracts.shape import Shape, ring
from mechwright.contracts.surroundings import Place
from mechwright.contracts.turned import Length, Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.fixing import Fixing, fixing, put_fixing
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import (
    EDGE,
    NOTE,
    PILLAR,
    SCREW,
    Column,
    end_threads,
    spanner_flats,
)
from mechwright.machine.frame.plates import Hole, add_plate
from mechwright.machine.frame.standing import Standing
from mechwright.mechanics.strength.allowed import allowed
from mechwright.mechanics.strength.tightening import bond_torque
from mechwright.standards.ordering import UNIFIED, inch_length
from mechwright.standards.screws import needs_washer, screw, through_hole, washer
from mechwright.standards.stock import plate_stock

MARGIN = 16.0
"""By how much the base plate is larger than the bearing plates on every side, mm: it stands wider."""

LEAST = 8.0
"""Thickness of the base plate at least, mm: room for the chamfers of its holes, and stiff in the hand."""

HAND, WEIGHT, SAG = 100.0, 1e-3, 1 / 2000
"""What the base plate carries in its middle: a hand, N, and the machine, N on each mm², which is 100 kg on a
square metre; and by which share of its length it may give way."""

UNDER = 10.0
"""Between the motor and the base plate, mm: its cable, and air."""

FOOT = (20.0, 15.0, 6.0)
"""Diameter and height of a foot and the depth of its thread, mm: higher than a screw's head."""

LEG = 0.05
"""Limit deviations of the height of a leg, plus and minus, mm."""

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
        inch=f"rubber bumper {inch_length(wide)} x {inch_length(high)} in, thread {UNIFIED[SCREW]} inside",
    )


def washers_for(size: float, thickness: float, material: str) -> int:
    """How many washers lie under the head of a screw on the base plate."""
    return int(needs_washer(size, through_hole(size, thickness), material))


def foot_fixing(thickness: float, material: str) -> Fixing:
    """The screw from above the base plate into a foot; raises DesignError where none that is sold fits."""
    (thread,) = foot().threads
    washers = washers_for(thread.diameter, thickness, material)
    return fixing(thread.diameter, thickness, thread.depth, washers=washers)


def add_foot(kit: Kit, name: str, point: Point, top: float, thickness: float, material: str) -> None:
    """A foot under a plate whose upper face is at ``top``, mm, and the screw that goes down into it.

    Raises DesignError where no screw that is sold goes deep enough into the foot, and not too deep.
    """
    kit.places[name] = Place((*point, 0.0))
    try:
        found = foot_fixing(thickness, material)
    except DesignError as error:
        raise DesignError(f"machine.plates: {error}; leave it out") from error
    put_fixing(kit, found, name, top)
    kit.bought("foot", foot(), name, top - thickness - FOOT[1])


def least_thickness(size: Point, name: str) -> float:
    """Of a base plate of a width and a height, mm, as a beam between its shorter sides.

    With load F, length L and width b its thickness t follows from F L³/(4 E b t³) = :data:`SAG` L and from
    3 F L/(2 b t²), at most what the material bears for long.

    >>> [round(least_thickness((332.0, 192.0), one), 1) for one in ("steel", "aluminium", "pom")]
    [8.0, 8.8, 25.6]
    """
    width, length = sorted(size)
    load = HAND + WEIGHT * width * length
    stiff = math.cbrt(load * length**2 / (4 * material(name).modulus * width * SAG))
    strong = math.sqrt(3 * load * length / (2 * width * allowed(name).endurance))
    return max(LEAST, stiff, strong)


def base_stock(wanted: float, material: str, in_hand: Sequence[float] = ()) -> float:
    """The least plate that is at least so thick, mm, and whose feet have a screw that is sold.

    Raises DesignError where none is so thick.

    >>> base_stock(12, "aluminium", (16.6,)), base_stock(12, "aluminium", (16.6, 19))
    (12.0, 19.0)
    """
    for sizes in (in_hand, plate_stock(material).thicknesses):
        fitting = [one for one in sizes if one >= wanted and _has_foot_screw(one, material)]
        if fitting:
            return float(min(fitting))
    raise DesignError(
        f"machine.plate_material: no base plate of {material} is sold {wanted:.1f} mm thick or thicker; "
        'set plate_material = "aluminium"'
    )


def _has_foot_screw(thickness: float, material: str) -> bool:
    try:
        foot_fixing(thickness, material)
    except DesignError:
        return False
    return True


def thickness_for(standing: Standing, material: str, in_hand: Sequence[float] = ()) -> float:
    """Of the base plate, mm; of the plates in hand, if there are any."""
    wide, high = (one + 2 * (EDGE + MARGIN) for one in standing.size)
    return base_stock(least_thickness((wide, high), material), material, in_hand)


def leg_fixing(thickness: float, material: str) -> tuple[Fixing, float]:
    """The screw from below the base plate into a leg, and how deep it goes into that, mm."""
    washers = washers_for(SCREW, thickness, material)
    grip = thickness + (washer(SCREW).height if washers else 0.0)
    found = screw(SCREW, grip + SCREW)
    return Fixing(found, washers), found.length - grip


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
    thickness = thickness_for(standing, material, in_hand)
    low = top - thickness
    found, engaged = leg_fixing(thickness, material)
    leg = Turned(
        (Step(PILLAR, under - top),),
        note=NOTE.replace("pillars", "legs"),
        lengths=(Length("height of the legs", 0.0, under - top, -LEG, LEG),),
        threads=end_threads(engaged, depth),
        flats=spanner_flats(under - top),
    )
    holes, clear = [], through_hole(SCREW, thickness)
    for k, column in enumerate(columns, start=1):
        holes.append(Hole.through(f"leg-{k}", column.point, clear, thickness))
        kit.turned("leg", leg, column.name, top)
        put_fixing(kit, found, f"{column.name}-below", -low)
    edge = EDGE + MARGIN
    inset = edge - FOOT[0] / 2 - 2.0
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    for k, ((x, y), (a, b)) in enumerate(zip(standing.corners, signs, strict=True), start=1):
        point = (x + a * inset, y + b * inset)
        holes.append(Hole.through(f"foot-{k}", point, clear, thickness))
        add_foot(kit, f"foot-{k}", point, top, thickness, material)
    kit.places["base-carrier"] = Place()
    add_plate(kit, "base-plate", standing, edge, thickness, material, holes, "base-carrier", low)

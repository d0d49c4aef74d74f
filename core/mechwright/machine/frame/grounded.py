"""A base under a mechanism with a ground plate of its own, or the motor alone behind that plate.

From above: the ground plate, pillars under its four holes, the plate with the motor, legs, and the base plate
on its feet. Without a motor the legs go up to the ground plate. All of it stands in the ground plate's frame.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import GroundPlate
from mechwright.contracts.surroundings import Place, Surroundings
from mechwright.errors import DesignError
from mechwright.machine.frame.base import UNDER, add_base, leg_fixing, thickness_for
from mechwright.machine.frame.coupled import (
    PLATE,
    Coupled,
    add_motor,
    coupling_below,
    face_below,
    fasten_motor,
    motor_holes,
    outline,
)
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.fixing import Fixing, put_fixing
from mechwright.machine.frame.ground_refusals import (
    GroundError,
    coupling_on,
    foot_of,
    key_faults,
    longer,
    lowest_of,
    motor_wanted,
    refusal,
    washers_on,
)
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import (
    EDGE,
    SCREW,
    SPARE,
    Column,
    cap_screw,
    columns,
    least_bar,
    pillar,
    put_screw,
    stud,
)
from mechwright.machine.frame.plates import Hole, add_plate
from mechwright.machine.frame.standing import Standing
from mechwright.machine.frame.sweep import Space
from mechwright.standards.screws import screw_size, washer


def base_under(
    keys: FrameKeys, ground: GroundPlate, space: Space, motion: Motion, wanted: Wanted
) -> Surroundings:
    """Base, legs and motor under a ground plate; no parts where a finding is an error.

    ``space``: what the mechanism takes in all its settings.
    """
    faults = key_faults(keys, ground)
    if faults:
        return Surroundings(findings=tuple(faults))
    try:
        coupling = coupling_on(ground, wanted)
        angle = foot_of(keys, ground, space, motion, wanted, coupling)
        coupled = None
        if wanted.motor is not None and coupling is not None:
            low = coupling_below(ground.end, coupling.of.length)
            face = face_below(wanted.motor.face, low, coupling.of.length)
            coupled = Coupled(wanted.motor, coupling, ground.axis, angle, low, face)
        if keys.frame == "plate":
            kit = behind(ground, coupled, keys.plate_material)
        else:
            kit = built(ground, coupled, keys, lowest_of(ground, space.pieces))
    except DesignError as error:
        return Surroundings(findings=(refusal(error),))
    places = {
        name: replace(place, on=ground.body) if place.on == GROUND else place
        for name, place in kit.places.items()
    }
    return Surroundings(tuple(kit.parts.values()), places)


def built(ground: GroundPlate, coupled: Coupled | None, keys: FrameKeys, lowest: float) -> Kit:
    """All parts, in the ground plate's frame, under a mechanism whose lowest height is given, mm.

    Raises DesignError where no screw is long enough.
    """
    kit, material = Kit(), keys.plate_material
    (standing, posts), depth = _columns(kit, ground)
    under = ground.low
    if coupled is not None:
        joint = stud(PLATE, depth + SPARE)
        below = (joint.length - PLATE) / 2
        _add_motor(kit, ground, coupled, (standing, posts), depth, material, below)
        for post in posts:
            put_screw(kit, joint, post.name, coupled.top + below)
        depth = below
        under, lowest = coupled.face, coupled.low
    _, foot = leg_fixing(thickness_for(standing, material, keys.plates), material)
    top = min(lowest - UNDER, under - least_bar(foot, depth))
    add_base(kit, standing, list(posts), under, top, depth, material, keys.plates)
    return kit


def behind(ground: GroundPlate, coupled: Coupled | None, material: str) -> Kit:
    """The motor on four pillars behind the ground plate, which hangs where it is wanted."""
    if coupled is None:
        raise GroundError(motor_wanted())
    kit = Kit()
    where, depth = _columns(kit, ground)
    fixing = cap_screw(PLATE)
    _add_motor(kit, ground, coupled, where, depth, material, fixing.length - PLATE)
    for post in where[1]:
        put_screw(kit, fixing, f"{post.name}-below", -coupled.face)
    return kit


def _columns(kit: Kit, ground: GroundPlate) -> tuple[tuple[Standing, Sequence[Column]], float]:
    """Places of the pillars, screws through the ground plate unless it has its own, and their depth, mm."""
    (x0, y0), (x1, y1) = ground.holes[0], ground.holes[2]
    standing = Standing(x0, y0, x1, y1)
    posts = columns(standing.corners)
    for post in posts:
        post.place(kit)
    if ground.bolts is not None:
        return (standing, posts), ground.bolts[1]
    count = washers_on(ground)
    grip = ground.high - ground.low + count * washer(SCREW).height
    found = cap_screw(grip)
    for post in posts:
        put_fixing(kit, Fixing(found, count), post.name, ground.high)
    return (standing, posts), found.length - grip


def _add_motor(
    kit: Kit,
    ground: GroundPlate,
    coupled: Coupled,
    where: tuple[Standing, Sequence[Column]],
    depth: float,
    material: str,
    below: float,
) -> None:
    """Pillars, screws ``depth`` mm deep in them from above and ``below`` mm from below, the motor's plate."""
    standing, posts = where
    height, need = ground.low - coupled.top, least_bar(below, depth)
    if height < need:
        said = f"pillars of {height:.1f} mm beside it have no room for threads in both ends"
        raise GroundError(longer(ground, said, need - height))
    add_motor(kit, coupled, ground.shaft)
    x0, y0, x1, y1 = outline(coupled.motor.face, coupled.axis, coupled.angle).bounds
    wide = Standing(
        min(standing.left, math.floor(x0) + EDGE),
        min(standing.below, math.floor(y0) + EDGE),
        max(standing.right, math.ceil(x1) - EDGE),
        max(standing.above, math.ceil(y1) - EDGE),
    )
    clear = screw_size(SCREW).clearance()
    holes = [replace(hole, point=coupled.at(hole.point)) for hole in motor_holes(coupled.motor.face)]
    holes += [Hole.through(post.name, post.point, clear, PLATE) for post in posts]
    holes += [
        Hole.through(f"access-{k}", at, 2 * radius, PLATE)
        for k, (at, radius) in enumerate(ground.access, start=1)
    ]
    carrier = "motor-carrier"
    kit.places[carrier] = Place()
    add_plate(kit, "motor-plate", wide, EDGE, PLATE, material, holes, carrier, coupled.face)
    for post in posts:
        form = pillar(height, below, depth, spigot=False)
        kit.turned("pillar", form, post.name, coupled.top)
    fasten_motor(kit, coupled)

"""A frame from the mounting of a mechanism: every decision in its order, or a finding that says why not."""

import math
from collections.abc import Sequence

import shapely

from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import Mounting
from mechwright.contracts.part import Part
from mechwright.contracts.surroundings import OVER, Place, Surroundings
from mechwright.errors import DesignError
from mechwright.machine.frame.base import UNDER, add_base
from mechwright.machine.frame.bracket import NoCouplingError, add_bracket, bracket_for, pillar_holes
from mechwright.machine.frame.decided import Frame, Wanted
from mechwright.machine.frame.findings import strength
from mechwright.machine.frame.free import in_the_way
from mechwright.machine.frame.guard import add_guard, widened
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.located import add_retainer, height_over
from mechwright.machine.frame.overload import overloaded
from mechwright.machine.frame.pillars import (
    EDGE,
    PILLAR,
    REGISTER,
    SHORT,
    SPARE,
    Column,
    cap_screw,
    columns,
    least_height,
    pillar,
    put_screw,
    register,
    stud,
)
from mechwright.machine.frame.plates import (
    add_plate,
    bearing_hole,
    least_thickness,
    retainer_holes,
    seat_depth,
    thickness_for,
)
from mechwright.machine.frame.play import coupling_stack, shaft_stacks
from mechwright.machine.frame.posts import add_post, post_disc, post_faults, post_hole
from mechwright.machine.frame.seats import Seat, bores, candidates, plate_radius, seats
from mechwright.machine.frame.shafts import AxialLocation, Levels, add_shaft, highest, lowest
from mechwright.machine.frame.slideways import add_slideway, floor_of, rail_discs, rail_holes, region_of
from mechwright.machine.frame.standing import CLEARANCE, Disc, stand
from mechwright.machine.frame.sweep import Space, space_of
from mechwright.standards.couplings import BORES, OverloadError
from mechwright.standards.stock import plate_for

STUB = 2.0
"""Length of the shaft for a drive of one's own below the frame, in its diameters."""


def frame_around(
    keys: FrameKeys, mounting: Mounting, parts: Sequence[Part], motion: Motion, wanted: Wanted
) -> Surroundings:
    """The frame of a mechanism with its findings; no parts where one of them is an error."""
    try:
        found = decided(keys, mounting, parts, motion, wanted)
        if isinstance(found, Frame):
            kit = built(found, keys)
            said = [*strength(found, wanted)]
            if errors(said):
                return Surroundings(findings=tuple(said))
            return Surroundings(tuple(kit.parts.values()), kit.places, tuple(said), tuple(kit.stacks))
    except DesignError as error:
        return Surroundings(findings=(refusal("frame.design", "machine.frame", str(error)),))
    return Surroundings(findings=tuple(found))


def refusal(code: str, key: str, said: str) -> Finding:
    """A frame that cannot be had, in a sentence whose end says what to do."""
    message, _, remedy = said.rpartition("; ")
    return Finding.error(code, key, message or said, remedy=remedy if message else "", stage=Stage.PARTS)


def decided(
    keys: FrameKeys, mounting: Mounting, parts: Sequence[Part], motion: Motion, wanted: Wanted
) -> Frame | list[Finding]:
    """All sizes, or what is in the way; raises DesignError for what there is no room for."""
    if keys.frame == "plate":
        return [_one_plate()]
    chosen, faults = seats(mounting, keys)
    if faults:
        return faults
    thickness = keys.plate_thickness or thickness_for(chosen, keys.plate_material, keys.plates)
    if thickness < least_thickness(chosen):
        least = plate_for(least_thickness(chosen), keys.plate_material, keys.plates)
        return [_too_thin(thickness, least)]
    space = space_of(parts, motion)
    levels = levels_of(space, chosen, keys, thickness, mounting)
    faults = [fault for seat in chosen for fault in in_the_way(seat, levels, space, mounting)]
    faults += [fault for post in mounting.posts for fault in post_faults(post, levels, space)]
    if faults:
        return faults
    held = [
        *(Disc(seat.spindle.point, plate_radius(seat, keys.plate_material)) for seat in chosen),
        *map(post_disc, mounting.posts),
        *(disc for way in mounting.slideways for disc in rail_discs(way)),
    ]
    if keys.cover:
        x0, y0, x1, y1 = space.region.bounds
        held += [Disc(corner, CLEARANCE) for corner in ((x0, y0), (x1, y1))]
    bracket, region = None, shapely.union_all([space.region, *map(region_of, mounting.slideways)])
    if keys.frame == "base" and wanted.motor is not None:
        driver = next(seat for seat in chosen if seat.spindle.drives)
        try:
            bracket = bracket_for(
                wanted.motor,
                (
                    driver.spindle.point,
                    driver.bearing.bore,
                    seat_depth(driver, upper=False),
                ),
                (levels.lower, levels.lower - thickness),
                wanted.torque,
                held,
            )
        except NoCouplingError as error:
            return [_no_coupling(driver, keys, str(error))]
        except OverloadError as error:
            return [overloaded(error, wanted)]
        region = region.union(bracket.region)
        held += [Disc(corner, EDGE) for corner in bracket.corners]
    standing = stand(region, held, PILLAR / 2, EDGE)
    if keys.guard:
        standing = widened(standing, space.region.bounds)
    return Frame(tuple(chosen), levels, thickness, standing, bracket, mounting.posts, mounting.slideways)


def _one_plate() -> Finding:
    """Gears and wheels on shafts of their own are straddled: a plate on one side alone does not hold them."""
    return Finding.error(
        "frame.one-plate",
        "machine.frame",
        "one plate is for mechanisms that have their bearings in a ground plate of their own, and here "
        "shafts stand in bearings on both sides",
        remedy='set frame = "plates"',
        stage=Stage.PARTS,
        proposed=({"machine.frame": "plates"},),
    )


def levels_of(
    space: Space, chosen: Sequence[Seat], keys: FrameKeys, thickness: float, mounting: Mounting
) -> Levels:
    """The inner faces: clear of the mechanism, with room for shoulders and for the pillars' threads.

    The lower one is that on which linear guides lie. Raises DesignError where these are too low for the rest.
    """
    located = [seat.bearing for seat in chosen if seat.located]
    over = height_over(located) if located else 0.0
    lower = min(space.low - keys.axial_gap - over, *(lowest(seat) for seat in chosen))
    upper = max(space.high + keys.axial_gap, *(highest(seat) for seat in chosen))
    if mounting.slideways:
        lower = floor_of(mounting.slideways, lower)
        return Levels(lower, lower + math.ceil(round(max(upper - lower, least_height(thickness)), 6)))
    short = max(least_height(thickness) - (upper - lower), 0.0)
    # Whole millimetres between the plates, half of what is missing on either side.
    height = math.ceil(round(upper - lower + short, 6))
    return Levels(lower - short / 2, lower - short / 2 + height)


def _no_coupling(driver: Seat, keys: FrameKeys, said: str) -> Finding:
    """With the least bore whose bearings leave a shaft for a coupling."""
    able = (bore for bore in bores() if bore > driver.spindle.hub.bore)
    works = next((b for b in able if _bearing_bore(b, keys) >= BORES[0]), None)
    key = driver.spindle.bore_key
    return Finding.error(
        "frame.coupling",
        key,
        said,
        driver.spindle.hub.bore,
        works,
        "mm",
        "take a larger bore" if works is None else f"make it {works:g}",
        Stage.PARTS,
        ({key: works},) if works is not None and key else (),
    )


def _bearing_bore(bore: float, keys: FrameKeys) -> float:
    found = candidates(bore, keys.bearing, keys.bearing_arrangement)
    return found[0].bore if found else 0.0


def _too_thin(thickness: float, least: float) -> Finding:
    return Finding.error(
        "frame.plate-thickness",
        "machine.plate_thickness",
        f"a plate of {thickness:g} mm has no floor under its bearings",
        thickness,
        least,
        "mm",
        f"make it {least:g}, or leave it out",
        Stage.PARTS,
        ({"machine.plate_thickness": None},),
    )


def built(frame: Frame, keys: FrameKeys) -> Kit:
    """All parts where they stand."""
    kit = Kit()
    levels, thickness, standing, bracket = frame.levels, frame.thickness, frame.standing, frame.bracket
    corners = columns(standing.corners)
    lower = [bearing_hole(seat, thickness, upper=False) for seat in frame.seats]
    lower += [hole for seat in frame.seats for hole in retainer_holes(seat, thickness)]
    upper = [bearing_hole(seat, thickness, upper=True) for seat in frame.seats]
    for column in corners:
        column.place(kit)
        hole = register(column.name, column.point, thickness, spigot=column.spigot)
        lower.append(hole)
        upper.append(hole)
    for post in frame.posts:
        (upper if post.hangs else lower).append(post_hole(post, thickness))
        add_post(kit, post, levels.upper + thickness if post.hangs else frame.under)
    for way in frame.slideways:
        lower += rail_holes(way)
    if bracket is not None:
        lower += pillar_holes(bracket, thickness)
    kit.places["lower-carrier"] = Place()
    kit.places["upper-carrier"] = Place(rotation=OVER)
    material = keys.plate_material
    add_plate(kit, "lower-plate", standing, EDGE, thickness, material, lower, "lower-carrier", frame.under)
    top = -levels.upper - thickness
    add_plate(kit, "upper-plate", standing, EDGE, thickness, material, upper, "upper-carrier", top, over=True)
    for way in frame.slideways:
        add_slideway(kit, way, material)
    if keys.guard:
        add_guard(kit, standing, levels)
    for seat in frame.seats:
        if seat.located:
            point, name = seat.spindle.point, seat.spindle.name
            add_retainer(kit, seat.bearing, name, point, levels.lower, "lower-plate")
        shaft = add_shaft(kit, seat, levels, _stub(frame) if seat.spindle.drives else None)
        kit.stacks += shaft_stacks(seat, shaft, levels)
    _add_columns(kit, frame, keys, corners)
    if bracket is not None:
        body = frame.driver.spindle.body
        add_bracket(kit, bracket, body, (levels.lower, frame.under), material)
        kit.stacks.append(coupling_stack(bracket, frame.driver, levels.lower, thickness))
    return kit


def _stub(frame: Frame) -> tuple[float, float]:
    """Diameter and length of the input's shaft below its bearing, mm."""
    if frame.bracket is not None:
        return frame.bracket.stub
    bearing, depth = frame.driver.bearing, seat_depth(frame.driver, upper=False)
    diameter = bearing.bore - 1.0 if bearing.bore > 4 else bearing.bore
    return diameter, frame.thickness - depth + STUB * bearing.bore


def _add_columns(kit: Kit, frame: Frame, keys: FrameKeys, posts: Sequence[Column]) -> None:
    """Pillars and their screws; of a base its legs."""
    levels, thickness = frame.levels, frame.thickness
    fixing = cap_screw(thickness)
    deep = fixing.length - thickness
    based = keys.frame == "base"
    joint = stud(thickness, deep + SPARE) if based else None
    below = deep if joint is None else (joint.length - thickness) / 2
    for post in posts:
        name = "pillar" if post.spigot else "plain-pillar"
        foot = levels.lower - (REGISTER - SHORT if post.spigot else 0.0)
        form = pillar(levels.height, below, deep, spigot=post.spigot)
        kit.turned(name, form, post.name, foot, play=SHORT if post.spigot else 0.0)
        put_screw(kit, fixing, post.name, levels.upper + thickness)
        if joint is None:
            put_screw(kit, fixing, f"{post.name}-below", -frame.under)
        else:
            put_screw(kit, joint, post.name, levels.lower + below)
    if based:
        bracket = frame.bracket
        stub = _stub(frame)
        lowest_point = bracket.low if bracket else AxialLocation.of(frame.driver, levels).foot(stub)
        top, material = lowest_point - UNDER, keys.plate_material
        add_base(kit, frame.standing, list(posts), frame.under, top, below, material, keys.plates)

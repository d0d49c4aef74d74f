"""A motor on the flange of a mechanism whose input's axis is askew to its foot, and a base under that foot.

From the flange outwards: four pillars, the plate with the motor, and the coupling of motor and shaft. The
foot is screwed on a base plate with feet, which reaches under mechanism and motor.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.joint import Vector
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import Flange, Foot
from mechwright.contracts.surroundings import OVER, Place, Surroundings, Turn
from mechwright.errors import DesignError
from mechwright.machine.frame.base import FOOT, add_foot, base_stock, foot, least_thickness
from mechwright.machine.frame.bracket import Bracket, add_bracket, least_half
from mechwright.machine.frame.coupled import coupling_below, face_below, outline
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.findings import BOND, BOND_SAFETY
from mechwright.machine.frame.ground_refusals import GroundError, plate_key_faults, refusal
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.overload import overloaded
from mechwright.machine.frame.pillars import EDGE, put_screw
from mechwright.machine.frame.plates import Hole, add_plate
from mechwright.machine.frame.standing import CLEARANCE, Standing
from mechwright.mechanics.strength.fastening import press_fit_torque
from mechwright.standards.couplings import OverloadError, coupling_for
from mechwright.standards.screws import Screw, lengths, screw, through_hole

INWARDS: Turn = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
"""The flange's own frame, whose z points from the motor to the mechanism, in a body whose x is the axis."""

TILTS = range(1, 171)
"""Angles between axis and foot that are tried, degrees."""


def on_flange(keys: FrameKeys, flange: Flange, motion: Motion, wanted: Wanted) -> Surroundings:
    """Motor and base of a mechanism with a flange; no parts where a finding is an error."""
    faults = plate_key_faults(keys)
    if faults:
        return Surroundings(findings=tuple(faults))
    try:
        bracket = _bracket(flange, wanted)
        said = _bonded(flange, wanted)
        if bracket is not None:
            _check_tilt(flange, bracket, motion)
        askew, upright = Kit(), Kit()
        if bracket is not None:
            levels = (-flange.inner, -flange.outer)
            add_bracket(askew, bracket, flange.shaft, levels, keys.plate_material, sunk=False)
        _add_base(upright, flange, _under(flange, bracket, motion), keys)
    except DesignError as error:
        return Surroundings(findings=(refusal(error),))
    places = {
        **_carried(askew.places, flange.body, INWARDS),
        **_carried(upright.places, flange.foot.body, OVER),
    }
    # Screws of both are one part where they are one size.
    for part in askew.parts.values():
        for at in part.instances:
            upright.put(replace(part, instances=()), at.body, at.z)
    return Surroundings(tuple(upright.parts.values()), places, (*said, *_gap_unused(keys)))


def _gap_unused(keys: FrameKeys) -> list[Finding]:
    """A warning of a gap between what moves and bearing plates, of which there are none here."""
    key = "axial_gap"
    if keys.axial_gap == FrameKeys.model_fields[key].default:
        return []
    said = f"{key} changes nothing: a motor on a flange has no bearing plates to keep clear of"
    remedy, change = f"leave {key} out", {f"machine.{key}": None}
    where = f"machine.{key}"
    return [Finding.warning("machine.key", where, said, remedy=remedy, stage=Stage.PARTS, proposed=(change,))]


def _carried(places: Mapping[str, Place], body: str, turn: Turn) -> dict[str, Place]:
    """The same places in bodies of the motion, of whose frame theirs is turned."""
    turning = np.array(turn)
    found = {}
    for name, place in places.items():
        origin, rotation = turning @ place.origin, turning @ np.array(place.rotation)
        found[name] = Place(_vector(origin), _turn(rotation), place.on or body)
    return found


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return x, y, z


def _turn(values: Array) -> Turn:
    one, two, three = (_vector(row) for row in values)
    return one, two, three


def _fault(
    code: str, key: str, said: str, value: float, limit: float | None, unit: str, remedy: str, *tried: Change
) -> GroundError:
    return GroundError(Finding.error(code, key, said, value, limit, unit, remedy, Stage.PARTS, tried))


def _bracket(flange: Flange, wanted: Wanted) -> Bracket | None:
    """Where the motor stands in the flange's own frame; None without one."""
    if wanted.motor is None:
        return None
    face = wanted.motor.face
    try:
        coupling = coupling_for(face.shaft, flange.diameter, wanted.torque)
    except OverloadError as error:
        raise GroundError(overloaded(error, wanted)) from error
    least = math.ceil(least_half(face, coupling))
    if flange.half < least:
        said = f"pillars in a square of {2 * flange.half:g} mm leave no room for coupling and motor"
        remedy, change = f"make it {2 * least:g}", {flange.size_key: float(2 * least)}
        raise _fault(
            "frame.flange", flange.size_key, said, 2 * flange.half, 2.0 * least, "mm", remedy, change
        )
    low = coupling_below(-flange.end, coupling.of.length)
    stub = (flange.diameter, flange.end - flange.outer)
    motor_face = face_below(face, low, coupling.of.length)
    return Bracket(wanted.motor, coupling, (0.0, 0.0), 0.0, low, motor_face, flange.half, stub)


def _bonded(flange: Flange, wanted: Wanted) -> list[Finding]:
    """Whether retaining compound holds the link on the input's shaft."""
    length, key = flange.bond
    most = press_fit_torque(BOND, flange.diameter, length, 1.0) / BOND_SAFETY
    if wanted.torque > most:
        said = f"retaining compound holds {most:.3g} N·m of the {wanted.torque:.3g} N·m at the input's shaft"
        slower = float(f"{0.9 * wanted.speed * math.sqrt(most / wanted.torque):.2g}")
        remedy = "take thicker pins, run it slower, or load it less"
        changes: list[Change] = [{key: size} for size in (8.0, 10.0) if size > flange.diameter]
        changes.append({"machine.speed": slower})
        raise _fault("frame.bond", key, said, wanted.torque, most, "N*m", remedy, *changes)
    return [
        Finding.note(
            "frame.bond-input",
            f"retaining compound holds the input's link on its shaft, up to {most:.3g} N·m",
            most,
            "N*m",
        )
    ]


def _box(flange: Flange, bracket: Bracket) -> Array:
    """Corners (8, 3) of what flange, pillars, plate and motor take, in the flange's body, mm."""
    half = flange.half + EDGE
    x0, y0, x1, y1 = outline(bracket.motor.face, (0.0, 0.0), 0.0).bounds
    wide = max(half, *map(abs, (x0, y0, x1, y1)))
    ends = (flange.inner, -bracket.low)
    return np.array([(x, y, z) for x in ends for y in (-wide, wide) for z in (-wide, wide)])


def _seen(flange: Flange, points: Array, motion: Motion) -> Array:
    """Points of the flange's body in that of the foot, whose z points down, mm."""
    one, two = motion.poses[flange.body], motion.poses[flange.foot.body]
    there = points @ one.rotation[0].T + one.position[0]
    found: Array = (there - two.position[0]) @ two.rotation[0]
    return found


def _check_tilt(flange: Flange, bracket: Bracket, motion: Motion) -> None:
    """Raises GroundError where flange, bracket or motor would stand in the foot or its base."""
    box = _box(flange, bracket)
    lowest = float(_seen(flange, box, motion)[:, 2].max())
    if lowest <= -CLEARANCE:
        return
    place, turn = _seen(flange, np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]), motion)
    distance, now = -float(place[2]), math.degrees(math.acos(float((turn - place)[2])))
    ends, wide = (flange.inner, -bracket.low), float(box[:, 1].max())
    able = [
        float(tilt)
        for tilt in TILTS
        if max(end * math.cos(math.radians(tilt)) + wide * math.sin(math.radians(tilt)) for end in ends)
        <= distance - CLEARANCE
    ]
    # The nearest first; one may be barred by what else stands there.
    able.sort(key=lambda tilt: abs(tilt - now))
    said = (
        f"the motor stands {now:.4g}° from the foot's axis, and would reach {lowest + CLEARANCE:.1f} mm into "
        "its plate"
    )
    said_so = [180 - tilt if flange.opposite else tilt for tilt in able]
    remedy = f"make it {said_so[0]:g}" if able else "take a smaller motor"
    changes: list[Change] = [{flange.tilt_key: tilt} for tilt in said_so[:40:4]]
    value, limit = 180 - now if flange.opposite else now, said_so[0] if able else None
    raise _fault("frame.flange-tilt", flange.tilt_key, said, value, limit, "deg", remedy, *changes)


def _under(flange: Flange, bracket: Bracket | None, motion: Motion) -> Standing:
    """The rectangle of feet under all of it, in the foot's frame as seen from above."""
    reach = flange.reach
    centre = _seen(flange, np.zeros((1, 3)), motion)[0]
    points = [(centre[0] - reach, centre[1] - reach), (centre[0] + reach, centre[1] + reach)]
    if bracket is not None:
        points += [(x, y) for x, y, _ in _seen(flange, _box(flange, bracket), motion)]
    xs, ys = [x for x, _ in points], [-y for _, y in points]
    return Standing(math.floor(min(xs)), math.floor(min(ys)), math.ceil(max(xs)), math.ceil(max(ys)))


def _add_base(kit: Kit, flange: Flange, standing: Standing, keys: FrameKeys) -> None:
    """The base plate under the foot, and the screws that hold both; heights from the foot's upper face."""
    plate, edge = flange.foot, FOOT[0] / 2 + 2.0
    material, (wide, high) = keys.plate_material, standing.size
    wanted = least_thickness((wide + 2 * edge, high + 2 * edge), material)
    thickness = base_stock(wanted, material, keys.plates)
    top = -plate.thickness
    low = top - thickness
    fixing, foot_hole = _fixing(plate, thickness), through_hole(foot().threads[0].diameter, thickness)
    clear = through_hole(plate.screw, thickness)
    holes = []
    for k, (x, y) in enumerate(plate.holes, start=1):
        holes.append(Hole.through(f"stand-{k}", (x, -y), clear, thickness))
        kit.places[f"stand-{k}"] = Place((x, -y, 0.0), OVER)
        put_screw(kit, fixing, f"stand-{k}", -low)
    for k, (x, y) in enumerate(standing.corners, start=1):
        holes.append(Hole.through(f"foot-{k}", (x, y), foot_hole, thickness))
        add_foot(kit, f"foot-{k}", (x, y), top, thickness, material)
    kit.places["base-carrier"] = Place()
    add_plate(kit, "base-plate", standing, edge, thickness, material, holes, "base-carrier", low)
    held = _fixing(plate, plate.grip)
    for k, (x, y) in enumerate(plate.inner, start=1):
        kit.places[f"stand-inner-{k}"] = Place((x, -y, 0.0))
        put_screw(kit, held, f"stand-inner-{k}", plate.grip)


def _fixing(plate: Foot, grip: float) -> Screw:
    """The longest screw that goes into the foot's threads and not out of them, a diameter deep at least."""
    sold, have = lengths(plate.screw), plate.thickness
    fitting = [one for one in sold if grip + plate.screw <= one <= grip + have]
    if fitting:
        return screw(plate.screw, fitting[-1])
    said = (
        f"no screw M{plate.screw:g} that is sold goes through {grip:g} mm and a diameter into a foot of "
        f"{have:g} mm, and not out of it"
    )
    longer = next((one for one in sold if one >= grip + plate.screw), None)
    if longer is None:
        off: Change = {"machine.frame": "none"}
        raise _fault("frame.foot", plate.key, said, have, None, "mm", 'set frame = "none"', off)
    works = math.ceil(10 * (longer - grip) - 1e-6) / 10
    change: Change = {plate.key: works}
    raise _fault("frame.foot", plate.key, said, have, works, "mm", f"make it {works:g}", change)

"""Whether a base goes under a ground plate: its holes, its shaft, the motor's room, and what works."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import shapely
from shapely import affinity

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import GroundPlate
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.coupled import (
    BESIDE,
    GAP,
    PLATE,
    SHAFT_GAP,
    TURNS,
    coupling_below,
    face_below,
    outline,
)
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.fault import fault
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.frame.overload import overloaded
from mechwright.machine.frame.pillars import PILLAR, SCREW
from mechwright.machine.frame.standing import CLEARANCE
from mechwright.machine.frame.sweep import Space, Swept
from mechwright.standards.couplings import BORES, Coupling, OverloadError, coupling_for
from mechwright.standards.screws import lengths, needs_washer, screw_size, through_hole, washer

WITHOUT = ("bearing", "bearing_arrangement", "plate_thickness", "cover", "guard")
"""Keys of bearing plates, of which there are none here."""

_TOUCH = 1e-6
"""By how much something may lie below the plate's underside and still be in it, mm."""


class GroundError(DesignError):
    """With the finding that says why."""

    def __init__(self, finding: Finding) -> None:
        super().__init__(finding.message)
        self.finding = finding


def refusal(error: DesignError) -> Finding:
    """Of an error that may begin with a key and end with what to do."""
    if isinstance(error, GroundError):
        return error.finding
    said, _, remedy = str(error).rpartition("; ")
    key, colon, rest = said.partition(": ")
    if not colon or " " in key:
        key, rest = "machine.frame", said
    return fault("frame.design", key, rest or remedy, remedy=remedy if rest else 'set frame = "none"')


def plate_key_faults(keys: FrameKeys) -> list[Finding]:
    """Keys of bearing plates, which a mechanism with bearings of its own has not."""
    if keys.frame == "plates":
        said = "the mechanism has its bearings in its own ground: no bearing plates go around it"
        change: Change = {"machine.frame": "base"}
        return [
            fault("frame.own-ground", "machine.frame", said, remedy='set frame = "base"', proposed=(change,))
        ]
    found = []
    for key in WITHOUT:
        usual = FrameKeys.model_fields[key].default
        if getattr(keys, key) != usual:
            said = "the mechanism has its bearings in its own ground: there are no bearing plates"
            if key == "guard":
                said += " for rings to lie between, and what moves reaches beyond the ground plate"
            change = {f"machine.{key}": usual}
            found.append(
                fault("frame.own-ground", f"machine.{key}", said, remedy="leave it out", proposed=(change,))
            )
    return found


def key_faults(keys: FrameKeys, ground: GroundPlate) -> list[Finding]:
    """Keys that no frame of this kind obeys, and holes that its screws do not fit."""
    found = plate_key_faults(keys)
    if keys.frame == "plates":
        return found
    least, most_hole = screw_size(SCREW).clearance("fine"), float(math.ceil(screw_size(SCREW).clearance()))
    if not least <= ground.hole <= most_hole:
        # A bolt that is as thick as the hole bears on its shoulder.
        works = most_hole if ground.bolts else through_hole(SCREW, ground.high - ground.low)
        said = (
            f"the ground plate's holes of {ground.hole:g} mm do not fit the screws M{SCREW:g} of its legs: "
            f"{least:g} to {most_hole:g} mm"
        )
        change = {ground.hole_key: works}
        key, remedy = ground.hole_key, f"make it {works:g}"
        found.append(fault("frame.ground-holes", key, said, ground.hole, works, remedy, (change,)))
    thick = ground.high - ground.low
    most = lengths(SCREW, "cap")[-1] - SCREW - washers_on(ground) * washer(SCREW).height
    if thick > most and ground.bolts is None:
        key = ground.thickness_key
        said = f"no screw M{SCREW:g} is long enough for a ground plate of {thick:g} mm: {most:g} mm at most"
        remedy = f"make it {most:g}"
        found.append(fault("frame.ground-thickness", key, said, thick, most, remedy, ({key: most},)))
    return found


def motor_wanted() -> Finding:
    """One plate adds the motor behind it, and nothing without one."""
    said = "a frame of one plate is the ground plate with the motor behind it, and there is no motor"
    change: Change = {"machine.motor": "auto"}
    return fault("frame.one-plate", "machine.motor", said, remedy='set motor = "auto"', proposed=(change,))


def coupling_on(ground: GroundPlate, wanted: Wanted) -> Coupling | None:
    """On the shaft's end; None without a motor. Raises DesignError where none fits or holds."""
    if wanted.motor is None:
        return None
    if ground.diameter not in BORES:
        raise GroundError(_no_bore(ground))
    try:
        coupling = coupling_for(wanted.motor.face.shaft, ground.diameter, wanted.torque)
    except OverloadError as error:
        raise GroundError(overloaded(error, wanted)) from error
    have, need = ground.bare - ground.end, GAP + coupling.of.length / 2 - SHAFT_GAP
    if have < need:
        said = f"its coupling of {coupling.of.length:g} mm takes more"
        raise GroundError(longer(ground, said, need - have))
    return coupling


def _no_bore(ground: GroundPlate) -> Finding:
    """A shaft for which no coupling is sold; one that is turned down to its stub cannot be made thicker."""
    key = ground.diameter_key
    able = [bore for bore in BORES if bore <= ground.diameter or not ground.length_key]
    works = min(able, key=lambda bore: (abs(bore - ground.diameter), bore), default=None)
    sold = ", ".join(f"{bore:g}" for bore in BORES)
    said = f"no coupling is sold for a shaft of {ground.diameter:g} mm; one of: {sold}"
    if works is None:
        return _without_motor(key, said, ground.diameter, BORES[0])
    return fault("frame.coupling", key, said, ground.diameter, works, f"make it {works:g}", ({key: works},))


def _without_motor(key: str, said: str, have: float, need: float) -> Finding:
    remedy, change = 'set motor = "none"', {"machine.motor": "none"}
    return fault("frame.coupling", key, said, have, need, remedy, (change,))


def foot_of(
    keys: FrameKeys,
    ground: GroundPlate,
    space: Space,
    motion: Motion,
    wanted: Wanted,
    coupling: Coupling | None,
) -> float:
    """By how much the motor is turned, rad, so that it stands clear of all legs and of the way of keys.

    Raises
    ------
    DesignError
        Something passes over the heads of the screws or where a pillar stands, a leg would stand in the
        motor, or something hangs down to the coupling or to the motor's plate.
    """
    pieces = placed(ground, space, motion)
    _hanging(keys, ground, pieces, wanted, coupling)
    size, count = screw_size(SCREW), washers_on(ground)
    top = ground.high + count * washer(SCREW).height + size.head_height + keys.axial_gap
    head = max(size.head, size.washer[1] if count else 0.0)
    over = []
    if ground.bolts is None:  # else links pass between plates, and heads are the mechanism's own
        over = [one for one in pieces if one.low < top and one.high > ground.high and one.body != ground.body]
    under = [one for one in pieces if one.low < ground.low - _TOUCH and one.high < ground.high + _TOUCH]

    def attitude(corners: Sequence[Point]) -> tuple[float | None, str]:
        """The motor's, or what is in the way."""
        for at in map(shapely.Point, corners):
            for one in over:
                if one.region.distance(at) < head / 2 + CLEARANCE:
                    return None, f"{one.part} passes over the head of the screw"
            for one in under:
                if one.region.distance(at) < PILLAR / 2 + CLEARANCE:
                    return None, f"{one.part} is in the way of the pillar"
        found = _turn(corners, ground, wanted, coupling)
        return found, "" if found is not None else "the motor or its coupling is in the way of the leg"

    angle, why = attitude(ground.holes)
    if angle is None:
        far = max((abs(end) for one in (*over, *under) for end in one.region.bounds), default=0.0)
        raise GroundError(_offset_fault(ground, why, far, lambda corners: attitude(corners)[0] is not None))
    return angle


def washers_on(ground: GroundPlate) -> int:
    """How many washers lie under the head of each screw through the ground plate."""
    return int(needs_washer(SCREW, ground.hole))


def placed(ground: GroundPlate, space: Space, motion: Motion) -> list[Swept]:
    """What the mechanism takes, bolts into the pillars apart, in the ground plate's frame."""
    pose = motion.poses[ground.body]
    x, y = pose.position[0, :2]
    turn = math.atan2(pose.rotation[0, 1, 0], pose.rotation[0, 0, 0])

    def of(region: shapely.Geometry) -> shapely.Geometry:
        return affinity.rotate(affinity.translate(region, -x, -y), -turn, (0, 0), use_radians=True)

    own = ground.bolts[0] if ground.bolts else ""
    return [replace(piece, region=of(piece.region)) for piece in space.pieces if piece.part != own]


def lowest_of(ground: GroundPlate, pieces: Sequence[Swept]) -> float:
    """Of all that hangs below a ground plate, its shaft included, mm."""
    return min(ground.end, *(one.low for one in pieces))


def _hanging(
    keys: FrameKeys,
    ground: GroundPlate,
    pieces: Sequence[Swept],
    wanted: Wanted,
    coupling: Coupling | None,
) -> None:
    """Raises GroundError for what hangs beside the shaft where coupling and motor's plate are."""
    if wanted.motor is None or coupling is None:
        return
    low = coupling_below(ground.end, coupling.of.length)
    plate = face_below(wanted.motor.face, low, coupling.of.length) + PLATE
    axis = shapely.Point(ground.axis)
    for one in pieces:
        if one.body == ground.shaft:
            continue
        if one.low < low + coupling.of.length and one.region.distance(axis) < _beside(coupling):
            need = low + coupling.of.length + GAP - one.low
            raise GroundError(longer(ground, f"{one.part} is in the way of the coupling", need))
        if one.low < plate + keys.axial_gap:
            need = plate + keys.axial_gap - one.low
            raise GroundError(longer(ground, f"{one.part} hangs down to the motor's plate", need))


def _beside(coupling: Coupling) -> float:
    return coupling.of.outside / 2 + CLEARANCE


def longer(ground: GroundPlate, said: str, more: float) -> Finding:
    """A shaft that ends so much too high, mm; its end has a key of its own, or grows with its diameter."""
    key, have = ground.diameter_key, ground.bare - ground.end
    need = have + more
    said = f"the shaft stands out {have:g} mm below what it carries, and {said}: {need:.4g} mm are needed"
    if ground.length_key:
        works = math.ceil(need)
        change: Change = {ground.length_key: works}
        return fault("frame.coupling", ground.length_key, said, have, need, f"make it {works:g}", (change,))
    able: list[Change] = [{key: bore} for bore in BORES if bore * have >= need * ground.diameter]
    if not able:
        return _without_motor(key, said, have, need)
    remedy = "take a thicker shaft, which is longer"
    return fault("frame.coupling", key, said, have, need, remedy, tuple(able))


def _turn(
    corners: Sequence[Point], ground: GroundPlate, wanted: Wanted, coupling: Coupling | None
) -> float | None:
    """The first attitude of the motor that is clear of all columns and of the way of keys."""
    if wanted.motor is None or coupling is None:
        return 0.0
    room = PILLAR / 2 + BESIDE
    if any(math.dist(at, ground.axis) < coupling.of.outside / 2 + room for at in corners):
        return None
    if any(math.dist(at, place) < radius + room for at in corners for place, radius in ground.access):
        return None
    places = shapely.multipoints(corners)
    for angle in TURNS:
        plan = outline(wanted.motor.face, ground.axis, angle)
        free = all(plan.distance(shapely.Point(at)) >= radius + BESIDE for at, radius in ground.access)
        if free and plan.distance(places) >= room:
            return angle
    return None


def _offset_fault(
    ground: GroundPlate, why: str, far: float, clear: Callable[[Sequence[Point]], bool]
) -> Finding:
    """With the least whole offset of the holes that leaves all of them free; beyond ``far`` nothing is."""
    now, key = ground.out, ground.offset_key
    most = math.ceil(max(now, far)) + 2 * math.ceil(PILLAR) + 60
    works = next((float(y) for y in range(math.floor(now) + 1, most) if clear(ground.moved(y))), None)
    remedy = "use a smaller motor" if works is None else f"make it {works:g}"
    (x0, y0), (x1, y1) = ground.holes[0], ground.holes[2]
    said = f"the ground plate's holes stand {x1 - x0:.4g} by {y1 - y0:.4g} mm apart, where {why}"
    proposed: tuple[Change, ...] = () if works is None else ({key: works},)
    return fault("frame.ground-offset", key, said, now, works, remedy, proposed)

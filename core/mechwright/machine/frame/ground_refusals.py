"""Whether a base goes under a ground plate: its holes, its shaft, the motor's room, and what works."""

import math
from collections.abc import Callable, Sequence

import shapely
from shapely import affinity

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import GroundPlate
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.base import HOLE
from mechwright.machine.frame.coupled import BESIDE, GAP, TURNS, outline
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.keys import FrameKeys
from mechwright.machine.frame.overload import overloaded
from mechwright.machine.frame.pillars import PILLAR, SCREW
from mechwright.machine.frame.standing import CLEARANCE
from mechwright.machine.frame.sweep import Space
from mechwright.standards.couplings import BORES, Coupling, OverloadError, coupling_for
from mechwright.standards.screws import lengths, screw_size

WITHOUT = ("bearing", "plate_thickness", "cover")
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
    return _fault("frame.design", key, rest or remedy, remedy=remedy if rest else 'set frame = "none"')


def _fault(
    code: str,
    key: str,
    said: str,
    value: float | None = None,
    limit: float | None = None,
    remedy: str = "",
    proposed: tuple[Change, ...] = (),
) -> Finding:
    unit = "" if value is None else "mm"
    return Finding.error(code, key, said, value, limit, unit, remedy, Stage.PARTS, proposed)


def plate_key_faults(keys: FrameKeys) -> list[Finding]:
    """Keys of bearing plates, which a mechanism with bearings of its own has not."""
    if keys.frame == "plates":
        said = "the mechanism has its bearings in its own ground: no bearing plates go around it"
        change: Change = {"machine.frame": "base"}
        return [
            _fault("frame.own-ground", "machine.frame", said, remedy='set frame = "base"', proposed=(change,))
        ]
    found = []
    for key in WITHOUT:
        usual = FrameKeys.model_fields[key].default
        if getattr(keys, key) != usual:
            said = "the mechanism has its bearings in its own ground: there are no bearing plates"
            change = {f"machine.{key}": usual}
            found.append(
                _fault("frame.own-ground", f"machine.{key}", said, remedy="leave it out", proposed=(change,))
            )
    return found


def key_faults(keys: FrameKeys, ground: GroundPlate) -> list[Finding]:
    """Keys that no frame of this kind obeys, and holes that its screws do not fit."""
    found = plate_key_faults(keys)
    if keys.frame == "plates":
        return found
    least = screw_size(SCREW).clearance("fine")
    if not least <= ground.hole <= HOLE:
        said = (
            f"the ground plate's holes of {ground.hole:g} mm do not fit the screws M{SCREW:g} of its legs: "
            f"{least:g} to {HOLE:g} mm"
        )
        change = {ground.hole_key: HOLE}
        found.append(
            _fault(
                "frame.ground-holes", ground.hole_key, said, ground.hole, HOLE, f"make it {HOLE:g}", (change,)
            )
        )
    thick, most = ground.high - ground.low, lengths(SCREW, "cap")[-1] - SCREW
    if thick > most:
        key = ground.thickness_key
        said = f"no screw M{SCREW:g} is long enough for a ground plate of {thick:g} mm: {most:g} mm at most"
        remedy = f"make it {most:g}"
        found.append(_fault("frame.ground-thickness", key, said, thick, most, remedy, ({key: most},)))
    return found


def coupling_on(ground: GroundPlate, wanted: Wanted) -> Coupling | None:
    """On the shaft's end; None without a motor. Raises DesignError where none fits or holds."""
    if wanted.motor is None:
        return None
    key, have = ground.diameter_key, ground.low - ground.neck - ground.end
    if ground.diameter not in BORES:
        works = min(BORES, key=lambda bore: (abs(bore - ground.diameter), bore))
        sold = ", ".join(f"{bore:g}" for bore in BORES)
        said = f"no coupling is sold for a shaft of {ground.diameter:g} mm; one of: {sold}"
        raise GroundError(
            _fault("frame.coupling", key, said, ground.diameter, works, f"make it {works:g}", ({key: works},))
        )
    try:
        coupling = coupling_for(wanted.motor.face.shaft, ground.diameter, wanted.torque)
    except OverloadError as error:
        raise GroundError(overloaded(error, wanted)) from error
    need = GAP + coupling.of.length / 2
    if have < need:
        # The end grows with the diameter.
        longer: list[Change] = [{key: bore} for bore in BORES if bore * have >= need * ground.diameter]
        said = (
            f"the shaft stands out {have:g} mm below the ground plate; its coupling of "
            f"{coupling.of.length:g} mm takes {need:g} mm"
        )
        raise GroundError(
            _fault(
                "frame.coupling",
                key,
                said,
                have,
                need,
                "take a thicker shaft, which is longer",
                tuple(longer),
            )
        )
    return coupling


def foot_of(
    keys: FrameKeys,
    ground: GroundPlate,
    space: Space,
    motion: Motion,
    wanted: Wanted,
    coupling: Coupling | None,
) -> float:
    """By how much the motor is turned, rad, so that it stands clear of all legs.

    Raises
    ------
    DesignError
        Something other than the shaft is below the plate, something passes over the heads of its screws, or a
        leg would stand in the motor.
    """
    below = next(
        (
            piece
            for piece in space.pieces
            if piece.low < ground.low - _TOUCH and piece.body not in (ground.body, ground.shaft)
        ),
        None,
    )
    if below is not None:
        raise DesignError(
            f'{below.part} stands out below the ground plate, where legs and motor stand; set frame = "none"'
        )
    size = screw_size(SCREW)
    top = ground.high + size.head_height + keys.axial_gap
    over = list(space.between(ground.high, top, without=ground.body))
    pose = motion.poses[ground.body]
    x, y = pose.position[0, :2]
    turn = math.atan2(pose.rotation[0, 1, 0], pose.rotation[0, 0, 0])
    regions = [
        (
            piece.part,
            affinity.rotate(affinity.translate(piece.region, -x, -y), -turn, (0, 0), use_radians=True),
        )
        for piece in over
    ]
    radius = size.head / 2 + CLEARANCE

    def attitude(corners: Sequence[Point]) -> tuple[float | None, str]:
        """The motor's, or what is in the way."""
        for at in corners:
            for part, region in regions:
                if region.distance(shapely.Point(at)) < radius:
                    return None, f"{part} passes over the head of the screw"
        found = _turn(corners, ground, wanted, coupling)
        return found, "" if found is not None else "the motor or its coupling is in the way of the leg"

    angle, why = attitude(ground.holes)
    if angle is None:
        raise GroundError(
            _offset_fault(ground, why, regions, lambda corners: attitude(corners)[0] is not None)
        )
    return angle


def _turn(
    corners: Sequence[Point], ground: GroundPlate, wanted: Wanted, coupling: Coupling | None
) -> float | None:
    """The first attitude of the motor that is clear of all columns."""
    if wanted.motor is None or coupling is None:
        return 0.0
    room = PILLAR / 2 + BESIDE
    if any(math.dist(at, ground.axis) < coupling.of.outside / 2 + room for at in corners):
        return None
    places = shapely.multipoints(corners)
    for angle in TURNS:
        if outline(wanted.motor.face, ground.axis, angle).distance(places) >= room:
            return angle
    return None


def _offset_fault(
    ground: GroundPlate,
    why: str,
    regions: Sequence[tuple[str, shapely.Geometry]],
    clear: Callable[[Sequence[Point]], bool],
) -> Finding:
    """With the least whole offset of the holes that leaves all of them free."""
    now, key = ground.holes[2][1], ground.offset_key
    far = max((abs(y) for _, region in regions for y in region.bounds[1::2]), default=0.0)
    x0, x1 = ground.holes[0][0], ground.holes[1][0]
    works = next(
        (
            float(y)
            for y in range(math.floor(now) + 1, math.ceil(max(now, far)) + 2 * math.ceil(PILLAR) + 60)
            if clear(((x0, -y), (x1, -y), (x1, y), (x0, y)))
        ),
        None,
    )
    remedy = "use a smaller motor" if works is None else f"make it {works:g}"
    said = f"the ground plate's holes stand {now:g} mm beside the line of its pivots, where {why}"
    proposed: tuple[Change, ...] = () if works is None else ({key: works},)
    return _fault("frame.ground-offset", key, said, now, works, remedy, proposed)

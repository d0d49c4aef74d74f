"""The motor under the lower bearing plate: a plate that carries it, four pillars, and the coupling.

The motor's shaft stands in the axis of the input. Between it and the shaft is a flexible coupling, for the
motor has two bearings of its own.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import shapely

from mechwright.contracts.bought import Bought
from mechwright.contracts.holes import threaded
from mechwright.contracts.shape import Revolve, Shape, ring
from mechwright.contracts.surroundings import OVER, Place, turned
from mechwright.contracts.turned import EndThread, Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import EDGE, PILLAR, PITCH, SCREW, SPARE, put_screw
from mechwright.machine.frame.plates import Hole, add_plate
from mechwright.machine.frame.standing import Disc, Standing
from mechwright.standards.couplings import BORES, Coupling, coupling_for
from mechwright.standards.motors import GearMotor, MotorFace, Stepper
from mechwright.standards.screws import screw, screw_size

Motor = Stepper | GearMotor

PLATE = 6.0
"""Thickness of the plate that carries the motor, mm: thin, for the motor's shaft goes through it."""

GAP = 1.0
"""Between coupling and bearing plate, and over the heads of the motor's screws, mm."""

FLANGE = 5.0
"""Thickness of a flange with through holes, mm: NEMA 23 motors have 4.8 to 5."""

PILOT = 0.2
"""By how much the plate's hole is larger than the motor's pilot, mm: the coupling takes what it is off."""

REACH, GRIP = 4.0, 3.0
"""How deep screws go into a motor with threaded holes, mm, at most, for they are 4.5 deep; and at least."""

BESIDE = 2.0
"""Between a pillar and what is beside it, mm."""

TURNS = tuple(math.radians(angle) for angle in (0, 15, 30, 45, 60, 75))
"""Attitudes of the bracket that are tried, rad: a quarter turn brings the square of pillars back."""

WIDER = 40
"""Its square of pillars is tried up to so much wider than it need be, mm."""


@dataclass(frozen=True)
class Bracket:
    """The motor, its coupling, and where everything stands.

    Parameters
    ----------
    axis
        Of the input, mm.
    angle
        By which the motor is turned, rad.
    half
        Half the side of the square of its pillars, mm.
    stub
        Diameter and length, mm, of the shaft below the lower bearing.
    coupling_low, face
        Heights of the coupling's lower end and of the motor's face, mm.
    """

    motor: Motor
    coupling: Coupling
    axis: Point
    angle: float
    half: float
    stub: tuple[float, float]
    coupling_low: float
    face: float

    @property
    def top(self) -> float:
        """Upper face of the motor's plate, mm."""
        return self.face + PLATE

    @property
    def low(self) -> float:
        """Lower end of the motor, mm."""
        return self.face - self.motor.length

    def at(self, place: Point) -> Point:
        """A place of the motor's plate in the ground, mm."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return self.axis[0] + c * place[0] - s * place[1], self.axis[1] + s * place[0] + c * place[1]

    @property
    def corners(self) -> list[Point]:
        """Where its pillars stand in the ground, mm."""
        signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
        return [self.at((a * self.half, b * self.half)) for a, b in signs]

    @property
    def region(self) -> shapely.Geometry:
        """What plate and motor take, seen from above."""
        return shapely.MultiPoint(self.corners).convex_hull.buffer(EDGE)


class NoCouplingError(DesignError):
    """The shaft is thinner than any coupling's bore."""


def stub_for(bearing_bore: float, motor_shaft: float, torque: float) -> tuple[float, Coupling]:
    """Diameter of the shaft's stub, mm, and its coupling; DesignError where no coupling has both bores."""
    fault: DesignError | None = None
    for bore in sorted((b for b in BORES if b <= bearing_bore), reverse=True):
        try:
            return bore, coupling_for(motor_shaft, bore, torque)
        except DesignError as error:
            fault = fault or error
    raise fault or NoCouplingError(
        f"a shaft in bearings of {bearing_bore:g} mm has no coupling: the least has a bore of {BORES[0]:g} mm"
    )


def bracket_for(
    motor: Motor,
    seat: tuple[Point, float, float],
    levels: tuple[float, float],
    torque: float,
    others: Sequence[Disc],
) -> Bracket:
    """Where a motor stands.

    Parameters
    ----------
    seat
        Axis of the input, bore and width of its bearing, mm.
    levels
        Inner and outer face of the bearing plate above, mm.
    torque
        That the coupling carries, N m.
    others
        Places in that plate which the pillars' screws keep clear of.

    Raises
    ------
    DesignError
        No coupling fits, or there is no room for the screws.
    """
    axis, bore, width = seat
    inner, under = levels
    face = motor.face
    diameter, coupling = stub_for(bore, face.shaft, torque)
    long, size = coupling.of.length, screw_size(SCREW)
    low = under - GAP - long
    inserted = min(long / 2, face.shaft_length - PLATE - screw_head(face) - GAP / 2)
    stub = (diameter, (inner - width) - (low + long / 2))
    least = max(face.spread / 2, coupling.of.outside / 2) + (PILLAR + size.head) / 2 + BESIDE
    head = size.counterbore / 2 + BESIDE
    for wider in range(WIDER):
        for angle in TURNS:
            found = Bracket(
                motor,
                coupling,
                axis,
                angle,
                round(least) + wider,
                stub,
                low,
                low + inserted - face.shaft_length,
            )
            clear = all(
                math.dist(corner, one.point) >= one.radius + head
                for corner in found.corners
                for one in others
            )
            if clear:
                return found
    raise DesignError(
        f"no room for the pillars of the motor's bracket within {round(least) + WIDER} mm of the input's axis"
    )


def pillar_holes(bracket: Bracket, thickness: float) -> list[Hole]:
    """Of the bearing plate above: screws whose heads lie below its inner face."""
    size = screw_size(SCREW)
    sunk = (size.counterbore, 0.0, size.counterbore_depth)
    return [
        Hole(f"motor-{k}", point, (sunk, (size.clearance(), 0.0, thickness)))
        for k, point in enumerate(bracket.corners, start=1)
    ]


def screw_head(face: MotorFace) -> float:
    """Height of the motor's screws over its plate, mm."""
    return screw_size(face.thread).head_height if face.thread else 0.0


def screw_places(face: MotorFace) -> list[Point]:
    """Where a motor's screws stand, from its shaft, mm."""
    x, half = -face.offset, face.spread / 2
    if not face.round:
        return [(a, b) for a in (-half, half) for b in (-half, half)]
    # The shaft stands off the middle towards the gap between two screws.
    turns = (math.tau * (k + 0.5) / face.holes for k in range(face.holes))
    return [(x + half * math.cos(turn), half * math.sin(turn)) for turn in turns]


def drilled(motor: Motor) -> Bought:
    """The motor with the holes of its screws; behind a flange with through holes their heads have room."""
    face, bought = motor.face, motor.bought
    assert bought.shape is not None  # noqa: S101 - the table's motors have one
    if face.thread:
        holes = [ring(0.0, face.thread, REACH + SPARE, -REACH - SPARE)]
    else:
        head = screw_size(SCREW).head + 1.0
        holes = [
            ring(0.0, face.hole, FLANGE, -FLANGE),
            ring(0.0, head, motor.length - FLANGE, -motor.length),
        ]
    less = [Revolve(hole.profile, place) for place in screw_places(face) for hole in holes]
    return replace(bought, shape=Shape(bought.shape.pieces, (*bought.shape.less, *less)))


def add_bracket(kit: Kit, bracket: Bracket, body: str, levels: tuple[float, float], material: str) -> None:
    """Motor, coupling, plate, pillars and screws; ``body`` of the motion turns with the input."""
    face, axis = bracket.motor.face, bracket.axis
    kit.places["motor"] = Place((*axis, 0.0), turned(bracket.angle))
    kit.places["motor-carrier"] = Place((*axis, 0.0), turned(bracket.angle))
    kit.places["motor-shaft"] = Place(on=body)
    kit.bought("motor", drilled(bracket.motor), "motor", bracket.face)
    kit.bought("coupling", bracket.coupling.bought, "motor-shaft", bracket.coupling_low)
    half, size = bracket.half, screw_size(SCREW)
    corners = ((-half, -half), (half, -half), (half, half), (-half, half))
    hole = screw_size(face.thread).clearance() if face.thread else SCREW
    holes = [
        Hole.through("pilot", (0.0, 0.0), face.pilot + PILOT, PLATE),
        *(Hole.through(f"pillar-{k}", p, size.clearance(), PLATE) for k, p in enumerate(corners, start=1)),
        *(Hole.through(f"screw-{k}", p, hole, PLATE) for k, p in enumerate(screw_places(face), start=1)),
    ]
    standing = Standing(-half, -half, half, half)
    add_plate(kit, "motor-plate", standing, EDGE, PLATE, material, holes, "motor-carrier", bracket.face)
    if not face.thread:
        plate = kit.parts["motor-plate"]
        for k in range(1, len(screw_places(face)) + 1):
            plate = threaded(plate, f"screw-{k}", f"M{SCREW:g}")
        kit.parts["motor-plate"] = plate
    _add_pillars(kit, bracket, levels)
    _add_motor_screws(kit, bracket)


def _add_pillars(kit: Kit, bracket: Bracket, levels: tuple[float, float]) -> None:
    """Between both plates, with a screw from either side."""
    inner, under = levels
    seat = inner - screw_size(SCREW).counterbore_depth
    above, below = screw(SCREW, seat - under + SCREW), screw(SCREW, PLATE + SCREW)
    threads = (
        EndThread("lower", SCREW, PITCH, below.length - PLATE + SPARE),
        EndThread("upper", SCREW, PITCH, above.length - (seat - under) + SPARE),
    )
    note = "all four to one length in one setting, ±0.05"
    form = Turned((Step(PILLAR, under - bracket.top),), note=note, threads=threads)
    for k, point in enumerate(bracket.corners, start=1):
        body = f"motor-pillar-{k}"
        kit.places[body] = Place((*point, 0.0))
        kit.places[f"{body}-below"] = Place((*point, 0.0), OVER)
        kit.turned("motor-pillar", form, body, bracket.top)
        put_screw(kit, above, body, seat)
        put_screw(kit, below, f"{body}-below", -bracket.face)


def _add_motor_screws(kit: Kit, bracket: Bracket) -> None:
    """From above into the motor's threads, or from behind its flange into the plate's."""
    face = bracket.motor.face
    for k, place in enumerate(screw_places(face), start=1):
        body = f"motor-screw-{k}"
        origin = (*bracket.at(place), 0.0)
        if face.thread:
            kit.places[body] = Place(origin)
            put_screw(kit, screw(face.thread, PLATE + GRIP), body, bracket.top)
        else:
            kit.places[body] = Place(origin, OVER)
            put_screw(kit, screw(SCREW, FLANGE + PLATE - 1.0), body, FLANGE - bracket.face)

"""A motor in the axis of the input with its coupling, its screws, and the holes that a plate needs for it."""

import math
from dataclasses import dataclass, replace

import shapely
from shapely import affinity

from mechwright.contracts.bought import BlindThread, Bought
from mechwright.contracts.holes import threaded
from mechwright.contracts.shape import Revolve, Shape, ring
from mechwright.contracts.surroundings import OVER, Place, turned
from mechwright.geometry.segments import Point
from mechwright.machine.frame.fixing import Fixing, fixing, put_fixing
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import SCREW, put_screw
from mechwright.machine.frame.plates import Hole
from mechwright.standards.couplings import Coupling
from mechwright.standards.motors import DIE_CAST, GearMotor, MotorFace, Stepper
from mechwright.standards.screws import screw, screw_size

Motor = Stepper | GearMotor

PLATE = 6.0
"""Thickness of the plate that carries the motor, mm: thin, for the motor's shaft goes through it."""

GAP = 1.0
"""Between coupling and bearing plate, and over the heads of the motor's screws, mm."""

SHAFT_GAP = 1.5
"""By how much the driven shaft ends above the middle of the coupling, mm: both shafts keep half a millimetre
apart with all tolerances, and either is in its hub by four fifths of the depth."""

FLANGE = 5.0
"""Thickness of a flange with through holes, mm: NEMA 23 motors have 4.8 to 5."""

PILOT_HOLE = "H8"
"""Class of the plate's hole for the motor's pilot: screws alone would centre the motor to 0.15 mm."""

SUNK = 2.0
"""How deep the heads of the motor's screws may be sunk into its plate, mm: so much longer they reach."""

BESIDE = 2.0
"""Between a pillar and what is beside it, mm."""

TURNS = tuple(math.radians(angle) for angle in (0, 15, 30, 45, 60, 75))
"""Attitudes of the bracket that are tried, rad: a quarter turn brings the square of pillars back."""


@dataclass(frozen=True)
class Coupled:
    """The motor and its coupling, and where they stand.

    Parameters
    ----------
    axis
        Of the input, mm.
    angle
        By which the motor is turned, rad.
    coupling_low, face
        Heights of the coupling's lower end and of the motor's face, mm.
    """

    motor: Motor
    coupling: Coupling
    axis: Point
    angle: float
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


def coupling_below(end: float, long: float) -> float:
    """Height of the lower end of a coupling of a length, mm, on a shaft that ends at a height."""
    return end - long / 2 - SHAFT_GAP


def face_below(face: MotorFace, low: float, long: float) -> float:
    """Height of a motor's face, mm, under a coupling of a length whose lower end is at ``low``."""
    inserted = min(long / 2, face.shaft_length - PLATE - screw_head(face) - GAP / 2)
    return low + inserted - face.shaft_length


def outline(face: MotorFace, axis: Point, angle: float) -> shapely.Geometry:
    """What a motor takes, seen from above, its shaft in ``axis`` and turned by an angle, rad."""
    x, half = -face.offset, face.across / 2
    plan = shapely.Point(x, 0.0).buffer(half) if face.round else shapely.box(x - half, -half, x + half, half)
    return affinity.translate(affinity.rotate(plan, angle, (0, 0), use_radians=True), *axis)


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
    threads: tuple[BlindThread, ...] = ()
    if face.thread:
        holes = [ring(0.0, face.thread, face.depth, -face.depth)]
        threads = tuple(
            BlindThread(place, 0.0, face.thread, face.depth, DIE_CAST) for place in screw_places(face)
        )
    else:
        head = screw_size(SCREW).head + 1.0
        holes = [
            ring(0.0, face.hole, FLANGE, -FLANGE),
            ring(0.0, head, motor.length - FLANGE, -motor.length),
        ]
    less = [Revolve(hole.profile, place) for place in screw_places(face) for hole in holes]
    shape = Shape(bought.shape.pieces, (*bought.shape.less, *less))
    return replace(bought, shape=shape, threads=threads)


def motor_fixing(face: MotorFace) -> Fixing:
    """A screw from above through the motor's plate into its thread; raises DesignError where none fits."""
    return fixing(face.thread, PLATE, face.depth, SUNK)


def motor_holes(face: MotorFace) -> list[Hole]:
    """Of the plate that carries a motor, from the motor's shaft: pilot and screws."""
    steps: tuple[tuple[float, float, float], ...] = ((SCREW, 0.0, PLATE),)
    if face.thread:
        size, sunk = screw_size(face.thread), motor_fixing(face).sunk
        steps = ((size.clearance(), 0.0, PLATE),)
        if sunk:
            steps = ((size.counterbore, 0.0, sunk), *steps)
    places = enumerate(screw_places(face), start=1)
    return [
        Hole("pilot", (0.0, 0.0), ((face.pilot, 0.0, PLATE),), PILOT_HOLE),
        *(Hole(f"screw-{k}", place, steps) for k, place in places),
    ]


def add_motor(kit: Kit, coupled: Coupled, body: str) -> None:
    """Motor and coupling; ``body`` of the motion turns with the input."""
    kit.places["motor"] = Place((*coupled.axis, 0.0), turned(coupled.angle))
    kit.places["motor-shaft"] = Place(on=body)
    short = max(PLATE - coupled.motor.face.pilot_height, 0.0)
    kit.bought("motor", drilled(coupled.motor), "motor", coupled.face, play=short)
    # Each shaft goes into half of the coupling, that of the motor as far as it is long enough.
    inside = coupled.face + coupled.motor.face.shaft_length - coupled.coupling_low
    empty = max(coupled.coupling.of.length / 2 - inside, 0.0)
    kit.bought(
        "coupling", coupled.coupling.bought, "motor-shaft", coupled.coupling_low, play=max(empty, SHAFT_GAP)
    )


def fasten_motor(kit: Kit, coupled: Coupled) -> None:
    """To the part ``motor-plate``: from above into the motor's threads, or from below into the plate's."""
    face = coupled.motor.face
    for k, place in enumerate(screw_places(face), start=1):
        body = f"motor-screw-{k}"
        origin = (*coupled.at(place), 0.0)
        if face.thread:
            kit.places[body] = Place(origin)
            put_fixing(kit, motor_fixing(face), body, coupled.top)
        else:
            kit.parts["motor-plate"] = threaded(kit.parts["motor-plate"], f"screw-{k}", f"M{SCREW:g}")
            kit.places[body] = Place(origin, OVER)
            put_screw(kit, screw(SCREW, FLANGE + PLATE - 1.0), body, FLANGE - coupled.face)

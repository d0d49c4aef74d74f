"""The motor under the lower bearing plate: a plate that carries it, four pillars, and the coupling.

The motor's shaft stands in the axis of the input. Between it and the shaft is a flexible coupling, for the
motor has two bearings of its own.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import shapely

from mechwright.contracts.surroundings import OVER, Place, turned
from mechwright.contracts.turned import Length, Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.coupled import (
    BESIDE,
    GAP,
    PLATE,
    SHAFT_GAP,
    TURNS,
    Coupled,
    Motor,
    add_motor,
    face_below,
    fasten_motor,
    motor_holes,
)
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import EDGE, PILLAR, SCREW, end_threads, put_screw, spanner_flats
from mechwright.machine.frame.plates import Hole, add_plate
from mechwright.machine.frame.standing import Disc, Standing
from mechwright.standards.couplings import BORES, Coupling, coupling_for
from mechwright.standards.motors import MotorFace
from mechwright.standards.screws import screw, screw_size

HEIGHT, BRACKET_HEIGHT = 0.05, "pillars of the bracket"
"""Limit deviations of the height of its pillars, plus and minus, mm, and the name of that length."""

WIDER = 40
"""Its square of pillars is tried up to so much wider than it need be, mm."""


@dataclass(frozen=True)
class Bracket(Coupled):
    """With the plate that carries it on pillars of its own.

    Parameters
    ----------
    half
        Half the side of the square of its pillars, mm.
    stub
        Diameter and length, mm, of the shaft below the lower bearing.
    """

    half: float
    stub: tuple[float, float]

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


def least_half(face: MotorFace, coupling: Coupling) -> float:
    """Half the side of the square of pillars, mm, between which motor's screws and coupling have room."""
    beside = (PILLAR + screw_size(SCREW).head) / 2 + BESIDE
    return max(face.spread / 2, coupling.of.outside / 2) + beside


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
    stub = (diameter, (inner - width) - (low + long / 2 + SHAFT_GAP))
    least = least_half(face, coupling)
    head = size.counterbore / 2 + BESIDE
    for wider in range(WIDER):
        for angle in TURNS:
            found = Bracket(
                motor,
                coupling,
                axis,
                angle,
                low,
                face_below(face, low, long),
                round(least) + wider,
                stub,
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


def add_bracket(
    kit: Kit, bracket: Bracket, body: str, levels: tuple[float, float], material: str, *, sunk: bool = True
) -> None:
    """Motor, coupling, plate, pillars and screws; ``body`` of the motion turns with the input.

    ``sunk``: the heads of the screws are sunk into the upper one of the ``levels``, mm, else they lie on it.
    """
    add_motor(kit, bracket, body)
    kit.places["motor-carrier"] = Place((*bracket.axis, 0.0), turned(bracket.angle))
    half, size = bracket.half, screw_size(SCREW)
    corners = ((-half, -half), (half, -half), (half, half), (-half, half))
    pilot, *screws = motor_holes(bracket.motor.face)
    pillars = [
        Hole.through(f"pillar-{k}", p, size.clearance(), PLATE) for k, p in enumerate(corners, start=1)
    ]
    holes = [pilot, *pillars, *screws]
    standing = Standing(-half, -half, half, half)
    add_plate(kit, "motor-plate", standing, EDGE, PLATE, material, holes, "motor-carrier", bracket.face)
    inner, under = levels
    _add_pillars(kit, bracket, inner - screw_size(SCREW).counterbore_depth if sunk else inner, under)
    fasten_motor(kit, bracket)


def _add_pillars(kit: Kit, bracket: Bracket, seat: float, under: float) -> None:
    """Between both plates, with a screw from either side; the heads of the upper ones lie on ``seat``, mm."""
    above, below = screw(SCREW, seat - under + SCREW), screw(SCREW, PLATE + SCREW)
    threads = end_threads(below.length - PLATE, above.length - (seat - under))
    height = under - bracket.top
    length = Length(BRACKET_HEIGHT, 0.0, height, -HEIGHT, HEIGHT)
    note = "all four to one length in one setting"
    form = Turned(
        (Step(PILLAR, height),),
        note=note,
        threads=threads,
        lengths=(length,),
        flats=spanner_flats(height),
    )
    for k, point in enumerate(bracket.corners, start=1):
        body = f"motor-pillar-{k}"
        kit.places[body] = Place((*point, 0.0))
        kit.places[f"{body}-below"] = Place((*point, 0.0), OVER)
        kit.turned("motor-pillar", form, body, bracket.top)
        put_screw(kit, above, body, seat)
        put_screw(kit, below, f"{body}-below", -bracket.face)

"""The joint between the arm's shaft and its gear: pressed on in one phase, clamped at an angle in several.

With several phases the wheel runs on the shaft, and a disc below it is pressed onto the shaft. Two screws go
from below through arc slots of the disc into threads of the wheel: loosened, crank and gears turn while the
arm rests.
"""

import math
from dataclasses import dataclass

from mechwright import GeometryError, kept
from mechwright.mechanics.linkage.clamp import Clamp, clamps, least_stud
from mechwright.mechanics.linkage.slots import ArcSlot
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY, face_torque
from mechwright_five_bar.kinematics.phases import phases_of
from mechwright_five_bar.kinematics.train import train_of
from mechwright_five_bar.parameters import FiveBarParams

SCREWS = 2
"""Opposite each other."""

ENGAGED = 1.2
"""Least length of thread in the wheel, in diameters."""


@dataclass(frozen=True)
class Hub:
    """The clamp of the wheel; lengths in mm, angles in rad.

    Parameters
    ----------
    clamp
        Screw, washer and width of the slots.
    circle, outside
        Radius on which the screws stand, and that of the disc.
    first, sweep
        Direction of the first slot's first end in the arm's frame, and its length.
    angles
        Of the wheel against the arm in each phase, that of the design first.
    """

    clamp: Clamp
    circle: float
    outside: float
    first: float
    sweep: float
    angles: tuple[float, ...]

    @property
    def slots(self) -> tuple[ArcSlot, ...]:
        """Of the disc, in the arm's frame."""
        return tuple(
            ArcSlot(0j, self.circle, self.first + k * math.tau / SCREWS, self.sweep, self.clamp.width)
            for k in range(SCREWS)
        )

    def torque(self, shaft: float) -> float:
        """What the disc's face holds by friction, N m, with safety."""
        return face_torque(self.clamp.preload, SCREWS, self.outside, shaft / 2) / CLAMP_SAFETY


def wheel_angles(params: FiveBarParams) -> tuple[float, ...]:
    """Angle of the wheel's frame from the arm's in each phase, rad, that of the design first."""
    train, ground = train_of(params), math.radians(params.ground_angle)
    base = train.angles(-ground)["wheel"] + ground
    return tuple(base - math.radians(one.arm_angle) for one in phases_of(params))


@kept
def hub_of(params: FiveBarParams) -> Hub | None:
    """The clamp of a design that shows its first phase; None where nothing is re-phased.

    Raises
    ------
    GeometryError
        The pins are too thin for a screw, the slots run into each other, or the wheel is too small or too
        thin; the message names the parameter.
    """
    angles = wheel_angles(params)
    if max(angles) - min(angles) < ANGLE:
        return None
    plate = params.gear_thickness
    faults = []
    for clamp in clamps(params.pin_diameter, plate, plate, ENGAGED):
        try:
            return _hub(params, clamp, angles)
        except GeometryError as error:
            faults.append(error)
    if faults:
        raise faults[-1]
    raise GeometryError(
        f"gear_thickness: no screw clamps a gear {plate:g} mm thick on a shaft of {params.pin_diameter:g} "
        "mm; take "
        f"shafts of {least_stud():g} mm or more and gears of 8 mm"
    )


def _hub(params: FiveBarParams, clamp: Clamp, angles: tuple[float, ...]) -> Hub:
    """With one size of screws; raises as :func:`hub_of`."""
    width, low = clamp.width, min(angles)
    circle = _up(params.pin_diameter / 2 + params.rim + width / 2)
    sweep = max(angles) - low
    if (math.tau / SCREWS - sweep) * circle < width + params.rim:
        turn = (math.tau / SCREWS - (width + params.rim) / circle) / abs(params.ratio)
        raise GeometryError(
            f"phases: the crank is turned over {math.degrees(sweep / abs(params.ratio)):.4g} degrees "
            "between the "
            f"phases, and the slots of the gear's clamp leave room for {math.degrees(turn):.4g}"
        )
    wheel = train_of(params).root("wheel")
    need = circle + clamp.size.size / 2 + params.rim
    if need > wheel:
        raise GeometryError(
            f"arm_teeth: the arm's gear has a root radius of {wheel:.4g} mm, and the screws of its clamp "
            "need "
            f"{need:.4g} mm"
        )
    outside = circle + max(width / 2 + params.rim, clamp.reach)
    return Hub(clamp, circle, outside, low, sweep, angles)


ANGLE = 1e-9
"""rad. Phases in which gear and arm stand alike to this need no clamp."""


def _up(radius: float) -> float:
    """To the next half millimetre."""
    return math.ceil(2 * radius - 1e-9) / 2

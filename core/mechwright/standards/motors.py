"""Motors: steppers of NEMA 17 and 23, and DC gear motors of 37 mm.

The origin is the shaft's axis in the mounting face; the shaft points along +z, the body lies below.
"""

from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import Fit, shaft_fit
from mechwright.contracts.shape import Prism, Revolve, Shape, box, ring
from mechwright.errors import DesignError, did_you_mean
from mechwright.standards.ordering import UNIFIED
from mechwright.standards.screws import FRAME
from mechwright.standards.stock import AS_THICK, INCH, InchSize
from mechwright.standards.table import table

NOMINAL_VOLTAGE = 12.0
"""At which the gear motors of the table have their speeds and torques, V."""
IDLE_CURRENT, STALL_CURRENT = 0.2, 5.5
"""Of the gear motors at that voltage without load and at standstill, A: a maker's sheet, for all ratios."""
GEARBOX_CONTINUOUS, GEARBOX_PEAK = 100.0, 250.0
"""Torques that their gearbox bears, kg mm: for long, a maker's advice; for a moment, a handbook figure."""
DIE_CAST = 110.0
"""At which a thread strips in the die-cast face of a motor or gearbox, MPa; handbook, unchecked."""

KG_MM = 9.80665e-3
"""A torque of one kilogram-force millimetre, N m."""


@dataclass(frozen=True)
class MotorFace:
    """What a motor needs of the plate that carries it, mm; see the table's own words."""

    name: str
    across: float
    round: bool
    holes: int
    spread: float
    thread: float
    depth: float
    hole: float
    pilot: float
    pilot_height: float
    shaft: float
    shaft_length: float
    flat: float
    offset: float

    @property
    def fits(self) -> tuple[Fit, ...]:
        """Limits of shaft and pilot: those of makers' sheets, by the nearest classes; unchecked."""
        return shaft_fit(self.shaft, "h7"), shaft_fit(self.pilot, "h9" if self.round else "h8")

    @property
    def inch(self) -> str:
        """Shaft and screws where sizes are in inches: both are sold everywhere as they are.

        >>> motor_face("NEMA 23").inch
        'shaft 1/4 in, screws #10-32 through its flange'
        >>> motor_face("NEMA 17").inch
        'shaft 5 mm (0.197 in), screws M3 in its face'
        """
        quarter = InchSize("1/4")
        exact = abs(self.shaft - quarter.size) < AS_THICK
        shaft = f"{quarter.name} in" if exact else f"{self.shaft:g} mm ({self.shaft / INCH:.3f} in)"
        if self.thread:
            return f"shaft {shaft}, screws M{self.thread:g} in its face"
        return f"shaft {shaft}, screws {UNIFIED[FRAME]} through its flange"

    def shape(self, length: float) -> Shape:
        """Body of that length, pilot and shaft as one solid."""
        x, half = -self.offset, self.across / 2
        axis = (x, 0.0)
        flat: tuple[Prism, ...] = ()
        if self.flat:
            side = self.flat - self.shaft / 2
            top = self.shaft_length + 1.0
            flat = (box((side, self.shaft), (-self.shaft, self.shaft), (self.pilot_height, top)),)
        body: Revolve | Prism = (
            Revolve(((0.0, -length), (half, -length), (half, 0.0), (0.0, 0.0)), axis)
            if self.round
            else box((x - half, x + half), (-half, half), (-length, 0.0))
        )
        shaft = ring(0.0, self.shaft, self.shaft_length)
        return Shape((body, ring(0.0, self.pilot, self.pilot_height), shaft), flat)


@dataclass(frozen=True)
class Stepper:
    """A stepper of 200 full steps; torque N m, inertia kg m², mass g, loads N, mH, A."""

    name: str
    size: int
    length: float
    hold: float
    rotor: float
    mass: float
    radial: float
    axial: float
    inductance: float
    current: float

    @property
    def face(self) -> MotorFace:
        """Of its frame."""
        return motor_face(f"NEMA {self.size}")

    @property
    def bought(self) -> Bought:
        """How it is ordered."""
        words = f"stepper {self.name} mm, {self.hold:g} N m, 1.8°"
        face = self.face
        shape = face.shape(self.length)
        return Bought(words, "NEMA ICS 16", self.mass, shape, fits=face.fits, inch=face.inch)


@dataclass(frozen=True)
class GearMotor:
    """A DC gear motor at its nominal voltage: rev/min, torques in the table's kg mm, length mm, mass g."""

    ratio: float
    no_load: float
    best: float
    best_torque: float
    stall: float
    length: float
    mass: float

    @property
    def name(self) -> str:
        """Size and ratio.

        >>> gear_motors()[0].name
        '37D 18.75:1'
        """
        return f"37D {self.ratio:g}:1"

    @property
    def stall_torque(self) -> float:
        """N m."""
        return self.stall * KG_MM

    @property
    def continuous(self) -> float:
        """Torque that its gearbox bears for long, N m."""
        return GEARBOX_CONTINUOUS * KG_MM

    @property
    def peak(self) -> float:
        """Torque that its gearbox bears for a moment, N m."""
        return GEARBOX_PEAK * KG_MM

    def current(self, torque: float) -> float:
        """That it draws at a torque, A: on the line from no load to stall.

        >>> one = motor("37D 131:1")
        >>> one.current(0.0), one.current(one.stall_torque), round(one.current(one.peak), 3)
        (0.2, 5.5, 3.144)
        """
        return IDLE_CURRENT + (STALL_CURRENT - IDLE_CURRENT) * abs(torque) / self.stall_torque

    @property
    def current_limit(self) -> float | None:
        """A driver's limit with which the motor cannot break its gearbox, A; None if it cannot anyway."""
        return self.current(self.peak) if self.stall_torque > self.peak else None

    @property
    def face(self) -> MotorFace:
        """Of its gearbox."""
        return motor_face("37D")

    @property
    def bought(self) -> Bought:
        """How it is ordered."""
        words = f"gear motor 37D, {NOMINAL_VOLTAGE:g} V, {self.ratio:g}:1, {self.no_load:g} rev/min"
        note = "no standard fixes its face; compare with the maker's sheet"
        shape, inch = self.face.shape(self.length), f"the same motor; {self.face.inch}"
        return Bought(words, "", self.mass, shape, note, fits=self.face.fits, inch=inch)


def steppers() -> tuple[Stepper, ...]:
    """From the weakest to the strongest."""
    return table("steppers").of(Stepper)


def gear_motors() -> tuple[GearMotor, ...]:
    """From the fastest to the slowest."""
    return table("gear-motors").of(GearMotor)


def motors() -> tuple[Stepper | GearMotor, ...]:
    """All of them, the lightest first."""
    return tuple(sorted((*steppers(), *gear_motors()), key=lambda one: one.mass))


def motor(name: str) -> Stepper | GearMotor:
    """The motor of that name; raises DesignError that says the nearest.

    >>> motor("NEMA 17 - 40").hold
    0.36
    """
    known: dict[str, Stepper | GearMotor] = {one.name: one for one in motors()}
    if name in known:
        return known[name]
    hint = did_you_mean(name, known) or f"one of: {', '.join(known)}"
    raise DesignError(f"no motor {name!r}; {hint}")


def motor_faces() -> tuple[MotorFace, ...]:
    """All of them."""
    return table("motor-faces").of(MotorFace)


def motor_face(name: str) -> MotorFace:
    """The face of that name; raises DesignError that lists them."""
    for one in motor_faces():
        if one.name == name:
            return one
    raise DesignError(f"no motor face {name!r}; one of: {', '.join(one.name for one in motor_faces())}")

"""What a part that is bought is ordered as."""

from dataclasses import dataclass

from mechwright.contracts.fits import Fit
from mechwright.contracts.shape import Shape
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point


@dataclass(frozen=True)
class BlindThread:
    """A threaded blind hole of a bought part, which opens upwards along the part's own z.

    Parameters
    ----------
    place
        Of its axis, mm.
    mouth
        Height at which it opens, mm.
    diameter
        Nominal, mm; the pitch is that of the coarse thread.
    depth
        How far a screw may go into it, mm.
    shear
        At which the thread's turns strip, MPa.
    torque
        That its holder bears while a screw is tightened, N m, where rubber holds it; None: any screw's.
    """

    place: Point
    mouth: float
    diameter: float
    depth: float
    shear: float
    torque: float | None = None


@dataclass(frozen=True)
class Bought:
    """A part to order: it is not made, and stands in the bill of materials under its designation.

    Parameters
    ----------
    designation
        As one orders it: ``"ISO 4762 - M4 x 12 - 8.8"``, ``"608-2Z"``.
    standard
        That fixes its sizes, such as ``"ISO 4762"``; empty where only its maker does.
    mass
        Of the catalogue, g, where the solid is an envelope whose volume says another; None: volume times
        density.
    shape
        Its envelope at nominal sizes; None where the part gives its solid itself.
    note
        What a buyer or fitter has to know besides.
    threads
        Its threaded holes, into which screws of the machine go.
    fits
        Limits of its round faces, each by the diameter at which it is drawn.
    stretched
        Whether its length changes with the motion, as of a spring: it is drawn as it is at the start, and the
        check for interference passes it over.
    inch
        What is sold in its place where sizes are in inches, if no standard says it; empty for nothing.
    """

    designation: str
    standard: str = ""
    mass: float | None = None
    shape: Shape | None = None
    note: str = ""
    threads: tuple[BlindThread, ...] = ()
    fits: tuple[Fit, ...] = ()
    stretched: bool = False
    inch: str = ""

    def __post_init__(self) -> None:
        if not self.designation.strip():
            raise DesignError("a part that is bought needs the designation that it is ordered by")
        if self.mass is not None and not self.mass > 0:
            raise DesignError(f"{self.designation}: a mass of {self.mass:g} g; leave it out, or above 0")

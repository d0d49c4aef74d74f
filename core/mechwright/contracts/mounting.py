"""Where the shafts of a mechanism stand, so that a frame can be built around it.

Glossary
--------
spindle
    An axis about which a body of the motion turns in the frame. It is upright, and goes through the body's
    origin.
hub
    What sits on the spindle's shaft and turns with it: one part, or several on each other with one bore.
share
    A torque or force for each newton metre at the input, at its greatest over the motion.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.finding import Change
from mechwright.contracts.on_plates import Post, Slideway
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry.segments import Point


class MountingError(DesignError):
    """A design cannot be held as it is: a key, what is wrong, and what to do, with changes to try."""

    def __init__(self, message: str, proposed: tuple[Change, ...] = ()) -> None:
        super().__init__(message)
        self.proposed = proposed


@dataclass(frozen=True)
class Hub:
    """A hub's seat on its shaft.

    Parameters
    ----------
    low, high
        Heights between which it sits, mm.
    bore
        Diameter, mm.
    key
        Width of its keyway of DIN 6885-1, mm; 0 for a plain bore.
    key_angle
        Direction of the keyway in the body, rad.
    material
        Of the hub: what the key presses on.
    recess
        Diameter of a counterbore about the bore, mm, in which what holds the hub has to stay; infinite
        without one.
    bonded
        Length on which a hub without a keyway is bonded to the shaft, mm: of several hubs the shortest; None
        for all of the seat.
    pieces
        Lengths of the parts that are the hub one on the other, mm; none where it is one part.
    """

    low: float
    high: float
    bore: float
    key: float = 0.0
    key_angle: float = 0.0
    material: str = "aluminium"
    recess: float = math.inf
    bonded: float | None = None
    pieces: tuple[float, ...] = ()

    @property
    def length(self) -> float:
        """Of the seat, mm."""
        return self.high - self.low

    @property
    def stacked(self) -> tuple[float, ...]:
        """Lengths of its parts from below, mm."""
        return self.pieces or (self.length,)

    @property
    def grip(self) -> float:
        """Length on which it is bonded, mm."""
        return self.length if self.bonded is None else self.bonded


@dataclass(frozen=True)
class Spindle:
    """An upright axis that turns in the frame.

    Parameters
    ----------
    name
        Of its parts: ``"2"`` gives ``shaft-2``.
    body
        Of the motion; its origin is on the axis.
    point
        Where the axis stands in the ground, mm.
    hub
        What sits on it.
    bore_key
        The design-file key that sets the hub's bore, such as ``"parameters.bore"``.
    drives
        Whether the input turns it.
    torque
        Share of torque that goes through the shaft; 1 of the input itself.
    force
        Share of radial force in the middle of the hub, N for each N m.
    origin
        Height of the body's origin, mm.
    """

    name: str
    body: str
    point: Point
    hub: Hub
    bore_key: str = ""
    drives: bool = False
    torque: float = 1.0
    force: float = 0.0
    origin: float = 0.0


_ANGLES = (180.0, 90.0, -90.0, 135.0, -135.0, 45.0, -45.0, 0.0)
"""To which parts are turned to get them out of the way, degrees, best first."""


@dataclass(frozen=True)
class Mounting:
    """What a family says of where its mechanism is held.

    Parameters
    ----------
    spindles
        All axes that turn in the frame; one of them drives.
    gap
        The design-file key of the gap along the axes between what turns over each other, and its value, mm;
        None if there is none.
    own_shafts
        Names of the family's own parts in whose place the shafts of a frame stand.
    turning_keys
        The design-file keys, in degrees, that turn parts of the mechanism about a spindle, out of the way of
        others.
    posts
        Pins that stand in a bearing plate.
    slideways
        Linear guides on the lower bearing plate, at one height.
    fastest
        Speed of the input, rev/min, above which the mechanism comes apart, as a follower that leaves its cam,
        and the design-file key of the speed for which it is made; None for none.

    Raises
    ------
    GeometryError
        No spindle, or not one of them, drives; two have one name or stand in one place; or a hub has no bore
        or no length.
    """

    spindles: tuple[Spindle, ...]
    gap: tuple[str, float] | None = None
    own_shafts: tuple[str, ...] = ()
    turning_keys: tuple[str, ...] = ()
    posts: tuple[Post, ...] = ()
    slideways: tuple[Slideway, ...] = ()
    fastest: tuple[float, str] | None = None

    def __post_init__(self) -> None:
        if sum(spindle.drives for spindle in self.spindles) != 1:
            raise GeometryError("a mounting has one spindle that drives")
        for what in ("name", "point"):
            if len({getattr(one, what) for one in self.spindles}) < len(self.spindles):
                raise GeometryError(f"two spindles of a mounting have one {what}")
        for one in self.spindles:
            if not (one.hub.bore > 0 and one.hub.length > 0):
                raise GeometryError(f"the hub of spindle {one.name} has no bore or no length")

    @property
    def driver(self) -> Spindle:
        """The spindle that the input turns."""
        return next(one for one in self.spindles if one.drives)

    @property
    def turned_away(self) -> list[Change]:
        """Changes that turn parts out of the way of others."""
        return [{key: angle} for key in self.turning_keys for angle in _ANGLES]

    def others(self, spindle: Spindle) -> Sequence[Spindle]:
        """All but one."""
        return [one for one in self.spindles if one is not spindle]


@dataclass(frozen=True)
class GroundPlate:
    """What a family says of a ground plate of its own, whose input's shaft stands out below.

    Parameters
    ----------
    body
        Of the motion, which does not move; what follows is in its frame.
    low, high
        Heights of the plate's faces, mm.
    holes
        Where screws go through: corners of a rectangle, counter-clockwise from (least x, least y), mm.
    hole
        Their diameter, mm.
    shaft
        The body that turns with the input; its origin is on the axis.
    axis
        Where it stands, mm.
    diameter, end
        Of the shaft's end, and the height at which it ends, mm.
    offset_key
        The design-file key that moves all four holes outwards.
    hole_key, diameter_key, thickness_key
        Those of ``hole`` and ``diameter``, and of the plate's thickness.
    neck
        How far down the shaft is thicker than its end, or carries something, mm below the plate.
    offset
        What that key says, mm. Default: the distance of the holes from y = 0.
    outwards
        By how much a millimetre of the offset moves a hole along x and y, mm.
    length_key
        The design-file key of how far the shaft stands out; empty where it grows with the diameter.
    access
        Where a key has to reach screws below the plate from underneath: places and radii, mm.
    bolts
        The mechanism's own bolts through the holes, whose ends go into the pillars: the part, and how far
        they stand out below, mm. None where screws of the frame go through.

    Raises
    ------
    GeometryError
        The holes are no such rectangle, or the shaft ends in the plate.
    """

    body: str
    low: float
    high: float
    holes: tuple[Point, Point, Point, Point]
    hole: float
    shaft: str
    axis: Point
    diameter: float
    end: float
    offset_key: str
    hole_key: str
    diameter_key: str
    thickness_key: str
    neck: float = 0.0
    offset: float | None = None
    outwards: Point = (0.0, 1.0)
    length_key: str = ""
    access: tuple[tuple[Point, float], ...] = ()
    bolts: tuple[str, float] | None = None

    def __post_init__(self) -> None:
        (x0, y0), (x1, y1) = self.holes[0], self.holes[2]
        if self.holes != ((x0, y0), (x1, y0), (x1, y1), (x0, y1)) or not (x0 < x1 and y0 < y1):
            raise GeometryError("the holes of a ground plate are the corners of no rectangle")
        if not self.end < self.low - self.neck <= self.low < self.high:
            raise GeometryError("the shaft of a ground plate does not stand out below it")

    @property
    def bare(self) -> float:
        """Height below which the shaft is as thick as its end and carries nothing, mm."""
        return self.low - self.neck

    @property
    def out(self) -> float:
        """The offset of the holes, mm."""
        return self.holes[2][1] if self.offset is None else self.offset

    def moved(self, offset: float) -> tuple[Point, Point, Point, Point]:
        """The holes with another offset, mm."""
        more = offset - self.out
        dx, dy = more * self.outwards[0], more * self.outwards[1]
        (x0, y0), (x1, y1) = self.holes[0], self.holes[2]
        return (x0 - dx, y0 - dy), (x1 + dx, y0 - dy), (x1 + dx, y1 + dy), (x0 - dx, y1 + dy)


@dataclass(frozen=True)
class Foot:
    """A plate on which a mechanism stands, with threads for what it carries and for a base below.

    Parameters
    ----------
    body
        Of the motion, which does not move. The plate lies between z = 0 and its thickness, z pointing down.
    thickness
        mm.
    holes, inner
        Where its threads are for screws from below, and for those from above that hold what it carries, mm.
    screw
        Their diameter, mm.
    grip
        Thickness of what the inner ones hold, mm.
    key
        The design-file key of its thickness.
    """

    body: str
    thickness: float
    holes: tuple[Point, ...]
    inner: tuple[Point, ...]
    screw: float
    grip: float
    key: str


@dataclass(frozen=True)
class Flange:
    """What a family says of a flange about its input's axis, which a motor is to stand on, askew to its foot.

    Parameters
    ----------
    body
        Of the motion, which has the flange and does not move. Its x axis is that of the input, outwards; so
        is that of ``shaft``, whose origin is the same.
    inner, outer
        From the origin to the flange's faces, mm; screws go through from the inner one.
    half
        Half the side of the square of its holes, whose sides lie along y and z, mm.
    shaft
        The body that turns with the input.
    diameter, end
        Of the shaft's end, and from the origin to it, mm.
    reach
        Radius about the origin in which all the rest is, mm.
    foot
        The plate that carries all.
    size_key, tilt_key
        The design-file keys of the square's side, and of the angle, in degrees, between axis and foot's z.
    bond
        Length of what is bonded to the shaft there, mm, and the key of the shaft's diameter.
    opposite
        Whether the flange is at the other end of the axis from which ``tilt_key`` counts: it says 180 degrees
        less the angle.
    """

    body: str
    inner: float
    outer: float
    half: float
    shaft: str
    diameter: float
    end: float
    reach: float
    foot: Foot
    size_key: str
    tilt_key: str
    bond: tuple[float, str]
    opposite: bool = False

    def __post_init__(self) -> None:
        if not 0 < self.inner < self.outer < self.end:
            raise GeometryError("the shaft of a flange does not stand out of it")

"""Free-body diagrams of a linkage: the bodies with their masses, and what acts between them.

Glossary
--------
link
    A moving body with mass; the ground is the body named ``GROUND``.
pin
    A joint that carries a force (two unknowns) through one point.
slide
    A joint along a direction that carries a normal force and a moment (two unknowns).
gears
    Two links that a mesh couples on a carrier; the mesh carries one unknown.
actuator
    The moment or force that keeps a link moving as it does (one unknown).
load
    A given force and moment on a body.

All arrays are (..., n) over the samples, with designs on the axes before; numbers of a design may be columns
(n_designs, 1). Units are any consistent ones.
"""

from dataclasses import dataclass
from typing import Any

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion

GROUND = "ground"
"""Name of the body that does not move."""


@dataclass(frozen=True)
class Link:
    """A moving body with mass.

    Parameters
    ----------
    name
        Its own.
    motion
        Samples (..., n).
    mass
        kg, a number or a column.
    centre
        Centre of mass in the body's coordinates, x + i y, mm, a number or a column.
    inertia
        Moment of inertia about the centre of mass, kg mm², a number or a column.
    """

    name: str
    motion: BodyMotion
    mass: Any
    centre: Any = 0j
    inertia: Any = 0.0

    @property
    def centre_motion(self) -> PointMotion:
        """Motion of the centre of mass, without its jerk."""
        return self.motion.point(self.centre, 2)


@dataclass(frozen=True)
class Pin:
    """A pin at ``place`` (..., n), mm; its force is that of the body ``one`` on the body ``two``."""

    name: str
    one: str
    two: str
    place: Plane


@dataclass(frozen=True)
class Slide:
    """A slide of ``two`` along ``direction``, a unit vector (..., n) or constant.

    Its force on ``two`` by ``one`` acts at ``place`` (..., n), normal to the direction, with a moment.
    """

    name: str
    one: str
    two: str
    direction: Plane | complex
    place: Plane


@dataclass(frozen=True)
class Gears:
    """A mesh: θ two - θ carrier = ratio (θ one - θ carrier) + a constant.

    A multiplier m acts as a moment m on ``two``, -ratio m on ``one`` and (ratio - 1) m on ``carrier``. They
    are in balance and do no work. The force of the teeth on the pins of both gears is not part of it.
    """

    name: str
    one: str
    two: str
    carrier: str
    ratio: Any


@dataclass(frozen=True)
class Actuator:
    """A drive between two bodies.

    Parameters
    ----------
    link, on
        The driven body, and the body that takes the opposite moment or force.
    direction
        Unit vector (..., n) of the force on ``link``, or constant; None for a moment.
    place
        Where the force acts (..., n), mm.
    name
        Key of the result; the default is ``link``.
    """

    link: str
    on: str = GROUND
    direction: Plane | complex | None = None
    place: Plane | complex = 0j
    name: str = ""

    @property
    def key(self) -> str:
        """Name under which its effort is found."""
        return self.name or self.link


@dataclass(frozen=True)
class Load:
    """A given force (..., n) or constant that acts on ``body`` at ``place`` (..., n), and a moment."""

    body: str
    force: Plane | complex
    place: Plane
    moment: Array | float = 0.0


Joint = Pin | Slide | Gears

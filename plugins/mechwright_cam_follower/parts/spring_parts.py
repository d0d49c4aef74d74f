"""The spring of a follower, and its pin on that; the pin that stands is the frame's."""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

from mechwright import FittingMark, Instance, Part, Point, Step, Turned, material
from mechwright.contracts.mass import KILOGRAMS
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parts.follower_dimensions import follower_depth, follower_foot
from mechwright_cam_follower.parts.slide_dimensions import pin_place
from mechwright_cam_follower.spring.choice import mounted_spring
from mechwright_cam_follower.spring.hooks import MountedSpring

SPRING, SPRING_PIN = "spring", "spring-pin"
"""Bodies: the spring, and its pin on the follower."""

GREY, BLACK = (0.68, 0.70, 0.74), (0.25, 0.26, 0.28)

LOOSE = 0.05
"""By how much a hook is drawn off its pin, mm."""

STEEL = "steel"


@dataclass(frozen=True)
class SpringPlace:
    """The spring at the start of the turn.

    Parameters
    ----------
    stands, moves
        The pin that stands, and where the other one is then, mm.
    on_follower
        The other one in the follower's frame, mm.
    z
        Height of the follower's upper face, mm.
    """

    mounted: MountedSpring
    stands: complex
    moves: complex
    on_follower: complex
    z: float

    @property
    def direction(self) -> float:
        """Of the spring from the pin that stands, rad."""
        return cmath.phase(self.moves - self.stands)


def spring_place(m: Mechanism) -> SpringPlace | None:
    """Where the spring of one design is; None without one that is bought."""
    mounted = None if m.given.spring is None else mounted_spring(m.given)
    if mounted is None:
        return None
    hooks, top = mounted.hooks, follower_foot(m) + follower_depth(m)
    if m.slides:
        moves = complex(m.offset, m.start + pin_place(m) + m.given.ends[-1])
        stands = complex(m.offset, m.start + pin_place(m) - hooks.apart)
        return SpringPlace(mounted, stands, moves, 1j * pin_place(m), top)
    # A lever's +x goes from its axis to its roller or along its face, under this angle where it is lowest.
    lowest = math.pi / 2 + m.start if m.flat else math.pi - m.start
    start = math.radians(m.given.ends[-1])
    along = cmath.exp(1j * (lowest - hooks.middle))
    axis = complex(m.axis)
    stands = axis - hooks.tail * along - 1j * hooks.apart * along
    moves = axis - hooks.tail * cmath.exp(1j * (lowest - start))
    return SpringPlace(mounted, stands, moves, complex(-hooks.tail), top)


def hooking(place: SpringPlace) -> str:
    """How the spring is hooked, for whoever puts it in."""
    mounted, apart = place.mounted, abs(place.moves - place.stands)
    first = "the pin of the slide first, and over the hanging one" if mounted.hangs else "both pins"
    return (
        f"Hook the spring over {first} with a spring puller: it is stretched by "
        f"{apart + mounted.neck - mounted.spring.free:.1f} mm and pulls with "
        f"{float(mounted.pull_at(apart)):.3g} N. Keep fingers away."
    )


def spring_pin(m: Mechanism) -> dict[str, tuple[Point, float]]:
    """Place and diameter of the pin's hole in the follower, by its name, mm; empty without a spring."""
    place = spring_place(m)
    if place is None:
        return {}
    return {SPRING_PIN: ((place.on_follower.real, place.on_follower.imag), place.mounted.pin)}


def spring_parts(m: Mechanism) -> list[Part]:
    """The spring, drawn at the start of the turn, and its pin on the follower; empty without a spring."""
    place = spring_place(m)
    if place is None:
        return []
    mounted, depth = place.mounted, follower_depth(m)
    pin = Turned((Step(mounted.pin, depth), *mounted.head))
    apart = abs(place.moves - place.stands)
    bought = mounted.spring.bought(apart, mounted.pin + 2 * LOOSE)
    marks = () if mounted.hangs else (FittingMark(hooking(place)),)
    z = place.z + mounted.height
    return [
        Part(SPRING_PIN, None, 0, STEEL, (Instance(SPRING_PIN, follower_foot(m)),), GREY, turned=pin),
        Part(
            SPRING,
            None,
            0,
            STEEL,
            (Instance(SPRING, z),),
            BLACK,
            bought=bought,
            marks=marks,
            play=mounted.pin,
        ),
    ]


def spring_hole_area(m: Mechanism) -> float:
    """Of the pin's hole in the follower of one design, mm²."""
    return sum(math.pi / 4 * size**2 for _, size in spring_pin(m).values())


def _of_spring(m: Mechanism) -> float:
    place = spring_place(m)
    return math.nan if place is None else place.mounted.spring.mass / 1000


def _of_pin(m: Mechanism) -> float:
    place = spring_place(m)
    if place is None:
        return math.nan
    steps = (Step(place.mounted.pin, follower_depth(m)), *place.mounted.head)
    volume = sum(math.pi / 4 * step.diameter**2 * step.length for step in steps)
    return KILOGRAMS * material(STEEL).density * volume


SPRING_MASSES: dict[str, Callable[[Mechanism], float]] = {SPRING_PIN: _of_pin, SPRING: _of_spring}
"""Masses of one design, kg, by the name of the part; no number without a spring."""

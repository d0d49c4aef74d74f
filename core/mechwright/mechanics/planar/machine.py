"""A planar machine: links, the joints between them, and the drives that move it.

Glossary
--------
link
    A rigid body with a frame of its own; the link called ``GROUND`` stands still.
revolute
    A pin: a point of one link stays on a point of another. Three links on one pin are two revolutes.
prismatic
    A slide: a line of the guide, and a point and a direction of the block; the point stays on the line, the
    directions stay equal.
gear pair
    Two links that turn with a constant ratio as seen from their carrier, which holds both centres.
drive
    The joint whose angle or slide is the input.
branch
    Which of two ways a dyad is put together.

Places are complex numbers x + i y in the frame of their link, mm; angles are in rad. Each number may be a
column (n, 1) over n designs.
"""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.free_bodies import GROUND

Place = Any
"""A complex number, or a column (n, 1) of them."""


@dataclass(frozen=True)
class Revolute:
    """A pin at ``place_one`` of the link ``one`` and at ``place_two`` of the link ``two``."""

    name: str
    one: str
    two: str
    place_one: Place
    place_two: Place

    equations = 2

    @property
    def links(self) -> tuple[str, str]:
        """Both links."""
        return self.one, self.two

    def place(self, link: str) -> Place:
        """Where the pin is in a link."""
        return self.place_one if link == self.one else self.place_two


@dataclass(frozen=True)
class Prismatic:
    """A slide.

    Parameters
    ----------
    guide, block
        The link with the line, and the link that slides on it.
    line, line_angle
        A point of the line in the guide, and the line's direction there; the slide is counted from the point.
    point, block_angle
        The point of the block that stays on the line, and the direction in the block that stays along it.
    """

    name: str
    guide: str
    block: str
    line: Place
    point: Place
    line_angle: Any = 0.0
    block_angle: Any = 0.0

    equations = 2

    @property
    def links(self) -> tuple[str, str]:
        """Both links."""
        return self.guide, self.block

    def direction(self, link: str) -> Any:
        """The direction of the line in the frame of a link, rad."""
        return self.line_angle if link == self.guide else self.block_angle

    def place(self, link: str) -> Place:
        """The point of the line in the guide, or that of the block in the block."""
        return self.line if link == self.guide else self.point


@dataclass(frozen=True)
class GearPair:
    """Two links geared with each other: θ two - θ carrier = ratio (θ one - θ carrier) + phase.

    The ratio is below 0 for two external gears.
    """

    name: str
    one: str
    two: str
    carrier: str
    ratio: float
    phase: Any = 0.0

    equations = 1

    @property
    def links(self) -> tuple[str, str, str]:
        """Both gears and their carrier."""
        return self.one, self.two, self.carrier


Joint = Revolute | Prismatic | GearPair


@dataclass(frozen=True)
class Drive:
    """The input: the angle of ``link`` over ``on``, or its slide where a slide joins them."""

    link: str
    on: str = GROUND

    equations = 1

    @property
    def links(self) -> tuple[str, str]:
        """Both links."""
        return self.link, self.on


@dataclass(frozen=True)
class Pose:
    """Where the frame of a link stands: its origin, x + i y, mm, and its angle, rad."""

    origin: Place
    angle: Any = 0.0


@dataclass(frozen=True)
class Machine:
    """Links, joints and drives.

    Parameters
    ----------
    joints
        In the order of the design file.
    drives
        As many as the machine has degrees of freedom.
    branches
        Name of the inner joint of a dyad to +1 or -1. Default: +1. Revolute between two bars: +1 if the pin
        is to the left of the way from the outer pin of the first bar to that of the second, in the order of
        the joint's links. Slide at one end: the side to which the bar points along the slide. Slide between
        two bars: the side of the second pin from the first along the slide.
    drawn
        Poses at the inputs ``drawn_at``, from which groups that have no closed form are followed.
    """

    joints: Sequence[Joint]
    drives: Sequence[Drive]
    branches: Mapping[str, Any] = field(default_factory=dict)
    drawn: Mapping[str, Pose] = field(default_factory=dict)
    drawn_at: Sequence[Any] = ()

    def __post_init__(self) -> None:
        names = [joint.name for joint in self.joints]
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise KinematicsError(f"joint {twice[0]!r} is named twice")
        for drive in self.drives:
            self.driven_joint(drive)

    @cached_property
    def followed(self) -> dict[Hashable, Any]:
        """What was found by following a group from the drawn pose, for whoever follows it again."""
        return {}

    @property
    def links(self) -> tuple[str, ...]:
        """The moving links in the order in which joints name them."""
        every = dict.fromkeys(link for joint in self.joints for link in joint.links)
        return tuple(link for link in every if link != GROUND)

    @property
    def freedom(self) -> int:
        """Degrees of freedom by the count of Grübler: 3 per moving link less the equations of the joints."""
        return 3 * len(self.links) - sum(joint.equations for joint in self.joints)

    def between(self, one: str, two: str) -> Iterator[Revolute | Prismatic]:
        """The pins and slides of two links."""
        for joint in self.joints:
            if not isinstance(joint, GearPair) and {one, two} == set(joint.links):
                yield joint

    def driven_joint(self, drive: Drive) -> Revolute | Prismatic:
        """The joint that a drive moves; raises KinematicsError where none joins its two links."""
        for joint in self.between(drive.link, drive.on):
            return joint
        raise KinematicsError(f"no joint between {drive.link!r} and {drive.on!r}, which the drive moves")

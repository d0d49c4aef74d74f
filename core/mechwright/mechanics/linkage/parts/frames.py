"""Bodies of the motion: the links, and a frame on every axis that carries turned parts."""

from collections.abc import Iterator, Mapping
from math import cos, sin
from typing import Literal

from mechwright.contracts.joint import GROUND as STANDS
from mechwright.contracts.joint import Joint as MotionJoint
from mechwright.contracts.joint import fixed
from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.mechanics.linkage.parts.axes import joints_to_ground, number
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.parts.slides import position
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Drive, GearPair, Joint, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.rigid import BodyMotion


def frame_of(pin: Pin, link: str, place: complex) -> str:
    """The frame on the axis of a pin that moves with a link: the link itself where its origin is there."""
    if abs(place) <= SAME_PLACE:
        return link
    return f"{link}-{pin.tag}"


def roller_place(layout: Layout, pin: Pin, link: str) -> complex:
    """Where the axis of a pin is in a link that turns with it, or in a roller block, mm."""
    if link in pin.places:
        return pin.places[link]
    for joint in layout.linkage.machine.joints:
        if isinstance(joint, Revolute) and link in joint.links:
            return number(joint.place(link))
    raise GeometryError(f"{pin.name}: link {link} has no pin; give its block one")


def placed_frames(layout: Layout) -> dict[str, tuple[str, complex]]:
    """Frame to its link and its place there, mm; links and posts among them.

    Raises GeometryError for two frames of one name.
    """
    found = {link: (link, 0j) for link in (GROUND, *layout.linkage.machine.links)}

    def add(name: str, link: str, place: complex) -> None:
        if name in found and (found[name][0] != link or abs(found[name][1] - place) > SAME_PLACE):
            raise GeometryError(
                f"{name} is the name of a frame in {found[name][0]} and of one in {link}; "
                "rename a point or a link"
            )
        found.setdefault(name, (link, place))

    for pin in layout.pins:
        for link in (pin.body, *(link for _, link in (*pin.turning, *pin.rolling))):
            place = roller_place(layout, pin, link)
            add(frame_of(pin, link, place), link, place)
    for name, (link, place) in layout.spares.items():
        add(name, link, place)
    for count, at in enumerate(layout.posts, start=1):
        add(f"{GROUND}-post-{count}", GROUND, at)
    return found


def frames_of(layout: Layout, bodies: Mapping[str, BodyMotion]) -> dict[str, Poses]:
    """Poses of all links and frames over a motion of the links (n,)."""
    found = {}
    for name, (link, place) in placed_frames(layout).items():
        at = position(bodies[link], place)
        found[name] = Poses.planar(at.real, at.imag, bodies[link].turning.theta)
    return found


def joints_of(layout: Layout) -> dict[str, MotionJoint]:
    """What holds the bodies of :func:`frames_of`, from the ground outwards; what closes loops is last.

    The drive moves its joint in its own sense.
    """
    machine = layout.linkage.machine
    frames = placed_frames(layout)
    drives = {machine.driven_joint(drive).name: drive for drive in machine.drives}
    held = fixed(STANDS, GROUND)
    closing: dict[str, MotionJoint] = {}
    for joint, one, closes in _outwards(machine):
        if joint.name in frames:
            raise GeometryError(f"joint {joint.name} has the name of a frame; rename its point")
        (closing if closes else held)[joint.name] = _joint(joint, one, drives.get(joint.name))
    for name, (link, _) in frames.items():
        if name != link:
            held |= fixed(link, name)
    return held | closing


def _outwards(machine: Machine) -> Iterator[tuple[Revolute | Prismatic, str, bool]]:
    """Joints, each with its link that is nearer to the ground, and whether both stood before it."""
    distance, reached = joints_to_ground(machine), {GROUND}

    def near(joint: Joint) -> int:
        return min(distance[link] for link in joint.links)

    driven = {machine.driven_joint(drive).name for drive in machine.drives}
    for joint in sorted(machine.joints, key=lambda one: (near(one), one.name not in driven)):
        if isinstance(joint, GearPair):
            continue
        one, two = sorted(joint.links, key=lambda link: distance[link])
        yield joint, one, two in reached
        reached.add(two)


def _joint(joint: Revolute | Prismatic, one: str, drive: Drive | None) -> MotionJoint:
    """A joint with its axis so that a positive way of the second link is that of the drive."""
    two = joint.links[1] if joint.links[0] == one else joint.links[0]
    place = number(joint.place(one))
    point = (place.real, place.imag, 0.0)
    kind: Literal["revolute", "prismatic"] = "revolute"
    if isinstance(joint, Revolute):
        sense = -1.0 if drive is not None and drive.link == one else 1.0
        axis = (0.0, 0.0, sense)
    else:
        kind = "prismatic"
        sense = 1.0 if one == joint.guide else -1.0
        angle = number(joint.direction(one)).real
        axis = (sense * cos(angle), sense * sin(angle), 0.0)
    return MotionJoint(kind, one, two, point, axis, drives=drive is not None)

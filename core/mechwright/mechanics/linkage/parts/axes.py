"""Axes: revolutes that share a point are one pin through the plates of two links or more.

Glossary
--------
roller block
    A block without a plate: its pin runs in a slot of the guide. It has one pin and one slide, and is neither
    driven nor the output, and draws no path.
holder
    The link into which a pin is pressed; the others turn on it.

The driven link holds its shaft, which turns in the ground. At other pivots of the ground the lower ground
plate holds the pin. In the upper ground plate a link that is alone on its pivot holds the pin and turns with
it. Elsewhere the link holds the pin that has the fewest joints between it and the ground, of several the
first one.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright.errors import GeometryError
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import GearPair, Machine, Prismatic, Revolute


@dataclass(frozen=True)
class Axis:
    """The axis of one pin.

    Parameters
    ----------
    point
        Name of the point; its eye in every link is named so.
    places
        Link with a plate to the place of the axis in it, x + i y, mm.
    rollers
        Roller block on the axis to its slide.
    holder
        The link that holds the pin, where the ground does not.
    shaft
        Whether it is the axis of the driven link on the ground.
    joints
        The revolutes on it.
    """

    point: str
    places: Mapping[str, complex]
    rollers: Mapping[str, Prismatic]
    holder: str
    shaft: bool
    joints: tuple[Revolute, ...] = ()


def axes_of(linkage: Linkage) -> tuple[Axis, ...]:
    """The axes in the order of the joints; raises GeometryError for gears and for joints of many designs."""
    machine = linkage.machine
    if geared := next((one for one in machine.joints if isinstance(one, GearPair)), None):
        raise GeometryError(
            f"gear pair {geared.name}: plates of a linkage have no teeth; replace the gears by links"
        )
    blocks = roller_blocks(linkage)
    distance = joints_to_ground(machine)
    return tuple(_axis(linkage, group, blocks, distance) for group in _groups(machine))


def _axis(
    linkage: Linkage, group: list[Revolute], blocks: Mapping[str, Prismatic], distance: Mapping[str, int]
) -> Axis:
    every = {link: number(one.place(link)) for one in group for link in one.links}
    places = {link: at for link, at in every.items() if link not in blocks}
    driven = _driven(linkage, group)
    moving = [link for link in places if link != GROUND]
    order = {link: place for place, link in enumerate(linkage.machine.links)}
    holder = driven or min(moving, key=lambda one: (distance[one], order[one]))
    rollers = {link: blocks[link] for link in every if link in blocks}
    return Axis(group[0].name, places, rollers, holder, driven is not None, tuple(group))


def _driven(linkage: Linkage, group: list[Revolute]) -> str | None:
    for drive in linkage.machine.drives:
        joint = linkage.machine.driven_joint(drive)
        if any(joint is one for one in group) and GROUND in (drive.link, drive.on):
            return drive.on if drive.link == GROUND else drive.link
    return None


def number(value: object) -> complex:
    """A place as one complex number; raises GeometryError for a column of several designs."""
    found = np.asarray(value, complex)
    if found.size != 1:
        raise GeometryError(f"plates are those of one design, not of {found.size}; choose one of them")
    return complex(found.reshape(-1)[0])


def _groups(machine: Machine) -> list[list[Revolute]]:
    """Revolutes that share a point of a link, each group in order."""
    groups: list[list[Revolute]] = []
    for joint in machine.joints:
        if not isinstance(joint, Revolute):
            continue
        own = [group for group in groups if any(_on_one_point(joint, other) for other in group)]
        merged = [one for group in own for one in group] + [joint]
        at = groups.index(own[0]) if own else len(groups)
        groups = [group for group in groups if group not in own]
        groups.insert(at, merged)
    return groups


def _on_one_point(one: Revolute, two: Revolute) -> bool:
    return any(
        abs(number(one.place(link)) - number(two.place(link))) <= SAME_PLACE
        for link in set(one.links) & set(two.links)
    )


def roller_blocks(linkage: Linkage) -> dict[str, Prismatic]:
    """Links without a plate, each to its slide.

    Of two that slide on each other one stays a plate, the guide; of those on one pin that would be left
    without a plate, the first.
    """
    machine = linkage.machine
    kept = {linkage.output, GROUND, *(link for link, _ in linkage.traces.values())}
    kept |= {link for drive in machine.drives for link in drive.links}
    found: dict[str, Prismatic] = {}
    slides = [one for one in machine.joints if isinstance(one, Prismatic)]
    for slide, link in [(one, one.block) for one in slides] + [(one, one.guide) for one in slides]:
        other = slide.guide if link == slide.block else slide.block
        on = [one for one in machine.joints if link in one.links and one is not slide]
        pins = [one for one in on if isinstance(one, Revolute)]
        one_pin = len(on) == len(pins) and len({complex(number(p.place(link))) for p in pins}) == 1
        if link not in kept and link not in found and other not in found and one_pin:
            found[link] = slide
    for group in _groups(machine):
        links = dict.fromkeys(link for joint in group for link in joint.links)
        if all(link in found for link in links):
            del found[next(iter(links))]
    return found


def joints_to_ground(machine: Machine) -> dict[str, int]:
    """Link to the least number of joints from it to the ground; GeometryError for links that have no way."""
    found, last = {GROUND: 0}, {GROUND}
    while last:
        reached = {
            link
            for joint in machine.joints
            if not isinstance(joint, GearPair) and last & set(joint.links)
            for link in joint.links
        } - set(found)
        found |= dict.fromkeys(reached, max(found.values()) + 1)
        last = reached
    if loose := [link for link in machine.links if link not in found]:
        raise GeometryError(f"link {loose[0]}: no pin or slide joins it to the ground; add a joint")
    return found

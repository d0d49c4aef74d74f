"""A linkage as it is drawn: points in one position, the links through them, slides and gears."""

import math
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise

from mechwright import KinematicsError
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.planar.drawn import frame_of, in_frame, with_drawn_branches
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import (
    Drive,
    GearPair,
    Joint,
    Machine,
    Pose,
    Prismatic,
    Revolute,
)
from mechwright_linkage.sketch.tables import NAME, GearTable, SlideTable

MOST_LINKS, MOST_POINTS = 16, 60
"""Of a drawn linkage: layers are sought for all of them."""


def drawn_linkage(
    points: Mapping[str, complex],
    links: Mapping[str, Sequence[str]],
    slides: Sequence[SlideTable],
    gears: Sequence[GearTable],
    drive: Drive,
    output: str,
) -> Linkage:
    """The linkage that is drawn.

    Parameters
    ----------
    points
        Name to place in the drawn position, mm.
    links
        Name to the points of the link, the ground among them. A point of several links is a pin.

    Raises
    ------
    KinematicsError
        The joints do not make a machine that the drive moves; a dyad is drawn at its dead point.
    """
    directions = {slide.block: math.radians(slide.angle) for slide in slides}
    poses = {
        link: frame_of({name: points[name] for name in own}, directions.get(link, 0.0))
        for link, own in links.items()
        if link != GROUND
    }
    poses[GROUND] = Pose(0j)
    inside = {
        link: {name: complex(in_frame(points[name], poses[link])) for name in own}
        for link, own in links.items()
    }
    joints: list[Joint] = _pins(inside)
    joints += [_slide(number, slide, points, poses) for number, slide in enumerate(slides, start=1)]
    joints += [_gears(number, pair, poses) for number, pair in enumerate(gears, start=1)]
    machine = Machine(tuple(joints), (drive,), drawn=poses)
    start = _input(machine, drive, poses)
    machine = with_drawn_branches(Machine(tuple(joints), (drive,), drawn=poses, drawn_at=(start,)))
    return Linkage(machine, inside, output, _traces(inside))


def _pins(inside: Mapping[str, Mapping[str, complex]]) -> list[Joint]:
    """A pin at every point of several links: the ground, or else the first, with each of the others."""
    found: list[Joint] = []
    for point in dict.fromkeys(name for own in inside.values() for name in own):
        on = [link for link in inside if point in inside[link]]
        first, *others = sorted(on, key=lambda link: link != GROUND)
        for number, other in enumerate(others, start=1):
            name = point if number == 1 else f"{point}-{number}"
            found.append(Revolute(name, first, other, inside[first][point], inside[other][point]))
    return found


def _slide(
    number: int, slide: SlideTable, points: Mapping[str, complex], poses: Mapping[str, Pose]
) -> Prismatic:
    guide, block, angle = poses[slide.guide], poses[slide.block], math.radians(slide.angle)
    place = points[slide.point]
    return Prismatic(
        slide.name or f"slide-{number}",
        slide.guide,
        slide.block,
        in_frame(place, guide),
        in_frame(place, block),
        angle - guide.angle,
        angle - block.angle,
    )


def _gears(number: int, pair: GearTable, poses: Mapping[str, Pose]) -> GearPair:
    one, two, carrier = (poses[link].angle for link in (pair.one, pair.two, pair.carrier))
    phase = two - carrier - pair.ratio * (one - carrier)
    return GearPair(pair.name or f"gears-{number}", pair.one, pair.two, pair.carrier, pair.ratio, phase)


def _input(machine: Machine, drive: Drive, poses: Mapping[str, Pose]) -> float:
    """The input in the drawn position: an angle, rad, or 0 of a slide."""
    if isinstance(machine.driven_joint(drive), Prismatic):
        return 0.0
    return float(poses[drive.link].angle - poses[drive.on].angle)


def _traces(inside: Mapping[str, Mapping[str, complex]]) -> dict[str, tuple[str, str]]:
    """The points of one moving link alone: they draw the paths that the linkage is for."""
    every = [name for own in inside.values() for name in own]
    return {
        name: (link, name)
        for link, own in inside.items()
        for name in own
        if link != GROUND and every.count(name) == 1
    }


def refuse_strangers(
    points: Mapping[str, object],
    links: Mapping[str, Sequence[str]],
    slides: Sequence[SlideTable],
    gears: Sequence[GearTable],
) -> None:
    """Refuse names of points and links that are not there, and links that are no links; raises ValueError."""
    for key, names, most in (("points", points, MOST_POINTS), ("links", links, MOST_LINKS)):
        if len(names) > most:
            raise ValueError(f"{key}: there are {len(names)}; at most {most}")
        if wrong := [name for name in names if not re.fullmatch(NAME, name)]:
            raise ValueError(
                f"{key}: {wrong[0]!r} is no name; use up to 40 letters, digits, - and _, and begin with a "
                "letter or a digit"
            )
    if GROUND not in links:
        raise ValueError(
            'links: none is called "ground"; name the points that stand still: ground = ["A0", "B0"]'
        )
    for link, own in links.items():
        if not own:
            raise ValueError(f"links: {link} has no points; name those of its joints")
        if unknown := [name for name in own if name not in points]:
            raise ValueError(f"links: {link} names the point {unknown[0]!r}, which points has not")
        if twice := [one for one, two in pairwise(sorted(own)) if one == two]:
            raise ValueError(f"links: {link} names the point {twice[0]!r} twice")
    used = {name for own in links.values() for name in own}
    if loose := [name for name in points if name not in used]:
        raise ValueError(f"points: {loose[0]} is on no link; name it in one of links, or leave it out")
    tables: list[SlideTable | GearTable] = [*slides, *gears]
    for table in tables:
        for link in table.links:
            if link not in links:
                raise ValueError(f"{table.what}: {link!r} is none of links: {', '.join(links)}")
    for slide in slides:
        if slide.point not in links[slide.block]:
            raise ValueError(f"slides: {slide.point!r} is no point of {slide.block}, which slides")
        if slide.block == slide.guide:
            raise ValueError(f"slides: {slide.block} cannot slide on itself; name another guide")


def refuse_loose_driver(
    driver: str, on: str, links: Mapping[str, Sequence[str]], slides: Sequence[SlideTable]
) -> None:
    """Refuse a driver that no pin and no slide joins to the link on which it moves; raises ValueError."""
    if driver not in links or on not in links:
        return  # refused elsewhere
    joined = set(links[driver]) & set(links[on]) or any({driver, on} == set(one.links) for one in slides)
    if driver == on or not joined:
        raise ValueError(f"driver: no pin or slide joins {driver} to {on}; name a link that moves on it")


def refuse_coincident(
    points: Mapping[str, complex], links: Mapping[str, Sequence[str]], apart: float
) -> None:
    """Refuse a link whose first points coincide, which gives it no direction; raises KinematicsError."""
    for link, own in links.items():
        if link != GROUND and len(own) > 1 and abs(points[own[0]] - points[own[1]]) < apart:
            raise KinematicsError(
                f"points: {own[0]} and {own[1]} of {link} are less than {apart:g} mm apart; the link has no "
                "direction"
            )

"""Pins of the mechanism that stand in the lower bearing plate, or hang from the upper one."""

from dataclasses import replace

import shapely

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.fitting_marks import FittingMark
from mechwright.contracts.on_plates import Post
from mechwright.contracts.surroundings import OVER, UPRIGHT, Place
from mechwright.contracts.turned import Step, Turned
from mechwright.machine.frame.fault import fault
from mechwright.machine.frame.free import CLEARANCE
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.plates import Hole
from mechwright.machine.frame.seats import LEAST_WALL
from mechwright.machine.frame.shafts import BREAK, Levels
from mechwright.machine.frame.standing import Disc
from mechwright.machine.frame.sweep import Space


def post_disc(post: Post) -> Disc:
    """What the plate has to hold of a post."""
    return Disc(post.point, post.diameter / 2 + LEAST_WALL)


def post_hole(post: Post, thickness: float) -> Hole:
    """In the plate: as wide as the post, which is pressed in."""
    return Hole.through(post.name, post.point, post.diameter, thickness)


def post_faults(post: Post, levels: Levels, space: Space) -> list[Finding]:
    """The first thing that is in a post's way; empty if it is free."""
    at = shapely.Point(post.point)
    low, high = (post.tip, levels.upper) if post.hangs else (levels.lower, post.tip)
    for piece in space.between(low, high):
        room = float(shapely.distance(at, piece.region))
        if piece.body not in post.holds and room < post.diameter / 2 + CLEARANCE:
            said = (
                f"{piece.part} passes the axis of {post.name} at {room:.2f} mm, and that is "
                f"{post.diameter:g} mm thick"
            )
            change: Change = {post.key: None}
            return [
                fault(
                    "frame.in-the-way",
                    post.key or "machine.frame",
                    said,
                    room,
                    post.diameter / 2 + CLEARANCE,
                    "leave it out" if post.key else "a frame of two plates is not for this mechanism",
                    (change,) if post.key else (),
                )
            ]
    return []


def add_post(kit: Kit, post: Post, outer: float) -> None:
    """The post, flush with the plate's outer face, whose height is ``outer``, mm."""
    kit.places[post.name] = Place((*post.point, 0.0), OVER if post.hangs else UPRIGHT)
    length = abs(post.low - outer)
    form = Turned((Step(post.diameter, length), *post.head), chamfer=min(BREAK, post.head[-1].diameter / 8))
    kit.turned(post.name, form, post.name, -outer if post.hangs else outer)
    if post.note:
        kit.parts[post.name] = replace(kit.parts[post.name], marks=(FittingMark(post.note),))

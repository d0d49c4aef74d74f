"""The kinematic skeleton of a mechanism whose parts are not there: joints as points, links as lines.

It comes from what the motion says of its joints alone. Bodies that are fixed to each other are one link; it
joins the places of its joints, and the points whose paths are drawn.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Motion, Poses
from mechwright_cad.animation.figures import DRAWN, rounded

COLOURS = ("#c75c4d", "#7394b3", "#cbac6a", "#6f9c6b", "#9a79b0", "#4f9a9a", "#b57f50")
"""Of the links that move, one after the other."""

FRAME = "#8a929a"
"""Colour of what stands still."""

DOT, BLOCK, HAND = 0.012, 0.05, 0.12
"""Radius of a joint, length of a sliding block, and of the hand of a body with one joint only, as parts of
the mechanism's size."""

ARC = 24
"""Pieces of an arc about the centre of a sphere."""

FEW = 16
"""Points of a line of which all are taken; to find the outermost of more costs less than to move them."""

CENTRED = 1e-6
"""Part of the mechanism's size by which an axis may miss a body's origin and still go through it."""


@dataclass
class Link:
    """A link: the body whose poses it follows, its joints there (k, 3), mm, and lines that belong to it."""

    body: str
    joints: list[Array] = field(default_factory=list)
    axes: list[Array] = field(default_factory=list)
    strokes: list[Array] = field(default_factory=list)

    def add(self, point: Array, axis: Array, same: float) -> None:
        """Take a joint, once."""
        if all(np.linalg.norm(point - other) > same for other in self.joints):
            self.joints.append(point)
            self.axes.append(axis)


def links_of(motion: Motion) -> tuple[list[Link], float]:
    """The links in the order of the bodies, the ground first, and the mechanism's size, mm."""
    still = Poses(np.zeros((motion.samples, 3)), np.tile(np.eye(3), (motion.samples, 1, 1)))
    poses = {GROUND: still, **motion.poses}
    leader = leaders(motion.joints, list(poses))
    links = {body: Link(body) for body in poses if leader[body] == body}
    size = _size(motion, poses)
    for joint in motion.joints.values():
        if joint.kind in {"fixed", "gear"}:
            continue
        if joint.kind == "prismatic":
            _slide(joint, poses, links, leader, size)
            continue
        for body in (joint.one,) if joint.kind == "contact" else (joint.one, joint.two):
            point, axis = _seen(joint, poses, leader[body])
            links[leader[body]].add(point[0], axis[0], CENTRED * size)
    for curve in motion.curves.values():
        own = leader[curve.body]
        at, of = poses[curve.body], poses[own]
        placed = curve.points @ at.rotation[0].T + at.position[0]
        links[own].strokes.append((placed - of.position[0]) @ of.rotation[0])
    for trace in motion.traces.values():
        here = Joint("fixed", trace.body, "-", trace.point)
        links[leader[trace.body]].add(
            _seen(here, poses, leader[trace.body])[0][0], np.zeros(3), CENTRED * size
        )
    return list(links.values()), size


def leaders(joints: Mapping[str, Joint], bodies: list[str]) -> dict[str, str]:
    """Body to the one whose poses stand for all that is fixed to it."""
    leader = {body: body for body in bodies}
    for _ in bodies:
        for joint in joints.values():
            if joint.kind == "fixed":
                one, two = leader[joint.one], leader[joint.two]
                first = min(one, two, key=bodies.index)
                leader = {body: first if held in (one, two) else held for body, held in leader.items()}
    return leader


def _size(motion: Motion, poses: Mapping[str, Poses]) -> float:
    points = [
        poses[joint.one].transform(np.array([joint.point]))[:, 0]
        for joint in motion.joints.values()
        if joint.kind not in {"fixed", "gear", "prismatic"}
    ]
    points += [motion.path(name) for name in motion.traces]
    if not points:
        return 1.0
    every = np.concatenate(points)
    return float(np.linalg.norm(np.ptp(every, axis=0))) or 1.0


def _seen(joint: Joint, poses: Mapping[str, Poses], body: str) -> tuple[Array, Array]:
    """Place and axis (n, 3) of a joint in the coordinates of a body, at every sample."""
    one, own = poses[joint.one], poses[body]
    point = one.transform(np.array([joint.point]))[:, 0] - own.position
    axis = np.einsum("nij,j->ni", one.rotation, np.array(joint.axis))
    return np.einsum("nji,nj->ni", own.rotation, point), np.einsum("nji,nj->ni", own.rotation, axis)


def _slide(
    joint: Joint,
    poses: Mapping[str, Poses],
    links: Mapping[str, Link],
    leader: Mapping[str, str],
    size: float,
) -> None:
    """The line of a guide, as long as the way on it, and the block that slides there."""
    point, axis = _seen(joint, poses, leader[joint.one])
    place = Joint("fixed", joint.two, "-", (0.0, 0.0, 0.0))
    way = np.einsum("ni,ni->n", _seen(place, poses, leader[joint.one])[0] - point, axis)
    half = BLOCK * size / 2
    ends = np.array([way.min() - 2 * half, way.max() + 2 * half])
    links[leader[joint.one]].strokes.append(point[0] + ends[:, None] * axis[0])
    own, across = _seen(joint, poses, leader[joint.two])
    middle = own[0] + float(way[0]) * across[0]  # where the slide's own origin is on its line
    side = np.cross(across[0], [0.0, 0.0, 1.0]) if abs(across[0][2]) < 1 - CENTRED else np.array([1.0, 0, 0])
    side /= np.linalg.norm(side)
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    block = [middle + half * (u * across[0] + 0.6 * v * side) for u, v in corners]
    links[leader[joint.two]].strokes.append(np.array(block))


def lines_of(link: Link, size: float) -> list[Array]:
    """The lines (k, 3), mm, of a link in its body: from joint to joint, or a hand where there is one only."""
    found = list(link.strokes)
    if link.body == GROUND and len(link.joints) < 2:
        return found
    if len(link.joints) == 1 and not link.strokes:
        found.append(np.array([link.joints[0], link.joints[0] + [HAND * size, 0.0, 0.0]]))
    pairs = list(pairwise(link.joints))
    if len(link.joints) > 2 and link.body != GROUND:
        pairs.append((link.joints[-1], link.joints[0]))
    round_ = _about_the_centre(link, size)
    return found + [_arc(one, two) if round_ else np.array([one, two]) for one, two in pairs]


def _about_the_centre(link: Link, size: float) -> bool:
    """Whether all axes of a link go through its body's origin, so that it is drawn on a sphere."""
    off = [float(np.linalg.norm(np.cross(p, a))) for p, a in zip(link.joints, link.axes, strict=True)]
    away = min((float(np.linalg.norm(point)) for point in link.joints), default=0.0)
    return len(off) > 1 and max(off) < CENTRED * size and away > CENTRED * size


def _arc(one: Array, two: Array) -> Array:
    """Points (ARC + 1, 3) from one to the other on a great circle about 0."""
    angle = float(np.arccos(np.clip(one @ two / np.linalg.norm(one) / np.linalg.norm(two), -1, 1)))
    if not CENTRED < angle < np.pi - CENTRED:
        return np.array([one, two])
    share = np.linspace(0, 1, ARC + 1)[:, None]
    points: Array = (np.sin((1 - share) * angle) * one + np.sin(share * angle) * two) / np.sin(angle)
    return points


def plane_layers(motion: Motion) -> list[dict[str, Any]]:
    """What a picture in the plane draws: a path of lines and small circles for each link."""
    links, size = links_of(motion)
    return [
        {
            "body": link.body,
            "name": link.body or "ground",
            "colour": colour,
            "top": 0,
            "bones": True,
            "path": "".join(
                [*map(_stroke, lines_of(link, size)), *(_ring(p, DOT * size) for p in link.joints)]
            ),
        }
        for link, colour in _coloured(links)
    ]


def space_meshes(motion: Motion) -> list[dict[str, Any]]:
    """What a picture in space draws: lines as pairs of points, and a small cross for each joint."""
    links, size = links_of(motion)
    found = []
    for link, colour in _coloured(links):
        pieces = [piece for line in lines_of(link, size) for piece in pairwise(line)]
        step = DOT * size * np.eye(3)
        pieces += [(point - way, point + way) for point in link.joints for way in step]
        found.append(
            {
                "body": link.body,
                "name": link.body or "ground",
                "colour": colour,
                "points": [],
                "triangles": [],
                "lines": rounded(np.array(pieces).ravel(), DRAWN),
            }
        )
    return found


def reach_of(motion: Motion) -> list[Array]:
    """All places (n, 3), mm, that joints and lines come to."""
    links, size = links_of(motion)
    still = Poses(np.zeros((1, 3)), np.eye(3)[None])
    found = [motion.path(name) for name in motion.traces]
    for link in links:
        points = [*map(_outermost, lines_of(link, size)), *(joint[None] for joint in link.joints)]
        if points:
            poses = motion.poses.get(link.body, still)
            found.append(poses.transform(np.concatenate(points)).reshape(-1, 3))
    return found


def _outermost(line: Array) -> Array:
    """Points (k, 3) of a line within whose convex hull all of it lies; a flat curve has thousands inside."""
    if np.ptp(line[:, 2]) > 0 or len(line) <= FEW:
        return line
    hull = shapely.convex_hull(shapely.multipoints(line[:, :2])).simplify(10.0**-DRAWN)
    corners = shapely.get_coordinates(hull)
    return np.column_stack((corners, np.full(len(corners), line[0, 2])))


def _coloured(links: list[Link]) -> list[tuple[Link, str]]:
    """The links that there is something to see of, each with its colour."""
    seen = [link for link in links if link.joints or link.strokes]
    moving = [link for link in seen if link.body != GROUND]
    return [
        (link, FRAME if link.body == GROUND else COLOURS[moving.index(link) % len(COLOURS)]) for link in seen
    ]


def _stroke(line: Array) -> str:
    return "M" + "L".join(f"{x:g} {y:g}" for x, y in (np.round(line[:, :2], DRAWN) + 0.0).tolist())


def _ring(point: Array, radius: float) -> str:
    """A small circle as the ``d`` of an SVG path."""
    x, y = (np.round(point[:2], DRAWN) + 0.0).tolist()
    r = round(radius, DRAWN)
    return f"M{round(x - r, DRAWN):g} {y:g}a{r:g} {r:g} 0 1 0 {2 * r:g} 0a{r:g} {r:g} 0 1 0 {-2 * r:g} 0Z"

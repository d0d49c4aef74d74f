"""A planar machine as it is drawn: frames of links, and the branch of each dyad, from points in one pose."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.assembly_order import Dyad, assembly_order
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Machine, Pose, Prismatic, Revolute

LEAST = 1e-9
"""Share of a dyad's size by which it must be drawn off its dead point."""


def frame_of(places: Mapping[str, Any], direction: float = 0.0) -> Pose:
    """The frame of a link through its drawn points: origin in the first, x axis to the second.

    A link with one point has its x axis in the ``direction``, rad.
    """
    first, *others = places.values()
    return Pose(first, np.angle(others[0] - first) if others else direction)


def in_frame(place: Any, pose: Pose) -> Any:
    """A drawn place in the frame of a link.

    >>> complex(in_frame(1 + 3j, Pose(1 + 1j, np.pi / 2))).real
    2.0
    """
    return (place - pose.origin) * np.exp(-1j * np.asarray(pose.angle))


def with_drawn_branches(machine: Machine) -> Machine:
    """The machine with each dyad put together as it is drawn.

    Raises
    ------
    KinematicsError
        The machine cannot be put together, or a dyad is drawn at its dead point, which decides nothing.
    """
    found = {}
    for group in assembly_order(machine):
        if isinstance(group, Dyad) and group.kind in {"RRR", "RRP", "RPR"}:
            found[group.inner.name] = _branch(machine, group)
    return replace(machine, branches=found)


def _branch(machine: Machine, group: Dyad) -> Any:
    inner, (first, last) = group.inner, group.outer
    one, two = _place(machine, first, group.links[0]), _place(machine, last, group.links[1])
    if group.kind == "RRR":
        pin = _place(machine, inner, group.links[0])
        side = ((pin - one) * np.conj(two - one)).imag / np.maximum(abs(pin - one) * abs(two - one), 1e-300)
    else:
        slide, far = (last, _place(machine, inner, group.links[0])) if group.kind == "RRP" else (inner, two)
        bar = (far - one) * np.exp(-1j * _direction(machine, slide))
        side = bar.real / np.maximum(np.abs(bar), 1e-300)
    if np.any(np.abs(side) < LEAST):
        raise KinematicsError(
            f"{inner.name}: {' and '.join(group.links)} are drawn at their dead point, where "
            "nothing decides how they go on; draw the linkage in another position of its input"
        )
    return np.sign(side)


def _place(machine: Machine, joint: Any, link: str) -> Any:
    """Where a pin is drawn."""
    pose = _pose(machine, link)
    return pose.origin + joint.place(link) * np.exp(1j * np.asarray(pose.angle))


def _direction(machine: Machine, slide: Revolute | Prismatic) -> Any:
    assert isinstance(slide, Prismatic)  # noqa: S101 - as groups are ordered
    return np.asarray(_pose(machine, slide.guide).angle) + slide.line_angle


def _pose(machine: Machine, link: str) -> Pose:
    return Pose(0j) if link == GROUND else machine.drawn[link]

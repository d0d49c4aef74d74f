"""A planar linkage: its machine, and the named points of its links."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mechwright.mechanics.planar.machine import Machine

Place = Any
"""A complex number x + i y, mm, or a column (n, 1) of them over n designs."""


@dataclass(frozen=True)
class Linkage:
    """What a design says of its links and joints.

    Parameters
    ----------
    machine
        Links, joints and drives. A pin is named after its point, ``"A"``; where it joins a third link to the
        same point, the second joint is ``"A-2"``, the third ``"A-3"``.
    points
        Link to its points by name, in the frame of the link, mm; the ground among the links. They are those
        of its joints, and what is traced.
    output
        The link whose motion the linkage is for.
    traces
        Name of a path to the link and the point that draws it.
    straight
        Inputs, degrees, between which the first path is meant to be straight; None for no such path.
    walks
        Whether the first path is that of a foot, which walks along X.
    """

    machine: Machine
    points: Mapping[str, Mapping[str, Place]]
    output: str
    traces: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    straight: tuple[float, float] | None = None
    walks: bool = False

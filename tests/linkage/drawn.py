"""A linkage as data, and how it moves."""

import math
from dataclasses import dataclass, field

import numpy as np

from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.planar.machine import Drive, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import Turning


@dataclass(frozen=True)
class Drawn:
    """Points (x, y), mm; joints ("R", name, point, links) and ("P", name, guide, point, angle, block, ...)."""

    links: dict
    joints: tuple
    driven: str
    output: str
    branches: dict = field(default_factory=dict)
    traces: dict = field(default_factory=dict)
    swing: tuple | None = None

    def linkage(self, output=None, traces=None):
        points = {link: {name: complex(*at) for name, at in own.items()} for link, own in self.links.items()}
        joints = []
        for kind, name, *rest in self.joints:
            if kind == "R":
                at, one, two = rest
                joints.append(Revolute(name, one, two, points[one][at], points[two][at]))
            else:
                guide, line, angle, block, at, own = rest
                joints.append(
                    Prismatic(name, guide, block, points[guide][line], points[block][at], angle, own)
                )
        machine = Machine(tuple(joints), (Drive(self.driven),), self.branches)
        return Linkage(machine, points, output or self.output, self.traces if traces is None else traces)

    def moved(self, linkage, samples=361):
        """The motion of all links over a turn, or over the swing there and back."""
        if self.swing is None:
            theta = np.linspace(0.0, math.tau, samples)
        else:
            low, high = self.swing
            theta = (low + high) / 2 - (high - low) / 2 * np.cos(np.linspace(0.0, math.tau, samples))
        return solve(linkage.machine, [Turning.of(theta, 1.0)]).bodies

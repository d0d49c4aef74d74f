"""What a linkage is to do: answer angles of its input, dwell, or lead a point along a path."""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic
from mechwright.mechanics.planar.positions import Solution
from mechwright_linkage.requirements import DwellRequirement, FunctionRequirement, PathRequirement
from mechwright_linkage.synthesis.search import TURN, Task
from mechwright_linkage.synthesis.unknowns import Unknowns

DWELL_SAMPLES = 13
"""Positions in a dwell at which the output is looked at."""

SHARP = 20.0
"""Weight of what moves in a dwell, in strokes."""


def output_of(linkage: Linkage, found: Solution) -> tuple[Array, bool]:
    """The output (n, k) counted on over the samples, rad, or mm of one that slides; and whether it slides."""
    for joint in linkage.machine.between(linkage.output, GROUND):
        if isinstance(joint, Prismatic):
            at = found.bodies[joint.block].point(joint.point).position
            return np.asarray((at * np.exp(-1j * np.asarray(joint.line_angle))).real), True
    return np.unwrap(found.bodies[linkage.output].turning.theta), False


class Function(Task):
    """The output answers angles of the input."""

    def __init__(self, unknowns: Unknowns, wanted: FunctionRequirement) -> None:
        super().__init__(unknowns, wanted)
        self.turns = np.radians(wanted.input_angles)
        outputs = np.array(wanted.outputs)
        slides = output_of(*unknowns.moved(np.zeros((1, len(unknowns.names))), TURN))[1]
        self.outputs = outputs if slides else np.radians(outputs)
        self.unit = 1.0 if slides else math.radians(1.0)
        self.size = float(np.ptp(self.outputs)) or 1.0

    def errors(self, x: Array) -> Array:
        """Errors (n, k) of the output, rad or mm, about their middle."""
        dimensions, others = self.split(x)
        linkage, found = self.unknowns.moved(dimensions, others[:, :1] + self.turns)
        output, _ = output_of(linkage, found)
        off = output - output[:, :1] - self.outputs
        middle = (off.max(axis=1, keepdims=True) + off.min(axis=1, keepdims=True)) / 2
        return np.asarray(off - middle)

    def miss(self, x: Array) -> Array:
        """Errors over the range of the outputs."""
        return np.asarray(self.errors(x) / self.size)


class Dwell(Task):
    """The output goes its stroke, and stands still for a part of the turn."""

    def __init__(self, unknowns: Unknowns, wanted: DwellRequirement) -> None:
        super().__init__(unknowns, wanted)
        self.turns = math.radians(wanted.dwell) * np.linspace(0.0, 1.0, DWELL_SAMPLES)
        slides = output_of(*unknowns.moved(np.zeros((1, len(unknowns.names))), TURN))[1]
        self.stroke = wanted.stroke if slides else math.radians(wanted.stroke)

    def dwelling(self, x: Array) -> tuple[Array, Array]:
        """The output (n, k) in the dwell about its middle, and its stroke (n, 1)."""
        dimensions, others = self.split(x)
        linkage, found = self.unknowns.moved(dimensions, others[:, :1] + self.turns)
        output, _ = output_of(linkage, found)
        _, turn = self.unknowns.moved(dimensions, np.append(TURN, math.tau))
        whole, _ = output_of(linkage, turn)
        middle = (output.max(axis=1, keepdims=True) + output.min(axis=1, keepdims=True)) / 2
        return output - middle, np.ptp(whole, axis=1)[:, None]

    def miss(self, x: Array) -> Array:
        """What moves in the dwell, and the error of the stroke."""
        output, stroke = self.dwelling(x)
        return np.hstack([SHARP * output / self.stroke, np.log(stroke / self.stroke)])


class Leading(Task):
    """A point goes through points; where and how large the linkage stands follows from them."""

    def __init__(self, unknowns: Unknowns, wanted: PathRequirement) -> None:
        super().__init__(unknowns, wanted)
        self.points = np.array([complex(*point) for point in wanted.points])
        self.size = float(np.abs(self.points - self.points.mean()).max())
        given = wanted.input_angles
        self.turns = None if given is None else np.radians(given)
        self.extra = 1 if given is not None else len(self.points)

    def start(self, count: int, rng: np.random.Generator) -> Array:
        """Random unknowns; inputs that are free go evenly round."""
        found = super().start(count, rng)
        if self.turns is None:
            even = np.linspace(0.0, math.tau, len(self.points) + 1)[1:-1] * rng.choice((-1, 1), (count, 1))
            found[:, -len(self.points) + 1 :] = even
        return found

    def inputs(self, x: Array) -> Array:
        """The input (n, k) at each point, rad."""
        _, others = self.split(x)
        if self.turns is not None:
            return others[:, :1] + self.turns
        return others[:, :1] + np.hstack([np.zeros((len(x), 1)), others[:, 1:]])

    def fitted(self, x: Array) -> tuple[Array, Array, Array]:
        """Shift and turn with scale (n, 1), complex, and distances (n, k) of the path from the points, mm."""
        linkage, found = self.unknowns.moved(self.split(x)[0], self.inputs(x))
        link, point = next(iter(linkage.traces.values()))
        path = found.bodies[link].point(linkage.points[link][point]).position
        path = np.broadcast_to(path, (len(x), self.points.size))
        about = path - path.mean(axis=1, keepdims=True)
        to = self.points - self.points.mean()
        turn = (np.conj(about) * to).sum(axis=1) / np.square(np.abs(about)).sum(axis=1)
        shift = self.points.mean() - turn * path.mean(axis=1)
        return shift[:, None], turn[:, None], shift[:, None] + turn[:, None] * path - self.points

    def miss(self, x: Array) -> Array:
        """Distances from the points over the size of the path."""
        _, turn, off = self.fitted(x)
        self.scale = np.abs(turn)
        return np.hstack([off.real, off.imag]) / self.size

    def in_order(self, x: Array) -> bool:
        """Whether the input goes one way through the points, within a turn."""
        steps = np.diff(self.inputs(x[None])[0])
        way = np.sign(steps[0])
        return bool((way * steps > 0).all() and abs(steps.sum()) < math.tau)

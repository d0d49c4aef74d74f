"""Motion of all links of a planar machine over its input, group after group, from pose to jerk.

Inputs and designs are arrays: the last axis are the samples of the input, one before it the designs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster, Driven, Dyad, Geared, Group, assembly_order
from mechwright.mechanics.planar.cluster_following import followed, with_steps
from mechwright.mechanics.planar.dyads import (
    Slide,
    Solved,
    Way,
    body_at,
    crossing,
    pin_and_slide,
    pins,
    slide_between,
    turned,
)
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Machine, Prismatic, Revolute
from mechwright.mechanics.planar.outer_joints import (
    guide_line,
    neighbour,
    offset_across,
    offset_from_line,
    outer_pin,
)
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

NO_STEPS = range(0)
"""Where every group has a closed form, no way has to be followed from the drawn pose."""


@dataclass(frozen=True)
class Solution:
    """How a machine moves.

    Parameters
    ----------
    bodies
        Link to its motion (..., n), the ground among them; NaN where a group does not close.
    sines
        Inner joint of each dyad to the sine (..., n) of its transmission angle; 0 at a dead point.
    pivots
        First inner joint of each larger group to the smallest singular value (..., n) of its equations over
        the largest one; 0 at a dead point.
    """

    bodies: Mapping[str, BodyMotion]
    sines: Mapping[str, Array]
    pivots: Mapping[str, Array] = field(default_factory=dict)

    def place(self, joint: Revolute, rates: int = 3) -> PointMotion:
        """How a pin moves; rates above ``rates`` are NaN."""
        link = joint.two if joint.one == GROUND else joint.one
        return self.bodies[link].point(joint.place(link), rates)

    def after(self, lead: int) -> "Solution":
        """The motion without its first samples."""
        bodies = {name: body.samples(slice(lead, None)) for name, body in self.bodies.items()}
        sines = {name: sine[..., lead:] for name, sine in self.sines.items()}
        return Solution(bodies, sines, {name: pivot[..., lead:] for name, pivot in self.pivots.items()})

    @property
    def closes(self) -> Array:
        """Whether every link stands (..., n)."""
        stands = [np.isfinite(body.turning.theta) for body in self.bodies.values()]
        closed: Array = np.logical_and.reduce(np.broadcast_arrays(*stands))
        return closed


def solve(
    machine: Machine, inputs: Sequence[Turning], order: Sequence[Group] | None = None, rates: int = 3
) -> Solution:
    """Find the motion of every link.

    Parameters
    ----------
    machine
        Links, joints and drives.
    inputs
        Of each drive its angle, or its slide in mm, and three rates (..., n); rates per unit of the input are
        those of the input with the rates 1, 0, 0.
    order
        That of :func:`assembly_order`, where it is known.
    rates
        The highest rate that is needed, 0 to 3; those above are NaN, or not to be used where links are
        followed. Without the jerk dyads take a third of the time.

    Many designs are fastest in blocks of some 10,000 samples, which stay in the cache of a core.

    Raises
    ------
    KinematicsError
        The machine cannot be put together.

    Examples
    --------
    >>> from mechwright.mechanics.planar.machine import Drive
    >>> joints = [
    ...     Revolute("A0", "ground", "crank", 0, 0), Revolute("A", "crank", "coupler", 30, 0),
    ...     Revolute("B", "coupler", "rocker", 80, 70), Revolute("B0", "ground", "rocker", 90, 0),
    ... ]
    >>> found = solve(Machine(joints, [Drive("crank")]), [Turning.of([0.0, 1.0], 1.0)])
    >>> np.degrees(found.bodies["rocker"].turning.theta).round(3).tolist()
    [104.478, 95.929]
    """
    groups = assembly_order(machine) if order is None else order
    if any(isinstance(group, Cluster) for group in groups):
        stepped, steps = with_steps(machine, inputs)
        return _solved(machine, stepped, groups, max(rates, 1), steps).after(len(steps))
    return _solved(machine, inputs, groups, rates)


def _solved(
    machine: Machine, inputs: Sequence[Turning], groups: Sequence[Group], rates: int, steps: range = NO_STEPS
) -> Solution:
    still = np.zeros(np.broadcast_shapes(*(one.theta.shape for one in inputs)))
    bodies = {GROUND: BodyMotion.about(0j, Turning.of(still))}
    sines: dict[str, Array] = {}
    pivots: dict[str, Array] = {}
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):  # infinite rates at a dead point
        for group in groups:
            if isinstance(group, Driven):
                bodies[group.link] = _driven(machine, group, bodies, inputs[group.drive], rates)
            elif isinstance(group, Geared):
                bodies[group.link] = _geared(group, bodies, rates)
            elif isinstance(group, Dyad):
                one, two, sine = _dyad(machine, group, bodies, rates)
                bodies |= dict(zip(group.links, (one, two), strict=True))
                sines[group.inner.name] = sine
            else:
                found, sine = followed(machine, group, bodies, inputs, steps, rates)
                bodies |= found
                pivots[cluster_name(group)] = sine
    return Solution(bodies, sines, pivots)


def cluster_name(group: Cluster) -> str:
    """What a cluster is named by: the first of its inner joints."""
    return next(joint.name for joint in group.joints if set(joint.links) <= set(group.links))


def _driven(
    machine: Machine, group: Driven, bodies: Mapping[str, BodyMotion], drive: Turning, rates: int
) -> BodyMotion:
    joint, on = group.joint, bodies[group.on]
    backwards = machine.drives[group.drive].link != group.link
    sense = -1.0 if backwards else 1.0
    if isinstance(joint, Revolute):
        turning = _sum(on.turning, drive.scaled(sense))
        return body_at(on.point(joint.place(group.on), rates), joint.place(group.link), turning, rates)
    # The slide counts along the line of the guide, whichever of the two is found.
    sense = 1.0 if group.on == joint.guide else -1.0
    slide = guide_line(joint, on, group.on, rates)
    way = Way(sense * drive.theta, sense * drive.omega, sense * drive.alpha, sense * drive.jerk)
    own = turned(slide.turning, -joint.direction(group.link))
    return body_at(slide.at(way, rates), joint.place(group.link), own, rates)


def _geared(group: Geared, bodies: Mapping[str, BodyMotion], rates: int) -> BodyMotion:
    gears, pin = group.gears, group.pin
    carrier = bodies[gears.carrier].turning
    forwards = group.link == gears.two
    mate = bodies[gears.one if forwards else gears.two].turning
    ratio = gears.ratio if forwards else 1 / gears.ratio
    phase = gears.phase if forwards else -gears.phase / gears.ratio
    turning = turned(_sum(carrier.scaled(1 - ratio), mate.scaled(ratio)), phase)
    stands = pin.one if pin.two == group.link else pin.two
    return body_at(bodies[stands].point(pin.place(stands), rates), pin.place(group.link), turning, rates)


def _sum(one: Turning, two: Turning) -> Turning:
    return Turning(one.theta + two.theta, one.omega + two.omega, one.alpha + two.alpha, one.jerk + two.jerk)


def _dyad(machine: Machine, group: Dyad, bodies: Mapping[str, BodyMotion], rates: int) -> Solved:
    inner, (first, last), (one, two) = group.inner, group.outer, group.links
    branch = machine.branches.get(inner.name, 1)
    if isinstance(first, Revolute) and isinstance(last, Revolute):
        ends = [outer_pin(joint, link, bodies, rates) for joint, link in ((first, one), (last, two))]
        if isinstance(inner, Revolute):
            places = [(joint.place(link), inner.place(link)) for joint, link in ((first, one), (last, two))]
            return pins(ends[0], ends[1], (places[0], places[1]), branch, rates)
        offset = offset_across(inner, first.place(one), last.place(two), one)
        own = [(joint.place(link), inner.direction(link)) for joint, link in ((first, one), (last, two))]
        return slide_between(ends[0], ends[1], offset, tuple(own), branch, rates)
    assert isinstance(last, Prismatic)  # noqa: S101 - as groups are ordered
    slide = guide_line(last, bodies[neighbour(last, two)], neighbour(last, two), rates)
    if isinstance(inner, Revolute) and isinstance(first, Revolute):
        moved = Slide(slide.point, slide.turning, offset_from_line(last, two, inner.place(two)))
        second = inner.place(two), last.direction(two)
        places_ = first.place(one), inner.place(one)
        return pin_and_slide(outer_pin(first, one, bodies, rates), places_, moved, second, branch, rates)
    if isinstance(inner, Revolute):  # PRP: the pin slides along two lines
        assert isinstance(first, Prismatic)  # noqa: S101 - as groups are ordered
        other = guide_line(first, bodies[neighbour(first, one)], neighbour(first, one), rates)
        lines = [
            Slide(line.point, line.turning, offset_from_line(joint, link, inner.place(link)))
            for line, joint, link in ((other, first, one), (slide, last, two))
        ]
        pin, sine = crossing(lines[0], lines[1], rates)
        turnings = [
            turned(line.turning, -joint.direction(link))
            for line, joint, link in zip(lines, (first, last), (one, two), strict=True)
        ]
        found = [body_at(pin, inner.place(k), t, rates) for k, t in zip((one, two), turnings, strict=True)]
        return found[0], found[1], sine
    # RPP: the second link slides on what stands, and the first, pinned to what stands, slides on it.
    assert isinstance(first, Revolute)  # noqa: S101 - a group of three slides does not close
    second_turning = turned(slide.turning, -last.direction(two))
    direction = turned(second_turning, inner.direction(two))
    first_turning = turned(direction, -inner.direction(one))
    bar = body_at(outer_pin(first, one, bodies, rates), first.place(one), first_turning, rates)
    sought = Slide(slide.point, slide.turning, offset_from_line(last, two, inner.place(two)))
    point, sine = crossing(sought, Slide(bar.point(inner.place(one), rates), direction), rates)
    return bar, body_at(point, inner.place(two), second_turning, rates), sine

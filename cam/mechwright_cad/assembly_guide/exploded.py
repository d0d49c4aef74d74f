"""How far bodies are drawn from their seats: the whole mechanism taken apart, and one step of it."""

from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright_cad.assembly_order.layers import frame_of, mesh_points
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.bodies import Body

GAP, SHARE = 6.0, 0.04
"""Least room between bodies in a picture, mm, and as a share of the mechanism's greatest size."""

Shifts = dict[int, Array]
"""Number of a body to its shift (3,), mm."""


class Boxes:
    """The boxes round bodies, across any way."""

    def __init__(self, bodies: Sequence[Body], sample: int) -> None:
        self._points = [mesh_points(body, sample)[0] for body in bodies]
        whole = np.concatenate(self._points)
        self.gap = max(GAP, SHARE * float(np.ptp(whole, axis=0).max()))

    def across(self, number: int, way: Array, shift: Array) -> Array:
        """Least and greatest corner (2, 3) of a shifted body in the frame of a way; the third is along it."""
        frame = frame_of(way)
        seen = self._points[number] @ frame.T + frame @ shift
        return np.array((seen.min(axis=0), seen.max(axis=0)))

    def centre(self, number: int) -> Array:
        """Middle (3,) of the box round a body where it stands, mm."""
        points = self._points[number]
        middle: Array = (points.min(axis=0) + points.max(axis=0)) / 2
        return middle

    def room(self, moved: Sequence[int], onto: Sequence[int], way: Array, shifts: Shifts) -> float:
        """How far some have to go along a way until no box of theirs stands beside one of the others, mm."""
        theirs = np.array([self.across(k, way, shifts[k]) for k in onto])
        far = 0.0
        for k in moved:
            mine = self.across(k, way, shifts[k])
            beside = (theirs[:, 0, :2] < mine[1, :2]).all(axis=1) & (mine[0, :2] < theirs[:, 1, :2]).all(
                axis=1
            )
            far = max(far, float((theirs[beside, 1, 2] - mine[0, 2] + self.gap).max(initial=0.0)))
        return far


def exploded(steps: Sequence[Step], boxes: Boxes, count: int) -> Shifts:
    """The shifts of all bodies in the exploded view: each step away from what it goes onto, by what it needs.

    Steps are in order, so that what a group is made of is apart before the group goes away from the rest.
    """
    shifts = {k: np.zeros(3) for k in range(count)}
    for step in steps:
        if step.way is None:
            for place, k in enumerate(step.moved[1:], start=1):
                others = step.moved[:place]
                shifts[k][2] += boxes.room((k,), others, np.array((0.0, 0.0, 1.0)), shifts)
            continue
        out = -np.array(step.way)
        far = boxes.room(step.moved, step.onto, out, shifts)
        for k in step.moved:
            shifts[k] = shifts[k] + far * out
    return shifts


def lifted(step: Step, boxes: Boxes) -> Shifts:
    """The shifts of one step: what goes to its seat stands just outside of what is there already."""
    shifts = {k: np.zeros(3) for k in (*step.moved, *step.onto)}
    if step.way is not None and step.onto:
        out = -np.array(step.way)
        far = boxes.room(step.moved, step.onto, out, shifts)
        shifts |= dict.fromkeys(step.moved, far * out)
    return shifts

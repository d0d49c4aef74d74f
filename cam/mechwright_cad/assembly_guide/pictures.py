"""Pictures of a plan as SVG: the exploded view with its balloons, and one for each step."""

from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.output.svg import element, number, picture, text
from mechwright_cad.assembly_guide.balloons import APART, RADIUS, balloons
from mechwright_cad.assembly_guide.exploded import Boxes, Shifts, exploded, lifted
from mechwright_cad.assembly_guide.view import EYE, Lines, View
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan

SIZE = 120.0
"""Width of paper, mm, on which numbers are as high as they are told here."""

LETTER = 3.2
"""Height of numbers on that paper, mm."""


SEEN = 0.6
"""What comes from below is drawn from below where less than this share of its lines is seen from above."""


class Pictures:
    """All pictures of a plan, seen from above; steps from below that are hidden there, from below."""

    def __init__(self, plan: Plan, numbers: Mapping[str, int]) -> None:
        self.plan = plan
        self.numbers = {k: numbers[body.part.name] for k, body in enumerate(plan.bodies)}
        self.view = View(plan.bodies, plan.sample)
        self.boxes = Boxes(plan.bodies, plan.sample)
        self.shifts = exploded(plan.steps, self.boxes, len(plan.bodies))

    def exploded(self) -> str:
        """The exploded view."""
        lines = self.view.lines(self.shifts)
        x0, y0, x1, y1 = shapely.union_all(list(lines.values())).bounds
        letter = LETTER * max(x1 - x0, (y1 - y0) / 2) / SIZE
        numbers = {k: self.numbers[k] for k in self.plan.sequence}
        found = balloons(lines, numbers, letter, self.middles)
        parts = [_drawn(lines.values(), "there"), _dashed(self.traces())]
        ring = RADIUS * APART * letter
        for one in found:
            (x, y), (tx, ty) = one.at, one.tip
            away = np.array((tx - x, ty - y))
            start = np.array(one.at) + ring * away / np.linalg.norm(away)
            parts += [
                element("path", d=_path([start, one.tip]), class_="leader"),
                element("circle", cx=number(tx), cy=number(-ty), r=number(letter / 5), class_="dot"),
                element("circle", cx=number(x), cy=number(-y), r=number(ring), class_="ring"),
                text(x, y - 0.36 * letter, str(one.number), letter, text_anchor="middle"),
            ]
        corners = [point for one in found for point in (one.at, one.tip)]
        return self._framed(parts, lines, corners, 1.5 * ring, "Exploded view with the numbers of the items")

    @cached_property
    def middles(self) -> dict[int, tuple[float, float]]:
        """Each body to its middle in the exploded view, mm."""
        found = {}
        for k, shift in self.shifts.items():
            ((x, y),) = self.view.flat(self.boxes.centre(k) + shift).tolist()
            found[k] = (x, y)
        return found

    def step(self, step: Step, label: str) -> str:
        """What stands there, thin, and what comes, thick, outside of its seat."""
        shifts = lifted(step, self.boxes)
        view, lines = self.view, self.view.lines(shifts)
        moved = set(step.moved) if step.onto else set()
        if step.way is not None and step.way[2] > 0 and self._hidden(step, shifts, lines):
            view, lines = self.under, self.under.lines(shifts)
            label += ", seen from below"
        parts = [
            _drawn((lines[k] for k in lines if k not in moved), "there"),
            _dashed(self._lines_of(step, shifts, view)),
            _drawn((lines[k] for k in lines if k in moved), "comes"),
        ]
        return self._framed(parts, lines, [], 2.0, label)

    @cached_property
    def under(self) -> View:
        """All bodies as they are seen from below."""
        return View(self.plan.bodies, self.plan.sample, EYE * (1.0, 1.0, -1.0))

    def _hidden(self, step: Step, shifts: Shifts, lines: Lines) -> bool:
        """Whether most of what comes stands behind what is there."""
        alone = self.view.lines({k: shifts[k] for k in step.moved})
        seen = sum(float(lines[k].length) for k in step.moved)
        return seen < SEEN * sum(float(one.length) for one in alone.values())

    def _framed(
        self, parts: list[str], lines: Lines, corners: list[tuple[float, float]], edge: float, label: str
    ) -> str:
        x0, y0, x1, y1 = shapely.union_all(list(lines.values())).bounds
        xs, ys = [x0, x1, *(x for x, _ in corners)], [y0, y1, *(y for _, y in corners)]
        box = (min(xs) - edge, -max(ys) - edge, max(xs) - min(xs) + 2 * edge, max(ys) - min(ys) + 2 * edge)
        return picture("".join(parts), box, label)

    def traces(self) -> list[Array]:
        """Lines (2, 2), mm, from where each thing is drawn to what it goes onto."""
        return [
            line
            for step in self.plan.steps
            for line in self._lines_of(step, self.shifts, self.view, relative=True)
        ]

    def _lines_of(self, step: Step, shifts: Shifts, view: View, *, relative: bool = False) -> list[Array]:
        """From each round body of a step, or from its largest, to where it is put; ends (2, 2)."""
        if step.way is None or not step.onto:
            return []
        bodies = self.plan.bodies
        base = max(step.onto, key=lambda k: (self.plan.order.size(k), -k))
        rounds = [k for k in step.moved if not bodies[k].is_plate] or [
            max(step.moved, key=self.plan.order.size)
        ]
        ends = []
        for k in rounds:
            at = self.boxes.centre(k)
            seat = at + (shifts[base] if relative else 0.0)
            ends.append(view.flat(np.array((at + shifts[k], seat))))
        return ends


def _drawn(lines: Iterable[shapely.Geometry], kind: str) -> str:
    data = "".join(_path(shapely.get_coordinates(one)) for some in lines for one in shapely.get_parts(some))
    return element("path", d=data, class_=kind) if data else ""


def _dashed(lines: Iterable[Array]) -> str:
    data = "".join(_path(line) for line in lines)
    return element("path", d=data, class_="trace") if data else ""


def _path(points: Iterable[Iterable[float]]) -> str:
    return "M" + "L".join(f"{x:.1f},{-y:.1f}".replace("-0.0", "0.0") for x, y in points)

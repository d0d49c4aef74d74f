"""The construction with the auxiliary circle drawn to scale, step by step, and all of its solutions."""

import cmath
import math
from collections.abc import Sequence

import numpy as np

from mechwright.mechanics.planar import Plane
from mechwright.pipeline.figures.sheet import INK, LINKS, Window
from mechwright_slider_crank.pages.circle import AuxiliaryCircle, Found

GIVEN, FREE, BLOCKED, NONE, NEW = "#1f5fa8", "#2e7d32", "#8a5a00", "#b3261e", "#6a3d9a"
"""What is drawn first, the arc of A, the arc whose cranks cannot turn, the one without solutions, each "
"step."""


class Drawing:
    """A picture of the circle to which steps are added.

    Parameters
    ----------
    circle
        The circle.
    solution
        What the construction will lead to, so that its picture is large enough; none for the circle alone.
    """

    def __init__(self, circle: AuxiliaryCircle, solution: Found | None = None) -> None:
        o, r = circle.centre, circle.radius
        held = [o - r * (1.9 + 1j), o + r * (1.1 + 1j)]
        if solution is not None:
            held += [solution.pivot, solution.pin]
        self.circle, self.window = circle, Window.about(held, 0.12)
        self.drawn: list[str] = []
        self.key: list[tuple[str, str]] = []

    def line(self, *places: complex, colour: str = INK, width: float = 1.0, dashed: bool = False) -> None:
        """A line through places."""
        look = {"stroke_dasharray": self.window.dashes()} if dashed else {}
        self.drawn.append(self.window.line(np.array(places), colour, width, **look))

    def about(self, centre: complex, radius: float, colour: str, *, dashed: bool = False) -> None:
        """A circle."""
        look = {"stroke_dasharray": self.window.dashes()} if dashed else {}
        self.drawn.append(self.window.circle(centre, radius, colour, 1.2, **look))

    def points(self, colour: str = INK, **places: complex) -> None:
        """Points by their names; ``C1_`` is C1′."""
        for name, place in places.items():
            before = place.real < self.circle.centre.real - self.circle.stroke / 4
            label = name.replace("_", "′")
            self.drawn.append(self.window.dot(place, colour, label, 0.9, before=before))

    def says(self, words: str, colour: str = INK) -> None:
        """A line of the key."""
        self.key.append((words, colour))

    def picture(self, label: str) -> str:
        """The whole, with what a screen reader says."""
        return self.window.picture([*self.drawn, self.window.scale(), self.window.key(self.key)], label)


def base(circle: AuxiliaryCircle, solution: Found | None = None, *, faint: bool = False) -> Drawing:
    """C1C2 = H, the triangle with O, the circle with its arcs, F, C1′ and C2′."""
    drawing = Drawing(circle, solution)
    (c1, c2), (p1, p2) = circle.ends, circle.opposite
    o, f = circle.centre, circle.middle
    if faint:
        drawing.about(o, circle.radius, LINKS)
    else:
        for ends, colour in (((p1, c1), FREE), ((c2, p2), FREE), ((p2, p1), BLOCKED), ((c1, c2), NONE)):
            drawing.drawn.append(drawing.window.line(arc(o, *ends), colour, 2.2))
        drawing.line(c1, o, c2, colour=GIVEN)
        drawing.line(o, f, colour=LINKS, dashed=True)
        drawing.says("A here", FREE)
        drawing.says("crank blocked, b − a < e", BLOCKED)
        drawing.says("no solution, 180° − θ", NONE)
    drawing.line(c1, c2, colour=GIVEN, width=2.0)
    drawing.points(C1=c1, C2=c2, O=o, F=f, C1_=p1, C2_=p2)
    return drawing


def arc(centre: complex, start: complex, end: complex) -> Plane:
    """The arc counter-clockwise from start to end."""
    first, last = cmath.phase(start - centre), cmath.phase(end - centre)
    turn = np.linspace(first, first + (last - first) % math.tau, 181)
    return np.asarray(centre + abs(start - centre) * np.exp(1j * turn), np.complex128)


def by_offset(circle: AuxiliaryCircle, found: Found) -> str:
    """Line MN at the height e."""
    drawing = base(circle, found, faint=True)
    window, e = drawing.window, found.offset
    m, n = complex(window.low.real, e), complex(window.high.real, e)
    drawing.line(m, n, colour=NEW, dashed=True)
    drawing.points(NEW, A=found.pivot)
    drawing.says(f"MN at e = {e:.6g}", NEW)
    _divided(drawing, found)
    return drawing.picture("A from the offset: the line MN")


def by_crank(circle: AuxiliaryCircle, found: Found) -> str:
    """Circles I about F and II about C2, E, and A on C2E prolonged."""
    drawing = base(circle, found, faint=True)
    c2 = circle.ends[1]
    drawing.about(circle.middle, abs(c2 - circle.middle), NEW, dashed=True)
    drawing.about(c2, 2 * found.crank, GIVEN, dashed=True)
    drawing.says(f"I about F, r = {abs(c2 - circle.middle):.6g}", NEW)
    drawing.says(f"II about C2, r = 2 a = {2 * found.crank:.6g}", GIVEN)
    _divided(drawing, found)
    return drawing.picture("A from the crank: circles I and II")


def by_rod(circle: AuxiliaryCircle, found: Found) -> str:
    """Circle III about F."""
    drawing = base(circle, found, faint=True)
    radius = found.rod / math.cos(circle.theta / 2)
    drawing.about(circle.middle, radius, NEW, dashed=True)
    drawing.says(f"III about F, r = b/cos(θ/2) = {radius:.6g}", NEW)
    _divided(drawing, found)
    return drawing.picture("A from the rod: circle III")


def _divided(drawing: Drawing, found: Found) -> None:
    """AC2 with E and G on it, AC1 and F's lines."""
    c1, c2 = drawing.circle.ends
    drawing.line(found.pivot, c2, colour=FREE, width=1.8)
    drawing.line(found.pivot, c1, colour=FREE, width=1.8)
    drawing.line(drawing.circle.middle, found.foot, colour=LINKS, dashed=True)
    drawing.line(drawing.circle.middle, found.pivot, colour=LINKS, dashed=True)
    drawing.points(FREE, A=found.pivot, E=found.divide, G=found.foot)


def mechanism(circle: AuxiliaryCircle, found: Found) -> str:
    """Crank and rod with the slider in C1 and in C2, the crank's circle, and the lengths."""
    drawing = base(circle, found, faint=True)
    (c1, c2), a = circle.ends, found.pivot
    far = a + found.crank * (c2 - a) / abs(c2 - a)
    drawing.about(a, found.crank, LINKS, dashed=True)
    drawing.line(found.pin, c1, colour=GIVEN, width=2.4)
    drawing.line(far, c2, colour=FREE, width=2.4)
    drawing.line(a, found.pin, colour=NONE, width=3.0)
    drawing.line(a, far, colour=NONE, width=3.0)
    drawing.line(complex(a.real), a, colour=BLOCKED, dashed=True)
    drawing.points(A=a, B=found.pin)
    for name, value, colour in (
        ("a", found.crank, NONE),
        ("b", found.rod, GIVEN),
        ("e", found.offset, BLOCKED),
    ):
        drawing.says(f"{name} = {value:.6f} mm", colour)
    return drawing.picture("crank and rod at both limits")


SPAN = 181
"""Places of A in the chart."""


def family(circle: AuxiliaryCircle, marks: Sequence[Found]) -> str:
    """Crank, rod and offset over the place λ of A, with their limits."""
    positions = np.linspace(circle.last / 2000, circle.last, SPAN)
    solutions = [circle.at(float(position)) for position in positions]
    most = max(solutions[-1].rod, solutions[-1].offset, circle.stroke / 2)
    wide = 1.15 * most / circle.last

    def place(position: float, value: float) -> complex:
        return complex(wide * position, value)

    window = Window.about([0j, place(circle.last, 0), 1j * most], 0.16)
    drawn = [window.line(np.array([place(circle.last, 0), 0j, 1j * most]), INK, 1.2)]
    lines = (("a", "crank", NONE), ("b", "rod", GIVEN), ("e", "offset", BLOCKED))
    for name, length, colour in lines:
        values = [getattr(one, length) for one in solutions]
        points = [place(float(at), value) for at, value in zip(positions, values, strict=True)]
        drawn.append(window.line(np.array(points), colour, 2.0))
        drawn.append(window.words(points[-1] + window.size / 60, f"{name} {values[-1]:.5g}", colour, 0.9))
        for one in marks:
            drawn.append(window.dot(place(one.position, getattr(one, length)), colour, "", 0.9))
    half = f"H/2 = {circle.stroke / 2:g}"
    drawn.append(window.words(1j * circle.stroke / 2 - window.size / 60, half, INK, 0.9, before=True))
    ends = [(0.0, "λ = 0: C1"), (circle.last, f"{math.degrees(circle.last):.4g}°: C1′")]
    for position, words in ends:
        under = place(position, 0) - 1j * window.size / 22
        drawn.append(window.words(under, words, INK, 0.9, before=position > 0))
    key = [(f"{name}, mm" + (" (crank)" if name == "a" else ""), colour) for name, _, colour in lines]
    return window.picture([*drawn, window.key(key)], "crank, rod and offset over the place of A on its arc")

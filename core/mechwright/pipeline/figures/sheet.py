"""Drawing in a window of the plane: lines of any length, marks and words in the window's own measure."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane
from mechwright.output import svg

INK, LINKS = "#22303c", "#a9b4be"

SHAPE = 4 / 3
"""Width of a window over its height."""

CIRCLE = 361
"""Points of a circle."""


@dataclass(frozen=True)
class Window:
    """A part of the plane, mm."""

    low: complex
    high: complex

    @classmethod
    def about(cls, points: Iterable[complex], room: float = 0.08) -> "Window":
        """The window of the usual shape that holds points, with a margin as a share of its width."""
        held = np.array(list(points))
        low, high = complex(held.real.min(), held.imag.min()), complex(held.real.max(), held.imag.max())
        width = max((high - low).real, SHAPE * (high - low).imag) * (1 + 2 * room)
        half = complex(width, width / SHAPE) / 2
        return cls((low + high) / 2 - half, (low + high) / 2 + half)

    @property
    def size(self) -> float:
        """Its width."""
        return (self.high - self.low).real

    @property
    def middle(self) -> complex:
        """Its middle."""
        return (self.low + self.high) / 2

    def holds(self, points: Plane) -> Array:
        """Whether points (n,) are inside."""
        inside = (points.real >= self.low.real) & (points.real <= self.high.real)
        return np.asarray(inside & (points.imag >= self.low.imag) & (points.imag <= self.high.imag), float)

    def line(self, points: Plane, colour: str, width: float = 1.0, **look: object) -> str:
        """A line through points (n,); what is far outside is left out, in thousandths of the window wide."""
        near = np.isfinite(points) & (np.abs(points - self.middle) < 2 * self.size)
        runs = np.split(points, np.flatnonzero(np.diff(near.astype(int))) + 1)
        keep = np.split(near, np.flatnonzero(np.diff(near.astype(int))) + 1)
        data = "".join(
            svg.path([(one.real, one.imag) for one in run])
            for run, good in zip(runs, keep, strict=True)
            if good[0] and len(run) > 1
        )
        if not data:
            return ""
        given = {"fill": "none", "stroke": colour, "stroke_width": width * self.size / 500, **look}
        return svg.element("path", d=data, stroke_linejoin="round", **given)

    def circle(self, centre: complex, radius: float, colour: str, width: float = 1.0, **look: object) -> str:
        """A circle of any size; of one far larger than the window, the part that comes near."""
        if not np.isfinite(centre) or not np.isfinite(radius):
            return ""
        towards = np.angle(self.middle - centre)
        span = np.pi if radius < self.size else min(np.pi, 4 * self.size / radius)
        turn = np.linspace(towards - span, towards + span, CIRCLE)
        return self.line(centre + radius * np.exp(1j * turn), colour, width, **look)

    def dashes(self) -> str:
        """The look of a dashed line."""
        return f"{self.size / 70:.3g} {self.size / 110:.3g}"

    def dot(
        self, at: complex, colour: str, name: str = "", size: float = 1.0, *, before: bool = False
    ) -> str:
        """A point with its name to the right or left of it, nothing outside of the window."""
        if not self.holds(np.array([at]))[0]:
            return ""
        circle = svg.element("circle", cx=at.real, cy=-at.imag, r=size * self.size / 130, fill=colour)
        beside = complex(-1, -0.8) if before else complex(1, 0.6)
        words = self.words(at + self.size / 80 * beside, name, colour, before=before)
        return circle + (words if name else "")

    def words(
        self, at: complex, words: str, colour: str = INK, size: float = 1.0, *, before: bool = False
    ) -> str:
        """Words that begin at a place, or end before it, with a rim that keeps them clear of lines."""
        look = {"fill": colour, "stroke": "#fff", "paint_order": "stroke", "stroke_width": self.size / 130}
        if before:
            look["text_anchor"] = "end"
        return svg.text(at.real, at.imag, words, size * self.size / 32, **look)

    def key(self, lines: Sequence[tuple[str, str]]) -> str:
        """What the colours mean, below each other in the upper left corner."""
        top = complex(self.low.real, self.high.imag) + self.size / 50 * (1 - 2.4j)
        return "".join(
            self.words(top - 1j * number * self.size / 24, words, colour)
            for number, (words, colour) in enumerate(lines)
        )

    def scale(self) -> str:
        """A bar of a round length in the lower left corner."""
        length = 10 ** np.floor(np.log10(self.size / 4))
        length *= max(step for step in (1, 2, 2.5) if step * length <= self.size / 4)
        start = self.low + self.size / 50 * (1 + 1.4j)
        bar = self.line(np.array([start, start + length]), INK, 2.5)
        return bar + self.words(start + self.size / 100 * 1j, f"{length:g} mm", size=0.85)

    def picture(self, drawn: Sequence[str], label: str) -> str:
        """The whole picture on white."""
        across = self.high - self.low
        box = (self.low.real, -self.high.imag, across.real, across.imag)
        sheet = svg.element("rect", x=box[0], y=box[1], width=box[2], height=box[3], fill="#fff")
        return svg.picture(sheet + "".join(drawn), box, label)


def linkage(window: Window, joints: Mapping[str, complex], lines: Sequence[Sequence[complex]]) -> list[str]:
    """Links as lines, and the joints by their names."""
    drawn = [window.line(np.array(line), LINKS, 3.0) for line in lines]
    return [*drawn, *(window.dot(place, INK, name) for name, place in joints.items())]

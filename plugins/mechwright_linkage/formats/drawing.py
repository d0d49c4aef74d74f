"""What every format is read into: points, links, slides, and the link that drives."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mechwright import DesignError
from mechwright.mechanics.planar.dynamics import GROUND

_OTHER = re.compile(r"[^A-Za-z0-9_]+")


@dataclass
class Drawing:
    """A linkage in one position.

    Parameters
    ----------
    points
        Name to x and y, mm.
    links
        Name to the points of the link, the ground among them.
    slides
        Tables of ``slides`` in a design file.
    driver
        The link that the input moves; empty for one that the file does not name.
    """

    points: dict[str, tuple[float, float]] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    slides: list[dict[str, Any]] = field(default_factory=list)
    driver: str = ""

    def add(self, point: str, link: str) -> None:
        """Put a point on a link."""
        own = self.links.setdefault(link, [])
        if point not in own:
            own.append(point)

    def slide(self, point: str, block: str, guide: str, angle: float) -> None:
        """Let a link slide on another one through its point, in a direction in degrees."""
        self.slides.append({"block": block, "guide": guide, "point": point, "angle": round(angle, 9)})

    def parameters(self, source: str) -> Mapping[str, Any]:
        """The table of a design file; raises DesignError where something needed is missing."""
        if GROUND not in self.links:
            raise DesignError(f'{source}: no point stands on a link called "ground"; name one there')
        driver = self.driver or next(
            (
                link
                for link, own in self.links.items()
                if link != GROUND and set(own) & set(self.links[GROUND])
            ),
            "",
        )
        if not driver:
            raise DesignError(f"{source}: no link turns about a point of the ground, so none can drive")
        return {
            "linkage": "drawn",
            "points": {name: {"x": round(x, 9), "y": round(y, 9)} for name, (x, y) in self.points.items()},
            "links": {name: tuple(own) for name, own in self.links.items()},
            "slides": tuple(self.slides),
            "driver": driver,
        }


def name_of(text: str, taken: Mapping[str, object], other: str) -> str:
    """A name that points and links may have, as near to a text as that goes.

    >>> name_of("joint 1", {}, "P1"), name_of("", {}, "P1"), name_of("A", {"A": 0}, "P1")
    ('joint_1', 'P1', 'A-2')
    """
    name = _OTHER.sub("_", text).strip("_")[:30] or other
    number, found = 2, name
    while found in taken:
        found, number = f"{name}-{number}", number + 1
    return found

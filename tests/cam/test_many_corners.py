"""Stars: corners by the dozen that only the finest mill reaches, each of them a cavity of its own."""

import math
from collections import Counter

from planning_parts import job, part

from mechwright.contracts.part import Loop
from mechwright_cam.operations import clearing
from mechwright_cam.planning import plan

POINTS = 12


def star(points: int, outer: float, inner: float) -> Loop:
    """A loop with so many points, between two radii, mm."""
    corners = range(2 * points)
    at = [(inner if n % 2 else outer, math.pi * n / points) for n in corners]
    return Loop.polygon([(radius * math.cos(turn), radius * math.sin(turn)) for radius, turn in at])


def test_the_stock_of_all_corners_is_grown_once(monkeypatch):
    asked, cavities = Counter(), []
    kept = []  # while they are there no other shape has their identity
    grow, linked = clearing.grow, clearing.Roughing._linked

    def counted(shape, distance, *more):
        kept.append(shape)
        asked[id(shape), distance] += 1
        return grow(shape, distance, *more)

    def noted(self, *given):
        cavities.append(self)
        return linked(self, *given)

    monkeypatch.setattr(clearing, "grow", counted)
    monkeypatch.setattr(clearing.Roughing, "_linked", noted)
    of = job(part(star(POINTS, 20.0, 14.0), thickness=2.0), "mill-6", "mill-2")
    assert plan(of).tools
    narrow = [cut for cut in cavities if cut.only is not None]
    assert len(narrow) >= POINTS
    assert max(asked[id(cut.only), cut.radius - clearing.CLEAR] for cut in narrow) == 1

"""Whether the tip cuts the contours: the text read back, and the blade drawn behind the holder."""

import math
import re
from collections.abc import Sequence

import numpy as np
import shapely

from mechwright import Outline

NEAR, STEP = 0.05, 0.01
"""How far the tip may stray from a contour, and the step in which it is drawn along, mm."""
_WORD = re.compile(r"([GXYZFM])([-+]?[0-9.]+)")


def cuts(text: str, offset: float) -> list[shapely.LineString]:
    """Ways of the tip while the blade is down: a tractrix behind the holder, in short steps."""
    x = y = 0.0
    z, tip, found = 1.0, (-offset, 0.0), list[list[tuple[float, float]]]()
    for line in text.splitlines():
        said = {letter: float(value) for letter, value in _WORD.findall(line)}
        if re.sub(r"\s", "", _WORD.sub("", line)):
            return []
        was, z = z, said.get("Z", z)
        nx, ny = said.get("X", x), said.get("Y", y)
        if z >= 0:
            tip = (tip[0] + nx - x, tip[1] + ny - y)  # lifted, the blade keeps its heading
        elif was >= 0:
            found.append([tip])
        else:
            for share in np.linspace(0, 1, math.ceil(math.hypot(nx - x, ny - y) / STEP) + 1)[1:]:
                at = (x + share * (nx - x), y + share * (ny - y))
                pull = offset / math.dist(at, tip)
                tip = (at[0] + pull * (tip[0] - at[0]), at[1] + pull * (tip[1] - at[1]))
                found[-1].append(tip)
        x, y = nx, ny
    return [shapely.LineString(way) for way in found if len(way) > 1]


def faults(text: str, pieces: Sequence[Outline], offset: float) -> list[str]:
    """What is wrong with a program, a sentence each; none where it cuts all contours in their order."""
    _, *ways = cuts(text, offset) or [None]
    rings = [shapely.LinearRing(one.flatten()) for piece in pieces for one in piece.inner]
    inside = len(rings)
    rings += [shapely.LinearRing(piece.outer.flatten()) for piece in pieces]
    order, wrong = [], []
    for number, way in enumerate(ways, start=1):
        near = [k for k, ring in enumerate(rings) if shapely.hausdorff_distance(way, ring) <= NEAR]
        order += near[:1]
        wrong += [] if near else [f"cut {number} follows no contour"]
    wrong += [
        f"contour {k + 1} is cut {order.count(k)} times" for k in range(len(rings)) if order.count(k) != 1
    ]
    if sorted(order, key=lambda k: k >= inside) != order:
        wrong.append("an outside is cut before an opening")
    return wrong

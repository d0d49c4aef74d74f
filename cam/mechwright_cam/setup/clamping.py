"""Where a plate can be held on its table: toe clamps on its rim, or screws through what is waste of it.

Glossary
--------
rim
    Stock beyond the widest channel around the part and a skin: what a strap may lie on.
strap
    A toe clamp with a screw M8 behind the plate: it covers 10 mm of the rim, and is up to 30 mm wide.
"""

import math
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.contracts.sections import plan_view
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.job import PEELED, Job
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.tool import widest_mill
from mechwright_plane.offsets import ROUGH, filled, grow, polygons

STRAP_ROOM = 15.0
"""Rim for a strap, mm: it covers 10, and may stand 5 back from the cut (workshop practice)."""
OTHER_RIM = 5.0
"""Rim on the sides without clamps, mm: it keeps the frame stiff."""
SKIN = 2.0
"""Between the channel and the rim, mm: a saw is off by as much."""
COVERED = 10.0
"""How far a strap lies on the plate, mm."""
STRAP_WIDTH = 30.0
"""Of a strap along the edge, mm."""
FEW = 4 * STRAP_WIDTH
"""On a shorter edge, mm, there is one strap in its middle, else two at a quarter of its length."""
SCREW = 5.0
"""Diameter of the screws through the waste, mm."""
SCREW_ROOM = 1.5
"""So many diameters from a screw's axis to what is cut and to the plate's edge."""
MOST_SCREWS = 4
EDGES = {"front": "x", "rear": "x", "left": "y", "right": "y"}
"""The edges of a plate, and the axis that each lies along."""
PAIRS = (("front", "rear"), ("left", "right"))


@dataclass(frozen=True)
class Strap:
    """A toe clamp on the rim: the edge that it reaches over, and where along it, work coordinates, mm."""

    edge: str
    at: float


def rim_margins(length: float, width: float, channel: float) -> tuple[float, float]:
    """Stock beyond a part in X and in Y, mm, with room for straps on its two longer sides.

    >>> rim_margins(100.0, 60.0, 12.2)
    (20, 30)
    """
    held, other = math.ceil(channel + SKIN + STRAP_ROOM), math.ceil(channel + SKIN + OTHER_RIM)
    return (other, held) if length >= width else (held, other)


def widest_channel(job: Job) -> float:
    """Width of the channel around the part, mm, with the widest mill of the job."""
    wide = 1.0 if job.settings.outsides == "contour" else PEELED
    return widest_mill(job.tools) * wide + job.settings.stock_to_leave


def _part(job: Job) -> shapely.Geometry:
    return job.target if job.frame is None else job.frame.part


def rims(job: Job) -> dict[str, float]:
    """Width of the rim at each edge of the plate, mm; below 0 where a channel breaks out."""
    x0, y0, x1, y1 = shapely.total_bounds(_part(job)).tolist()
    left, front, right, rear = job.stock
    beside = {"left": x0 - left, "front": y0 - front, "right": right - x1, "rear": rear - y1}
    return {edge: room - widest_channel(job) - SKIN for edge, room in beside.items()}


def straps(job: Job) -> tuple[Strap, ...]:
    """Toe clamps on the two opposite edges with the most room; none where no pair has enough."""
    room, found = rims(job), []
    x0, y0, x1, y1 = job.stock
    for pair in PAIRS:
        least = min(room[edge] for edge in pair)
        low, high = (x0, x1) if EDGES[pair[0]] == "x" else (y0, y1)
        if least >= STRAP_ROOM - TOLERANCES.noise:
            found.append((high - low, low, pair))
    if not found:
        return ()
    length, low, pair = max(found)
    places = (0.5,) if length < FEW else (0.25, 0.75)
    return tuple(Strap(edge, round(low + share * length, 1)) for edge in pair for share in places)


def strap_box(job: Job, strap: Strap) -> tuple[float, float, float, float]:
    """Where a strap lies on the plate: least and greatest x and y, work coordinates, mm."""
    x0, y0, x1, y1 = job.stock
    low, high = strap.at - STRAP_WIDTH / 2, strap.at + STRAP_WIDTH / 2
    match strap.edge:
        case "front":
            return low, y0, high, y0 + COVERED
        case "rear":
            return low, y1 - COVERED, high, y1
        case "left":
            return x0, low, x0 + COVERED, high
        case _:
            return x1 - COVERED, low, x1, high


def screw_places(job: Job) -> tuple[Point, ...]:
    """Places of up to four screws in the waste around the part, as far apart as there is room."""
    apart = SCREW_ROOM * SCREW
    taken = [filled(grow(filled(_part(job)), widest_channel(job), ROUGH))]
    taken += [tab.shape for tab in job.tabs]
    for feature in job.inner:
        view = inside_of(feature)
        if not shapely.contains(filled(_part(job)), plan_view(feature)):
            taken.append(view)
    plate = shapely.box(*job.stock)
    free = shapely.difference(grow(plate, -apart, ROUGH), grow(shapely.union_all(taken), apart, ROUGH))
    parts = [part for part in polygons(free) if not shapely.is_empty(part)]
    if not parts:
        return ()
    x0, y0, x1, y1 = job.stock
    middle = np.array([(x0 + x1) / 2, (y0 + y1) / 2])
    corners = np.concatenate([shapely.get_coordinates(part) for part in parts])
    chosen: list[Point] = []
    for sx, sy in ((-1, -1), (1, 1), (1, -1), (-1, 1)):
        away = (corners - middle) @ (sx, sy)
        x, y = corners[int(np.argmax(away))].tolist()
        if all(math.dist((x, y), other) > 2 * apart for other in chosen):
            chosen.append((round(x, 1), round(y, 1)))
    return tuple(chosen[:MOST_SCREWS])


def least_margin(channel: float) -> int:
    """Stock beyond a part on every side, mm, with which straps find room on any pair of edges."""
    return math.ceil(channel + SKIN + STRAP_ROOM)

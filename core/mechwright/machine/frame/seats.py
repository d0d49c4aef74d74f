"""Which ball bearings carry each spindle: on its hub's shaft, between its neighbours.

Both bearings of a shaft are alike, and their bore is smaller than the hub's: the shaft steps down to them, so
that everything is put on from its upper end.
"""

import math
from dataclasses import dataclass
from itertools import combinations

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.materials import entry, material
from mechwright.contracts.mounting import Mounting, Spindle
from mechwright.machine.frame.fault import fault
from mechwright.machine.frame.keys import Arrangement, FrameKeys
from mechwright.machine.frame.located import APART, has_room, retainer_diameter
from mechwright.standards.bearings import Bearing, bearings
from mechwright.standards.circlips import Circlip, shaft_circlips

ORDER = ("60", "62", "619", "618")
"""In which series are tried: the usual one, the heavier one on shafts that it alone has, thinner ones."""

WALL, SOFT_WALL, LEAST_WALL = {"steel": 0.15}, 0.3, 4.0
"""Wall around a bearing in shares of its outside, 0.2 of other metals, and at least, mm; handbook."""

MOST_STEP = 2.0
"""By how much a circlip's shaft may be thinner than the hub's bore, mm: the ring still holds the hub."""


@dataclass(frozen=True)
class Seat:
    """A spindle with its bearings and the circlip over its hub."""

    spindle: Spindle
    bearing: Bearing
    circlip: Circlip
    arrangement: Arrangement = "floating"

    @property
    def located(self) -> bool:
        """Whether the lower bearing holds the shaft both ways, and the upper one is free."""
        return self.arrangement == "locating-free"


def wall(outside: float, name: str) -> float:
    """Around a bearing's outside in a plate of a material, mm."""
    plate = material(name)
    share = SOFT_WALL if plate.soft else entry(WALL, plate.name) or 0.2
    return max(LEAST_WALL, share * outside)


def circlip_over(bore: float) -> Circlip | None:
    """The ring that holds a hub of this bore, mm; None where none is near enough."""
    fitting = [one for one in shaft_circlips() if bore - MOST_STEP <= one.size <= bore]
    return fitting[-1] if fitting else None


def candidates(bore: float, series: str, arrangement: Arrangement = "floating") -> list[Bearing]:
    """What can carry the shaft of a hub of this bore, mm, best first; at most one of each series."""
    able = [one for one in bearings() if arrangement == "floating" or has_room(one)]
    ring = circlip_over(bore)
    if ring is None:
        return []
    found = []
    for name in ORDER if series == "auto" else (series,):
        fitting = [one for one in able if one.series == name and one.shoulder <= ring.size]
        if fitting:
            found.append(fitting[-1])
    widest = max((one.bore for one in found), default=0.0)
    # A series that begins far below the hub's size is no choice for it, except where it is asked for.
    return [one for one in found if one.bore >= widest / 2]


def seats(mounting: Mounting, keys: FrameKeys) -> tuple[list[Seat], list[Finding]]:
    """The bearings of all spindles, or findings that say why there are none."""
    way = keys.bearing_arrangement
    choice = {one.name: candidates(one.hub.bore, keys.bearing, way) for one in mounting.spindles}
    lacking = [one for one in mounting.spindles if not choice[one.name]]
    if lacking:
        return [], [_no_bearing(one, keys) for one in lacking]
    clash = _thinned(mounting, choice, keys)
    if clash is not None:
        return [], [_too_near(mounting, keys, *clash)]
    found = []
    for one in mounting.spindles:
        ring = circlip_over(one.hub.bore)
        assert ring is not None  # noqa: S101 - without one there are no candidates
        found.append(Seat(one, choice[one.name][0], ring, way))
    return found, []


def needed(one: Bearing, two: Bearing, material: str, arrangement: Arrangement = "floating") -> float:
    """Least distance of two axes, mm: half of both outsides, and the wall of the larger between them.

    Retainers of locating bearings keep apart as well.
    """
    least = (one.outside + two.outside) / 2 + wall(max(one.outside, two.outside), material)
    if arrangement == "floating":
        return least
    return max(least, (retainer_diameter(one) + retainer_diameter(two)) / 2 + APART)


def plate_radius(seat: Seat, material: str) -> float:
    """Of what a plate keeps for a seat about its axis, mm: the bearing with its wall, or its retainer."""
    least = seat.bearing.outside / 2 + wall(seat.bearing.outside, material)
    return max(least, retainer_diameter(seat.bearing) / 2) if seat.located else least


def _thinned(
    mounting: Mounting, choice: dict[str, list[Bearing]], keys: FrameKeys
) -> tuple[Spindle, Spindle, Bearing, Bearing] | None:
    """Drop bearings that are too large until all have room; a pair that cannot, with its smallest ones."""
    material, way = keys.plate_material, keys.bearing_arrangement
    while True:
        for one, two in combinations(mounting.spindles, 2):
            pair = choice[one.name][0], choice[two.name][0]
            if needed(*pair, material, way) <= math.dist(one.point, two.point):
                continue
            for spindle in sorted((one, two), key=lambda s: -choice[s.name][0].outside):
                now = choice[spindle.name][0].outside
                smaller = [other for other in choice[spindle.name] if other.outside < now]
                if smaller:
                    choice[spindle.name][:] = smaller
                    break
            else:
                return one, two, *pair
            break
        else:
            return None


def _no_bearing(spindle: Spindle, keys: FrameKeys) -> Finding:
    bore = spindle.hub.bore
    able = [b for b in bores() if candidates(b, keys.bearing, keys.bearing_arrangement)]
    near = min(able, key=lambda b: (abs(b - bore), b), default=None)
    series = "" if keys.bearing == "auto" else f" of series {keys.bearing}"
    if keys.bearing != "auto" and candidates(bore, "auto", keys.bearing_arrangement):
        return fault(
            "frame.bearing",
            "machine.bearing",
            f"no bearing{series} fits the shaft of spindle {spindle.name}, whose hub has a bore of "
            f"{bore:g} mm",
            remedy='set bearing = "auto"',
            proposed=({"machine.bearing": "auto"},),
        )
    return fault(
        "frame.bearing",
        spindle.bore_key,
        f"no bearing{series} and circlip of the tables fit the shaft of spindle {spindle.name}, whose hub "
        f"has a bore of {bore:g} mm",
        bore,
        near,
        "" if near is None else f"make it {near:g}",
        ({spindle.bore_key: near},) if near is not None and spindle.bore_key else (),
    )


def _too_near(
    mounting: Mounting, keys: FrameKeys, one: Spindle, two: Spindle, first: Bearing, second: Bearing
) -> Finding:
    """What two axes leave for bearings, and what fits: another series, thinner shafts, more distance."""
    distance = math.dist(one.point, two.point)
    least = needed(first, second, keys.plate_material, keys.bearing_arrangement)
    most = second.outside - 2 * (least - distance)
    between = "the wall" if keys.bearing_arrangement == "floating" else "retainers"
    said = (
        f"the axes of {one.name} and {two.name} stand {distance:.2f} mm apart; bearings {first.name} and "
        f"{second.name}, {first.outside:g} and {second.outside:g} mm outside, need "
        f"{least:.2f} mm with {between} between them: beside the {first.name} there is room for "
        f"{max(most, 0):.1f} mm"
    )
    proposed: list[Change] = []
    if keys.bearing_arrangement != "floating":
        proposed.append({"machine.bearing_arrangement": "floating"})
    if keys.bearing != "auto":
        proposed.append({"machine.bearing": "auto"})
    smaller: list[Change] = [
        {spindle.bore_key: bore for spindle in mounting.spindles if spindle.hub.bore > bore}
        for bore in sorted(bores(), reverse=True)
        if bore < max(one.hub.bore, two.hub.bore)
        and _room(min(bore, one.hub.bore), min(bore, two.hub.bore), keys, distance)
    ]
    proposed += [change for change in smaller if "" not in change][:3]
    proposed += mounting.turned_away
    remedy = "use thinner bearings or shafts, or move the axes apart"
    return fault(
        "frame.bearing-room",
        "machine.bearing",
        said,
        distance,
        least,
        remedy,
        tuple(proposed),
    )


def _room(one: float, two: float, keys: FrameKeys, distance: float) -> bool:
    way = keys.bearing_arrangement
    first, second = candidates(one, "auto", way), candidates(two, "auto", way)
    return any(needed(a, b, keys.plate_material, way) <= distance for a in first for b in second)


def bores() -> list[float]:
    """For which there are circlips, mm, from the least."""
    return sorted({one.size for one in shaft_circlips()})

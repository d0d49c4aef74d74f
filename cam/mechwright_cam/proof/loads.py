"""How hard the tools work: what was taken along the path, in windows, and what it asks of cutter and spindle.

Glossary
--------
place
    A point of the path at which the cutter was set onto the grid of the simulation.
window
    A stretch of path in material, a diameter of the cutter long.
engagement
    Angle of the cutter's circumference that is in material; 180 degrees is a full slot.
section
    Area of what is taken, seen along the path: depth times width.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.materials import Material, material
from mechwright_cam.controls.reading import Run
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.timing import operation_steps
from mechwright_cam.shop.cutter import BLUNT, POINTED, approach
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.power import WATTS, available, drilling_force, milling_force

ALIKE = 1e-6
"""Share by which loads differ that are told as one: rounding, which depends on the processor, is less."""


def first_greatest(values: Array) -> int:
    """Place of the first of the values (n,) that are the greatest, whatever rounds the others.

    >>> first_greatest(np.array([1.0, 3.0, 3.0 + 1e-9]))
    1
    """
    return int(np.argmax(values >= (1 - ALIKE) * values.max()))


@dataclass(frozen=True)
class Taken:
    """What one tool takes at places (n,) along its path."""

    places: Array
    """(n, 2), mm."""
    z: Array
    step: Ints
    """(n,) the step that leads to the place."""
    way: Array
    """(n, 3) from the place before; 0 at the first of a chain of moves."""
    length: Array
    seconds: Array
    """(n,) length of path, mm, and time at its feeds, s, since the place before."""
    chain: Ints
    """(n,) number of the chain of moves that follow on each other."""
    volume: Array
    depth: Array
    """(n,) mm³, and the most that a cell was lowered by, mm."""
    moment: Array
    """(n, 2) volume times the way from the cutter's axis to its middle, mm⁴."""

    @classmethod
    def along(cls, paths: Paths, steps: Ints, spacing: float) -> "Taken":
        """Places so far apart along the path, mm, with nothing taken yet; many short moves have one place."""
        places, z, step = paths.samples(steps, spacing)
        point = np.column_stack((places, z))
        chain = np.concatenate(([0], np.cumsum(np.diff(step) > 1)))
        first = np.concatenate(([True], np.diff(chain) > 0))
        way = np.diff(point, axis=0, prepend=point[:1])
        length = np.where(first, 0.0, np.sqrt((way**2).sum(axis=1)))
        so_far = np.cumsum(length)
        time = np.cumsum(length / np.maximum(paths.run.feed[step], NEAR) * 60)
        moved = np.maximum.accumulate(np.where(first | (length > 0), np.arange(step.size), 0))
        fall = np.sign(np.where(first, 0.0, way[:, 2]))[moved]  # where one move ends the next begins
        turns = fall[:-1] != fall[1:]  # lowest and highest places of the way
        apart = np.diff(np.floor(so_far / (spacing / 2))) > 0
        long = paths.length[step] >= spacing / 2
        keep = np.flatnonzero(first | np.append(first[1:] | turns | apart, True) | long)
        way = np.where(first[keep, None], 0.0, np.diff(point[keep], axis=0, prepend=point[keep[:1]]))
        return cls(
            places[keep],
            z[keep],
            step[keep],
            way,
            np.where(first[keep], 0.0, np.diff(so_far[keep], prepend=0.0)),
            np.where(first[keep], 0.0, np.diff(time[keep], prepend=0.0)),
            chain[keep],
            np.zeros(keep.size),
            np.zeros(keep.size),
            np.zeros((keep.size, 2)),
        )

    @property
    def cuts(self) -> Ints:
        """Indices of the places at which something is taken on the way there."""
        return np.flatnonzero((self.volume > 0) & (self.length > 0))

    def of_steps(self, steps: Ints) -> Array:
        """Volume (k,) that each of the steps takes; one without a place of its own has that of the next."""
        own = np.zeros(int(steps[-1]) + 1)
        np.add.at(own, self.step, self.volume)
        after = np.searchsorted(self.step, steps)
        lacks = self.step[after] != steps
        found: Array = np.where(lacks, self.volume[after], own[steps])
        return found


@dataclass(frozen=True)
class Loads:
    """All windows (m,) of a program in its order."""

    stuff: Material
    step: Ints
    """The step in which most is taken."""
    first: Ints
    last: Ints
    """Its first and its last step."""
    tool: Ints
    radius: Array
    flutes: Array
    path: Array
    """Length, mm."""
    depth: Array
    """Greatest depth of cut, mm."""
    section: Array
    """mm²."""
    feed: Array
    """Greatest feed, mm/min."""
    removal: Array
    """cm³/min."""
    rpm: Array
    angle: Array
    """Sine of the angle between the cutting edge and the path: 1 for a flat end mill."""
    side: Array
    """Where the material is taken: -1 on the right of the path, as in climb milling, 1 on the left."""
    down: NDArray[np.bool_]
    """Whether the way is straight down."""
    x: Array
    y: Array
    """Where it ends, mm."""

    @cached_property
    def width(self) -> Array:
        """Width of cut, mm."""
        return np.clip(self.section / np.maximum(self.depth, NEAR), 0.0, 2 * self.radius)

    @cached_property
    def engagement(self) -> Array:
        """rad; straight down it is all around."""
        angle = np.arccos(np.clip(1 - self.width / self.radius, -1.0, 1.0))
        return np.where(self.down, np.pi, angle)

    @cached_property
    def tooth(self) -> Array:
        """Feed per tooth, mm."""
        return self.feed / np.maximum(self.rpm * self.flutes, NEAR)

    @cached_property
    def chip(self) -> Array:
        """Greatest thickness of a chip, mm."""
        return self.tooth * np.sin(np.minimum(self.engagement, np.pi / 2)) * self.angle

    @cached_property
    def power(self) -> Array:
        """Power that goes into chips, kW."""
        tooth = self.tooth * self.angle
        milled = milling_force(self.stuff, tooth, self.engagement)
        force = np.where(self.down, drilling_force(self.stuff, tooth), milled)
        return self.removal * force * WATTS / 1000

    @cached_property
    def torque(self) -> Array:
        """N m at the tool."""
        return self.power * 1000 / np.maximum(2 * np.pi * self.rpm / 60, NEAR)

    def only(self, which: NDArray[np.bool_] | Ints) -> "Loads":
        """Some of the windows."""
        return Loads(self.stuff, **{name: getattr(self, name)[which] for name in _ARRAYS})


_ARRAYS: dict[str, type] = {
    field.name: np.int64 if field.type == Ints else np.float64 if field.type == Array else np.bool_
    for field in fields(Loads)[1:]
}
"""Name and kind of the arrays of Loads."""


@dataclass(frozen=True, slots=True)
class Work:
    """How hard a tool works in an operation: the greatest of everything, in windows."""

    operation: str
    tool: int
    """T number."""
    feed_per_tooth: float
    """mm, in material."""
    chip: float
    """Thickness of a chip, mm: feed per tooth times the sine of the engagement, 90 degrees at most; less
    where only the rounded corner or the cone of a cutter is in the cut."""
    engagement: float
    """Degrees."""
    removal: float
    """cm³/min."""
    power: float
    """In the cut, kW."""
    torque: float
    """N m."""
    share: float
    """Of what the spindle has at that speed for the cut."""
    line: int
    """Line of the program where that is."""


def loads_of(taken: Sequence[Taken], paths: Paths, name: str) -> Loads:
    """The windows of what was taken of a material."""
    stuff = material(name)
    parts = [_windows(one, paths, stuff) for one in taken if one.cuts.size]
    values: dict[str, NDArray[Any]] = {
        name: np.concatenate([getattr(one, name) for one in parts]) if parts else np.empty(0, dtype=kind)
        for name, kind in _ARRAYS.items()
    }
    return Loads(stuff, **values)


def _windows(taken: Taken, paths: Paths, stuff: Material) -> Loads:
    """The windows of one tool's path, which takes something."""
    run, cuts = paths.run, taken.cuts
    tool = paths.tools[int(run.tool[taken.step[cuts[0]]])]
    down = (np.hypot(*taken.way[cuts, :2].T) <= NEAR) & (taken.way[cuts, 2] < 0)
    # A window ends where the cutter has left the material or turns down, or where it is long enough.
    apart = (np.diff(cuts) > 1) | (np.diff(taken.chain[cuts]) > 0) | (np.diff(down.astype(np.int8)) != 0)
    begin = np.concatenate(([0], np.flatnonzero(apart) + 1))
    count = np.diff(np.append(begin, cuts.size))
    before = np.cumsum(taken.length[cuts]) - taken.length[cuts]
    piece = np.floor((before - np.repeat(before[begin], count)) / tool.diameter)
    fresh = np.concatenate(([False], apart | (np.diff(piece) > 0)))
    window = np.cumsum(fresh)
    n = int(window[-1]) + 1

    def total(values: Array) -> Array:
        out: Array = np.bincount(window, values, minlength=n).astype(np.float64)
        return out

    def greatest(values: Array) -> Array:
        most = np.zeros(n)
        np.maximum.at(most, window, values)
        return most

    step, volume = taken.step[cuts], taken.volume[cuts]
    ends = np.append(np.flatnonzero(fresh), cuts.size) - 1
    path, all_volume = total(taken.length[cuts]), total(volume)
    order = np.lexsort((volume, window))  # the last of each window takes most
    heaviest = step[order[np.searchsorted(window[order], np.arange(n), side="right") - 1]]
    flat = np.maximum(np.hypot(*taken.way[cuts, :2].T), NEAR)
    ahead = taken.way[cuts, :2] / flat[:, None]
    aside = ahead[:, 0] * taken.moment[cuts, 1] - ahead[:, 1] * taken.moment[cuts, 0]
    depth = greatest(taken.depth[cuts])
    if tool.kind in POINTED:
        angle = np.full(n, math.sin(math.radians(min(tool.point_angle, BLUNT) / 2)))
    else:
        angle = approach(tool, depth)
    straight = np.zeros(n, dtype=np.bool_)
    straight[window] = down
    loads = Loads(
        stuff,
        heaviest,
        step[np.searchsorted(window, np.arange(n))],
        step[np.searchsorted(window, np.arange(n), side="right") - 1],
        np.full(n, tool.number),
        np.full(n, tool.radius),
        np.full(n, float(tool.flutes)),
        path,
        depth,
        all_volume / path,
        greatest(run.feed[step]),
        all_volume / total(taken.seconds[cuts]) * 60 / 1000,
        np.array([state.rpm for state in run.states])[run.state[heaviest]],
        angle,
        total(aside) / (all_volume * tool.radius),
        straight,
        *taken.places[cuts[ends]].T,
    )
    return loads.only(path >= tool.radius)  # of shorter ones nothing is known: the grid is coarser than that


def works_of(loads: Loads, run: Run, machine: Machine) -> tuple[Work, ...]:
    """The greatest loads of each operation."""
    share = loads.power / np.maximum(available(machine, loads.rpm), NEAR)
    works = []
    for name, first, last in operation_steps(run):
        for tool in dict.fromkeys(loads.tool[(loads.step >= first) & (loads.step < last)].tolist()):
            mine = np.flatnonzero((loads.step >= first) & (loads.step < last) & (loads.tool == tool))
            worst = mine[first_greatest(share[mine])]

            def most(values: Array, mine: Ints = mine) -> float:
                return float(values[mine].max())

            works.append(
                Work(
                    name,
                    tool,
                    most(loads.tooth),
                    most(loads.chip),
                    math.degrees(most(loads.engagement)),
                    most(loads.removal),
                    float(loads.power[worst]),
                    float(loads.torque[worst]),
                    float(share[worst]),
                    int(run.line[loads.step[worst]]),
                )
            )
    return tuple(works)

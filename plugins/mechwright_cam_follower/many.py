"""Many cams that have their segments and laws in common, and how they are sampled."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright.mechanics.laws import Rates
from mechwright_cam_follower.cycle import Segment, cycle_of
from mechwright_cam_follower.extremes import GRID, HAIR, cams_of
from mechwright_cam_follower.geometry import Contact, Geometry, geometry_of
from mechwright_cam_follower.loads import Loads, loads_at
from mechwright_cam_follower.params import CamParams

SPARE = 2.0
"""How often the rise that a parabola through three samples of the grid promises is reckoned with."""

ROUNDING = 1e-13
"""Share by which two samples of one value differ."""

NEARER = (1 / 16, 1 / 256)
"""Steps, in those of the grid, of the samples through which parabolas are put one after the other."""

SETTLED = 5e-6
"""Share by which the last parabola may have raised a value: what is left is 1/256² of that."""


class Cams:
    """Designs as formulas ask for them: of what is varied (n, 1), of the rest what all have."""

    def __init__(self, designs: Designs) -> None:
        self.designs = designs
        self.common: CamParams = designs.common

    def __len__(self) -> int:
        return len(self.designs)

    def __getattr__(self, name: str) -> Any:
        return self.one(name) if name in self.designs.varied else getattr(self.common, name)

    def one(self, name: str) -> Array:
        """What is varied, (n, 1)."""
        return np.asarray(self.designs.varied[name], dtype=float)[:, None]

    def value(self, name: str) -> Any:
        """A field that belongs to one kind of follower, (n, 1) or one number."""
        return self.one(name) if name in self.designs.varied else self.common.value(name)

    @property
    def face(self) -> Any:
        """From a lever's axis to its flat face, mm."""
        return self.follower_width / 2 if self.common.face_offset is None else self.face_offset

    @property
    def omega(self) -> Any:
        """Speed, rad/s."""
        return self.speed * np.pi / 30

    def some(self, places: NDArray[np.intp]) -> "Cams":
        """Those at these places."""
        return Cams(self.designs.some(places))


@dataclass(frozen=True)
class Seen:
    """Cams at some angles: rates (1, k) that all have in common or (n, k), and what follows, (n, k)."""

    cams: Cams
    rates: Rates

    @cached_property
    def geometry(self) -> Geometry[Any]:
        """Sizes (n, 1)."""
        return geometry_of(self.cams)

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """The contact of each cam."""
        return tuple(self.geometry.contact(self.rates, second) for second in cams_of(self.cams.common))

    @cached_property
    def loads(self) -> Loads:
        """Forces, pressures, torque."""
        return loads_at(self.cams, self.rates, self.contacts)


Measure = Callable[[Seen], Array]
"""What is looked at, (n, k) or (1, k); ``nan`` where there is nothing."""


@dataclass(frozen=True)
class Piece:
    """A smooth piece of a segment, and the shares (k,) of its samples."""

    segment: Segment
    low: float
    high: float

    @cached_property
    def shares(self) -> Array:
        """Those of the search for one cam; one of a dwell."""
        if self.segment.law is None:
            return np.array([self.low])
        return self.inside(np.linspace(self.low, self.high, GRID))

    def inside(self, u: Array) -> Array:
        """The same shares, none of them beyond the piece."""
        clipped: Array = np.clip(u, self.low + HAIR * (self.low > 0), self.high - HAIR)
        return clipped


def pieces_of(params: CamParams) -> Iterator[Piece]:
    """The smooth pieces of a turn."""
    for segment in cycle_of(params).segments:
        for low, high in pairwise(segment.cuts if segment.law else (0.0, 1.0)):
            yield Piece(segment, low, high)


class Course:
    """A turn of many cams, sampled once for all that is looked at."""

    def __init__(self, cams: Cams) -> None:
        self.cams = cams
        self.pieces = list(pieces_of(cams.common))
        self.seen = [Seen(cams, piece.segment.at(piece.shares[None])) for piece in self.pieces]

    def greatest(self, measure: Measure) -> tuple[Array, NDArray[np.bool_]]:
        """The greatest values (n,) over the turn, and whether each has been found for sure."""
        size = len(self.cams)
        tops = [_top(measure(seen), size) for seen in self.seen]
        best, sure = np.max([top.value for top in tops], axis=0), np.ones(size, dtype=bool)
        likely = best + ROUNDING * np.abs(best)
        for piece, top in zip(self.pieces, tops, strict=True):
            near = np.flatnonzero(top.value + SPARE * top.rise > likely)
            if piece.segment.law is None or not near.size:
                continue
            value, settled = _climbed(self.cams.some(near), piece, measure, top.place[near], top.value[near])
            best[near] = np.maximum(best[near], value)
            sure[near] &= settled
        return best, sure & np.isfinite(best)


@dataclass(frozen=True)
class _Top:
    """The greatest sample (n,) of a piece, in shares of steps where a parabola has its top, and its rise."""

    value: Array
    place: Array
    rise: Array


def _top(values: Array, size: int) -> _Top:
    values = np.where(np.isnan(values), -np.inf, values)
    place = np.argmax(values, axis=1)
    row = np.arange(len(values))
    most = values[row, place]
    if values.shape[1] < 3:
        return _Top(*(np.broadcast_to(one, size) for one in (most, place + 0.0, 0 * most)))
    middle = np.clip(place, 1, values.shape[1] - 2)
    shift, top = _vertex(*(values[row, middle + one] for one in (-1, 0, 1)))
    return _Top(*(np.broadcast_to(one, size) for one in (most, middle + shift, np.maximum(top - most, 0.0))))


def _vertex(left: Array, centre: Array, right: Array) -> tuple[Array, Array]:
    """Where a parabola through three values is greatest, at most a step off its middle, and how great."""
    bend, slope = left - 2 * centre + right, (right - left) / 2
    inside = np.abs(slope) <= -bend
    shift = np.where(inside, -slope / np.where(inside & (bend < 0), bend, -1.0), np.sign(slope))
    shift = np.where(np.isfinite(slope), shift, 0.0)
    top: Array = np.where(inside, centre + slope * shift / 2, np.maximum(left, right))
    return shift, np.where(np.isfinite(top), top, centre)


def _climbed(
    cams: Cams, piece: Piece, measure: Measure, place: Array, found: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """The greatest values (n,) about a place, by parabolas through ever nearer samples, and if they stand."""
    step = (piece.high - piece.low) / (GRID - 1)
    middle, best, settled = piece.low + step * place, found.copy(), np.zeros(len(cams), dtype=bool)
    for wide in NEARER:
        left = np.flatnonzero(~settled)
        some = cams if left.size == len(cams) else cams.some(left)
        around = np.clip(middle[left], piece.low + wide * step, piece.high - wide * step)
        values = _asked(some, piece, measure, around[:, None] + wide * step * np.array([-1.0, 0.0, 1.0]))
        last = np.maximum(best[left], values.max(axis=1))
        middle[left] = around + wide * step * _vertex(*values.T)[0]
        best[left] = np.maximum(last, _asked(some, piece, measure, middle[left, None])[:, 0])
        settled[left] = best[left] - last <= SETTLED * np.abs(last)
        if settled.all():
            break
    return best, settled


def _asked(cams: Cams, piece: Piece, measure: Measure, u: Array) -> Array:
    values = measure(Seen(cams, piece.segment.at(piece.inside(u))))
    found: Array = np.where(np.isnan(values), -np.inf, np.broadcast_to(values, u.shape))
    return found


def extremes(
    cams: Cams, theta: Array, measures: Sequence[Measure], block: int = 64
) -> list[tuple[Array, Array]]:
    """The least and greatest (n,) of each measure over angles (k,) of the cam, rad."""
    rates = cycle_of(cams.common).at(theta)
    rows = Rates(*(values[None] for values in (rates.s, rates.v, rates.a, rates.j)))
    found = np.empty((len(measures), 2, len(cams)))
    for start in range(0, len(cams), block):
        places = np.arange(start, min(start + block, len(cams)))
        seen = Seen(cams.some(places), rows)
        for number, measure in enumerate(measures):
            values = measure(seen)
            found[number, 0, places] = values.min(axis=1)
            found[number, 1, places] = values.max(axis=1)
    return [(low, high) for low, high in found]

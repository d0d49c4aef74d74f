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
from mechwright.mechanics.peaks import NEARER, Asked, Tops, climbed
from mechwright_cam_follower.cycle import Segment, cycle_of
from mechwright_cam_follower.extremes import GRID, HAIR, cams_of
from mechwright_cam_follower.geometry import Contact, Geometry, geometry_of
from mechwright_cam_follower.loads import Loads, loads_at
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.usual import FOLLOWS, followed

SPARE = 2.0
"""How often the rise that a parabola through three samples of the grid promises is reckoned with."""

ROUNDING = 1e-13
"""Share by which two samples of one value differ."""


LEVEL = 1e-5
"""Share by which the end of a piece may lie below the greatest sample of all, and have a hill beside it that
is the greatest: such a hill is narrower than a step, and as low."""


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
        if name in self.designs.varied:
            return self.one(name)
        if name in FOLLOWS and getattr(self.common, name) is None:
            return followed(self, name)
        return self.common.value(name)

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

    def rises(self, top: Tops, which: NDArray[np.intp], asked: Asked) -> NDArray[np.bool_]:
        """Of all designs (n,) whether one of some goes up from an end that is its greatest sample."""
        found = np.zeros(top.value.size, dtype=bool)
        first, last = top.place[which] <= 0, top.place[which] >= GRID - 1
        ends = which[first | last]
        if ends.size:
            step = NEARER[0] * (self.high - self.low) / (GRID - 1)
            beside = np.where(top.place[ends] <= 0, self.low + step, self.high - step)
            found[ends] = asked(ends, beside[:, None])[:, 0] > top.value[ends]
        return found


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
        tops = [Tops.of(measure(seen), size) for seen in self.seen]
        best, sure = np.max([top.value for top in tops], axis=0), np.ones(size, dtype=bool)
        likely, level = best + ROUNDING * np.abs(best), best - LEVEL * np.abs(best)
        for piece, top in zip(self.pieces, tops, strict=True):
            if piece.segment.law is None:
                continue

            def asked(which: NDArray[np.intp], u: Array, piece: Piece = piece) -> Array:
                values = measure(Seen(self.cams.some(which), piece.segment.at(piece.inside(u))))
                return np.broadcast_to(values, u.shape)

            high = top.value + SPARE * top.rise > likely
            near = np.flatnonzero(
                high | piece.rises(top, np.flatnonzero(~high & (top.value >= level)), asked)
            )
            if not near.size:
                continue
            value, settled = climbed(asked, top, near, piece.low, piece.high, GRID)
            best[near] = np.maximum(best[near], value)
            sure[near] &= settled
        return best, sure & np.isfinite(best)


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

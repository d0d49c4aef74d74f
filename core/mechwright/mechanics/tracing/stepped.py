"""Linkages on a path whose dimensions are rounded to steps, all else fitted again.

Rounding alone is never right: a line of 80 mm that is met within 0.02 mm is missed by ten times as much once
four links are set to whole millimetres. So what is rounded is held, and the rest of the linkage is fitted to
the points again, within its limits. Held are dimensions from above and below, as two limits each, which the
augmented Lagrangian of :mod:`mechwright.mechanics.tracing.descent` keeps exactly.

Each dimension may go up or down; the choices are tried in the order of what they change, and of the first few
that keep all limits the nearest to the points stays. Dimensions are rounded in groups, links before the place
of the point on them, which then makes up for a part of what the links have lost.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Protocol, TypeVar

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.tracing.descent import Traced

KEEPING = 3
"""Choices that keep all limits, of which the nearest to the points is taken."""

TRIED = 8
"""Most choices of a group that are fitted."""

CLEAN = 9
"""Decimals of multiples of a step: without the tail of a double."""

F = TypeVar("F")


class Dimensioned(Traced, Protocol):
    """A linkage that says its dimensions."""

    def dimensions(self, made: Any) -> Array:
        """(..., m) in the unit of the step, those first that are rounded first."""


@dataclass(frozen=True)
class Held:
    """A room whose first dimensions are decided; see ``mechwright.mechanics.tracing``.

    Parameters
    ----------
    room
        The room, with a sense of its crank.
    values
        (j,) of the first dimensions.
    unit
        What a dimension of 1 in the search's own measure is.
    """

    room: Any
    values: tuple[float, ...]
    unit: float

    @property
    def sense(self) -> int:
        """See ``Room``."""
        return int(self.room.sense)

    def made(self, x: Array) -> Any:
        """See ``Traced``."""
        return self.room.made(x)

    def missed(self, made: Any, theta: Array) -> Array:
        """See ``Traced``."""
        found: Array = self.room.missed(made, theta)
        return found

    def exceeded(self, made: Any, theta: Array) -> Array:
        """The limits of the room, and the dimensions' distances from their values, both ways."""
        over: Array = self.room.exceeded(made, theta)
        off = (self.room.dimensions(made)[..., : len(self.values)] - np.array(self.values)) / self.unit
        off = np.broadcast_to(off, (*over.shape[:-1], len(self.values)))
        return np.concatenate([over, off, -off], axis=-1)

    def ordered(self, theta: Array, sense: Array) -> Array:
        """See ``Traced``."""
        found: Array = self.room.ordered(theta, sense)
        return found

    def starts(self, count: int, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        """See ``Room``."""
        found: tuple[Array, Array, Array] = self.room.starts(count, rng)
        return found


def stepped(
    exact: Array,
    groups: Sequence[int],
    step: float,
    fitted: Callable[[tuple[float, ...], F | None], tuple[F, float, Array] | None],
) -> tuple[tuple[float, ...], F] | None:
    """Dimensions in multiples of a step, and the fit that has them; None where none keeps the limits.

    Parameters
    ----------
    exact
        (m,) dimensions before.
    groups
        How many are rounded together, one number after the other; they add up to m.
    step
        In the unit of the dimensions.
    fitted
        Fits a linkage whose first dimensions have given values, from an earlier fit or from the design itself
        (None): the fit, its distance from the points and all its dimensions (m,); or None.
    """
    held: tuple[float, ...] = ()
    now, start = exact, None
    for size in groups:
        part = now[len(held) : len(held) + size]
        kept: list[tuple[float, tuple[float, ...], F, Array]] = []
        for choice in _choices(part, step):
            found = fitted((*held, *choice), start)
            if found is not None:
                kept.append((found[1], (*held, *choice), found[0], found[2]))
            if len(kept) == KEEPING:
                break
        if not kept:
            return None
        _, held, start, now = min(kept, key=lambda one: one[0])
    return None if start is None else (held, start)


def _choices(values: Array, step: float) -> Iterator[tuple[float, ...]]:
    """Multiples of a step below and above each value, all together, the nearest first.

    >>> list(_choices(np.array([10.2, 5.0]), 0.5))
    [(10.0, 5.0), (10.5, 5.0), (10.0, 5.5), (10.5, 5.5)]
    """
    either = [[math.floor(value / step + k) for k in (0, 1)] for value in values.tolist()]
    off = [float(np.square(np.array(one) - values / step).sum()) for one in product(*either)]
    every = [one for _, one in sorted(zip(off, product(*either), strict=True))]
    for one in every[:TRIED]:
        yield tuple(round(n * step, CLEAN) for n in one)

"""Long motions in stretches: what they take together is bounded, however many samples there are.

Glossary
--------
stretch
    Samples of a motion that are worked out together.
lead
    Samples from the start of the period up to a stretch, far apart, that are worked out before it and then
    left out: angles that run on over a turn, and whatever else is counted from the start, are those of the
    whole.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion, Poses, Rates
from mechwright.errors import DesignError

TOGETHER = 16_384
"""Samples of a stretch: at up to 6 kB that linkages need for each, as much as Python and numpy themselves."""

LEAD = 4_096
"""Samples of a lead at most: an input that makes twenty turns has one for each two degrees."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Samples ``first`` to ``last``, which is not one of them, of a motion of so many ``samples``."""

    samples: int
    first: int
    last: int

    @property
    def lead(self) -> NDArray[np.int64]:
        """Numbers of the samples of the lead, the first of the motion first; none at the start."""
        return np.unique(np.linspace(0, self.first, LEAD, endpoint=False).astype(np.int64))[: self.first]

    @property
    def places(self) -> NDArray[np.int64]:
        """Numbers of all samples to be worked out, the lead before the stretch."""
        return np.concatenate([self.lead, np.arange(self.first, self.last)])

    def cut(self, motion: Motion) -> Motion:
        """A motion over :attr:`places` without its lead."""
        lead = self.lead.size
        return replace(
            motion,
            channels={
                name: replace(channel, values=channel.values[lead:])
                for name, channel in motion.channels.items()
            },
            poses={body: _after(lead, poses) for body, poses in motion.poses.items()},
            loads={
                name: load if load.share is None else replace(load, share=load.share[lead:])
                for name, load in motion.loads.items()
            },
        )


Samples = int | Stretch
"""How many samples of a motion, or which."""


def travelled(travel: float, samples: Samples, start: float = 0.0) -> Array:
    """Input angles (n,), rad, from ``start`` over ``travel``, both ends included.

    Those of a stretch are the same numbers, to the last bit, of its places.

    Raises
    ------
    DesignError
        Fewer than two samples.

    Examples
    --------
    >>> bool((travelled(6.3, Stretch(9, 0, 9), 0.1) == travelled(6.3, 9, 0.1)).all())
    True
    """
    stretch = samples if isinstance(samples, Stretch) else Stretch(samples, 0, samples)
    count, end = stretch.samples, start + travel
    if count < 2:
        raise DesignError(f"samples: {count} are too few for a motion; take at least 2")
    places = stretch.places
    angles: Array = np.asarray(places * ((end - start) / (count - 1)) + start, dtype=np.float64)
    angles[places == count - 1] = end
    return angles


def in_stretches(motion_of: Callable[[Samples], Motion], samples: int) -> Iterator[Motion]:
    """The motion of so many samples, a stretch after the other.

    Parameters
    ----------
    motion_of
        The motion of samples, or over the places of a stretch; one whose input goes by :func:`travelled`, and
        whose channels depend on the input alone, and on what came before it, takes either.
    samples
        Of the whole motion; up to :data:`TOGETHER` of them are one stretch, and that is the whole motion.

    Raises
    ------
    MechwrightError
        Whatever ``motion_of`` raises.
    """
    if samples <= TOGETHER:
        yield motion_of(samples)
        return
    for first in range(0, samples, TOGETHER):
        stretch = Stretch(samples, first, min(first + TOGETHER, samples))
        yield stretch.cut(motion_of(stretch))


def _after(lead: int, poses: Poses) -> Poses:
    rates = poses.rates
    return Poses(
        poses.position[lead:],
        poses.rotation[lead:],
        None if rates is None else Rates(rates.first[lead:], rates.second[lead:]),
    )

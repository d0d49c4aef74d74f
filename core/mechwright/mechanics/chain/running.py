"""How the inputs of all stages turn, from position to jerk, for any motion of the first one.

With y = g(x(φ)) the chain rule to the third order is :meth:`Turning.carried`, which every stage uses for its
own output; what follows here are senses and the angles at which stages are set to each other.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.parameters import kept
from mechwright.contracts.stretch import Samples, travelled
from mechwright.contracts.turning import Turning
from mechwright.mechanics.chain.links import Link, inputs_of, links_of, turns_of
from mechwright.mechanics.chain.params import ChainParams, Families

PEAK_SAMPLES = 2881
"""Of a turn of the chain's input, for greatest speeds and loads: an eighth of a degree."""


@dataclass(frozen=True, eq=False)
class Run:
    """A motion of a chain.

    Parameters
    ----------
    links
        The stages.
    time
        (n,) s.
    inputs
        Of each stage, by the angles of their ports.
    """

    links: tuple[Link, ...]
    time: Array
    inputs: tuple[Turning, ...]


def run_of(links: tuple[Link, ...], samples: Samples) -> Run:
    """One period of a chain, both ends included."""
    own = links[0].transmission
    sense = -1.0 if own.speed < 0 else 1.0
    angle = travelled(sense * math.tau * float(turns_of(links)), samples, own.start)
    return over(links, angle)


def over(links: tuple[Link, ...], angle: Array) -> Run:
    """The chain at angles (n,), rad, of its input, which begins there where it begins by itself."""
    own = links[0].transmission
    time, drive = own.at(np.concatenate(([own.start], angle)))
    inputs = tuple(
        Turning(one.theta[1:], one.omega[1:], one.alpha[1:], one.jerk[1:]) for one in inputs_of(links, drive)
    )
    return Run(links, time[1:] - time[0], inputs)


@kept
def finely(params: ChainParams, families: Families) -> Run:
    """One period, as finely as peaks are sought."""
    links = links_of(params, families)
    return run_of(links, math.ceil(float(turns_of(links)) * (PEAK_SAMPLES - 1)) + 1)

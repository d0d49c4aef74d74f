"""The points of a path as they are asked for: as numbers."""

import math

import numpy as np

from mechwright.mechanics.tracing.requirement import SENSES
from mechwright_four_bar.requirements import PathRequirement
from mechwright_four_bar.synthesis.paths.asked import Limits, PathProblem


def problem_of(wanted: PathRequirement) -> PathProblem:
    """The requirement in complex numbers and radians.

    A first point that comes again at the end closes the path.
    """
    targets = np.array([complex(x, y) for x, y in wanted.points])
    turns = None if wanted.crank_turns is None else np.radians(wanted.crank_turns)
    again = targets.size > 3 and targets[0] == targets[-1] and turns is None
    return PathProblem(
        targets[:-1] if again else targets,
        turns,
        SENSES[wanted.sense],
        wanted.closed or bool(again),
        math.radians(wanted.order_tolerance),
        Limits(
            wanted.shortest_link,
            wanted.longest_link,
            math.radians(wanted.least_transmission_angle),
            wanted.frame,
        ),
    )

"""How far a sampled path is from the programmed one, and whether that is what the control's look-ahead claims."""

from dataclasses import dataclass

import numpy as np
from planner_witness import Sampled

from mechwright_cam.controls.lookahead import Motion
from mechwright_cam.controls.reading import Kind, Run

AROUND = 3
"""A sample is compared with so many steps before and after the one of its line: lines change while moves overlap."""


@dataclass(frozen=True)
class Compared:
    """Samples in a cut, m of them.

    ``off`` (m,) distance from the path, mm; ``beyond`` (m,) by how much each is outside of the corridors of the moves
    around it, mm, negative inside; ``step`` (m,) the one of those moves.
    """

    off: np.ndarray
    beyond: np.ndarray
    step: np.ndarray


def compared(run: Run, motion: Motion, sampled: Sampled, below: float = -0.05) -> Compared:
    """The samples that move below the height ``below``, mm, against the moves of a run."""
    steps = np.flatnonzero(run.moving & np.isfinite(run.start).all(axis=1) & np.isfinite(run.end).all(axis=1))
    which = np.flatnonzero(sampled.moving & (sampled.at[:, 2] < below))
    at, line = sampled.at[which], _lines(sampled.line)[which]
    own = np.clip(np.searchsorted(run.line[steps], line), 0, len(steps) - 1)
    off, beyond = np.full((2, len(which)), np.inf)
    nearest = steps[own]
    of_line = np.searchsorted(run.line[steps], line, side="right") - own  # a cycle has many steps in a line
    for by in range(-AROUND, int(of_line.max(initial=0)) + AROUND):
        some = np.flatnonzero(by < of_line + AROUND)
        step = steps[np.clip(own[some] + by, 0, len(steps) - 1)]
        distance = _distance(run, step, at[some])
        off[some] = np.minimum(off[some], distance)
        past = distance - motion.off[step]
        better = past < beyond[some]
        nearest[some[better]] = step[better]
        beyond[some] = np.minimum(beyond[some], past)
    return Compared(off, beyond, nearest)


def _lines(line: np.ndarray) -> np.ndarray:
    """Lines (n,) with that of the sample before where the control shows none."""
    told = np.maximum.accumulate(np.where(line > 0, np.arange(len(line)), 0))
    return line[told]


def _distance(run: Run, step: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Distance (m,) of each place from its step, mm."""
    start, end = run.start[step], run.end[step]
    way = end - start
    share = ((at - start) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-12)
    foot = start + np.clip(share, 0, 1)[:, None] * way
    arc = run.kind[step] == Kind.ARC
    centre, radius, sweep = run.centre[step[arc]], run.radius[step[arc]], run.sweep[step[arc]]
    spoke, first = at[arc, :2] - centre, start[arc, :2] - centre
    angle = np.arctan2(spoke[:, 1], spoke[:, 0]) - np.arctan2(first[:, 1], first[:, 0])
    side = np.sign(sweep)
    ahead = np.mod(angle * side, 2 * np.pi)
    whole = np.abs(sweep)
    # Behind the end it is nearer to whichever end the rest of the turn is.
    ahead = np.where(ahead > whole, np.where(ahead - whole < 2 * np.pi - ahead, whole, 0.0), ahead)
    share = ahead / np.maximum(whole, 1e-12)
    turned = np.arctan2(first[:, 1], first[:, 0]) + side * ahead
    ends = np.hypot(*(end[arc, :2] - centre).T)
    length = radius + share * (ends - radius)
    foot[arc] = np.column_stack(
        (
            centre[:, 0] + length * np.cos(turned),
            centre[:, 1] + length * np.sin(turned),
            start[arc, 2] + share * way[arc, 2],
        )
    )
    return np.asarray(np.sqrt(((at - foot) ** 2).sum(axis=1)))


def times(run: Run, motion: Motion, sampled: Sampled) -> tuple[float, float]:
    """Moving time of the real machine and of the estimate, s, of all lines whose beginning the program states."""
    stated = np.isfinite(run.start[:, :2]).all(axis=1) & np.isfinite(run.end[:, :2]).all(axis=1)
    unstated = np.unique(run.line[(motion.seconds > 0) & ~stated])
    real = sampled.time_of_lines()
    guessed = ~np.isin(run.line, unstated)
    there = sum(real.get(line, 0.0) for line in unstated.tolist())
    return sampled.moving_time - there, float(motion.seconds[guessed].sum())

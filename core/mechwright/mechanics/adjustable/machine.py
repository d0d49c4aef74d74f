"""Planar machines that a search has found: in millimetres, what they keep, and what is said of them."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mechwright.contracts.finding import Finding
from mechwright.mechanics.adjustable.counts import Moves, exact_number
from mechwright.mechanics.adjustable.fit import senses
from mechwright.mechanics.adjustable.mechanism import Pins, Unknowns
from mechwright.mechanics.adjustable.requirement import PhasedPath
from mechwright.mechanics.adjustable.search import Path, search
from mechwright.mechanics.adjustable.space import PlaneSpace
from mechwright.mechanics.adjustable.task import Limits, Task
from mechwright.mechanics.tracing.descent import excess, settle, squares
from mechwright.mechanics.tracing.search import BROKEN, SETTLED
from mechwright.mechanics.tracing.stepped import Held, stepped

INSIDE = 0.002
"""Share by which limits are tightened in the search, where they are held by penalties: what it gives keeps
them strictly."""

MARGIN = math.radians(0.5)
"""The same of the transmission angle, which the search looks at in a few places."""

DIGITS = 9
"""Decimals of lengths and angles in design files: a hundredth of an atom, and no tail of a double to read."""

Rows = tuple[np.ndarray, np.ndarray]
"""Unknowns (1, k) and crank angles (1, n), rad."""

TINY = 1e-9
"""Distance, in sizes of the path, below which points are met: a millionth of what can be made."""


@dataclass(frozen=True)
class Machine:
    """One linkage with all its phases, mm.

    Parameters
    ----------
    pins
        Of all phases (phases,), in the pose of setting.
    theta
        Crank angles (n,) of the points from that pose, one array per phase, the pose itself first, rad.
    misses
        Distances (n,) of the points, one array per phase, mm.
    moves
        Which pivots are set.
    x
        Its unknowns (k,).
    """

    pins: Pins
    theta: tuple[np.ndarray, ...]
    misses: tuple[np.ndarray, ...]
    moves: Moves
    x: np.ndarray

    @property
    def rms(self) -> float:
        """Root mean square over all points, mm."""
        return float(np.sqrt(np.mean(np.concatenate(self.misses) ** 2)))

    @property
    def finite(self) -> bool:
        """Whether all points and pins are numbers."""
        return bool(np.isfinite(np.concatenate([*self.misses, np.abs(self.pins.c)])).all())

    @property
    def in_order(self) -> bool:
        """Whether each phase passes its points one after the other, within a turn of the crank."""
        return all(abs(one[-1]) < math.tau and (np.abs(np.diff(one)) > 0).all() for one in self.theta)

    @property
    def chords(self) -> list[float]:
        """Distances between the places of each pivot that is set, mm."""
        names = {"moving": ("a", "c"), "fixed": ("a0", "b0"), "both": ("a", "c", "a0", "b0")}[self.moves]
        upper = np.triu_indices(len(self.theta), 1)
        places = [getattr(self.pins, name) for name in names]
        return [float(apart) for at in places for apart in np.abs(at[:, None] - at[None, :])[upper]]

    def rounded(self, size: float) -> "Machine":
        """With what is rounding in a path of that size set to nothing, so that exact ones rank alike."""
        return replace(self, misses=tuple(np.where(one < TINY * size, 0.0, one) for one in self.misses))


def machines(
    wanted: PhasedPath, bars: int, moves: Moves, ratio: float, progress: Callable[[float], None]
) -> tuple[Task, float, list[Machine]]:
    """The task, the paths' size, mm, and what the search gives, the nearest first; several may be the same.

    ``ratio`` is that of a five-bar's gears, 0 for a four-bar.
    """
    points = [np.array([complex(x, y) for x, y in one]) for one in wanted.phases]
    whole = np.concatenate(points)
    size = float(np.abs(whole - whole.mean()).max())
    path = Path(tuple(one / size for one in points), 1.0)
    unknowns = Unknowns(PlaneSpace(complex(path.phases[0][0])), bars, moves, len(points), ratio)
    limits = Limits(
        math.radians(wanted.least_transmission_angle) + MARGIN,
        wanted.shortest_link * (1 + INSIDE) / size,
        wanted.longest_link * (1 - INSIDE) / size,
        wanted.full_turn,
        wanted.least_chord * (1 + INSIDE) / size,
    )
    found = search(path, unknowns, limits, wanted.starts, wanted.seed, progress)
    task = path.task(unknowns, limits)
    return task, size, [_machine(task, size, *row) for row in zip(found.x, found.theta, strict=True)]


def _machine(task: Task, size: float, x: np.ndarray, theta: np.ndarray) -> Machine:
    pins = task.unknowns.pins(x)
    off = np.linalg.norm(task.misses(x, theta), axis=-1) * size
    phases = range(task.unknowns.phases)
    return Machine(
        Pins(*(getattr(pins, name) * size for name in Pins.__slots__)),
        tuple(np.concatenate([[0.0], theta[task.phase == k]]) for k in phases),
        tuple(np.concatenate([[0.0], off[task.phase == k]]) for k in phases),
        task.unknowns.moves,
        x,
    )


def rounded(one: Machine, task: Task, size: float, step: float) -> Machine | None:
    """The machine with the lengths of all phases in multiples of ``step``, mm, all else fitted; or None.

    ``size`` is that of the paths, mm, in which the task counts.
    """

    def fitted(values: tuple[float, ...], before: Rows | None) -> tuple[Rows, float, np.ndarray] | None:
        x, theta = before or (one.x[None], angles)
        held = Held(task, tuple(value / size for value in values), 1.0)
        x, theta = settle(held, x, theta, senses(task, theta), SETTLED)
        if not excess(held, x, theta)[0] <= BROKEN:
            return None
        return (x, theta), float(squares(held, x, theta)[0]), _lengths(task, x) * size

    # The pose of setting itself is none of the task's points.
    angles = np.concatenate([theta[1:] for theta in one.theta])[None]
    exact = _lengths(task, one.x[None]) * size
    found = stepped(exact, (exact.size,), step, fitted)
    if found is None:
        return None
    values, (x, theta) = found
    return _machine(task, size, _with_lengths(task.unknowns, x[0], np.array(values) / size), theta[0])


def _lengths(task: Task, x: np.ndarray) -> np.ndarray:
    lengths: np.ndarray = task.dimensions(task.unknowns.pins(x))[0]
    return lengths


def _with_lengths(unknowns: Unknowns, x: np.ndarray, values: np.ndarray) -> np.ndarray:
    """The unknowns (k,) with these very lengths, which they have but for rounding."""
    x, links = x.copy(), unknowns.bars - 2
    x[:links] = np.log(values[:links])
    if values.size > links:
        near, far = x[links : links + 2], x[links + 2 : links + 4]
        x[links + 2 : links + 4] = near + (far - near) * values[links] / np.linalg.norm(far - near)
    return x


def count_note(wanted: PhasedPath, bars: int, moves: Moves) -> Finding:
    """How the number of points compares with what can be met exactly."""
    given = sum(len(points) for points in wanted.phases)
    most = exact_number(bars, moves, len(wanted.phases))
    free = most - given
    said = (
        f"{given} points in {len(wanted.phases)} phases, and {most} can be met exactly with these pivots set"
    )
    if free > 0:
        said += f": there is a family of linkages with {free} free parameters, of which a few are given"
    elif free < 0:
        said += f": {-free} too many, so they are met as nearly as can be"
    return Finding.note("path.count", said, float(given), "")


def missed(wanted: PhasedPath, residual: float, remedy: str) -> Finding:
    """A best machine that misses the points by more than the tolerance, mm."""
    return Finding.warning(
        "path.missed",
        "phases",
        f"the best machine found misses the points by {residual:.4g} mm in the mean, more than the tolerance "
        f"of {wanted.tolerance:g} mm",
        residual,
        wanted.tolerance,
        "mm",
        remedy,
    )


def refusal(found: list[Machine], reason: str) -> Finding:
    """No machine can be built; ``reason`` is the first that was met."""
    best = min((one.rms for one in found if math.isfinite(one.rms)), default=math.inf)
    said = reason or f"the nearest linkage misses the points by {best:.3g} mm and does not keep them"
    return Finding.error(
        "path.limits",
        "phases",
        f"within the limits no machine was found that can be built: {said}",
        remedy="ask for a smaller least_transmission_angle, least_chord or shortest_link, a larger "
        "longest_link, or more starts",
    )

"""Many four-bars at once: what forbids them, and their figures.

It covers what :func:`covered` says. There a layout always exists: with two ground plates the layers ground,
crank, coupler, follower, second ground hold every pin between neighbours, and the posts stand outside of all
that moves. Whether one plate is enough is asked for forces and for the masses of bodies and pins, which each
tells by itself.
"""

from collections.abc import Callable, Collection
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.mechanics.linkage import too_thin
from mechwright.mechanics.planar.course import counted_from
from mechwright.mechanics.planar.swing import LEAST_TRANSMISSION
from mechwright.tolerances import falls_short
from mechwright_four_bar.bounds import bears
from mechwright_four_bar.checks import LEAST_ROOM
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.many_masses import give_masses
from mechwright_four_bar.parts.sizes import OF_BORE
from mechwright_four_bar.parts.usual import bore_about, with_sizes
from mechwright_four_bar.period import Period, give_extremes
from mechwright_four_bar.swings import courses, toggles, transmission

_APART = {"phases", "phase", "setting_angle", "coupler_bend", "frame"}
"""What is not varied here."""

_TOGGLE = 1e-2
"""Transmission angle, rad, below which rounding tells in the rates: those linkages are asked one by one."""


def covered(designs: Designs) -> bool:
    """Whether these are plain four-bars whose frame may have two plates."""
    one = designs.common
    plain = not one.phases and one.coupler_bend == 0
    return plain and one.frame != "one" and not _APART & set(designs.varied)


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    designs = with_sizes(designs)
    found = Answer(len(designs))
    sizes: list[Any] = [designs.full(name) for name in ("crank", "coupler", "follower", "ground")]
    sizes += [np.radians(designs.full("ground_angle")), np.where(designs.full("branch") == "open", 1, -1)]
    bar = FourBar(*sizes)
    course = courses(found, designs, bar)
    least, greatest = transmission(bar, course)
    if stage is not Stage.MOTION:
        _parts(found, designs, bar, course, least)
        give_masses(found, columns, designs)
    found.doubt(least < _TOGGLE)
    _figures(found, columns, bar, course, least, greatest)
    give_extremes(found, columns, designs, bar, course)
    return found


def _parts(found: Answer, designs: Designs, bar: FourBar, course: Period, least: Array) -> None:
    """Errors of the parts, in the order of the check."""
    short = np.asarray(bar.crank_room) < LEAST_ROOM * np.asarray(bar.longest)
    found.forbid("four-bar.change-point", short & ~course.rocks)
    found.forbid("four-bar.transmission", _short(np.degrees(least), LEAST_TRANSMISSION))
    pin, rim, turning = (
        designs["pin_diameter"],
        designs["rim"],
        bore_about(*(designs[name] for name in OF_BORE)),
    )
    found.forbid("four-bar.bushing-wall", too_thin(designs["bushing_wall"], designs["running_fit"]))
    crowded = (
        _short(bar.crank, pin + rim) | _short(bar.coupler, turning + rim) | _short(bar.follower, pin + rim)
    )
    if designs.common.coupler_point is not None:
        x, y = designs["coupler_point_x"], designs["coupler_point_y"]
        for from_a in (x, x - bar.coupler):
            crowded |= _short(np.hypot(from_a, y), (turning + pin) / 2 + rim)
    found.forbid("four-bar.bores", crowded)
    if designs.common.frame == "auto":  # with one plate the follower turns about B0, in a wider bore
        found.doubt(_short(bar.follower, (turning + pin) / 2 + rim))
    left = found.left
    found.doubt(~bears(designs.some(left), *_some(bar, course, left), least[left]), left)


def _some(bar: FourBar, course: Period, places: NDArray[np.intp]) -> tuple[FourBar, Period]:
    fields: list[Any] = [
        np.broadcast_to(one, course.rocks.shape)[places]
        for one in (*bar.lengths, bar.ground_angle, bar.branch)
    ]
    return FourBar(*fields), course.some(places)


def _short(value: Any, limit: Any) -> NDArray[np.bool_]:
    return np.asarray(falls_short(value, limit))


def _figures(
    found: Answer, columns: Collection[str], bar: FourBar, course: Period, least: Array, greatest: Array
) -> None:
    """The figures that need no samples."""
    asked = set(columns)
    simple: dict[str, Callable[[], Array]] = {
        "least_transmission_angle": lambda: np.degrees(least),
        "greatest_transmission_angle": lambda: np.degrees(greatest),
        "grashof_excess": lambda: np.asarray(bar.grashof_excess),
        "time.least": lambda: np.zeros(found.size),
        "time.greatest": lambda: course.time,
    }
    for name in asked & simple.keys():
        found.give(name, simple[name]())
    if asked & {"swing", "time_ratio", "limit_extended", "limit_folded"}:
        limits, cranks = bar.folding(), _crank_rocker(bar) & ~course.rocks
        counted = partial(counted_from, course.start, course.travel)
        for name, value in (
            ("swing", np.degrees(limits.swing)),
            ("time_ratio", limits.time_ratio),
            ("limit_extended", np.degrees(counted(limits.extended + bar.ground_angle))),
            ("limit_folded", np.degrees(counted(limits.folded + bar.ground_angle))),
        ):
            if name in asked:
                found.give(name, np.where(cranks, value, np.nan))
    ends = np.sort(np.stack([course.start, course.start + course.travel]), axis=0)
    toggle = toggles(bar, course)
    lever = {
        "swing_from": ends[0],
        "swing_to": ends[1],
        "input_range": ends[1] - ends[0],
        "toggle_low": toggle[0],
        "toggle_high": toggle[1],
    }
    for name in asked & lever.keys():
        found.give(name, np.where(course.rocks, np.degrees(lever[name]), np.nan))


def _crank_rocker(bar: FourBar) -> NDArray[np.bool_]:
    """Which of them are crank-rockers, as :attr:`FourBar.kind` has it: the crank alone is shortest."""
    a, *others = bar.lengths
    return np.asarray(
        bar.closes & (bar.grashof_excess > 0) & (a < np.minimum.reduce(others)) & ~np.asarray(bar.lines_up)
    )

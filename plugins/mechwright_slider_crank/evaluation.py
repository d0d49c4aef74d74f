"""Many slider-cranks at once: what forbids them, and their figures.

It covers what :func:`covered` says. Forces are left to the motion of each.
"""

import math
from collections.abc import Callable, Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.tolerances import falls_short
from mechwright_slider_crank import period_kernels as kernels
from mechwright_slider_crank.bounds import bears
from mechwright_slider_crank.checks import TURN_MARGIN
from mechwright_slider_crank.limit_motion import LIMIT
from mechwright_slider_crank.many import Cranks
from mechwright_slider_crank.masses import give_masses
from mechwright_slider_crank.rooms import Rooms, forbid_layers
from mechwright_slider_crank.sizes import LEAST_WEB, Sizes, filled_in

_APART = {"swing_from", "swing_to", "crank_shape", "coupler_bore", "rod_width", "rod_bend", "screw_hole"}
"""What is not varied here."""

_LEAST_BASE = 5.0
"""mm. A base that is narrower may have no room for its rounded corners."""

_CHANNELS = {
    "s": kernels.S, "v": kernels.V, "a": kernels.A, "jerk": kernels.JERK, "sigma": kernels.SIGMA,
    "omega_c": kernels.OMEGA_C, "alpha_c": kernels.ALPHA_C, "jerk_c": kernels.JERK_C,
    "omega_a": kernels.OMEGA_A, "alpha_a": kernels.ALPHA_A, "jerk_a": kernels.JERK_A,
    "transmission_angle": kernels.COSINE,
    "xP": kernels.X, "yP": kernels.Y, "vxP": kernels.VX, "vyP": kernels.VY,
    "axP": kernels.AX, "ayP": kernels.AY, "jxP": kernels.JX, "jyP": kernels.JY,
}  # fmt: skip
_PEAKS = {"v_max": 0, "a_max": 1}
_CIRCLE = kernels.circle_of(2 * kernels.GRID + 1)


def covered(designs: Designs) -> bool:
    """Whether these have a disc and a straight rod, and turn or swing as far as they can."""
    one = designs.common
    plain = one.swing_from is None and one.crank_shape == "disc" and one.coupler_bore == 0
    plain = plain and one.rod_width is None and one.rod_bend == 0 and one.screw_hole is None
    return plain and not _APART & set(designs.varied)


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    found = Answer(len(designs))
    many = moved(found, designs)
    if stage is not Stage.MOTION:
        give_masses(found, columns, designs, many, _parts(found, designs, many))
    _figures(found, columns, many)
    _extremes(found, columns, designs, many)
    return found


def moved(found: Answer, designs: Designs) -> Cranks:
    """Errors of the motion, and how the cranks go."""
    a, c, e = (designs.full(name) for name in ("crank", "rod", "offset"))
    direction = np.radians(designs.full("slide_direction"))
    branch = np.where(designs.full("assembly") == "ahead", 1.0, -1.0)
    sense = np.where(designs.full("clockwise"), -1.0, 1.0)
    turns, ratio = c > a + np.abs(e), designs.full("acceleration_ratio")
    found.doubt(np.abs(c - a - np.abs(e)) <= LIMIT * c)
    most = c * math.cos(TURN_BACK)
    low, high = (e - most) / a, (e + most) / a
    found.forbid("slider-crank.closure", ~turns & ((low >= 1) | (high <= -1)))
    found.doubt(~turns & (low <= -1) & (high >= 1))
    found.forbid("slider-crank.acceleration", ~turns & (ratio != 0))
    first, last = np.arcsin(np.clip(low, -1, 1)), np.arcsin(np.clip(high, -1, 1))
    begin = np.where(low <= -1, -math.pi - last, first) + direction
    end = np.where((low > -1) & (high >= 1), math.pi - first, last) + direction
    start, stop = np.where(sense > 0, begin, end), np.where(sense > 0, end, begin)
    return Cranks(
        np.stack([a, c, e, direction, branch], axis=1),
        np.stack(
            [
                np.where(turns, 0.0, start),
                np.where(turns, sense * math.tau, stop - start),
                ~turns,
                ratio,
                designs.full("speed") * math.tau / 60,
            ],
            axis=1,
        ),
    )


def _parts(found: Answer, designs: Designs, many: Cranks) -> Rooms:
    """Errors of the parts, in the order of the check, and the rooms between their plates."""
    a, c, e = many.bars[:, 0], many.bars[:, 1], many.bars[:, 2]
    limit = (a + np.abs(e)) * (1 + TURN_MARGIN)
    found.forbid("slider-crank.crank-turn", _short(c, limit) & ~many.rocks)
    sizes = filled_in(designs.__getitem__)
    for code, web in (
        ("slider-crank.crank-web", a - (sizes.shaft + sizes.pin) / 2),
        ("slider-crank.rod-web", c - sizes.rod_bore),
        ("slider-crank.slider-web", (sizes.slider_width - sizes.pin) / 2),
        ("slider-crank.slider-web", (sizes.slider_length - sizes.pin) / 2),
        ("slider-crank.rail-web", (sizes.rail - sizes.dowel) / 2),
    ):
        found.forbid(code, _short(web, LEAST_WEB))
    found.doubt(_base(sizes) < _LEAST_BASE)
    rooms = forbid_layers(found, designs, many, sizes)
    left = found.left
    found.doubt(~bears(designs.some(left), many.some(left), filled_in(designs.some(left).__getitem__)), left)
    return rooms


def _base(sizes: Sizes) -> Any:
    """Least width of the base, mm: about the shaft's bore."""
    return sizes.base_bore + 2 * sizes.wall


def _short(value: Any, limit: Any) -> NDArray[np.bool_]:
    return np.asarray(falls_short(value, limit))


def _figures(found: Answer, columns: Collection[str], many: Cranks) -> None:
    """The figures that need no samples of the motion."""
    a, c, e, direction = many.bars[:, :4].T
    figures: dict[str, Callable[[], Array]] = {
        "stroke": lambda: np.abs(many.ends.far_position - many.ends.near_position),
        "time_ratio": lambda: np.asarray(many.ends.time_ratio),
        "phi_far": lambda: np.degrees(many.ends.far),
        "phi_near": lambda: np.degrees(many.ends.near),
        "s_far": lambda: np.asarray(many.ends.far_position),
        "s_near": lambda: np.asarray(many.ends.near_position),
        "least_transmission_angle": lambda: np.degrees(many.least),
        "time.least": lambda: np.zeros(len(many)),
        "time.greatest": lambda: many.time,
    }
    swung = np.sort(np.stack([many.drives[:, 0], many.drives[:, 0] + many.drives[:, 1]]), axis=0)
    low, high = (e - c) / a, (e + c) / a
    first, last = np.arcsin(np.clip(low, -1, 1)), np.arcsin(np.clip(high, -1, 1))
    levers = {
        "swing_from": swung[0],
        "swing_to": swung[1],
        "input_range": swung[1] - swung[0],
        "toggle_low": np.where(low <= -1, -math.pi - last, first) + direction,
        "toggle_high": np.where((low > -1) & (high >= 1), math.pi - first, last) + direction,
    }
    for name in columns:
        if name in figures:
            found.give(name, figures[name]())
        elif name in levers:
            found.give(name, np.where(many.rocks, np.degrees(levers[name]), np.nan))


def _extremes(found: Answer, columns: Collection[str], designs: Designs, many: Cranks) -> None:
    """Extremes of channels, and peaks, of the designs that are open."""
    left = found.left
    bars, drives = many.bars[left], many.drives[left]
    for name in set(columns) & _PEAKS.keys():
        found.give(name, kernels.peaks(bars, drives, _CIRCLE, _PEAKS[name]), left)
    asked = [(name, *name.rpartition(".")[::2]) for name in columns]
    asked = [(name, channel, end) for name, channel, end in asked if channel in _CHANNELS]
    if not asked:
        return
    wanted = sorted({_CHANNELS[channel] for _, channel, _ in asked})
    x = designs["coupler_x"]
    point = (many.bars[:, 1] / 2 if x is None else designs.full("coupler_x"), designs.full("coupler_y"))
    told = kernels.extremes(
        bars,
        drives,
        np.stack(point, axis=1).astype(float)[left],
        SAMPLES,
        np.array(wanted, dtype=np.int64),
        any(_CHANNELS[channel] >= kernels.X for _, channel, _ in asked),
    )
    varies = many.rocks[left] | (drives[:, 3] != 0)
    for name, channel, end in asked:
        row = _CHANNELS[channel]
        value = told[:, wanted.index(row), int((end == "greatest") != (row == kernels.COSINE))]
        if row == kernels.COSINE:
            value = np.arccos(np.minimum(1.0, value))
        if row in {kernels.COSINE, kernels.SIGMA}:
            value = np.degrees(value)
        if row in {kernels.ALPHA_A, kernels.JERK_A}:
            value = np.where(varies, value, np.nan)
        found.give(name, value, left)

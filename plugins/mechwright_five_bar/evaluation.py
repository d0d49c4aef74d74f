"""Many five-bars at once: what forbids them, and their figures.

It covers those of one phase whose gears stand in line, as :func:`covered` says, and of them the cranks that
turn on and on; levers are looked at one by one.
"""

import math
from collections.abc import Callable, Collection
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.linkage import too_thin
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, ROOT_SAFETY
from mechwright.tolerances import falls_short
from mechwright_five_bar import period_kernels as kernels
from mechwright_five_bar.bounds import Bars, Gears, stands, teeth_bear
from mechwright_five_bar.limits import USUAL_FACE
from mechwright_five_bar.many_masses import give_masses
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.reach import PER_TURN
from mechwright_five_bar.usual import with_sizes

_APART = {
    "crank_teeth", "arm_teeth", "idler_teeth", "module", "swing_from", "swing_to", "setting_angle", "phases",
    "phase",
}  # fmt: skip
"""What is not varied here."""

_EDGE = 1e-9
"""Share of D² within which rounding could decide whether a linkage closes: it is asked by itself."""

_CHANNELS = {
    "omega_c": kernels.OMEGA_C, "alpha_c": kernels.ALPHA_C, "jerk_c": kernels.JERK_C,
    "omega_r": kernels.OMEGA_R, "alpha_r": kernels.ALPHA_R, "jerk_r": kernels.JERK_R,
    "transmission_angle": kernels.COSINE,
    "xP": kernels.X, "yP": kernels.Y, "vxP": kernels.VX, "vyP": kernels.VY,
    "axP": kernels.AX, "ayP": kernels.AY, "jxP": kernels.JX, "jyP": kernels.JY,
}  # fmt: skip
_PEAKS = {"omega_c_max": kernels.OMEGA_C, "alpha_c_max": kernels.ALPHA_C}
_OF_POINT = set(range(kernels.X, kernels.JY + 1))
_THIRD = {kernels.JERK_C, kernels.JERK_R, kernels.JX, kernels.JY}
_FEW = 3
"""Rows up to which one after the other is faster than a table of all."""


def covered(designs: Designs) -> bool:
    """Whether these are five-bars of one phase, with gears of one module that stand in line."""
    one: FiveBarParams = designs.common
    plain = one.swing_from is None and one.setting_angle is None and not one.phases and one.module is None
    return plain and not _APART & set(designs.varied)


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    designs = with_sizes(designs)
    follows = "gear_thickness" not in {*designs.varied, *designs.common.model_fields_set}
    if follows:
        # It is the usual one where teeth surely last with that; the others are left undecided.
        usual = np.full(len(designs), USUAL_FACE)
        designs = Designs(designs.common, {**designs.varied, "gear_thickness": usual})
    found, bars = Answer(len(designs)), Bars.of(designs)
    least, greatest = _motion(found, bars)
    sense = np.where(designs.full("direction") == "ccw", 1.0, -1.0)
    omega = sense * designs.full("speed") * math.tau / 60
    if stage is not Stage.MOTION:
        share = REVERSING_ROOT if follows else ROOT_SAFETY
        bore = _parts(found, designs, bars, np.sin(least), omega, share)
        give_masses(found, columns, designs, bore)
    simple: dict[str, Callable[[], Array]] = {
        "least_transmission_angle": lambda: np.degrees(least),
        "greatest_transmission_angle": lambda: np.degrees(greatest),
        "ratio": lambda: np.full(found.size, bars.ratio),
        "turns": lambda: np.full(found.size, float(bars.turns)),
        "omega_a.least": lambda: omega,
        "omega_a.greatest": lambda: omega,
        "time.least": lambda: np.zeros(found.size),
        "time.greatest": lambda: math.tau * bars.turns / np.abs(omega),
    }
    for name in simple.keys() & set(columns):
        found.give(name, simple[name]())
    _extremes(found, columns, designs, bars, omega)
    return found


def _motion(found: Answer, bars: Bars) -> tuple[Array, Array]:
    """Errors of the motion; least and greatest transmission angle (n,), rad, of cranks that turn fully."""
    count = math.ceil(PER_TURN * bars.turns * max(1.0, abs(bars.ratio))) + 1
    theta, table = _table(bars.ratio, bars.turns, count)
    near, far = kernels.distances(bars.rows, bars.ratio, theta, table).T
    c, l = bars.coupler, bars.rocker
    less = 4 * c * l * math.sin(TURN_BACK / 2) ** 2
    inner, outer = (c - l) ** 2 + less, (c + l) ** 2 - less
    slack = _EDGE * outer
    found.doubt((np.abs(near - inner) < slack) | (np.abs(far - outer) < slack))
    found.doubt((np.abs(near - outer) < slack) | (np.abs(far - inner) < slack))
    found.forbid("five-bar.closure", (near > outer) | (far < inner))
    found.doubt((near < inner) | (far > outer))  # a lever
    cosines = [(c * c + l * l - square) / (2 * c * l) for square in (near, far)]
    angles = [np.arccos(np.minimum(1.0, np.abs(value))) for value in cosines]
    through = cosines[0] * cosines[1] <= 0
    return np.minimum(*angles), np.where(through, math.pi / 2, np.maximum(*angles))


@lru_cache(8)
def _table(ratio: float, turns: int, samples: int) -> tuple[Array, Array]:
    """Angles (m,), rad, of the crank over a period, and what the kernels want of them (4, m)."""
    theta = np.linspace(0.0, math.tau * turns, samples)
    arm = ratio * theta
    return theta, np.ascontiguousarray([np.cos(theta), np.sin(theta), np.cos(arm), np.sin(arm)])


def _parts(found: Answer, designs: Designs, bars: Bars, sine: Array, omega: Array, share: float) -> Any:
    """Errors of the parts, in the order of the check, and the diameter of what a pin turns in, mm.

    ``share`` is how much of what the roots of teeth are allowed may be used without a doubt.
    """
    pin, rim, wall = designs["pin_diameter"], designs["rim"], np.asarray(designs["bushing_wall"])
    found.forbid("five-bar.bushing-wall", too_thin(wall, designs["running_fit"]))
    bore = pin + np.where(wall > 0, 2 * wall, designs["running_fit"])
    crowded = _short(bars.crank, pin + rim) | _short(bars.arm, pin + rim)
    crowded |= _short(bars.rocker, (bore + pin) / 2 + rim)
    x, y = designs["coupler_point_x"], designs["coupler_point_y"]
    crowded |= _short(bars.coupler - bore, rim)
    for along in (x, x - bars.coupler):
        crowded |= _short(np.hypot(along, y) - (bore + pin) / 2, rim)
    found.forbid("five-bar.bores", crowded)
    gears = Gears.of(designs)
    found.doubt(~stands(designs, bars, gears, bore, sine))
    found.doubt(~teeth_bear(designs, bars, gears, bore, sine, omega, share))
    return bore


def _short(value: Any, limit: Any) -> NDArray[np.bool_]:
    return np.asarray(falls_short(value, limit))


def _extremes(found: Answer, columns: Collection[str], designs: Designs, bars: Bars, omega: Array) -> None:
    """Extremes of channels, and peaks, of the designs that are open."""
    sampled = {name: _CHANNELS.get(name.rpartition(".")[0], -1) for name in columns}
    peaks = {name: _PEAKS[name] for name in columns if name in _PEAKS}
    left = found.left
    of = bars.rows[left], bars.ratio, omega[left], _points(designs)[left]
    for asked, samples in ((sampled, SAMPLES), (peaks, math.ceil(PEAK_SAMPLES * bars.turns))):
        rows = sorted(set(asked.values()) - {-1})
        told = _told(rows, of, _table(bars.ratio, bars.turns, samples)[1]) if rows and left.size else {}
        for name, row in asked.items():
            if row not in told:
                continue
            least, greatest = told[row].T
            if row == kernels.COSINE:
                least, greatest = (np.degrees(np.arccos(np.minimum(1.0, one))) for one in (greatest, least))
            if name in _PEAKS:
                found.give(name, np.maximum(np.abs(least), np.abs(greatest)), left)
            else:
                found.give(name, greatest if name.endswith(".greatest") else least, left)


def _told(rows: list[int], of: tuple[Array, float, Array, Array], table: Array) -> dict[int, Array]:
    """Least and greatest value (n, 2) of each row: one after the other, or where that is slower together."""
    if set(rows) <= set(kernels.PARTS) and len(rows) <= _FEW:
        return {row: kernels.quick(*of, table, row) for row in rows}
    wanted = np.array(rows, dtype=np.int64)
    deep, traced = bool(_THIRD & set(rows)), bool(_OF_POINT & set(rows))
    return dict(zip(rows, np.moveaxis(kernels.extremes(*of, table, wanted, deep, traced), 1, 0), strict=True))


def _points(designs: Designs) -> Array:
    parts = [designs.full(name) for name in ("coupler_point_x", "coupler_point_y", "pivot_x", "pivot_y")]
    return np.stack(parts, axis=1).astype(float)

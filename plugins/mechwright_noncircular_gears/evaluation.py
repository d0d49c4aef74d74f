"""The motion of many pairs at once: what forbids it, and its figures.

The laws are those of one pair, with columns (n, 1) for numbers. Laws by lists and formulas, rings and
sectors, and all that is asked of teeth, are left to the check of each.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.mechanics.gearing import RatioLaw, Rolling
from mechwright.mechanics.peaks import greatest
from mechwright_noncircular_gears.law import LEAST_RATIO
from mechwright_noncircular_gears.laws.pitch import EllipseLaw, LimaconLaw
from mechwright_noncircular_gears.laws.window import WindowLaw

GRID = 129
"""Samples of half a lobe, or of a blend, at which peaks are sought."""

LAWS = ("window", "ellipse", "limacon")
"""Laws whose formulas take columns."""


def covered(designs: Designs) -> bool:
    """Whether the law is one by numbers, and the pair are two gears that go all the way round."""
    one = designs.common
    numbers = all(values.dtype.kind in "if" for values in designs.varied.values())
    lobes = {"lobes", "mate_lobes"} & set(designs.varied)
    return numbers and not lobes and one.law in LAWS and not one.internal and one.sector is None


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    found, pairs = Answer(len(designs)), Pairs(designs)
    if isinstance(pairs.law, WindowLaw):
        found.forbid("law.window", pairs.each(pairs.law.width + 2 * pairs.law.blend) >= pairs.law.period)
    least = LEAST_RATIO * designs.common.lobes / designs.common.mate_lobes
    found.forbid("law.turns-back", ~(pairs.ends.min(axis=0) > least))
    if stage is not Stage.MOTION:
        found.doubt(np.ones(len(designs), dtype=bool))
        return found
    left = found.left
    some = Pairs(designs.some(left))
    for name in columns:
        value = some.figure(name) if left.size else None
        if value is not None:
            found.doubt(~value[1], left)
            found.give(name, value[0], left)
    return found


@dataclass(frozen=True)
class Pairs:
    """Pairs of one kind of law."""

    designs: Designs

    def value(self, name: str, factor: float = 1.0) -> Any:
        """A field of the law, (n, 1) where it is varied."""
        if name in self.designs.varied:
            return factor * np.asarray(self.designs.varied[name], dtype=float)[:, None]
        return factor * self.designs.common.value(name)

    def each(self, values: Any) -> Array:
        """(n,) of what is (n, 1) or one number."""
        return np.broadcast_to(np.asarray(values, dtype=float).reshape(-1), len(self.designs))

    @cached_property
    def law(self) -> RatioLaw:
        """The law of all of them."""
        one = self.designs.common
        lobes = one.lobes, one.mate_lobes
        if one.law == "window":
            width, blend = (self.value(name, math.radians(1)) for name in ("window", "blend"))
            return WindowLaw(lobes, self.value("window_ratio"), width, blend)
        law = EllipseLaw if one.law == "ellipse" else LimaconLaw
        return law(lobes, self.value("eccentricity"))

    @property
    def ends(self) -> Array:
        """Ratios (2, n) between which all are: in a window and beyond it, or at the ends of half a lobe."""
        if isinstance(self.law, WindowLaw):
            return np.stack([self.each(self.law.ratio), self.each(self.law.beyond)])
        half = np.array([[0.0, self.law.period / 2]])
        return np.broadcast_to(self.law.rates(half)[0], (len(self.designs), 2)).T

    def figure(self, name: str) -> tuple[Array, NDArray[np.bool_]] | None:
        """A column (n,), and where it is one for sure; None where each pair has to tell it."""
        omega = self.each(self.designs["speed"]) * math.tau / 60
        sure = np.ones(len(self.designs), dtype=bool)
        if (
            name == "centre_distance"
            and self.designs.common.module is None
            and "module" not in self.designs.varied
        ):
            return self.each(self.designs["centre_distance"]), sure
        ends = {"ratio_max": lambda: self.ends.max(axis=0), "ratio_min": lambda: self.ends.min(axis=0),
                "omega2_max": lambda: self.ends.max(axis=0) * omega}  # fmt: skip
        if name in ends:
            return ends[name](), sure
        if name in {"alpha2_max", "jerk2_max"}:
            order = 1 if name == "alpha2_max" else 2
            value, sure = self._greatest(lambda law, phi: np.abs(law.rates(phi)[order]))
            return value * omega ** (order + 1), sure
        if name == "pressure_angle_max":
            value, sure = self._greatest(lambda law, phi: np.abs(Rolling.of(law, phi).tilt))
            return np.degrees(value) + self.each(self.designs["pressure_angle"]), sure
        return None

    def _greatest(self, measure: Any) -> tuple[Array, NDArray[np.bool_]]:
        """Over a blend, or over half a lobe: laws are mirror images of themselves in both of its ends."""

        def asked(which: NDArray[np.intp], share: Array) -> Array:
            some = Pairs(self.designs.some(which))
            law = some.law
            begin, way = 0.0, law.period / 2
            if isinstance(law, WindowLaw):
                begin, way = law.width / 2, law.blend
            phi = np.broadcast_to(begin + way * share, (which.size, share.shape[1]))
            return np.asarray(measure(law, phi))

        return greatest(asked, len(self.designs), 0.0, 1.0, GRID)

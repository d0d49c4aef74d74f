"""The cranks of many slider-cranks, and the ends of their sliders' ways."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.planar.course import counted_from
from mechwright_slider_crank.figures import Limits

_LEVER_SAMPLES = 1441
"""Positions among which the ends of a lever's way are sought: as many as for one."""


@dataclass(frozen=True)
class Cranks:
    """Linkages and drives, (n, 5) each as :mod:`mechwright_slider_crank.period_kernels` has them.

    A crank can be put together all along its way.
    """

    bars: Array
    drives: Array

    def __len__(self) -> int:
        return len(self.bars)

    def some(self, places: NDArray[Any]) -> "Cranks":
        """Those at these places."""
        found = Cranks(self.bars[places], self.drives[places])
        if "ends" in self.__dict__:
            one = self.ends
            parts: list[Any] = [np.asarray(getattr(one, name))[places] for name in Limits.__slots__]
            found.__dict__["ends"] = Limits(*parts)
        return found

    @property
    def rocks(self) -> NDArray[np.bool_]:
        """Which of them (n,) are levers."""
        return np.asarray(self.drives[:, 2] > 0)

    @property
    def time(self) -> Array:
        """How long a period takes (n,), s."""
        _, travel, _, k, speed = self.drives.T
        spent = np.where(k == 0, travel, -np.expm1(-k * travel) / np.where(k == 0, 1.0, k))
        return np.asarray(np.where(self.rocks, math.tau, np.abs(spent)) / speed)

    @cached_property
    def least(self) -> Array:
        """The least transmission angle (n,), rad."""
        a, c, e, direction, _ = self.bars.T
        turned = np.arccos(np.minimum(1.0, (a + np.abs(e)) / c))
        begin = self.drives[:, 0] - direction
        low, high = np.sort(np.stack([begin, begin + self.drives[:, 1]]), axis=0)
        # Beside its ends, with the crank across the slide.
        up, down = (np.ceil((low - x) / math.tau) * math.tau + x <= high for x in (math.pi / 2, -math.pi / 2))
        off = [np.abs(e - a * np.sin(x)) for x in (low, high)]
        off += [np.where(up, np.abs(e - a), 0.0), np.where(down, np.abs(e + a), 0.0)]
        swung = np.arccos(np.minimum(1.0, np.maximum.reduce(off) / c))
        return np.asarray(np.where(self.rocks, swung, turned))

    @cached_property
    def ends(self) -> Limits:
        """Ends of the slider's way, arrays (n,); angles as the channel ``phi``."""
        a, c, e, direction, branch = self.bars.T
        start, travel = self.drives.T[:2]
        with np.errstate(invalid="ignore", divide="ignore"):
            stretched = np.arcsin(e / (a + c))
            folded = math.pi + np.where(e != 0, np.arcsin(np.clip(e / (c - a), -1, 1)), 0.0)
        far, near = (np.sqrt(np.maximum((c + pin) ** 2 - e * e, 0.0)) for pin in (a, -a))
        inward, behind = (folded - stretched) % math.tau, branch < 0
        stretched, folded = (np.where(behind, math.pi - one, one) for one in (stretched, folded))
        far, near = np.where(behind, -far, far), np.where(behind, -near, near)
        inward = np.where(behind, math.tau - inward, inward)
        longer = np.maximum(inward, math.tau - inward)
        found = [
            *(counted_from(start, travel, one + direction) for one in (stretched, folded)),
            far,
            near,
            longer / np.minimum(inward, math.tau - inward),
        ]
        if (levers := np.flatnonzero(self.rocks)).size:
            for row, value in zip(found, _swept(self.some(levers)), strict=False):
                row[levers] = value
            found[-1][levers] = 1.0
        values: list[Any] = [*found, math.tau - inward > inward]
        return Limits(*values)


def _swept(many: Cranks) -> tuple[Array, Array, Array, Array]:
    """Crank angles and places of levers (n,) at the ends of their sliders' ways, from samples."""
    a, c, e, direction, branch = many.bars.T[:, :, None]
    start, travel = many.drives.T[:2, :, None]
    phi = start + travel / 2 * (1 - np.cos(np.linspace(0.0, math.tau, _LEVER_SAMPLES)))
    t = e - a * np.sin(phi - direction)
    s = a * np.cos(phi - direction) + branch * np.sqrt(c * c - t * t)
    each = np.arange(len(many))
    least, most = np.argmin(s, axis=1), np.argmax(s, axis=1)
    out = np.abs(s[each, least]) >= np.abs(s[each, most])
    far, near = np.where(out, least, most), np.where(out, most, least)
    return phi[each, far], phi[each, near], s[each, far], s[each, near]

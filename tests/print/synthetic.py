"""Printers with known errors, and what a calliper reads on their coupons."""

from dataclasses import dataclass

import numpy as np

from mechwright_print.coupon.features import GAPS, ROWS


@dataclass(frozen=True)
class SyntheticPrinter:
    """A printer by its true deviations, mm, and growths of lengths."""

    scale_x: float
    scale_y: float
    hole: float
    slot: float
    pin: float
    wall: float
    foot: float

    def size(self, kind: str, axis: str, nominal: float) -> float:
        """What is printed for a nominal size, mm."""
        scale = {"x": self.scale_x, "y": self.scale_y, "round": (self.scale_x + self.scale_y) / 2}[axis]
        off = {"length": self.wall, "bed": self.wall + 2 * self.foot}.get(kind)
        return scale * nominal + (getattr(self, kind) if off is None else off)

    def sizes(self, rng: np.random.Generator, noise: float) -> dict[str, float]:
        """The coupon as measured, mm."""
        return {
            row.name: self.size(row.kind, row.axis, row.nominal) + noise * float(rng.standard_normal())
            for row in ROWS
        }

    def trials(self, turning: float) -> dict[float, str]:
        """What the gauge pin does that turns from a clearance on each side on, mm."""
        words = {}
        for gap in GAPS:
            side = gap + (self.hole - self.pin) / 2
            words[gap] = (
                "turns"
                if side >= turning
                else "slides"
                if side >= turning / 2
                else "pushed"
                if side >= 0
                else "stuck"
            )
        return words


def drawn(seed: int) -> SyntheticPrinter:
    """A printer at random, within what printers are."""
    rng = np.random.default_rng(seed)
    return SyntheticPrinter(
        1 + rng.uniform(-0.004, 0.004),
        1 + rng.uniform(-0.004, 0.004),
        rng.uniform(-0.5, 0.05),
        rng.uniform(-0.3, 0.1),
        rng.uniform(-0.1, 0.25),
        rng.uniform(-0.1, 0.25),
        rng.uniform(0.0, 0.2),
    )

"""Shim rings that take up axial play: DIN 988."""

from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.shape import Shape, ring
from mechwright.standards.table import table

STANDARD = "DIN 988"
"""Of shim rings."""

THICKNESSES = (0.1, 0.15, 0.2, 0.3, 0.5, 1.0)
"""In which they are sold, mm."""

INNER_RING = 0.3
"""Outside of a bearing's inner ring: its bore, and this share of the way to its outside; handbook."""


@dataclass(frozen=True)
class Shim:
    """A ring of DIN 988: inner and outer diameter, mm."""

    inner: float
    outer: float

    @property
    def designation(self) -> str:
        """How it is ordered, without its thickness."""
        return f"{STANDARD} - {self.inner:g} x {self.outer:g}"

    def part_name(self, thickness: float) -> str:
        """Of the part that stands for the rings of a stack, drawn with this thickness, mm.

        >>> Shim(12, 18).part_name(0.2)
        'shim-12x18x0_2'
        """
        return f"shim-{self.inner:g}x{self.outer:g}x{thickness:g}".replace(".", "_")

    def bought(self, thickness: float, note: str = "", *, on_shaft: bool = True) -> Bought:
        """How a ring of this thickness, mm, is ordered; it stands on z = 0, on a shaft or in a bore."""
        words = f"{self.designation} x {thickness:g}"
        shape = Shape((ring(self.inner, self.outer, thickness),))
        fit = hole_fit(self.inner, "D12") if on_shaft else shaft_fit(self.outer, "d12")
        return Bought(words, STANDARD, None, shape, note, fits=(fit,))


def shims() -> tuple[Shim, ...]:
    """All of them, by inner diameter."""
    return table("shims").of(Shim)


def shim_on(shaft: float, room: float, over: float = 0.0) -> Shim | None:
    """The ring on a shaft, at most ``room`` outside and more than ``over``, mm; None where none is sold.

    >>> shim_on(12, 30).outer, shim_on(12, 16), shim_on(11.5, 30)
    (18, None, None)
    """
    found = [one for one in shims() if one.inner == shaft and over < one.outer <= room]
    return found[0] if found else None


def shim_behind(bore: float, outside: float) -> Shim | None:
    """The ring on the outer ring of a bearing of this bore and outside, mm; None where none is sold.

    It fills the seat, and stays clear of the inner ring.

    >>> shim_behind(10, 26).inner, shim_behind(10, 23)
    (19, None)
    """
    free = bore + INNER_RING * (outside - bore)
    found = [one for one in shims() if one.outer == outside and one.inner > free]
    return found[-1] if found else None

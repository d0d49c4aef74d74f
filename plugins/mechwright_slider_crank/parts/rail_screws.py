"""Screws that hold the rails on the base of a machine, from below: dowels place a rail and do not hold it.

A design without holes for the screws of legs is a model, and its dowels are bonded.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from mechwright import DesignError, Instance, Outline, Part
from mechwright.contracts.holes import threaded
from mechwright.contracts.part import Bore
from mechwright.mechanics.linkage import PIN_MATERIAL, Boss, bushing_part
from mechwright.mechanics.linkage.outlines import bores
from mechwright.standards.dowels import dowel_for
from mechwright.standards.parts import GREY
from mechwright.standards.screws import Screw, lengths, screw
from mechwright_slider_crank.parts.dimensions import Dimensions

SIZES = (6.0, 5.0, 4.0, 3.0)
"""Threads that are tried, mm, the largest first."""

SHARE = 0.5
"""Greatest thread over a rail's width: a quarter of the width is left on either side."""

INWARDS = 2.0
"""From a dowel to the screw beside it, in widths of the rail."""

PER_RAIL = 2
"""Screws of a rail."""

ENGAGED = 1.0
"""Least length of thread in a rail, in diameters: the torque is what that bears."""

BELOW = 0.5
"""How far screws and dowels end below the face of a rail, mm, at least: a screw is ±0.35 mm long, and the rod
passes over them."""

NAMES = tuple(f"rail-screw-{number}" for number in range(1, 2 * PER_RAIL + 1))
"""Bodies of the screws."""


@dataclass(frozen=True)
class RailScrews:
    """The screw of a rail and its places along the rail from the rail's middle, mm."""

    screw: Screw
    places: tuple[float, float]

    @property
    def core(self) -> float:
        """Diameter of the hole before it is threaded, mm."""
        size = self.screw.of
        return round(size.size - 1.0825 * size.pitch, 6)

    @property
    def rail_holes(self) -> tuple[Boss, ...]:
        """Those of a rail, in its own coordinates."""
        return tuple(Boss(complex(x), 0, self.core, "rail-screw") for x in self.places)

    def base_holes(self, rails: tuple[complex, complex]) -> tuple[Boss, ...]:
        """Those of the base, for both rails."""
        clear = self.screw.of.clearance()
        return tuple(Boss(rail + x, 0, clear, "rail-screw") for rail in rails for x in self.places)

    def threaded(self, rail: Part) -> Part:
        """A rail with its threads, all through."""
        for hole in rail.features:
            if isinstance(hole, Bore) and hole.diameter == self.core:
                rail = threaded(rail, hole.name, f"M{self.screw.of.size:g}")
        return rail

    def parts(self, base: float, under: float, over: float, material: str) -> Iterator[Part]:
        """The screws, and spacers around them where the rails stand high.

        Their heads lie at the height ``base``. The rails lie at ``over``, and the base's upper face is at
        ``under``, mm.
        """
        bought = self.screw.bought
        assert bought.shape is not None  # noqa: S101 - the table's screws have one
        upwards = replace(bought, shape=bought.shape.turned_over())
        at = tuple(Instance(name, base) for name in NAMES)
        yield Part("rail-screw", None, 0.0, PIN_MATERIAL, at, GREY, bought=upwards)
        if over > under:
            clear, high = self.screw.of.clearance(), over - under
            spacers = tuple(Instance(name, under) for name in NAMES)
            yield bushing_part("rail-spacer", clear, self.screw.of.head, high, spacers, material)


def rail_screws(sizes: Dimensions, dowel: float, grip: float, thickness: float) -> RailScrews | None:
    """The screws of a rail; None where none that is sold fits.

    Parameters
    ----------
    dowel
        From the rail's middle to its dowels, mm.
    grip, thickness
        What a screw goes through under the rail, and the thickness of the rail, mm.
    """
    inset = INWARDS * sizes.rail
    place = dowel - inset if dowel > 2 * inset else dowel / 2
    for size in SIZES:
        if size > SHARE * sizes.rail or place - size < sizes.dowel:
            continue
        least, most = grip + ENGAGED * size, grip + thickness - BELOW
        fitting = [one for one in lengths(size) if least <= one <= most]
        if fitting:
            return RailScrews(screw(size, fitting[-1]), (-place, place))
    return None


def dowel_span(diameter: float, room: float, thickness: float) -> tuple[float, float]:
    """Where a dowel of the longest length that is sold begins in a base of a thickness, and its length, mm.

    ``room`` is what base, spacer and rail measure together. It ends ``BELOW`` the rail's face at least.

    >>> dowel_span(3.0, 12.0, 6.0), dowel_span(3.0, 18.6, 6.0)
    ((1.5, 10), (0.1, 18))
    """
    try:
        long: float = dowel_for(diameter, room - BELOW).length
    except DesignError:
        long = round(room - BELOW, 6)
    return min(round(room - BELOW - long, 6), thickness / DEEP), long


DEEP = 4.0
"""A dowel begins so deep in the base at most, as a share of its thickness."""


def with_holes(outline: Outline, holes: tuple[Boss, ...]) -> Outline:
    """An outline with more round holes."""
    return Outline(outline.outer, (*outline.inner, *bores(holes)), outline.deviation)

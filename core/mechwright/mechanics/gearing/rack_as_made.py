"""A rack and its pinion as made: the pinion's play with the rack in its place, over the travel."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.as_made import AsMade
from mechwright.contracts.made_part import MadePart
from mechwright.mechanics.gearing.backlash import LEFT
from mechwright.mechanics.gearing.cut import ring_of
from mechwright.mechanics.gearing.made import Contacts
from mechwright.mechanics.gearing.mesh import Mesh
from mechwright.mechanics.gearing.rack import Rack
from mechwright.mechanics.gearing.rack_mesh import RackRun
from mechwright.mechanics.gearing.running import (
    DEEP,
    MadeMesh,
    about_bore,
    plain,
    play_curve,
    running_figures,
    running_findings,
)

NAMES = ("rack", "gear-1")
"""Bodies: the rack stands where it is, and the pinion turns from flank to flank."""


@dataclass(frozen=True)
class RackMesh:
    """A rack and its pinion as designed.

    Parameters
    ----------
    run
        How the rack goes past the pinion.
    rack
        The cutter of both, mm, with the backlash of the design.
    crossings
        Where flanks of the rack cross the pitch line (z, 2), mm along the rack.
    paths
        From the pitch point to the tips of pinion and of rack along the line of action, mm.
    way
        Places (n,), mm, of the rack that are looked at.
    back
        Depth of the back below the reference line, mm.
    """

    run: RackRun
    rack: Rack
    crossings: Array
    paths: tuple[float, float]
    way: Array
    back: float


@dataclass(frozen=True)
class MadeRack(MadeMesh):
    """A rack and its pinion as made; parameters are those of :class:`MadeMesh`."""

    design: RackMesh
    outlines: tuple[Array, Array]
    corridor: float
    least: tuple[float, str]
    names: tuple[str, str] = NAMES
    free: bool = True
    span: str = "the travel"
    play_rule: str = "2 (g + v sin α) / (r cos α)"

    @property
    def rack(self) -> Rack:
        """The cutter."""
        return self.design.rack

    @cached_property
    def contacts(self) -> Contacts:
        """Where the exact flanks touch."""
        one = self.design
        return one.run.contacts(one.crossings, one.way, one.paths, one.rack.backlash)

    @cached_property
    def mesh(self) -> Mesh:
        """The two polygons run against each other."""
        rack, pinion = map(plain, self.outlines)
        return self.design.run.mesh(rack, pinion, self.design.way, DEEP)

    def apart(self, off: float) -> tuple[float, float]:
        """The pinion stands above the rack."""
        return 0.0, off

    @property
    def places(self) -> tuple[str, Array]:
        """Of the rack, from the middle of its travel."""
        return "travel, mm", self.design.way

    def place(self, position: int) -> str:
        """Of the rack."""
        return f"{self.design.way[position]:.1f} mm of the rack from the middle of its travel"


def about_back(part: MadePart, back: float) -> Array:
    """The outside of a rack as made (n, 2), mm, counter-clockwise, above the middle of its back as made."""
    points = ring_of(part.outline.polygon())
    on_back = points[np.abs(points[:, 1] + back) < 2 * LEFT]
    off = float(np.median(on_back[:, 1])) + back if len(on_back) else 0.0
    return np.asarray(points - np.array([0.0, off]))


def rack_as_made(
    made: Mapping[str, Sequence[MadePart]], bore: float, design: RackMesh, least: tuple[float, str]
) -> AsMade:
    """Judge a rack and its pinion: part name to its copies as made.

    Parameters
    ----------
    bore
        Diameter of the pinion's bore, mm.
    design
        The rack and its pinion as designed.
    least
        Backlash, mm, with which they run, and the rule by which it is found.
    """
    copies = [made.get(name, ()) for name in NAMES]
    if not all(copies):
        return AsMade()
    rack, pinion = (copy[0] for copy in copies)
    outlines = about_back(rack, design.back), about_bore(pinion, bore)
    run = MadeRack(design, outlines, rack.corridor + pinion.corridor, least)
    return AsMade(tuple(running_figures(run)), (play_curve(run),), tuple(running_findings(run)))

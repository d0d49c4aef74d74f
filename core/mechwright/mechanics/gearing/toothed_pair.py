"""A pair of toothed bodies, or a table of pairs: what the rules of teeth take, whatever the pitch curves are.

Heights and radii of the cutter are in modules, its pressure angle in degrees; backlashes are in mm. Columns
are those of :mod:`mechwright.contracts.design_table`.
"""

from abc import abstractmethod
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, TypeVar

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.design_table import DesignTable, number
from mechwright.contracts.finding import Change
from mechwright.contracts.keyed import Keyed
from mechwright.contracts.parameters import Parameters
from mechwright.geometry.keyway import Opening
from mechwright.mechanics.gearing.backlash import PLANNED, pair_backlash
from mechwright.mechanics.gearing.checks import Profile, least_tip
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.gearing.rack import Rack
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.mechanics.openings import opening_of
from mechwright.tolerances import falls_short

P = TypeVar("P", bound=Parameters)


@dataclass(frozen=True)
class Rim:
    """What stays between the shaft opening of a gear and its nearest root; numbers or columns.

    Parameters
    ----------
    thickness
        Modules.
    root
        Radius of the nearest root, mm.
    blamed
        Key of the design file that makes it thin.
    """

    thickness: Any
    root: Any
    blamed: str = "bore"

    @classmethod
    def of(cls, table: Keyed, module: float, room: Callable[[Array], float], bare: str) -> "Rim":
        """The rim of one gear.

        Parameters
        ----------
        table
            The dimensions of the opening.
        module
            Of the teeth, mm.
        room
            Least distance, mm, of points (n, 2) from the root curve; below 0 beyond it.
        bare
            Key to blame for a gear without a bore.
        """
        opening = opening_of(table)
        root = room(np.zeros((1, 2)))
        rim = plain = root - table.bore / 2
        blamed = "bore" if opening else bare
        if opening and opening.has_keyway:
            rim = min(plain, room(opening.loop().flatten()))
            if falls_short(rim, plain):
                sharp = room(replace(opening, relief=0.0).loop().flatten())
                blamed = "keyway_relief" if opening.relief and rim < sharp else "keyway_depth"
        return cls(rim / module, root, blamed)


class ToothedPair(DesignTable[P]):
    """Two gears of one cutter: numbers of one pair, columns (n, 1) of a table.

    A family derives its table from it. Rules that are asked of tables take no more than ``profile``,
    ``half_land``, ``tip_width``, ``rim`` and the backlashes.
    """

    larger: ClassVar[str] = "module"
    """Keys that make teeth larger, in words."""
    roomier: ClassVar[str] = "use more teeth"
    """What gives a gear room for a bore."""

    @property
    @abstractmethod
    def profile(self) -> Profile:
        """The cutter, in modules and degrees."""

    @property
    @abstractmethod
    def rack(self) -> Rack:
        """The cutter of the driver, mm."""

    @property
    def upright(self) -> Any:
        """Cosine of the greatest slope ν of the pitch curves: 1 of circles."""
        return 1.0

    @property
    def backlash(self) -> Any:
        """Of the design, or the least with which gears as made turn, mm."""
        return self.least_backlash if self.profile.backlash is None else self.profile.backlash

    @property
    def least_backlash(self) -> Any:
        """With which gears as made turn, mm."""
        return number(pair_backlash(self.upright, np.radians(self.profile.pressure_angle)))

    @property
    def jamming_backlash(self) -> Any:
        """Below which walls as they are planned jam at the exact centre distance, mm."""
        return number(pair_backlash(self.upright, np.radians(self.profile.pressure_angle), PLANNED, 0.0))

    @abstractmethod
    def teeth_with(self, backlash: float) -> Sequence[Teeth]:
        """The teeth of one pair with another backlash."""

    @property
    @abstractmethod
    def rim(self) -> Rim:
        """The thinnest of both gears."""

    @abstractmethod
    def proof(self) -> MeshProof:
        """The mesh proof of one pair."""

    def clearing(self) -> Iterable[Change]:
        """Changes that may end a collision of one pair; they are tried."""
        return ()

    @property
    def half_land(self) -> Any:
        """Half the flat end of a tooth of the cutter, mm; below 0 if its tip arcs overlap."""
        return self.rack.half_land

    @property
    def tip_width(self) -> Any:
        """Width of the thinnest tip, modules; GeometryError if flanks do not reach their tip."""
        return least_tip(self.teeth_with(self.backlash))

    @property
    def opening(self) -> Opening | None:
        """The shaft opening of both gears of one pair."""
        table: Any = self.params
        return opening_of(table)

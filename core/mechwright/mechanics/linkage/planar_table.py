"""A linkage of plates, or a table of linkages of one topology, and its motion over a period of the input.

A family says which links and joints its parameters make, how the input goes, and what loads the links; the
rooms beside this module find motion, forces, plates, masses, tolerances and strength of it.
"""

import contextlib
import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Self, TypeVar

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.design_table import DesignTable, Rows, rows_of
from mechwright.contracts.parameters import Parameters, kept
from mechwright.errors import GeometryError, KinematicsError
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.mass import Mass
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.masses import masses_of
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.planar.assembly_order import Group, assembly_order
from mechwright.mechanics.planar.course import Ways
from mechwright.mechanics.planar.efforts import PointLoad
from mechwright.mechanics.planar.machine import Machine, Prismatic
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright.mechanics.planar.springs import AnySpring

if TYPE_CHECKING:
    from mechwright.mechanics.planar.compiled_chain import CompiledChain

P = TypeVar("P", bound=Parameters)
T = TypeVar("T", bound="PlanarTable[Any]")


class PlanarTable(DesignTable[P]):
    """One linkage, or linkages that differ in their dimensions; numbers of one, columns (n, 1) of many."""

    code: ClassVar[str]
    """First word of the codes of findings."""

    unloading: ClassVar[Mapping[str, Any]] = {}
    """Parameters that plates do not depend on, each with one value: what is kept of the plates serves all."""

    dead_sine: ClassVar[float] = 0.02
    """Sine of the transmission angle of a dyad below which a first order says nothing: at a sine s a dead
    point is s²/2 of a link's length away, with 0.02 as little as the tolerances."""

    @classmethod
    def of(cls, params: P, size: int | None = None) -> Self:
        """The linkage of a design, kept with all that is computed of it; or a table of ``size`` designs."""
        found: Self = _of_one(cls, params) if size is None else cls(params, size)  # type: ignore[arg-type]
        return found

    def rows(self, places: Rows) -> Self:
        """Some of the linkages; of what was computed of all, arrays that are attributes go along."""
        if self.single:
            return self
        taken = type(self)(rows_of(self.given, places, self.size), places.size)
        arrays = {name: one for name, one in self.__dict__.items() if isinstance(one, np.ndarray)}
        taken.__dict__.update({name: rows_of(one, places, self.size) for name, one in arrays.items()})
        return taken

    @property
    @abstractmethod
    def linkage(self) -> Linkage:
        """Links and joints; raises KinematicsError where they make no machine."""

    @property
    @abstractmethod
    def requested(self) -> tuple[float, float] | None:
        """The ends that a design states for its input: rad, or mm of a driver that slides; None for none."""

    @property
    def closed_ways(self) -> Ways | None:
        """How the inputs go, where the family has closed forms; None for inputs whose ends are sought."""
        return None

    @property
    def tolerance_names(self) -> Mapping[str, str]:
        """Names of contributors and outputs of the tolerance analysis to those that the family gives them."""
        return {}

    @abstractmethod
    def laid_out(self) -> Layout:
        """Plates and layers; raises GeometryError or KinematicsError where there are none."""

    @property
    def key(self) -> str:
        """The parameter that a finding about all dimensions names."""
        return ""

    @property
    def loads(self) -> Sequence[PointLoad]:
        """What loads the links from outside."""
        return ()

    @property
    def springs(self) -> Sequence[AnySpring]:
        """Springs between links."""
        return ()

    @property
    def gravity(self) -> complex:
        """The acceleration of free fall, x + i y, mm/s²."""
        return 0j

    @property
    def pole_pairs(self) -> Sequence[tuple[str, str]]:
        """The pairs of links whose poles of acceleration are wanted."""
        return ()

    @property
    def sizes(self) -> Sizes:
        """The sizes that a design states."""
        names = [name for name in Sizes.__dataclass_fields__ if hasattr(self.params, name)]
        return Sizes(**{name: getattr(self.params, name) for name in names})

    @property
    def sense(self) -> float:
        """+1 of an input that goes counter-clockwise or forwards, -1 of another."""
        return 1.0 if self.given.direction == "ccw" else -1.0  # type: ignore[attr-defined]

    @property
    def omega(self) -> float:
        """Speed of the driver, rad/s, or that of the crank that moves a lever to and fro once a turn."""
        speed: float = self.given.speed * math.tau / 60  # type: ignore[attr-defined]
        return speed

    @property
    def machine(self) -> Machine:
        """Its links and joints."""
        return self.linkage.machine

    @property
    def output(self) -> str:
        """The link that the linkage is for."""
        return self.linkage.output

    @property
    def driver(self) -> tuple[str, str]:
        """The link that the first drive moves, and the link against which it moves."""
        drive = self.machine.drives[0]
        return drive.link, drive.on

    @cached_property
    def order(self) -> tuple[Group, ...]:
        """The groups of the machine; raises KinematicsError where it cannot be put together."""
        return assembly_order(self.machine)

    @cached_property
    def chain(self) -> "CompiledChain | None":
        """The machine of a table, compiled; None of one linkage, and of links that only ``solved`` moves."""
        from mechwright.mechanics.planar.compiled_chain import CompiledChain

        with contextlib.suppress(NotImplementedError):
            return None if self.single else CompiledChain(self.machine, self.order)
        return None

    @property
    def driver_slides(self) -> bool:
        """Whether the input is a slide."""
        return isinstance(self.machine.driven_joint(self.machine.drives[0]), Prismatic)

    @property
    def drawn_at(self) -> float:
        """The input in the drawn position: rad, or mm of a driver that slides."""
        return float(np.ravel(self.machine.drawn_at[0])[0]) if self.machine.drawn_at else 0.0

    @property
    def may_turn(self) -> bool:
        """Whether the design leaves it to the dimensions that the driver turns all the way."""
        return not self.driver_slides and self.requested is None

    def solved(self, drive: Turning) -> Solution:
        """The motion for a motion of the input."""
        return solve(self.machine, [drive], self.order)

    def solved_at(self, at: Array, order: int = 3) -> Solution:
        """The motion per unit of the input, with rates up to an order."""
        return solve(self.machine, [Turning.of(at, 1.0)], self.order, rates=order)

    @property
    def unloaded(self) -> Self:
        """The same plates without loads and at one speed."""
        return self.of(self.given.model_copy(update=dict(self.unloading)))

    @property
    def layout(self) -> Layout:
        """Plates and layers; raises GeometryError where there are none."""
        found = self._layout
        if isinstance(found, str):
            raise GeometryError(found)
        return found

    @property
    def layout_or_none(self) -> Layout | None:
        """The same; None where there are none."""
        found = self._layout
        return None if isinstance(found, str) else found

    @property
    def _layout(self) -> Layout | str:
        """The layout, or why there is none, which is asked for as often."""
        return self.unloaded._laid_out_once

    @cached_property
    def _laid_out_once(self) -> Layout | str:
        try:
            return self.laid_out()
        except (GeometryError, KinematicsError) as error:
            return str(error)

    @property
    def masses(self) -> Mapping[str, Mass]:
        """The masses of all moving links from their parts; raises as :attr:`layout`."""
        return self.unloaded.once("masses", lambda: masses_of(self.layout))

    @property
    def masses_or_none(self) -> Mapping[str, Mass] | None:
        """The same; None where there are no parts."""
        return None if self.layout_or_none is None else self.masses


@kept
def _of_one(kind: type[T], params: Any) -> T:
    return kind(params)


AnyPlanarTable = PlanarTable[Any]
"""A linkage of any family."""

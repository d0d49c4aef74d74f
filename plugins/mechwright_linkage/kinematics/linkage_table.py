"""A linkage, or a table of linkages of one topology, and its motion over a period of the input."""

import math
from functools import cached_property

import numpy as np

from mechwright import Array, kept
from mechwright.contracts.design_table import DesignTable, Rows, rows_of
from mechwright.mechanics.planar.assembly_order import Group, assembly_order
from mechwright.mechanics.planar.machine import Drive, Machine, Prismatic
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright_linkage.linkage import Linkage
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.sketch import drawn_linkage, refuse_coincident

APART = 0.01
"""mm. Points of a link that are drawn nearer than this are one point."""


class LinkageTable(DesignTable[LinkageParams]):
    """One linkage, or linkages that differ in their dimensions; numbers of one, columns (n, 1) of many."""

    def rows(self, places: Rows) -> "LinkageTable":
        """Some of the linkages; what was computed of all is computed anew."""
        return self if self.single else LinkageTable(rows_of(self.given, places, self.size), places.size)

    @cached_property
    def linkage(self) -> Linkage:
        """Links and joints; raises KinematicsError where they make no machine."""
        params = self.given
        if params.linkage != "drawn":
            return params.entry.linkage()
        points = {name: params.scale * one.place for name, one in params.points.items()}
        refuse_coincident(points, params.links, APART)
        drive = Drive(*params.driver_links)
        return drawn_linkage(points, params.links, params.slides, params.gears, drive, params.output_link)

    @property
    def machine(self) -> Machine:
        """Its links and joints."""
        return self.linkage.machine

    @cached_property
    def order(self) -> tuple[Group, ...]:
        """The groups of the machine; raises KinematicsError where it cannot be put together."""
        return assembly_order(self.machine)

    @property
    def driver_slides(self) -> bool:
        """Whether the input is a slide."""
        return isinstance(self.machine.driven_joint(self.machine.drives[0]), Prismatic)

    @property
    def drawn_at(self) -> float:
        """The input in the drawn position: rad, or mm of a driver that slides."""
        return float(np.ravel(self.machine.drawn_at[0])[0])

    @property
    def omega(self) -> float:
        """Speed of the driver, rad/s, or that of the crank that moves a lever to and fro once a turn."""
        speed: float = self.given.speed * math.tau / 60
        return speed

    def solved(self, drive: Turning) -> Solution:
        """The motion for a motion of the input."""
        return solve(self.machine, [drive], self.order)

    def solved_at(self, at: Array, order: int = 3) -> Solution:
        """The motion per unit of the input, with rates up to an order."""
        return solve(self.machine, [Turning.of(at, 1.0)], self.order, rates=order)

    @property
    def may_turn(self) -> bool:
        """Whether the design leaves it to the dimensions that the driver turns all the way."""
        return not self.driver_slides and self.given.swing_from is None


def table_of(params: LinkageParams, size: int | None = None) -> LinkageTable:
    """The linkage of a design, kept with all that is computed of it; or a table of ``size`` designs."""
    return _of_one(params) if size is None else LinkageTable(params, size)


@kept
def _of_one(params: LinkageParams) -> LinkageTable:
    return LinkageTable(params)

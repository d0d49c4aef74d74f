"""The linkage of a design of the family, or those of a table of designs."""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.planar_table import PlanarTable
from mechwright.mechanics.planar.efforts import PointLoad
from mechwright.mechanics.planar.machine import Drive
from mechwright.mechanics.planar.springs import AnySpring, Spring
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.sketch.sketch import drawn_linkage, refuse_coincident

MILLI = 1e-3
APART = 0.01
"""mm. Points of a link that are drawn nearer than this are one point."""


class LinkageTable(PlanarTable[LinkageParams]):
    """A linkage of the catalogue, or one that is drawn."""

    code = "linkage"
    unloading: ClassVar[Mapping[str, Any]] = {
        "loads": (),
        "springs": (),
        "gravity_x": 0.0,
        "gravity_y": 0.0,
        "speed": 60.0,
        "pairs": (),
    }

    @cached_property
    def linkage(self) -> Linkage:
        """Links and joints; raises KinematicsError where they make no machine."""
        params = self.given
        if params.linkage != "drawn":
            return params.entry.linkage(params.output_link)
        points = {name: params.scale * one.place for name, one in params.points.items()}
        refuse_coincident(points, params.links, APART)
        drive = Drive(*params.driver_links)
        return drawn_linkage(points, params.links, params.slides, params.gears, drive, params.output_link)

    @property
    def requested(self) -> tuple[float, float] | None:
        """The ends that a design states for its input: rad, or mm of a driver that slides; None for none."""
        given = self.given
        if self.driver_slides:
            ends = (given.stroke_from, given.stroke_to)
            return None if ends[0] is None or ends[1] is None else (ends[0], ends[1])
        if given.swing_from is None or given.swing_to is None:
            return None
        return math.radians(given.swing_from), math.radians(given.swing_to)

    def laid_out(self) -> Layout:
        """Plates and layers; raises GeometryError or KinematicsError where there are none."""
        from mechwright.mechanics.linkage.parts.plates import plates_of

        return plates_of(self)

    @property
    def key(self) -> str:
        """The table with the dimensions."""
        return self.given.table_name

    @property
    def loads(self) -> Sequence[PointLoad]:
        """Those of the design."""
        found = []
        for load in self.given.loads:
            points = self.linkage.points[load.link]
            place = points[load.point or next(iter(points))]
            found.append(PointLoad(load.link, place, load.force_x + 1j * load.force_y, load.torque / MILLI))
        return found

    @property
    def springs(self) -> Sequence[AnySpring]:
        """Those of the design."""
        points = self.linkage.points
        return [
            Spring(
                one.link,
                one.on,
                points[one.link][one.point],
                points[one.on][one.on_point],
                one.rate,
                one.free_length,
            )
            for one in self.given.springs
        ]

    @property
    def gravity(self) -> complex:
        """The acceleration of free fall, mm/s²."""
        return complex(self.given.gravity_x, self.given.gravity_y) / MILLI

    @property
    def pole_pairs(self) -> Sequence[tuple[str, str]]:
        """The pairs of links whose poles of acceleration are wanted."""
        return self.given.pole_pairs

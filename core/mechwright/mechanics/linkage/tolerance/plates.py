"""What of a linkage is in which plate, as far as errors depend on it: axes, slides, holders of pins.

Glossary
--------
feature
    A pin's bore or the line of a slide in a link.
datum
    The feature from which the others of a link are measured: its first bore, or else its first slide.
"""

import cmath
from dataclasses import dataclass, replace
from functools import cached_property

from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import Axis, axes_of, number
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import GearPair, Machine, Prismatic


@dataclass(frozen=True)
class Plates:
    """The features of a design.

    Parameters
    ----------
    table
        The design.
    layout
        Its plates; None where there are none, as with gears. Each link then counts as one plate.
    linkage
        Links, joints and points, with places of the ground in the frame of the motion or in that of its
        plates.
    """

    table: AnyPlanarTable
    layout: Layout | None
    linkage: Linkage

    @classmethod
    def of(cls, table: AnyPlanarTable, *, drawn: bool = False) -> "Plates":
        """Those of a design, as the links move, or as the plates are ``drawn``."""
        layout = table.layout_or_none
        return cls(table, layout, table.linkage if layout is None or not drawn else layout.linkage)

    @property
    def sizes(self) -> Sizes:
        """Of plates, pins and slots."""
        found: Sizes = self.table.sizes
        return found

    @property
    def machine(self) -> Machine:
        """Links and joints."""
        return self.linkage.machine

    @cached_property
    def axes(self) -> tuple[Axis, ...]:
        """All axes."""
        joints = tuple(one for one in self.machine.joints if not isinstance(one, GearPair))
        return axes_of(replace(self.linkage, machine=replace(self.machine, joints=joints)))

    @cached_property
    def rollers(self) -> dict[str, Prismatic]:
        """Blocks without a plate, each with its slide."""
        return {block: slide for axis in self.axes for block, slide in axis.rollers.items()}

    @property
    def slides(self) -> list[Prismatic]:
        """All slides."""
        return [one for one in self.machine.joints if isinstance(one, Prismatic)]

    @property
    def links(self) -> list[str]:
        """Links with plates, the ground last."""
        return [*(link for link in self.machine.links if link not in self.rollers), GROUND]

    def bores(self, link: str) -> list[Axis]:
        """The axes in a link."""
        return [axis for axis in self.axes if link in axis.places]

    def own_slides(self, link: str) -> list[Prismatic]:
        """The slides of a link with a plate."""
        return [one for one in self.slides if link in one.links]

    def along(self, link: str) -> complex:
        """Unit vector in a link, along which its features are measured: from the first bore to the second."""
        bores, slides = self.bores(link), self.own_slides(link)
        if len(bores) > 1:
            way = bores[1].places[link] - bores[0].places[link]
            return way / abs(way)
        return cmath.rect(1.0, number(slides[0].direction(link)).real) if slides else 1 + 0j

    def datum(self, link: str) -> complex:
        """Place of the datum of a link, mm; the origin of a link without features."""
        bores, slides = self.bores(link), self.own_slides(link)
        if bores:
            return bores[0].places[link]
        return number(slides[0].place(link)) if slides else 0j

    def measured(self, link: str) -> list[Prismatic]:
        """The slides of a link whose lines are measured: all but one that is the datum."""
        slides = self.own_slides(link)
        return slides if self.bores(link) else slides[1:]

    def plate(self, link: str, eye: str) -> str:
        """The first plate of a link that has an eye."""
        return link if self.layout is None else self.layout.scheme.plates(link, eye)[0]

    def in_datum_plate(self, link: str, eye: str) -> bool:
        """Whether an eye of the ground is in the plate of its datum; of other links, always."""
        if link != GROUND:
            return True
        bores, slides = self.bores(link), self.own_slides(link)
        first = bores[0].point if bores else slides[0].name
        return self.plate(link, eye) == self.plate(link, first)

    def holder(self, axis: Axis) -> str:
        """The link into which the pin of an axis is pressed."""
        if self.layout is not None:
            return next(pin.body for pin in self.layout.pins if pin.eye == axis.point and not pin.number)
        return axis.holder if axis.shaft or GROUND not in axis.places else GROUND

    def turning(self, axis: Axis) -> list[str]:
        """The links with plates that turn on the pin of an axis."""
        return [link for link in axis.places if link != self.holder(axis)]

    def two_force(self, link: str) -> bool:
        """Whether a link has two pins and nothing else that carries a force: it is pressed along itself."""
        machine = self.machine
        driven = {one for drive in machine.drives for one in drive.links}
        loaded = {load.link for load in self.table.loads}
        loaded |= {link for spring in self.table.springs for link in (spring.one, spring.two)}
        others = (one for one in machine.joints if isinstance(one, Prismatic | GearPair))
        pins = len(self.bores(link)) == 2 and not any(link in one.links for one in others)
        return pins and link not in {GROUND, self.linkage.output} | driven | loaded

    def traced(self, link: str, place: complex) -> list[str]:
        """Names of the traced points of a link at one place of it."""
        points = self.linkage.points
        return [
            name
            for name, (own, point) in self.linkage.traces.items()
            if own == link and abs(number(points[own][point]) - place) <= SAME_PLACE
        ]

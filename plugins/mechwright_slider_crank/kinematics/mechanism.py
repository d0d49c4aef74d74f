"""The linkage of a design, or those of a table of designs: its machine, its input and its sizes."""

from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from mechwright.contracts.design_table import DesignTable, Rows, number
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.planar_table import PlanarTable
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.parts.dimensions import Dimensions, dimensions_of


class Mechanism(PlanarTable[SliderCrankParams]):
    """One slider-crank, or a table of them, without its plates."""

    code = "slider-crank"
    dead_sine: ClassVar[float] = 1e-6

    def rows(self, places: Rows) -> Self:
        """Some of the linkages, with what was computed of them."""
        taken = DesignTable.rows(self, places)
        for name in ("closed", "order", "chain"):
            taken.__dict__.pop(name, None)
        return taken

    @cached_property
    def closed(self) -> SliderCrank:
        """What closed forms are asked of."""
        return self.given.linkage

    @property
    def linkage(self) -> Linkage:
        """Crank, rod and slider; the rod's point P is traced."""
        machine, point = self.closed.machine, self.given.coupler_point
        return Linkage(machine, {"rod": {"P": point}}, "slider", {"P": ("rod", "P")})

    @property
    def requested(self) -> tuple[float, float] | None:
        """The ends of the swing that a design states, rad; None for none."""
        given = self.given
        if given.swing_from is None or given.swing_to is None:
            return None
        return number(np.radians(given.swing_from)), number(np.radians(given.swing_to))

    @property
    def drawn_at(self) -> float:
        """Crank angles count from the slide's direction, rad."""
        return float(self.closed.direction)

    @property
    def sense(self) -> float:
        """-1 of a crank that turns clockwise, +1 of another."""
        return -1.0 if self.given.clockwise else 1.0

    @cached_property
    def dimensions(self) -> Dimensions:
        """All sizes; what a design leaves open follows from the others."""
        return dimensions_of(self.given)

    @property
    def unloaded(self) -> Self:
        """The same plates at one load and speed; a pin that is left out may be thicker for the load."""
        plain = self.given.model_copy(update={"load": 0.0, "speed": 60.0})
        if dimensions_of(plain).pin != self.dimensions.pin:
            plain = plain.model_copy(update={"pin": self.dimensions.pin})
        return self.of(plain)

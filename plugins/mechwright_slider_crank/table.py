"""The slider-crank of a design of the family, or those of a table of designs."""

from typing import Any

from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.plates import laid_out


class SliderCrankTable(Mechanism):
    """One slider-crank, or a table of them, with base, rails, crank, rod and slider."""

    def laid_out(self) -> Any:
        """The :class:`Layout` of one design; raises GeometryError or KinematicsError where there is none."""
        return laid_out(self)

"""The machine of a design of the family with its plates, or those of a table of designs."""

from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright_four_bar.kinematics.machine import FourBarMachine
from mechwright_four_bar.parts.layout import laid_out


class FourBarTable(FourBarMachine):
    """A crank or lever that drives a follower through a coupler, in the phase that is shown."""

    def laid_out(self) -> Layout:
        """Plates and layers; raises GeometryError where there are none."""
        return laid_out(self)

"""The design table with gears that bear their load, where it leaves out their width."""

from collections.abc import Mapping
from typing import Any

from mechwright_five_bar.params import FiveBarParams


class SizedParams(FiveBarParams):
    """A crank, an arm that gears turn with it, coupler and rocker, and the width of the gears.

    Examples
    --------
    >>> SizedParams().gear_thickness, SizedParams(load_y=-1000).gear_thickness
    (8.0, 10.5)
    """

    def fitted(self) -> Mapping[str, Any]:
        """Gears that bear, beside what fits by lengths alone."""
        from mechwright_five_bar.face import face_of

        found = super().fitted()
        if "gear_thickness" in self.model_fields_set:
            return found
        try:
            self.phased()
        except ValueError:  # which is refused
            return found
        return {**found, "gear_thickness": face_of(self.model_copy(update=found))}

"""The design table with gears that bear their load, where it leaves out their width."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechwright_five_bar.defaults.limits import USUAL_FACE
from mechwright_five_bar.parameters import FiveBarParams


class CompleteParams(FiveBarParams):
    """A crank, an arm that gears turn with it, coupler and rocker, and the width of the gears.

    Examples
    --------
    >>> CompleteParams().gear_thickness, CompleteParams(load_y=-1000).gear_thickness
    (8.0, 12.0)
    """

    def fitted(self) -> Mapping[str, Any]:
        """Gears that bear, beside what fits by lengths alone; columns of designs have the default width."""
        from mechwright_five_bar.defaults.face_width import face_of

        found = super().fitted()
        if "gear_thickness" in self.model_fields_set:
            return found
        if any(isinstance(value, np.ndarray) for value in self.__dict__.values()):
            return {**found, "gear_thickness": USUAL_FACE}
        try:
            self.phased()
        except ValueError:  # which is refused
            return found
        usual = self.model_copy()
        usual.__dict__.update(found)  # which still counts as left out
        return {**found, "gear_thickness": face_of(usual)}

"""The design table with teeth, face width and bore that suit its law, where it leaves them out."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechwright_noncircular_gears.consistency import pair_together
from mechwright_noncircular_gears.parameters import NoncircularParams


class SizedParams(NoncircularParams):
    """A driver and the gear that it drives by a law, and their teeth.

    Examples
    --------
    >>> SizedParams(law="ellipse", eccentricity=0.64, module=1.0).thickness
    4.0
    """

    def fitted(self) -> Mapping[str, Any]:
        """Teeth that can be cut, a face width that mills reach, and a bore that leaves the rim."""
        from mechwright_noncircular_gears.defaults import following

        if any(isinstance(one, np.ndarray) for one in self.__dict__.values()):  # rows have their own
            return {}
        try:
            pair_together(self)
        except ValueError:  # which is refused
            return {}
        if (self.module is None) == (self.centre_distance is None):
            return {}
        return following(self.model_copy())

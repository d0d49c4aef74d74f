"""Figures and masses of a table of designs, computed when they are asked for."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.motion import Scalar


@dataclass(frozen=True)
class Figure:
    """A figure of a table of designs.

    Parameters
    ----------
    unit
        Of its values; angles are in rad.
    value
        Computes it when it is asked for: a number or a column (n, 1), NaN for designs without it.
    """

    unit: str
    value: Callable[[], Any]


@dataclass(frozen=True)
class PartMass:
    """The mass of a part of a table of designs.

    Parameters
    ----------
    copies
        The number of copies in the mechanism.
    value
        Computes the mass of one, kg, when it is asked for: a number or a column (n, 1).
    """

    copies: int
    value: Callable[[], Any]


def scalars(figures: Mapping[str, Figure]) -> dict[str, Scalar]:
    """Give the figures of one design, without those that it has not."""
    values = {name: (float(np.asarray(one.value()).item()), one.unit) for name, one in figures.items()}
    return {name: Scalar(value, unit) for name, (value, unit) in values.items() if value == value}

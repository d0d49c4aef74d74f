"""Figures and masses of designs: numbers of one design, columns of a table of many."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.motion import Scalar

Value = Any
"""A number, a column (n, 1), or a function without arguments that computes it when it is asked for."""


@dataclass(frozen=True)
class Figure:
    """A figure of designs.

    Parameters
    ----------
    value
        Its value; NaN for designs without it.
    unit
        Of its values; angles are in rad.
    """

    value: Value
    unit: str = ""

    def __call__(self) -> Any:
        """Give the number or the column."""
        return self.value() if callable(self.value) else self.value


@dataclass(frozen=True)
class PartMass:
    """The mass of a part of designs.

    Parameters
    ----------
    value
        The mass of one copy, kg; NaN for designs without it.
    copies
        The number of copies in the mechanism, a column (n, 1) where the designs differ in it.
    """

    value: "float | Callable[[], Any]"
    copies: Any = 1

    def __call__(self) -> Any:
        """Give the number or the column."""
        return self.value() if callable(self.value) else self.value


class SomeMasses(dict[str, PartMass]):
    """Masses of some of the parts of designs by their names: the total is that of their ``parts``."""


def scalars(figures: Mapping[str, Figure]) -> dict[str, Scalar]:
    """Give the figures of one design for its motion, without those that it has not."""
    values = {name: (float(np.asarray(one()).item()), one.unit) for name, one in figures.items()}
    return {name: Scalar(value, unit) for name, (value, unit) in values.items() if value == value}

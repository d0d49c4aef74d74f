"""The deviations of a printer by least squares over the sizes of its coupon.

A size of nominal d along an axis comes out as m = s d + a: s is the growth of lengths along that axis, a the
deviation of its kind; what is measured on the lowest layer is wider by twice the foot. Round holes take the
mean of both growths. Seven unknowns, as many equations as rows; the residuals are the spread of the printer,
with the calliper's.

Source: any text on linear regression, such as Draper and Smith, Applied Regression Analysis, ch. 2 and 8.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright_print.coupon.features import ROWS, Row

UNKNOWNS = ("scale_x", "scale_y", "hole", "slot", "pin", "wall", "foot")
"""Columns of the system; the scales as growth above 1."""
_KIND = {"length": "wall", "bed": "wall", "hole": "hole", "slot": "slot", "pin": "pin", "wall": "wall"}
"""Kind of a row to the deviation that it has."""


@dataclass(frozen=True, eq=False)
class PrinterFit:
    """What the sizes say.

    Parameters
    ----------
    values, errors
        Name of an unknown to its value and its standard error; mm, and pure numbers for the scales.
    spread
        Standard deviation of a size about the fit, mm.
    residuals
        Name of a row to what its size has more than the fit, mm.
    without
        The same of what a row has more than a fit of all other rows.
    studentised
        That in standard deviations of the other rows.
    """

    values: Mapping[str, float]
    errors: Mapping[str, float]
    spread: float
    residuals: Mapping[str, float]
    without: Mapping[str, float]
    studentised: Mapping[str, float]


def system() -> Array:
    """The matrix (rows, unknowns) of the equations for what sizes have more than nominal."""
    return np.array([_equation(row) for row in ROWS])


def _equation(row: Row) -> list[float]:
    share = {"x": (1.0, 0.0), "y": (0.0, 1.0), "round": (0.5, 0.5)}[row.axis]
    return [
        share[0] * row.nominal,
        share[1] * row.nominal,
        *(float(_KIND[row.kind] == name) for name in UNKNOWNS[2:6]),
        2.0 if row.kind == "bed" else 0.0,
    ]


def fit(sizes: Mapping[str, float]) -> PrinterFit:
    """The fit of all rows.

    >>> found = fit({row.name: row.nominal - (0.3 if row.kind == "hole" else 0.0) for row in ROWS})
    >>> round(found.values["hole"], 9), round(found.spread, 9)
    (-0.3, 0.0)
    """
    matrix = system()
    more = np.array([sizes[row.name] - row.nominal for row in ROWS])
    inverse = np.linalg.inv(matrix.T @ matrix)
    found = inverse @ matrix.T @ more
    residuals = more - matrix @ found
    free = len(ROWS) - len(UNKNOWNS)
    variance = float(residuals @ residuals) / free
    leverage = np.einsum("ij,jk,ik->i", matrix, inverse, matrix)
    left = np.maximum(variance * free - residuals**2 / (1 - leverage), 0.0) / (free - 1)
    studentised = residuals / np.maximum(np.sqrt(left * (1 - leverage)), _LEAST)
    errors = np.sqrt(variance * np.diag(inverse))
    names = [row.name for row in ROWS]
    values = dict(zip(UNKNOWNS, found.tolist(), strict=True))
    return PrinterFit(
        {name: value + (1.0 if name.startswith("scale") else 0.0) for name, value in values.items()},
        dict(zip(UNKNOWNS, errors.tolist(), strict=True)),
        variance**0.5,
        dict(zip(names, residuals.tolist(), strict=True)),
        dict(zip(names, (residuals / (1 - leverage)).tolist(), strict=True)),
        dict(zip(names, studentised.tolist(), strict=True)),
    )


_LEAST = 1e-3
"""A standard deviation that residuals are divided by, mm, at least: a tenth of a calliper's step."""

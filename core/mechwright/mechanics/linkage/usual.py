"""Sizes of joints that a design leaves out: the usual ones, or smaller ones where links are short."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import astuple, dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters


@dataclass(frozen=True)
class JointSizes:
    """Sizes of pins and of what is about them, mm: numbers, or arrays (n,) over designs."""

    pin_diameter: Any
    rim: Any
    bushing_wall: Any
    web_width: Any


SMALL = (
    JointSizes(5.0, 3.0, 1.0, 8.0),
    JointSizes(4.0, 2.5, 1.0, 7.0),
    JointSizes(3.0, 2.0, 0.5, 5.0),
    JointSizes(2.0, 1.5, 0.5, 4.0),
    JointSizes(1.5, 1.0, 0.5, 3.0),
    JointSizes(1.0, 0.75, 0.5, 2.0),
)
"""Dowel pins as they are sold below 6 mm; rim and web are about as large against them as those of 6 mm."""

NAMES = tuple(field.name for field in fields(JointSizes))
"""Their parameters."""

Fits = Callable[[JointSizes], NDArray[np.bool_] | bool]
"""Whether sizes leave material between all bores, of one design or of each (n,)."""


def fitting(usual: JointSizes, given: Mapping[str, Any], fits: Fits) -> JointSizes:
    """The usual sizes where they fit, else the largest smaller ones that do; what is given stays.

    Where none fit these are the usual ones, and a check says so.

    Examples
    --------
    >>> fitting(JointSizes(6.0, 4.0, 1.0, 10.0), {"rim": 2.0}, lambda one: one.pin_diameter + one.rim <= 6)
    JointSizes(pin_diameter=4.0, rim=2.0, bushing_wall=1.0, web_width=7.0)
    """
    smaller = (row for row in SMALL if row.pin_diameter < usual.pin_diameter)
    rows = [replace(row, **given) for row in (usual, *smaller)]
    fit = [np.asarray(fits(row)) for row in rows]
    if not any(one.ndim for one in fit):
        return next((row for row, one in zip(rows, fit, strict=True) if one), rows[0])
    return JointSizes(
        *(
            given[name] if name in given else np.select(fit, [getattr(row, name) for row in rows], of_usual)
            for name, of_usual in zip(NAMES, astuple(usual), strict=True)
        )
    )


def left_out(params: Parameters) -> frozenset[str]:
    """Which of the sizes a table leaves out."""
    return frozenset(NAMES) - params.model_fields_set


def told(code: str, usual: JointSizes, params: Parameters) -> Iterator[Finding]:
    """A note of the sizes that were left out and are smaller than usual."""
    smaller = [
        name for name in NAMES if name in left_out(params) and getattr(params, name) < getattr(usual, name)
    ]
    if smaller:
        said = ", ".join(f"{name} = {getattr(params, name):g}" for name in smaller)
        yield Finding.note(code, f"defaults reduced so that bores leave their rims: {said}")


def of_table(usual: JointSizes, params: Parameters, fits: Fits) -> dict[str, float]:
    """The sizes that a table leaves out, for :meth:`Parameters.fitted`."""
    out = left_out(params)
    given = {name: getattr(params, name) for name in NAMES if name not in out}
    found = fitting(usual, given, fits)
    return {name: getattr(found, name) for name in sorted(out)}

"""Elements of MJCF and the numbers in them."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array

METRES = 1e-3
"""From mm."""

STEP, STIFF = 2e-4, 5e-4
"""Time step, and the time in which a constraint is made good, s; MuJoCo wants at least two steps."""

SOLREF = [STIFF, 1.0]
"""How constraints and contacts are made good: in which time, and critically damped."""

DIGITS = 15
"""Decimals of places and directions: 1e-15 m, and the rounding of a unit vector."""

NOTHING = 1e-12
"""Part of a body's largest inertia below which a product of inertia is rounding."""

Value = str | float | Sequence[float] | Array


def element(parent: ET.Element, tag: str, **attributes: Value) -> ET.Element:
    """A new element of ``parent``; numbers are written by :func:`text`."""
    written = {name: value if isinstance(value, str) else text(value) for name, value in attributes.items()}
    return ET.SubElement(parent, tag, attrib=written)


def text(values: float | Sequence[float] | Array) -> str:
    """Numbers to 1e-15.

    >>> text([1.0, -0.0, 0.1])
    '1 0 0.1'
    """
    return " ".join(f"{round(x, DIGITS) + 0.0:.15g}" for x in np.ravel(values).tolist())


def relative(values: Sequence[float]) -> str:
    """Numbers to 15 digits each.

    >>> relative([1e-20, 2.5])
    '1e-20 2.5'
    """
    return " ".join(f"{x:.15g}" for x in values)


def remark(parent: ET.Element, sentence: str) -> None:
    """A comment in ``parent``."""
    parent.append(ET.Comment(f" {sentence.replace('--', '- -')} "))


def corners(points: Array) -> str:
    """Corners (n, 3) of a mesh, mm, in metres, which MuJoCo keeps in single precision."""
    return " ".join(f"{x + 0.0:.9g}" for x in np.round(points * METRES, 10).ravel().tolist())


def without_noise(tensor: Array) -> Array:
    """A tensor of inertia (3, 3) whose products are 0 where they are rounding."""
    return np.where(np.abs(tensor) < NOTHING * np.abs(tensor).max(), 0.0, tensor)

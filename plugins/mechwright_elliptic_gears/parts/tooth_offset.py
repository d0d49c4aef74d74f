"""Where teeth stand on two congruent gears so that they mesh; numbers, or arrays over designs."""

from typing import Any

import numpy as np

from mechwright.contracts.design_table import number

OFFSET_SLACK = 1e-6
"""Pitches by which a tooth offset may miss: a micrometre in a metre, far below any backlash."""


def offsets_that_mesh(teeth: Any) -> tuple[Any, Any]:
    """The two tooth offsets, in pitches, with which two congruent gears mesh.

    Half a perimeter lies between the far vertex of one gear and the near vertex of the other, which meet: a
    tooth there must find a space, so 2 δ = (z - 1)/2 (mod 1).

    >>> offsets_that_mesh(39), offsets_that_mesh(40)
    ((0.0, 0.5), (0.25, 0.75))
    """
    least = (1 - teeth % 2) / 4
    return least, least + 0.5


def offset_miss(offset: Any, teeth: Any) -> Any:
    """Pitches by which a tooth offset misses the nearest one that meshes; 0 where it hardly does.

    >>> offset_miss(0.5, 39), offset_miss(0.5, 40)
    (0.0, 0.25)
    """
    # An offset of 1 is 0 again.
    miss = np.minimum(*(np.abs((offset - right + 0.5) % 1 - 0.5) for right in offsets_that_mesh(teeth)))
    return number(np.where(miss <= OFFSET_SLACK, 0.0, miss))

"""Shapes that are asked many questions."""

from typing import Any

import shapely


def prepared(shape: Any) -> Any:
    """A copy of a shape, prepared for many questions.

    A prepared shape builds indices while it is asked, and threads that ask the same one at once spoil them:
    so what is prepared is never what others may hold.
    """
    own = shapely.force_2d(shape)
    shapely.prepare(own)
    return own

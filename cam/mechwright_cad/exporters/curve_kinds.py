"""What drawings may write curves as."""

from typing import Literal

Curves = Literal["spline", "spline3", "arc", "polyline"]
"""How a drawing holds B-splines.

``spline``: as they are, of any degree. ``spline3``: of degree 3, which every reader knows. ``arc``: one
closed polyline with arcs per loop. ``polyline``: one closed polyline of chords per loop.
"""

"""Plane geometry: segments, loops, outlines, curve fitting, and their polygons."""

from mechwright.geometry.outline import Loop, Outline
from mechwright.geometry.segments import Arc, BSpline, Line, Segment, circle

__all__ = ["Arc", "BSpline", "Line", "Loop", "Outline", "Segment", "circle"]

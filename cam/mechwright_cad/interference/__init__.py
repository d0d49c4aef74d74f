"""Interference: whether two bodies of a mechanism stand in each other at any instant of its motion."""

from mechwright_cad.interference.check import interference, interference_findings, smooth_motion

__all__ = ["interference", "interference_findings", "smooth_motion"]

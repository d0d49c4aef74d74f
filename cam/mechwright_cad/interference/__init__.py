"""Interference: whether two bodies of a mechanism stand in each other at any instant of its motion."""

from mechwright_cad.interference.check import faithful_motion, interference, interference_findings

__all__ = ["faithful_motion", "interference", "interference_findings"]

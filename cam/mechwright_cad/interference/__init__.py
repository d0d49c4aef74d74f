"""Interference: whether two bodies of a mechanism stand in each other at any instant of its motion."""

from mechwright_cad.interference.check import faithful_motion, interference, interference_findings
from mechwright_cad.interference.report import Collision, Gap, Instant, Report

__all__ = [
    "Collision",
    "Gap",
    "Instant",
    "Report",
    "faithful_motion",
    "interference",
    "interference_findings",
]

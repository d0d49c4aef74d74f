"""Mechwright: from how a mechanism should move to a proven program for the mill."""

__version__ = "0.1.0"

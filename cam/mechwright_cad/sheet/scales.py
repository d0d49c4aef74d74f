"""Scales of drawings."""

SCALES = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01)
"""ISO 5455."""

LEAST = 0.5
"""A smaller scale than this is taken only where the largest sheet wants it."""

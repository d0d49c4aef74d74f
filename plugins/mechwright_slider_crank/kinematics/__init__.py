"""Positions, rates, ends of the stroke, and forces."""

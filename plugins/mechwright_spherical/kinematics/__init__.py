"""Positions, rates and rooms of spherical linkages."""

"""Spherical linkages with tolerances, and with their bores as made."""

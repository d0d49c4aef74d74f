"""Spherical linkages for a requirement."""

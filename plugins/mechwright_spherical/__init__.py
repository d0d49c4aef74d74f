"""Spherical linkages: four-bars, and adjustable five-bar path generators."""

"""Dimensions that a design leaves open."""

"""Dimensions that a design leaves out."""

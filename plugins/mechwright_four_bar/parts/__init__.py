"""Plates, pins, bushings, clamps and the layers they stand in."""

"""Plates, pins and bushings, and the layers they stand in."""

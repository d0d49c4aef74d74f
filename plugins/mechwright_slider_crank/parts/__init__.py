"""Sizes, outlines, layers and masses of the parts."""

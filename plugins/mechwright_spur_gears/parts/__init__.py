"""Teeth, outlines, parts, shafts, and the pair as made."""

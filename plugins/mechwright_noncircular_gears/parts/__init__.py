"""Cutter, teeth, outlines, parts, shafts, and the pair as made."""

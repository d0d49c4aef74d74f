"""Paths of the cutter's centre in the plane: offsets, arc fitting, leads and links."""

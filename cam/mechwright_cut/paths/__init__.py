"""Paths of the beam: parallels of contours, leads, micro-joints, and the order of the cuts."""

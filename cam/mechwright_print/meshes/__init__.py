"""Triangles of compensated parts as they stand on the bed."""

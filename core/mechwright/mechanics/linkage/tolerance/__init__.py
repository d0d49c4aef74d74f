"""Errors of a linkage: from tolerances, and from plates as they are made."""

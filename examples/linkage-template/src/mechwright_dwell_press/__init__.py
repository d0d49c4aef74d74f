"""Presses whose ram dwells: a linkage of its own for Mechwright."""

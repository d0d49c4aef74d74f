"""Closed forms of the dimensions, motion and forces over one period."""

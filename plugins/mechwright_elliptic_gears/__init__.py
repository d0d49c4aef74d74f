"""Elliptic gears that turn about their foci."""

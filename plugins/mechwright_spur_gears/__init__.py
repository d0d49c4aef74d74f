"""Spur gears: involute gears and rings with profile shift."""

"""Spur gears: involute gears, rings and planetary sets with profile shift."""

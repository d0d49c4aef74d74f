"""Spur gears: involute pairs with profile shift."""

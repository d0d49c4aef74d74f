"""Linkages that are drawn: points, links, slides and gears in one position."""

"""Drawings of plates: the plan with its holes and corners in tables, and the edge.

``holes`` and ``contours`` say what the tables hold, ``placing`` where labels stand, ``drawing`` makes
the sheet.
"""

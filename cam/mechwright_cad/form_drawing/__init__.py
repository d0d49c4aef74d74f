"""Drawings of parts of free form: three views, their sizes, and a chart of all bores.

Glossary
--------
view
    The solid as seen along an axis, with its hidden edges; first-angle projection.
chart of bores
    Diameter with limits, direction of the axis, and place of each bore. The views show their names.
azimuth, elevation
    Of an axis: its angle from x in the xy plane, and its angle above that plane, degrees.
"""

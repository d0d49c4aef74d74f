"""Numbers of teeth that can be cut, and the usual width of gears."""

LEAST_TEETH, MOST_TEETH = 18, 200
"""A gear of fewer teeth is undercut by the rack of 20 degrees: 2/sin² 20° is 17.1."""

USUAL_FACE = 8.0
"""mm: face width of the gears."""

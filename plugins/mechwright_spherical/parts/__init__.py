"""Links, pins, frame and foot of a spherical linkage."""

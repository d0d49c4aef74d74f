"""Errors of the slider and of the coupler point, from tolerances and from plates as made."""

"""Positions, rates, figures and loads of gears, coupler and point Q."""

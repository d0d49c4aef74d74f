"""Slider-cranks: a crank and a rod that move a slider."""

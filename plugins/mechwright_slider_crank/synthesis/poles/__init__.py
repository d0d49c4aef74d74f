"""Slider-cranks whose rod has its acceleration pole in prescribed places."""

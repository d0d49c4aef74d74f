"""Mechanics that families share."""

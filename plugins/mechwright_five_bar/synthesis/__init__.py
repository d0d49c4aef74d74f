"""Designs for what is required."""

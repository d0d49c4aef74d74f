"""Designs for a requirement."""

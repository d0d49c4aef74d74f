"""Linkages of the catalogue that meet a requirement."""

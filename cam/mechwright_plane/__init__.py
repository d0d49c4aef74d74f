"""Paths in the plane, and parts on one plate: what milling and cutting share."""

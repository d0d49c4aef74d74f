"""Outlines, plates, openings, hardware and mounting."""

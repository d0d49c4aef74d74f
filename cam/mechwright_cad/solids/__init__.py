"""Solids of parts."""

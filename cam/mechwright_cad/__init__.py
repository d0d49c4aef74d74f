"""Solids, their files, their collisions, and the page on which they move."""

"""Synthesis of the path of a coupler point, its limits inside the search."""

"""Outlines, parts, masses and shafts of a cam and its follower."""

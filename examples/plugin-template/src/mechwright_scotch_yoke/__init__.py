"""Scotch yokes: a crank pin in a straight slot."""

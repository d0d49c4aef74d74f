"""Designs without a file."""

from pathlib import Path

from mechwright.designs.design import Design


def designed(family, params):
    """A design of a family with these parameters."""
    return Design("design", family, params, Path("design.toml"), "")

"""Strength and life of what a frame adds."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding


def strength(frame: object, wanted: object) -> Iterator[Finding]:
    """To be."""
    return iter(())

"""The linkages of the reference as machines, with their inputs at eight times."""

from reference_linkages import FIGURES, LINKAGES, case_of

__all__ = ["FIGURES", "LINKAGES", "inputs_of", "machine_of", "points_of"]


def points_of(linkage):
    """Link to its points."""
    return {link: {at: complex(*p) for at, p in own.items()} for link, own in linkage["links"].items()}


def machine_of(linkage):
    """The machine of a linkage; one without an order of dyads is drawn at its first time."""
    return case_of(linkage).machine


def inputs_of(linkage):
    """The laws of the drives at the times of the reference."""
    return case_of(linkage).inputs

"""Errors of follower and coupler point: of the drawing's tolerances, and of plates as made."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from mechwright import AsMade, DesignError, MadePart, Tolerances
from mechwright.mechanics.linkage.tolerance import as_made as of_linkages
from mechwright.mechanics.linkage.tolerance.model import LinkageTolerances
from mechwright_four_bar.table import FourBarTable

RULE = "(Σ ρ) / |N| + |Σ (∂/∂l) Δl|, every pin standing off in the worst direction; least: pins centred"


class FourBarTolerances(LinkageTolerances):
    """The model of one design; crank angles count from X, as in the motion."""

    def __init__(self, table: FourBarTable, tolerances: Tolerances) -> None:
        if table.through:
            raise DesignError(
                "crank: where all links line up, no error is in proportion to a tolerance; swing the crank "
                "between its change points, or make the linkage a little different"
            )
        super().__init__(table, tolerances)


def as_made(table: FourBarTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    layout = table.layout_or_none
    if layout is None or layout.raised:
        return AsMade()  # where A or B is clamped, how well it is set says more than how it is made
    found = of_linkages.as_made(table, made)
    named = {"output.error": "follower.error"}
    figures = (
        replace(
            one, name=named.get(one.name, one.name), rule=RULE if one.name.endswith("error") else one.rule
        )
        for one in found.figures
    )
    return replace(found, figures=tuple(figures))

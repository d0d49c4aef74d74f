"""What a design asks of the outputs of its stages, as the chain moves them."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding, Stage
from mechwright.mechanics.chain.indexing import index_figures
from mechwright.mechanics.chain.motion import rate_figures
from mechwright.mechanics.chain.params import ChainParams, Families

LIMITS = {
    "most_ca": (
        "Ca",
        "its moves from rest to rest have a Ca",
        "take a pair of gears before it whose law is for it",
    ),
    "most_acceleration": ("output_acceleration_max", "its output accelerates by", "run the chain slower"),
    "most_jerk": ("output_jerk_max", "its output has a jerk", "run the chain slower"),
}
"""Field of a stage to the figure that it limits, what is said of it, and what helps."""


def asked_findings(params: ChainParams, families: Families) -> Iterator[Finding]:
    """An error for each figure of a stage that is greater than asked, or that the stage does not have."""
    asked = [(number, table) for number, table in enumerate(params.stage, start=1)]
    if not any(getattr(table, field) for _, table in asked for field in LIMITS):
        return
    figures = rate_figures(params, families) | index_figures(params, families)
    for number, table in asked:
        for field, (name, said, cure) in LIMITS.items():
            limit = getattr(table, field)
            if limit is None:
                continue
            key, found = f"stage.{number}.{field}", figures.get(f"{number}.{name}")
            where = f"stage {number}, {table.family}:"
            if found is None:
                yield Finding.error(
                    "chain.asked",
                    key,
                    f"{where} it has no such figure",
                    remedy=f"leave {field} out, or ask it of another stage",
                    stage=Stage.PARTS,
                    proposed=({key: None},),
                )
            elif found.value > limit:
                yield Finding.error(
                    "chain.asked",
                    key,
                    f"{where} {said} of {found.value:.5g} {found.unit}".rstrip()
                    + f", and at most {limit:g} is asked",
                    found.value,
                    limit,
                    found.unit,
                    cure,
                    Stage.PARTS,
                )

"""Keys of ``[cut]`` that no chosen process uses."""

from collections.abc import Collection, Iterator

from mechwright.contracts.finding import Finding, Stage

BEAMS = frozenset({"laser", "waterjet", "plasma"})
PATHS = BEAMS | {"wire"}
"""Processes whose paths are planned here."""
USED_BY = {
    **dict.fromkeys(("sheet", "joints", "joint_width"), PATHS),
    **dict.fromkeys(("control", "lead", "overcut"), BEAMS),
    **dict.fromkeys(("power", "full_power"), frozenset({"laser", "waterjet"})),
    **dict.fromkeys(("engrave_power", "engrave_feed"), frozenset({"laser"})),
    **dict.fromkeys(("offsets", "start_hole"), frozenset({"wire", "service"})),
    "tab": frozenset({"wire"}),
}
"""Key to the processes that use it; the others also say what processes that are not chosen would take."""


def unused_keys(stated: Collection[str], chosen: Collection[str]) -> Iterator[Finding]:
    """Warn of each stated key that none of the chosen processes uses."""
    for key, users in USED_BY.items():
        if key in stated and chosen and not users.intersection(chosen):
            yield Finding.warning(
                "cut.unused",
                f"cut.{key}",
                f"cut.{key} changes nothing of what is cut by {' and '.join(sorted(chosen))}; it is for "
                f"{' and '.join(sorted(users))}",
                remedy=f"leave out cut.{key}",
                stage=Stage.MACHINING,
                proposed=({f"cut.{key}": None},),
            )

"""Walls of plain bushings in the turning bores of a linkage."""

from collections.abc import Iterator
from typing import Any, Protocol

from mechwright.contracts.finding import Finding, Stage
from mechwright.tolerances import falls_short

LEAST_WALL = 0.1
"""mm. A thinner wall of bronze cannot be turned, and yields when it is pressed into its bore."""


class Bushed(Protocol):
    """A table of parameters with bushings."""

    @property
    def bushing_wall(self) -> float:
        """Half of what a bore with a bushing is wider than its pin, mm; 0 for none."""
        ...

    @property
    def running_fit(self) -> float:
        """Diameter by which the bushing is wider than the pin, mm."""
        ...


def too_thin(wall: Any, running_fit: Any) -> Any:
    """Whether the running fit leaves too little of a bushing's wall; of one design or of each (n,)."""
    return (wall > 0) & falls_short(wall - running_fit / 2, LEAST_WALL)


def bushing_findings(code: str, params: Bushed) -> Iterator[Finding]:
    """Give an error for bushings whose wall cannot be produced."""
    wall, play = params.bushing_wall, params.running_fit / 2
    if too_thin(wall, params.running_fit):
        least = round(LEAST_WALL + play, 6)
        yield Finding.error(
            code,
            "bushing_wall",
            f"the running fit of {params.running_fit:g} mm leaves {wall - play:.3g} mm of the bushing's wall",
            wall,
            least,
            "mm",
            f"make bushing_wall at least {least:g}, or 0 for no bushings",
            Stage.PARTS,
            ({"parameters.bushing_wall": least}, {"parameters.bushing_wall": 0.0}),
        )

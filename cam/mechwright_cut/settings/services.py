"""The services that are known, and what they ask."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Literal

from mechwright.contracts.materials import MATERIALS
from mechwright_cut.settings.figures import Process


@dataclass(frozen=True, slots=True)
class ServiceRules:
    """What a service asks of a drawing; lengths in mm.

    Parameters
    ----------
    words
        Its name.
    dxf
        Version of the file.
    kerf
        Who allows for the kerf, but in the materials of ``own_in``, where the service does.
    kerf_width
        Its kerf, where the designer allows for it.
    hole_share, web_share
        Least hole, and least material between two cuts, in thicknesses.
    feature
        Least size of a hole or a web.
    part
        Least size of a part.
    waterjet_hole, waterjet_corner
        Least hole and least radius of an inside corner of its waterjet.
    engraves
        Whether a layer of marks is taken.
    source
        Where this is from.
    """

    name: str
    words: str
    dxf: Literal["R2000", "R2010"]
    kerf: Literal["service", "designer"]
    source: str
    kerf_width: float = 0.0
    own_in: tuple[str, ...] = ()
    hole_share: float = 0.0
    web_share: float = 0.0
    feature: float = 0.0
    part: float = 0.0
    waterjet_hole: float = 0.0
    waterjet_corner: float = 0.0
    engraves: bool = False

    def offset(self, material: str) -> float:
        """By how much a path stands off the outline, mm."""
        group = MATERIALS[material].group if material in MATERIALS else material
        return 0.0 if self.kerf == "service" or group in self.own_in else self.kerf_width / 2

    def limited(self, process: Process) -> Process:
        """The process with what the service asks for besides.

        >>> from mechwright_cut.settings.figures import processes
        >>> snapcut = services()["snapcut"].limited(processes()["fibre-laser"])
        >>> snapcut.words, snapcut.least_hole(6.0)
        ('fibre laser of SnapCut', 9.0)
        """
        jet = process.name == "waterjet"
        return replace(
            process,
            words=f"{process.words} of {self.words}",
            hole=max(process.hole, self.feature, self.waterjet_hole if jet else 0.0),
            hole_share=max(process.hole_share, self.hole_share),
            corner=max(process.corner, self.waterjet_corner if jet else 0.0),
        )

    def least_hole(self, thickness: float, waterjet: bool) -> float:
        """The least hole in a sheet, mm."""
        return max(self.hole_share * thickness, self.feature, self.waterjet_hole if waterjet else 0.0)

    def least_web(self, thickness: float) -> float:
        """The least material between two cuts, mm."""
        return max(self.web_share * thickness, self.feature)


@cache
def services() -> Mapping[str, ServiceRules]:
    """All services by name."""
    text = (Path(__file__).parent / "services.toml").read_text(encoding="utf-8")
    return {
        name: ServiceRules(name, **{**table, "own_in": tuple(table.get("own_in", ()))})
        for name, table in tomllib.loads(text).items()
    }

"""Rules of sintered bronze bushes: a bore for which they are sold, plates that hold one, a rim."""

from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Stage, at_stage
from mechwright.contracts.procedure import Procedure
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright.standards.bushes import bushes
from mechwright_elliptic_gears.parts.gear import rack_of, room
from mechwright_elliptic_gears.parts.layout import dividing_of
from mechwright_elliptic_gears.table import GearTable

WALL = 1.0
"""Between a bush and the holes of the phase pin, mm: a bush is pressed in, and nothing more bears there."""


def _findings(m: GearTable) -> Iterator[Finding]:
    """A bore for which bushes are sold, plates that hold one, and a rim around those of the gears."""
    params, layout = m.given, m.layout
    sizes = {one.bore: one for one in bushes()}
    if params.bore not in sizes:
        near = min(sizes, key=lambda bore: (abs(bore - params.bore), bore))
        sold = ", ".join(f"{bore:g}" for bore in sizes)
        yield Finding.error(
            "train.bush",
            "bore",
            f"no bush is sold for a shaft of {params.bore:g} mm; one of: {sold}",
            params.bore,
            near,
            "mm",
            f"make it {near:g}, or leave bushes out",
            proposed=({"parameters.bore": near}, {"parameters.bushes": None}),
        )
        return
    size = sizes[params.bore]
    for key, thickness in (("thickness", layout.thickness), ("base_thickness", layout.base)):
        if thickness < size.lengths[0]:
            yield Finding.error(
                "train.bush",
                key,
                f"the shortest bush on a shaft of {params.bore:g} mm is {size.lengths[0]:g} mm long, and the "
                f"plate {thickness:g} mm thick",
                thickness,
                size.lengths[0],
                "mm",
                f"make it {size.lengths[0]:g}, or leave bushes out",
                proposed=({f"parameters.{key}": size.lengths[0]}, {"parameters.bushes": None}),
            )
    rim = room(params, np.array([[0.0, 0.0]])) - size.outside / 2
    inner = dividing_of(params).rings[0] - layout.dowel / 2 if params.phase_joint == "pins" else np.inf
    for wall, least, what in (
        (rim, LEAST_RIM * rack_of(params).module, "the nearest root"),
        (inner - size.outside / 2, WALL, "the holes of the phase pin"),
    ):
        if wall < least:
            yield Finding.error(
                "train.bush",
                "bushes",
                f"a bush of {size.outside:g} mm outside leaves {wall:.2f} mm to {what}",
                wall,
                least,
                "mm",
                "take a thinner bore, or leave bushes out",
                proposed=({"parameters.bushes": None},),
            )


BUSHES = Procedure[GearTable](
    ("train.bush",),
    lambda m: at_stage(Stage.PARTS, _findings(m)),
    when=lambda m: bool(m.given.bushes),
    stage=Stage.PARTS,
)

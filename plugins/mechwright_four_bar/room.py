"""Whether the bores of each plate leave material between them, and the coupler can be drawn."""

import math
from collections.abc import Iterator
from itertools import combinations

from mechwright import Finding, GeometryError, Stage, of_stage
from mechwright.mechanics.linkage import Boss
from mechwright.tolerances import falls_short
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.joints import bosses
from mechwright_four_bar.parts.layout import link_outline
from mechwright_four_bar.parts.plates import TRIED, bosses_of


@of_stage(Stage.PARTS)
def room_findings(params: FourBarParams) -> Iterator[Finding]:
    """What is wrong on any number of sides; if that is nothing, what is on those that the layout takes.

    The layers are sought over the whole motion, which takes a hundred times as long as all of this.
    """
    ways = [_crowded(params, bosses(params, sides)) for sides in TRIED[params.frame]]
    found = [one for plate, some in ways[0].items() if all(plate in way for way in ways) for one in some]
    found += _bend(params)
    if not found:
        found = [one for some in _crowded(params, bosses_of(params)).values() for one in some]
    yield from found


def above(value: float) -> str:
    """A limit that is printed as no less than it is."""
    return f"{math.ceil(value * 1e4) / 1e4:g}" if value < 1e3 else f"{math.ceil(value * 100) / 100:.2f}"


def _crowded(params: FourBarParams, plates: dict[str, tuple[Boss, ...]]) -> dict[str, list[Finding]]:
    """The plates whose bores are too near to each other, with what there is to say."""
    found = {
        name: [one for pair in combinations(_plain(own), 2) for one in _between(params, name, *pair)]
        for name, own in plates.items()
    }
    return {name: some for name, some in found.items() if some}


def _plain(plate: tuple[Boss, ...]) -> list[Boss]:
    """The bosses with a bore that no other phase shares: places of phases are judged by themselves."""
    return [boss for boss in plate if boss.bore and not boss.tag.endswith("-spare")]


def _between(params: FourBarParams, name: str, one: Boss, two: Boss) -> Iterator[Finding]:
    distance = abs(one.centre - two.centre)
    needed = (one.bore + two.bore) / 2 + params.rim
    if not falls_short(distance, needed):
        return
    point = "coupler-point" in (one.tag, two.tag)
    yield Finding.error(
        "four-bar.bores",
        "coupler_point_x" if point else name,
        f"the bores of the {name} are {distance:.4g} mm apart and leave less than the rim of "
        f"{params.rim:g} mm",
        distance,
        needed,
        "mm",
        f"move the point at least {above(needed)} mm from A and B, or take smaller pins"
        if point
        else f"make {name} at least {above(needed)}, or take smaller pins, bushings or rims",
    )


def _bend(params: FourBarParams) -> Iterator[Finding]:
    try:
        link_outline(params, "coupler", bosses(params, 1)["coupler"])
    except GeometryError as error:
        yield Finding.error(
            "four-bar.bend",
            "coupler_bend",
            str(error),
            params.coupler_bend,
            unit="mm",
            remedy="make coupler_bend or web_width smaller, or rim larger",
        )

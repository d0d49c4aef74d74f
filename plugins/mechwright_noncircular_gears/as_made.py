"""Whether the pair as its programs leave it goes together and turns."""

from collections.abc import Mapping, Sequence

from mechwright import AsMade, MadePart
from mechwright.mechanics.gearing.running import (
    MadePair,
    about_bore,
    about_rim,
    play_curve,
    running_figures,
    running_findings,
)
from mechwright_noncircular_gears.gear import NAMES, least_backlash, pair_of, teeth_of
from mechwright_noncircular_gears.params import NoncircularParams

RULE = "least with which gears as made turn: 2 (D + c sin α / cos ν) / cos α"


def as_made(params: NoncircularParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the pair: part name to its copies as made."""
    copies = [made.get(name, ()) for name in NAMES]
    if not all(copies):
        return AsMade()
    one, two = (copy[0] for copy in copies)
    driver, mate = teeth_of(params)
    pair = MadePair(
        pair_of(params),
        driver,
        NAMES,
        (
            about_bore(one, params.bore),
            about_rim(two) if params.internal else about_bore(two, params.bore),
        ),
        one.corridor + two.corridor,
        (least_backlash(params), RULE),
        mate=mate,
    )
    return AsMade(tuple(running_figures(pair)), (play_curve(pair),), tuple(running_findings(pair)))

"""What a slider-crank of plates as made does: error of slider and coupler point, and the slider's play."""

from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from mechwright import AsMade, Finding, MadeFigure, MadePart, Severity, Stage
from mechwright.mechanics.linkage.made import Hole, Joint, joint, link, stuck
from mechwright.mechanics.linkage.made_error import EXACT, made_errors
from mechwright_slider_crank.as_made.tolerances import SliderCrankTolerances
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.plates import layout_of

RULE = "Σ ρ/|cos β| + play |tan β| + |Σ (∂x/∂l) Δl|; least: all centred"


def as_made(table: Mechanism, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    if not {"base", "rail", "crank", "rod", "slider"} <= set(made):
        return AsMade()
    params, sizes = table.given, table.dimensions
    crank, rod, base = (made[name][0] for name in ("crank", "rod", "base"))
    ends = [Hole(0j, sizes.rod_bore), Hole(complex(params.rod), sizes.rod_bore)]
    links = {
        "crank": link(crank, Hole(0j, sizes.shaft), Hole(complex(params.crank), sizes.pin)),
        "rod": link(rod, *ends),
    }
    pins: dict[str, Joint | None] = {}
    if params.bushing == 0:  # the bushings' own fit is not the program's
        pins = {
            "crank-pin": joint("crank pin", rod, ends[0], sizes.pin),
            "wrist-pin": joint("wrist pin", rod, ends[1], sizes.pin),
            "shaft": joint("shaft", base, Hole(0j, sizes.base_bore), sizes.shaft),
        }
    sure = {name: one for name, one in links.items() if one is not None}
    turning = {name: one for name, one in pins.items() if one is not None}
    play, spread = _guide(table, made)
    # Where the rod stands across the slide, no error is in proportion to what is off.
    errors = (
        []
        if params.linkage.at_limit
        else made_errors(
            SliderCrankTolerances(table, EXACT),
            sure,
            turning | {"guide": Joint("guide", play, spread)},
            {"guide": params.play},
        )
    )
    rule = RULE + ("; bushings without play" if params.bushing > 0 else "")
    figures = [
        *(one.figure(name, rule) for one, name in zip(errors, ("slider.error", "point.error"), strict=False)),
        MadeFigure(
            "slider.play",
            "play of the slider on each side",
            "mm",
            0.0,
            params.play,
            play,
            play - spread,
            play + spread,
            "less what stays on rail and slider",
        ),
    ]
    jammed = stuck("slider.as-made", [*turning.values()], "pin", sizes.pin)
    found = (*_jammed(params.play, play - spread), *jammed)
    return AsMade(tuple(figures), tuple(one.curve("crank") for one in errors), found)


def _guide(table: Mechanism, made: Mapping[str, Sequence[MadePart]]) -> tuple[float, float]:
    """Play of the slider on each side as made, and how far the path may change it, mm."""
    wider = 0.0
    corridor = 0.0
    for name in ("slider", "rail"):
        part, drawn = made[name][0], layout_of(table).outlines[name].bounds
        _, low, _, high = shapely.bounds(part.outline.polygon()).tolist()
        wider += ((high - low) - (drawn[3] - drawn[1])) / 2
        corridor += part.corridor
    return table.given.play - wider, corridor


def _jammed(given: float, least: float) -> list[Finding]:
    if least > 0:
        return []
    better = np.ceil((given - least) * 1e3 + 1) / 1e3
    return [
        Finding(
            "slider.as-made",
            Severity.ERROR,
            "play",
            f"as made the slider jams in its guide: {-least:.4f} mm are lacking on each side",
            least,
            0.0,
            "mm",
            f"make play {better:g}: on these walls that leaves {least + better - given:.4f} mm",
            Stage.MACHINING,
        )
    ]

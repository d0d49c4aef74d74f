"""What a slider-crank of plates as made does: error of the slider, and its play in the guide.

With β the rod's angle to the slide, φ' the crank's:

    dx/dc = 1/cos β,  dx/da = cos(φ' - β)/cos β,  dx/de = -tan β;

each of the three pins that stands off its bore by ρ adds at most ρ/|cos β|, and the play of the slider acts
as an offset e.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import shapely

from mechwright import Array, AsMade, Finding, MadeCurve, MadeFigure, MadePart, Severity, Stage
from mechwright.mechanics.linkage.made import Hole, Joint, joint, link, stuck
from mechwright_slider_crank.course import course_of
from mechwright_slider_crank.kinematics import SliderCrank
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.plates import layout_of
from mechwright_slider_crank.sizes import sizes_of

SAMPLES = 361


def slide_rates(bar: SliderCrank, phi: Array) -> dict[str, Array]:
    """Change (n,) of the slide position, mm/mm, with crank, rod and offset, and with any pin that is off."""
    angle = phi - bar.direction
    t = bar.offset - bar.crank * np.sin(angle)
    cos = bar.branch * np.sqrt(bar.rod**2 - t * t) / bar.rod
    sin = t / bar.rod
    return {
        "crank": (np.cos(angle) * cos + np.sin(angle) * sin) / cos,
        "rod": 1 / cos,
        "offset": -sin / cos,
        "pin": 1 / np.abs(cos),
    }


def as_made(params: SliderCrankParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    if not {"base", "rail", "crank", "rod", "slider"} <= set(made):
        return AsMade()
    sizes = sizes_of(params)
    crank, rod, base = (made[name][0] for name in ("crank", "rod", "base"))
    ends = [Hole(0j, sizes.rod_bore), Hole(complex(params.rod), sizes.rod_bore)]
    links = {
        "crank": link(crank, Hole(0j, sizes.shaft), Hole(complex(params.crank), sizes.pin)),
        "rod": link(rod, *ends),
    }
    if params.bushing > 0:  # the bushings' own fit is not the program's
        pins: list[Joint | None] = []
    else:
        pins = [
            joint("crank pin", rod, ends[0], sizes.pin),
            joint("wrist pin", rod, ends[1], sizes.pin),
            joint("shaft", base, Hole(0j, sizes.base_bore), sizes.shaft),
        ]
    phi = np.sort(course_of(params).way(SAMPLES))
    rates = slide_rates(params.linkage, phi)
    sure = {name: one for name, one in links.items() if one is not None}
    turning = [one for one in pins if one is not None]
    play, spread = _guide(params, made)
    still = np.abs(np.sum([rates[name] * one.off for name, one in sure.items()], axis=0))
    room = sum(max(one.room, 0.0) for one in turning)
    off = still + rates["pin"] * room + np.abs(rates["offset"]) * max(play, 0.0)
    more = np.sum([np.abs(rates[name]) * one.spread for name, one in sure.items()], axis=0)
    more = more + rates["pin"] * sum(one.spread for one in turning) + np.abs(rates["offset"]) * spread
    figures = (
        MadeFigure(
            "slider.error",
            "greatest error of the slider along its guide",
            "mm",
            None,
            float((np.abs(rates["offset"]) * params.play).max()),
            float(off.max()),
            float(still.max()),
            float((off + more).max()),
            "Σ ρ/|cos β| + play |tan β| + |Σ (∂x/∂l) Δl|; least: all centred"
            + ("; bushings without play" if params.bushing > 0 else ""),
        ),
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
    )
    curve = MadeCurve(
        "Error of the slider",
        "crank, degrees",
        "mm",
        np.degrees(phi),
        {"as drawn": np.abs(rates["offset"]) * params.play, "as made": off, "over the path": off + more},
    )
    found = [*_jammed(params, play - spread), *stuck("slider.as-made", turning, "pin", sizes.pin)]
    return AsMade(figures, (curve,), tuple(found))


def _guide(params: SliderCrankParams, made: Mapping[str, Sequence[MadePart]]) -> tuple[float, float]:
    """Play of the slider on each side as made, and how far the path may change it, mm."""
    wider = 0.0
    corridor = 0.0
    for name in ("slider", "rail"):
        part, drawn = made[name][0], layout_of(params).outlines[name].bounds
        _, low, _, high = shapely.bounds(part.outline.polygon()).tolist()
        wider += ((high - low) - (drawn[3] - drawn[1])) / 2
        corridor += part.corridor
    return params.play - wider, corridor


def _jammed(params: SliderCrankParams, least: float) -> list[Finding]:
    if least > 0:
        return []
    better = np.ceil((params.play - least) * 1e3 + 1) / 1e3
    return [
        Finding(
            "slider.as-made",
            Severity.ERROR,
            "play",
            f"as made the slider jams in its guide: {-least:.4f} mm are lacking on each side",
            least,
            0.0,
            "mm",
            f"make play {better:g}: on these walls that leaves {least + better - params.play:.4f} mm",
            Stage.MACHINING,
        )
    ]

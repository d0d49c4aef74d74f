"""What a four-bar of plates as made does: error of the follower and of the coupler point."""

from collections.abc import Mapping, Sequence

from mechwright import AsMade, MadePart
from mechwright.mechanics.linkage.made import Hole, MadeLink, joint, link, offset, stuck
from mechwright.mechanics.linkage.made_error import EXACT, made_errors, room_figure
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import slotted
from mechwright_four_bar.parts.plates import bosses_of, joints_of, posts_of
from mechwright_four_bar.tolerances import FourBarTolerances, lined_up

RULE = "(Σ ρ) / |N| + |Σ (∂/∂l) Δl|, every pin standing off in the worst direction; least: pins centred"


def as_made(params: FourBarParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    bosses = bosses_of(params)
    if not set(bosses) <= set(made) or slotted(params, "A") or slotted(params, "B"):
        return AsMade()  # where A or B is clamped, how well it is set says more than how it is made
    holes = {
        name: [Hole(boss.centre, boss.bore) for boss in own if boss.tag in ("A0", "A", "B", "B0")]
        for name, own in bosses.items()
    }
    links = {name: link(made[name][0], *own) for name, own in holes.items() if len(own) == 2}
    bushed = params.running_fit if params.bushing_wall > 0 else None
    turning = {"A0": ("ground", 0), "A": ("coupler", 0), "B": ("coupler", 1), "B0": ("follower", 0)}
    if "ground-2" in holes:
        turning["B0"] = ("ground-2", 0)
        links["ground"] = _between(params, made, holes["ground"][0], holes["ground-2"][0])
    joints = {
        name: joint(shown, made[plate][0], holes[plate][end], params.pin_diameter, bushed)
        for name, (shown, (plate, end)) in zip(joints_of(params), turning.items(), strict=True)
    }
    sure = {name: one for name, one in links.items() if one is not None}
    pins = {name: one for name, one in joints.items() if one is not None}
    if len(sure) < len(links) or len(pins) < len(joints):
        return AsMade()
    drawn = dict.fromkeys(pins, params.running_fit / 2)
    # Where all links line up, no error is in proportion to what is off.
    errors = [] if lined_up(params) else made_errors(FourBarTolerances(params, EXACT), sure, pins, drawn)
    figures = [
        one.figure(name, RULE) for one, name in zip(errors, ("follower.error", "point.error"), strict=False)
    ]
    figures.append(
        room_figure([*pins.values()], params.running_fit, "; that of the bushings" if bushed else "")
    )
    jammed = stuck("four-bar.as-made", list(pins.values()), "running_fit", params.running_fit)
    return AsMade(tuple(figures), tuple(one.curve("crank") for one in errors), tuple(jammed))


def _between(
    params: FourBarParams, made: Mapping[str, Sequence[MadePart]], one: Hole, two: Hole
) -> MadeLink | None:
    """The distance of A0 and B0 in two plates that four bolts bring in line."""
    screws = [Hole(at, params.screw_hole or params.pin_diameter) for at in posts_of(params).values()]
    ends = offset(made["ground"][0], one, screws, 1 + 0j), offset(made["ground-2"][0], two, screws, 1 + 0j)
    if ends[0] is None or ends[1] is None:
        return None
    return MadeLink(ends[1].off - ends[0].off, ends[0].spread + ends[1].spread)

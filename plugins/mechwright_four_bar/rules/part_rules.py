"""Rules of the parts: bores, bend, places of phases, layers."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from mechwright import Finding, GeometryError, Stage
from mechwright.contracts.design_table import column
from mechwright.contracts.finding import at_stage
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.linkage.clamp_findings import no_clamp, too_near
from mechwright.mechanics.linkage.parts.layout import TRIED
from mechwright.mechanics.linkage.rules.part_rules import bushing_rule, least_wall, part_notes
from mechwright.mechanics.linkage.setting_findings import Places
from mechwright.mechanics.linkage.usual import told
from mechwright.tolerances import falls_short
from mechwright_four_bar.parts.layout import bend_fault, hidden_point, layout_or_bare
from mechwright_four_bar.parts.phases import clamp_of_design, set_joints, slotted
from mechwright_four_bar.parts.usual import USUAL, turning_bore
from mechwright_four_bar.rules.motion_rules import Proc, Rule, above
from mechwright_four_bar.table import FourBarTable


class Pair(NamedTuple):
    """Two bores of a plate: whether one is the coupler point's, their distance, and the least one, mm."""

    plate: str
    point: bool
    distance: Any
    needed: Any


def pairs_of(t: FourBarTable, sides: int) -> list[Pair]:
    """The bores that share a plate, with ground plates on that many sides; those of other phases left out."""
    params, turning = t.params, turning_bore(t.params)
    pin, rim, one = params.pin_diameter, params.rim, sides == 1
    slot = {name: bool(params.phases) and slotted(params, name) for name in "AB"}
    end = {name: turning if slot[name] else pin for name in "AB"}
    found = [Pair("ground", False, params.ground, (turning + pin) / 2 + rim)] if one else []
    found.append(Pair("crank", False, params.crank, (pin + end["A"]) / 2 + rim))
    if not any(slot.values()):
        found.append(Pair("coupler", False, params.coupler, turning + rim))
    if params.coupler_point is not None:
        for name, at in (("A", 0.0), ("B", params.coupler)):
            if not slot[name]:
                away = np.abs(params.coupler_point - at)
                found.append(Pair("coupler", True, away, (turning + pin) / 2 + rim))
    found.append(Pair("follower", False, params.follower, ((turning if one else pin) + end["B"]) / 2 + rim))
    return found


def _first(t: FourBarTable) -> list[Pair]:
    """The pairs of plates that are there on any number of sides, as they are on those tried first."""
    found = [pairs_of(t, sides) for sides in TRIED[t.params.frame]]
    return [one for one in found[0] if all(one.plate in {other.plate for other in way} for way in found)]


def _least(t: FourBarTable) -> list[Any]:
    """What they need at least on any number of sides, mm."""
    plates = {one.plate for one in _first(t)}
    return [one.needed for one in pairs_of(t, TRIED[t.params.frame][-1]) if one.plate in plates]


def _stacked(t: FourBarTable, values: Sequence[Any]) -> Any:
    return np.concatenate([column(one, t.size) for one in values], axis=1)


def _message(plate: str, distance: float, rim: float) -> str:
    return f"the bores of the {plate} are {distance:.4g} mm apart and leave less than the rim of {rim:g} mm"


def _remedy(one: Pair) -> str:
    if one.point:
        return f"move the point at least {above(one.needed)} mm from A and B, or take smaller pins"
    return f"make {one.plate} at least {above(one.needed)}, or take smaller pins, bushings or rims"


BORES = Rule(
    "four-bar.bores",
    lambda f: "coupler_point_x" if _first(f.m)[f.item].point else _first(f.m)[f.item].plate,
    lambda f: _message(_first(f.m)[f.item].plate, f.value, f.m.params.rim),
    value=lambda t: _stacked(t, [one.distance for one in _first(t)]),
    limit=lambda t: _stacked(t, _least(t)),
    unit="mm",
    remedy=lambda f: _remedy(_first(f.m)[f.item]),
    reported=lambda f: (f.value, float(_first(f.m)[f.item].needed)),
)


def _plain(t: FourBarTable) -> Any:
    """Which designs have a layout without a doubt.

    With two ground plates the layers ground, crank, coupler, follower, second ground hold every pin between
    neighbours, and the posts stand outside of all that moves.
    """
    return (
        np.asarray(t.params.coupler_bend) == 0 if not t.params.phases and t.params.frame != "one" else False
    )


def _in_doubt(t: FourBarTable) -> Any:
    """Which designs may have bores that are too near to each other on as many sides as their layout has."""
    if t.params.frame == "two":
        return False
    short = {one.plate: falls_short(one.distance, one.needed) for one in pairs_of(t, 1)}
    own = np.asarray(short["follower"]) & ~np.asarray(short["ground"])
    return np.where(_plain(t), own, np.asarray(short["follower"]) | short["ground"])


def _crowded(m: FourBarTable) -> Iterator[Finding]:
    """Bores that are too near to each other on as many sides as the layout has."""
    for one in pairs_of(m, layout_or_bare(m).scheme.sides):
        if falls_short(one.distance, one.needed):
            key = "coupler_point_x" if one.point else one.plate
            said = _message(one.plate, one.distance, m.params.rim)
            yield Finding.error(
                "four-bar.bores", key, said, float(one.distance), float(one.needed), "mm", _remedy(one),
                Stage.PARTS,
            )  # fmt: skip


def _bend(m: FourBarTable) -> Iterator[Finding]:
    if said := bend_fault(m):
        yield Finding.error(
            "four-bar.bend",
            "coupler_bend",
            said,
            m.params.coupler_bend,
            unit="mm",
            remedy="make coupler_bend or web_width smaller, or rim larger",
            stage=Stage.PARTS,
        )


def _places(m: FourBarTable) -> Iterator[Finding]:
    """Whether holes, slots and the point of several phases leave material between them in the coupler."""
    params = m.params
    ways, pin = set_joints(params), params.pin_diameter
    places = Places((ways["A"], ways["B"]), params.coupler_point, turning_bore(params), pin)
    if clamp_of_design(params) is None and places.slotted:
        yield replace(no_clamp("four-bar.phases", pin, params.thickness), stage=Stage.PARTS)
    elif falls_short(places.nearest.land, params.rim):
        yield replace(too_near("four-bar.phases", places.nearest, params.rim, pin), stage=Stage.PARTS)


def _layers(m: FourBarTable) -> Iterator[Finding]:
    try:
        m.layout  # noqa: B018 - it raises
    except GeometryError as error:
        two = m.of(m.params.model_copy(update={"frame": "two"})).layout_or_none is not None
        remedy = "make pins, rims, webs or clearance smaller, or bend the coupler"
        yield Finding.error(
            "four-bar.layers",
            "frame",
            str(error),
            remedy='set frame = "two"' if two else remedy,
            stage=Stage.PARTS,
        )


def _sizes(m: FourBarTable) -> list[Finding]:
    return at_stage(Stage.PARTS, told("four-bar.sizes", USUAL, m.params))


def _hidden(m: FourBarTable) -> Iterator[Finding]:
    if hidden := hidden_point(m):
        yield Finding.warning(
            "four-bar.point",
            "coupler_point_x",
            f"over a turn the coupler point comes under the {hidden[0]} and over the {hidden[1]}: a tool in "
            "it has no way out of its own layer",
            remedy="work with it between the plates, or cut a window along its path into one of them",
            stage=Stage.PARTS,
        )


PARTS = in_turn(
    bushing_rule("four-bar").but(reported=lambda f: (f.m.params.bushing_wall, least_wall(f.m))),
    all_of(
        BORES,
        Proc(
            ("four-bar.bend",),
            _bend,
            when=lambda t: (np.asarray(t.params.coupler_bend) != 0) | bool(t.params.phases),
            stage=Stage.PARTS,
        ),
    ),
    Proc(("four-bar.bores",), _crowded, when=_in_doubt, stage=Stage.PARTS),
    Proc(("four-bar.phases",), _places, when=lambda t: bool(t.params.phases), stage=Stage.PARTS),
    Proc(
        ("four-bar.layers",),
        _layers,
        when=lambda t: t.single or ~np.asarray(_plain(t)),
        stage=Stage.PARTS,
    ),
    Proc(("four-bar.sizes",), _sizes, when=lambda t: t.single, stage=Stage.PARTS),
    part_notes("four-bar"),
    Proc(("four-bar.point",), _hidden, when=lambda t: t.single, stage=Stage.PARTS),
)
"""In order."""

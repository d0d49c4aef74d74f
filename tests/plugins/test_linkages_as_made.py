"""Linkages as made: sensitivities against the reference, the plates of the examples, and pins that do not fit."""

from dataclasses import replace

import numpy as np
import pytest
from as_made_builds import built, example, facts, table
from by_night import by_night

from mechwright.contracts.finding import Severity
from mechwright.contracts.made_part import MadeHole
from mechwright.mechanics.linkage.made import Hole, Joint, MadeLink, joint, link, stuck
from mechwright.mechanics.linkage.made_error import EXACT, made_errors
from mechwright_cam.pages.as_made.plot import plot
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.tolerances import FourBarTolerances
from mechwright_four_bar.table import FourBarTable
from mechwright_slider_crank.as_made.plates import as_made as slider_as_made
from mechwright_slider_crank.as_made.tolerances import SliderCrankTolerances
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.table import SliderCrankTable
from mechwright_spherical.as_made.tolerances import SphericalTolerances
from mechwright_spherical.parameters import SphericalParams

TURN = np.linspace(0, 2 * np.pi, 36001)
LINKS = ("crank", "coupler", "follower", "ground")
F1 = dict(
    zip(LINKS, (29.9864888895368, 79.98996674541814, 69.99688382152353, 89.99472798474908), strict=True)
)
F2 = dict(zip(LINKS, (25.0, 60.0, 50.0, 70.0), strict=True))
S1 = {"crank": 51.23710482942299, "rod": 113.28305527097054, "offset": 50.0}
S2 = {"crank": 50.0, "rod": 150.0, "offset": 0.0}
ARCS = ("ground", "input", "coupler", "output")
H1 = dict(zip(ARCS, (80.0, 30.0, 70.0, 60.0), strict=True))
H2 = dict(zip(ARCS, (90.0, 25.0, 80.0, 75.0), strict=True))


def four_bar(sizes):
    return FourBarTolerances(FourBarTable.of(FourBarParams(**sizes)), EXACT)


def slider(sizes):
    return SliderCrankTolerances(SliderCrankTable.of(SliderCrankParams(**sizes)), EXACT)


def spherical(arcs):
    return SphericalTolerances(SphericalParams(kind="four-bar", radius=60, four_bar=arcs), EXACT)


def fact_of(name, design):
    (fact,) = [f for f in facts(name) if f["inputs"]["design"] == design]
    return pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize(
    ("name", "design", "model", "off"),
    [
        ("four-bar.worst_case", "F1", four_bar(F1), 0.02),
        ("four-bar.worst_case", "F2", four_bar(F2), 0.02),
        ("slider-crank.worst_case", "S1", slider(S1), 0.02),
        ("slider-crank.worst_case", "S2", slider(S2), 0.02),
        ("spherical.worst_case", "H1", spherical(H1), np.radians(0.02)),
        ("spherical.worst_case", "H2", spherical(H2), np.radians(0.02)),
    ],
)
def test_worst_cases_are_the_reference(name, design, model, off):
    model.positions = TURN
    known = {one.name: one for one in model.contributors}
    pins = {one: Joint(one, 0.01, 0.0) for one in known if known[one].directions == 2}
    links = {one: MadeLink(0.0, off) for one in {*LINKS, *S1, *ARCS} & set(known)}
    error, *_ = made_errors(model, links, pins, dict.fromkeys(pins, 0.01))
    assert error.most.max() == fact_of(name, design)
    assert error.drawn.max() == pytest.approx(error.made.max())
    if design.startswith("F"):
        assert error.made.max() == fact_of("four-bar.pins_only", design)
    figure = error.figure("any", "rule")
    assert figure.high == pytest.approx(error.most.max() * (1.0 if error.output.unit == "mm" else 1e6))
    assert figure.low == 0


def test_errors_of_a_coupler_point_are_differences_of_positions():
    point, phi, off = 30 + 20j, np.array([0.4, 2.0, 4.5]), 1e-4

    def where(sizes):
        loop = close(FourBar(*sizes.values()), phi)
        return loop.joint_a + point * loop.coupler.direction

    model = four_bar(F1 | {"coupler_point_x": 30, "coupler_point_y": 20})
    model.positions = phi
    both = {"crank": MadeLink(off, 0.0), "follower": MadeLink(-2 * off, 0.0)}
    _, error = made_errors(model, both, {}, {})
    longer, shorter = (
        where(F1 | {"crank": F1["crank"] + s * off, "follower": F1["follower"] - 2 * s * off})
        for s in (1, -1)
    )
    assert error.centred == pytest.approx(np.abs(longer - shorter) / 2, rel=1e-6)
    # A pin at A in its worst direction is the farthest of all round.
    _, error = made_errors(model, {}, {"pin-a": Joint("A", off, 0.0)}, {})
    (rate,) = (
        row
        for one, row in zip(model.contributors, model.sensitivities("coupler point", phi), strict=True)
        if one.name == "pin-a"
    )
    turn = np.linspace(0, 2 * np.pi, 3601)
    moved = np.einsum("cmn,mk->ckn", rate, off * np.array([np.cos(turn), np.sin(turn)]))
    assert error.made == pytest.approx(np.hypot(*moved).max(axis=0), rel=1e-6)


class Bored:
    """A plate whose bores are as drawn."""

    corridor = 0.0

    def hole_at(self, x, y, diameter):
        return MadeHole(x, y, diameter, diameter, 0.0)


def test_where_links_line_up_the_play_alone_is_told(monkeypatch):
    slide = SliderCrankParams(crank=40, rod=40, offset=0, bushing=0)
    plates = {name: [Bored()] for name in ("base", "rail", "crank", "rod", "slider")}
    monkeypatch.setattr("mechwright_slider_crank.as_made.plates._guide", lambda *_: (0.05, 0.0))
    assert [one.name for one in slider_as_made(SliderCrankTable.of(slide), plates).figures] == ["slider.play"]


@pytest.mark.parametrize(
    ("name", "figures"),
    [
        ("crank-rocker-three-poles", {"follower.error", "pin.room"}),
        pytest.param("double-crank", {"follower.error", "pin.room"}, marks=by_night),
        ("slider-crank-quick-return", {"slider.error", "point.error", "slider.play"}),
        pytest.param("spherical-crank-rocker", {"output.error", "point.error", "pin.room"}, marks=by_night),
        pytest.param("spherical-double-crank", {"output.error", "pin.room"}, marks=by_night),
        ("spherical-five-bar-refined", {"point.error", "pin.room"}),
    ],
)
def test_the_plates_of_the_examples_are_judged(name, figures):
    _, said, _ = example(name)
    found = {figure.name: figure for figure in said.figures}
    assert figures <= set(found)
    assert not said.findings
    for figure in said.figures:
        assert figure.low <= figure.made <= figure.high
    (curve, *_) = said.curves
    assert all(np.isfinite(line).all() for line in curve.lines.values())
    assert plot(curve).count("<path") > 5


def test_a_slider_and_pins_that_do_not_fit_are_refused():
    parts, _, params = example("slider-crank-quick-return")
    made = {part.name: [replace(part, corridor=0.03)] for part in parts}
    (jammed,) = slider_as_made(SliderCrankTable.of(params), made).findings
    assert (jammed.severity, jammed.parameter) == (Severity.ERROR, "play")
    better = params.model_copy(update={"play": float(jammed.remedy.split()[2].rstrip(":"))})
    rail = {name: [replace(part, corridor=0.03)] for name, (part,) in made.items()}
    assert not slider_as_made(SliderCrankTable.of(better), rail).findings


def test_pins_that_do_not_turn_in_reamed_bores_are_refused(tmp_path):
    path = tmp_path / "bar.toml"
    path.write_text(table("four-bar", bushing_wall=0.0, running_fit=0.005))
    _, said, _ = built(path)
    (stays,) = said.findings
    assert (stays.severity, stays.parameter) == (Severity.ERROR, "running_fit")
    assert "does not turn in its bore" in stays.message
    path = tmp_path / "better.toml"
    better = float(stays.remedy.split()[2].rstrip(":"))
    path.write_text(table("four-bar", bushing_wall=0.0, running_fit=better))
    assert not built(path)[1].findings


def test_holes_of_a_plate_and_their_distance():
    parts, _, params = example("crank-rocker-three-poles")
    crank = next(part for part in parts if part.name == "crank")
    holes = Hole(0j, params.pin_diameter), Hole(complex(params.crank), params.pin_diameter)
    found = link(crank, *holes)
    assert abs(found.off) < 2e-4
    assert found.spread == 2 * crank.corridor
    assert link(crank, holes[0], Hole(500j, 6.0)) is None
    room = joint("A", crank, holes[0], params.pin_diameter - 0.05)
    assert room.room == pytest.approx(0.025 - np.median(crank.off), abs=1e-3)
    assert not stuck("x", [room], "fit", 0.05)
    (finding,) = stuck("x", [Joint("A", 0.001, 0.004)], "fit", 0.01)
    assert finding.remedy.startswith("make fit 0.017:")

"""Linkages as made: sensitivities against the reference, the plates of the examples, and pins that do not fit."""

from dataclasses import replace

import numpy as np
import pytest
from as_made_builds import built, example, facts, table

from mechwright.contracts.finding import Severity
from mechwright.mechanics.linkage.made import Hole, Joint, joint, link, stuck
from mechwright_cam.pages.as_made.plot import plot
from mechwright_four_bar.as_made import output_rates, point_rates
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_slider_crank.as_made import as_made as slider_as_made
from mechwright_slider_crank.as_made import slide_rates
from mechwright_slider_crank.kinematics import SliderCrank
from mechwright_spherical.as_made import output_rates as spherical_rates
from mechwright_spherical.linkage import linkage_of
from mechwright_spherical.params import FourBarTable, SphericalParams

TURN = np.linspace(0, 2 * np.pi, 36001)
BARS = {
    "F1": FourBar(29.9864888895368, 79.98996674541814, 69.99688382152353, 89.99472798474908),
    "F2": FourBar(25.0, 60.0, 50.0, 70.0),
}
SLIDERS = {
    "S1": SliderCrank(51.23710482942299, 113.28305527097054, 50.0),
    "S2": SliderCrank(50.0, 150.0, 0.0),
}
LINKS = ("crank", "coupler", "follower", "ground")


@pytest.mark.parametrize("fact", facts("four-bar.dpsi_d"), ids=lambda f: f"{f['name']}-{f['inputs']}")
def test_sensitivities_of_the_follower(fact):
    given = fact["inputs"]
    rates = output_rates(FourBar(*(given[name] for name in LINKS)), np.array([given["theta"]]))
    assert rates[fact["name"].split("_d")[1]][0] == pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize("name", BARS)
def test_worst_case_of_the_follower(name):
    rates = output_rates(BARS[name], TURN)
    pins = 4 * 0.01 * rates["pin"]
    links = 0.02 * sum(np.abs(rates[link]) for link in LINKS)
    found = {"worst_case": (pins + links).max(), "pins_only": pins.max()}
    for kind, value in found.items():
        (fact,) = [f for f in facts(f"four-bar.{kind}") if f["inputs"]["design"] == name]
        assert value == pytest.approx(fact["expected"], abs=fact["tolerance"])


def test_sensitivities_of_a_coupler_point_are_differences_of_positions():
    bar, point, phi, h = BARS["F1"], 30 + 20j, np.array([0.4, 2.0, 4.5]), 1e-5

    def where(one):
        loop = close(one, phi)
        return loop.joint_a + point * loop.coupler.direction

    rates = point_rates(bar, point, phi)
    for name in LINKS:
        longer, shorter = (replace(bar, **{name: getattr(bar, name) + s * h}) for s in (1, -1))
        assert rates[name] == pytest.approx(np.abs(where(longer) - where(shorter)) / (2 * h), rel=1e-6)
    assert (rates["pin-a"] >= 1).any()
    # A pin at B acts as an error of the coupler's length does at the most, seen along the follower.
    assert (rates["pin-b"] >= rates["follower"] - 1e-12).all()


@pytest.mark.parametrize("fact", facts("slider-crank.dx_d"), ids=lambda f: f"{f['name']}-{f['inputs']}")
def test_sensitivities_of_the_slider(fact):
    given = fact["inputs"]
    bar = SliderCrank(given["crank"], given["rod"], given["offset"])
    rates = slide_rates(bar, np.array([given["theta"]]))
    assert rates[fact["name"].split("_d")[1]][0] == pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize("name", SLIDERS)
def test_worst_case_of_the_slider(name):
    rates = slide_rates(SLIDERS[name], TURN)
    worst = 3 * 0.01 * rates["pin"] + 0.02 * sum(np.abs(rates[one]) for one in ("crank", "rod", "offset"))
    (fact,) = [f for f in facts("slider-crank.worst") if f["inputs"]["design"] == name]
    assert worst.max() == pytest.approx(fact["expected"], abs=fact["tolerance"])


def spherical(ground, input_, coupler, output, start, travel):
    four_bar = FourBarTable(
        ground=ground, input=input_, coupler=coupler, output=output, start=start, travel=travel
    )
    return linkage_of(SphericalParams(kind="four-bar", four_bar=four_bar)).shown


@pytest.mark.parametrize("fact", facts("spherical.dpsi_d"), ids=lambda f: f"{f['name']}-{f['inputs']}")
def test_sensitivities_of_the_spherical_output(fact):
    given = fact["inputs"]
    arcs = [given[f"{name}_deg"] for name in ("ground", "input", "coupler", "output")]
    phase = spherical(*arcs, np.degrees(given["theta"]), 1.0)
    rates = spherical_rates(phase, np.radians(arcs[0]), 2)
    name = {"input": "crank", "output": "rocker"}.get(
        fact["name"].split("_d")[1], fact["name"].split("_d")[1]
    )
    assert rates[name][0] == pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize(("name", "arcs"), [("H1", (80, 30, 70, 60)), ("H2", (90, 25, 80, 75))])
def test_worst_case_of_the_spherical_output(name, arcs):
    rates = spherical_rates(spherical(*arcs, 0.0, 360.0), np.radians(arcs[0]), 3601)
    links = sum(np.abs(rates[one]) for one in ("ground", "crank", "coupler", "rocker"))
    worst = 4 * 0.01 / 60 * rates["pin"] + np.radians(0.02) * links
    (fact,) = [f for f in facts("spherical.worst") if f["inputs"]["design"] == name]
    assert worst.max() == pytest.approx(fact["expected"], abs=fact["tolerance"])


def test_the_plates_of_the_examples_are_judged():
    names = {
        "crank-rocker-three-poles": {"follower.error", "pin.room"},
        "double-crank": {"follower.error", "pin.room"},
        "slider-crank-quick-return": {"slider.error", "slider.play"},
        "spherical-crank-rocker": {"output.error", "pin.room"},
        "spherical-double-crank": {"output.error", "pin.room"},
        "spherical-five-bar-refined": {"output.error", "pin.room"},
    }
    for name, figures in names.items():
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
    (jammed,) = slider_as_made(params, made).findings
    assert (jammed.severity, jammed.parameter) == (Severity.ERROR, "play")
    better = params.model_copy(update={"play": float(jammed.remedy.split()[2].rstrip(":"))})
    rail = {name: [replace(part, corridor=0.03)] for name, (part,) in made.items()}
    assert not slider_as_made(better, rail).findings


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

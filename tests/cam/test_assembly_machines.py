"""The checker of an order of assembly over the machines and chains of the examples."""

from pathlib import Path

import pytest
from by_night import by_night
from cam.assembly_check import badly_pressed, falling, faults, loose, unreached
from manifold3d import Manifold

from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.assembly_order.inspections import order_findings
from mechwright_cad.assembly_order.plan import plan_of
from mechwright_cad.assembly_order.press import presses, support

EXAMPLES = Path(__file__).parents[2] / "examples"


MACHINES = [
    pytest.param(name, marks=by_night)
    for name in (
        "elliptic-pair-machine",
        "figure-eight-machine",
        "four-bar-machine",
        "slider-crank-machine",
        "geneva-machine",
        "spur-gears-machine",
        "five-bar-machine",
    )
]

SPHERICAL = ("spherical-five-bar-machine", "spherical-machine", "spherical-double-crank-machine")


@pytest.mark.parametrize("name", ["crank-rocker-finished", *MACHINES])
def test_parts_are_held_when_needed_screws_reached_and_presses_supported(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        found = plan_of(build)
    assert max(falling(found)) <= 1
    assert falling(found)[-1] == 0
    assert list(unreached(found)) == []
    assert list(badly_pressed(found)) == []
    assert faults(found) == []
    framed = name.endswith("machine")
    assert [one for one in order_findings(found, framed=framed) if one.severity != "note"] == []


@by_night
@pytest.mark.parametrize(
    "name", sorted(one.stem for one in (EXAMPLES / "chains").glob("*.toml") if "requirement" not in one.stem)
)
def test_screws_of_a_chain_are_reached_and_its_presses_supported(name):
    with Build(EXAMPLES / "chains" / f"{name}.toml", host(), Wanted("model")) as build:
        found = plan_of(build)
    assert [one for one in order_findings(found, framed=False) if one.severity != "note"] == []


@by_night
def test_a_shaft_that_stands_in_its_plate_bears_a_press_where_its_lower_end_can_be_reached(monkeypatch):
    with Build(EXAMPLES / "chains" / "geneva-behind-gears-machine.toml", host(), Wanted("model")) as build:
        order = plan_of(build).order
    step, match = next(
        (step, match)
        for step in order.steps
        for match in (presses(order, step) if step.way is not None else ())
        if match.hole in step.moved and support(order, step, match).bears == "end" and step.root == order.root
    )
    assert support(order, step, match).holds
    pin = order.standing.solid(match.pin)
    low = pin.bounding_box()[2]
    (x, y), solids = match.outside.at[:2], order.standing.solid
    block = Manifold.cube((40, 40, 10), center=True).translate((x, y, low - 20))
    plate = next(k for k in step.onto if k != match.pin)
    monkeypatch.setattr(order.standing, "solid", lambda k: block if k == plate else solids(k))
    assert not support(order, step, match).holds


@by_night
@pytest.mark.parametrize("name", SPHERICAL)
def test_spherical_machines_need_two_hands_at_no_step(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        found = plan_of(build)
    assert list(unreached(found)) == []
    assert list(badly_pressed(found)) == []
    assert [one for one in order_findings(found) if one.severity != "note"] == []


@by_night
def test_pillars_of_a_machine_are_fast_before_its_shafts_come():
    with Build(EXAMPLES / "elliptic-pair-machine.toml", host(), Wanted("model")) as build:
        found = plan_of(build)
    counts = loose(found)
    names = [{found.bodies[k].part.name for k in step.moved} for step in found.order.steps]
    first = next(k for k, those in enumerate(names) if any(n.startswith("shaft-") for n in those))
    assert counts[first - 1] == 0
    assert max(counts[:first]) <= 4

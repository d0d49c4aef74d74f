"""Bodies of machines and chains that touch nothing, and gaps that nobody declares."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from mechwright import Part
from mechwright.designs.change import changed
from mechwright.designs.design import design_of, load
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.bodies import bodies_of
from mechwright_cad.contacts.engaged import disengaged
from mechwright_cad.contacts.inspections import Contact, gap_findings, screw_findings
from mechwright_cad.contacts.screw_joints import joints_of
from mechwright_cad.contacts.touching import Gap, Touching
from mechwright_cad.contacts.vacant import vacancies

EXAMPLES = Path(__file__).parents[2] / "examples"
CHAINS = [one for one in sorted((EXAMPLES / "chains").glob("*.toml")) if not one.stem.endswith("requirement")]
MACHINES = [one for one in sorted(EXAMPLES.glob("*-machine.toml")) if "spherical" not in one.stem]


@pytest.mark.parametrize(
    "path", [*CHAINS, *MACHINES, EXAMPLES / "spherical-machine.toml"], ids=lambda one: one.stem
)
def test_every_body_of_a_machine_and_a_chain_touches_what_carries_it(path):
    with Build(path, host(), Wanted("check")) as build:
        assert Contact().findings(build) == []


def kinds(parts: Sequence[Part], build: Build) -> set[str]:
    motion = build.design.solve(2)
    bodies = bodies_of(parts, motion)
    touching, joints = Touching(bodies, motion, 0), joints_of(bodies, 0)
    found = {
        gap.kind for gap in (*touching.gaps(joints), *vacancies(touching, joints), *disengaged(touching))
    }
    return found | {finding.code for finding in screw_findings(bodies, joints)}


def planted(build: Build, name: str, lift: float | None) -> set[str]:
    """What is found where the first copy of a part is lifted, mm, or missing."""
    parts = []
    for part in build.parts:
        if part.name == name:
            one, *rest = part.instances
            moved = [] if lift is None else [replace(one, z=one.z + lift)]
            part = replace(part, instances=(*moved, *rest))
        parts += [part] if part.instances else []
    return kinds(parts, build)


@pytest.mark.parametrize(
    ("file", "name", "lift"),
    [
        ("chains/geneva-behind-gears", "shaft-out", 11.0),  # as it stood
        ("chains/geneva-behind-gears", "shaft-out", 1.0),
        ("chains/geneva-behind-gears", "shaft-1", 1.0),
        ("chains/geneva-behind-gears", "2-wheel", -1.0),
        ("chains/geneva-behind-gears", "2-locking-disc", 1.0),
        ("chains/geneva-behind-gears", "spacer-1", None),
        ("chains/geneva-behind-gears", "shaft-1", None),
        ("chains/sectors-behind-lever", "shaft-1", 1.0),
        ("chains/five-bar-behind-gears", "spacer-1", None),
        ("chains/geneva-behind-gears", "1-gear-2", None),
        ("chains/geneva-behind-gears", "1-gear-2", 1.0),  # into the spacer
        ("chains/slider-behind-gears", "2-rail", 0.3),  # as it stood
        ("geneva-machine", "shaft-wheel", 1.0),
        ("geneva-machine", "bearing-608", None),
        ("geneva-machine", "circlip-10", None),
        ("geneva-machine", "locking-disc", None),
        ("geneva-machine", "coupling", None),
        ("geneva-machine", "plain-pillar", None),
        ("geneva-machine", "screw-m3x8", None),
        ("geneva-machine", "foot", -1.0),
        ("elliptic-pair-machine", "shaft-4", -1.0),
        ("five-bar-machine", "clamp", -0.5),  # as it stood
        ("slider-crank-machine", "leg", None),
        ("four-bar-machine", "motor", -1.0),
    ],
)
def test_a_planted_fault_is_found(file, name, lift):
    with Build(EXAMPLES / f"{file}.toml", host(), Wanted("check")) as build:
        assert name in {part.name for part in build.parts}
        assert planted(build, name, lift)


def test_a_spacer_that_is_shorter_leaves_a_gap():
    with Build(EXAMPLES / "chains" / "geneva-behind-gears.toml", host(), Wanted("check")) as build:
        parts = [
            replace(
                one, build=None, turned=replace(one.turned, steps=(replace(one.turned.steps[0], length=0.8),))
            )
            if one.name == "spacer-1"
            else one
            for one in build.parts
        ]
        assert kinds(parts, build) == {"column"}


def test_a_mechanism_alone_has_its_shafts_elsewhere():
    with Build(EXAMPLES / "elliptic-pair.toml", host(), Wanted("check")) as build:
        assert Contact().findings(build) == ()


def test_the_pilot_of_a_stepper_is_shorter_than_its_plate():
    content = {
        "format": 1,
        "name": "stepper",
        "family": "four-bar",
        "parameters": {"screw_hole": 6},
        "machine": {"frame": "base", "motor": "NEMA 17 - 40"},
    }
    with Build(design_of(content, Path("x.toml"), "", host()), host(), Wanted("check")) as build:
        assert "motor" in {part.name for part in build.parts}
        assert Contact().findings(build) == []
        assert planted(build, "motor", -1.0)


@pytest.mark.parametrize(
    ("file", "changes"),
    [
        ("geneva-machine", {"parameters.driver_bore": 10.4}),  # no circlip has that size
        ("four-bar-machine", {"parameters.running_fit": 0.5}),  # the widest that is allowed
    ],
    ids=["geneva", "four-bar"],
)
def test_dimensions_that_are_allowed_raise_no_alarm(file, changes):
    path = EXAMPLES / f"{file}.toml"
    content = changed(load(path, host()).content, changes)
    with Build(design_of(content, path, "", host()), host(), Wanted("check")) as build:
        assert Contact().findings(build) == []


def test_a_floating_body_names_the_nearest_by_its_true_distance():
    """The box of the ground reached round the pin: it was called 0 mm away."""
    with Build(EXAMPLES / "spherical-machine.toml", host(), Wanted("check")) as build:
        motion = build.design.solve(2)
        bodies = bodies_of(build.parts, motion)
        touching = Touching(bodies, motion, 0)
        away = {
            m: touching.standing.distance(0, m) for m in range(1, len(bodies)) if touching.heights(m)[0] > 0
        }
        gap, nearest = touching._nearest(0, sorted(away, key=lambda m: touching._far(0, m)))
        assert (gap, nearest) == min((gap, m) for m, gap in away.items())


def test_a_vacancy_is_no_distance():
    (found,) = gap_findings([Gap("thread", "leg", "", 8.0, 0.0)])
    assert found.message == "a thread of leg, 8.000 mm deep, has no screw"


def test_a_spacer_ends_below_the_neck_of_a_slider_crank_with_a_circlip():
    content = {"format": 1, "name": "x", "stage": [{"family": "elliptic-gears"}, {"family": "slider-crank"}]}
    with Build(design_of(content, Path("x.toml"), "", host()), host(), Wanted("check")) as build:
        assert "2-circlip-6" in {part.name for part in build.parts}
        assert Contact().findings(build) == []

"""Shafts of machines are held axially without their coupling, rails by screws: parts, places and stacks."""

from pathlib import Path

import pytest

from mechwright.designs.design import design_of, load
from mechwright.machine.stack_inspection import stack_findings
from mechwright.plugins.host import host

EXAMPLES = Path(__file__).parents[2] / "examples"


def design(name, **changes):
    path = EXAMPLES / f"{name}.toml"
    content = load(path, host()).content
    parameters = {**content["parameters"], **changes}
    parameters = {key: value for key, value in parameters.items() if value is not None}
    return design_of({**content, "parameters": parameters}, path, "", host())


def parts_of(found):
    return {part.name: part for part in found.parts()}


@pytest.mark.parametrize("name", ["four-bar-machine", "slider-crank-machine", "figure-eight-machine"])
def test_every_stack_of_a_machine_closes(name):
    stacks = design(name).stacks
    assert stacks
    assert list(stack_findings(stacks)) == []
    assert len({one.name for one in stacks}) == len(stacks)


def test_a_circlip_under_the_ground_plate_holds_the_shaft_of_a_four_bar():
    found = design("four-bar-machine")
    parts, ground = parts_of(found), found.family.mounting(found.params)
    (ring,) = parts["circlip-6"].instances
    shaft = parts["shaft"]
    (groove,) = shaft.turned.grooves
    foot = shaft.instances[0].z
    assert ring.z == pytest.approx(foot + groove.at), "it stands on the lower wall, which is loaded"
    assert ring.z + 0.7 == pytest.approx(ground.low - 0.4)
    assert ground.low - ground.neck == pytest.approx(foot + groove.at - 0.45), "the edge under the groove"
    (stack,) = found.stacks
    # The crank lies on the bushing, 0.4 mm are left under the ground plate; crank ±0.1, bushing ±0.05.
    assert stack.nominal == pytest.approx(0.4)
    assert stack.worst == pytest.approx((0.25, 0.7))
    free = design("four-bar") if (EXAMPLES / "four-bar.toml").exists() else None
    if free is not None:
        assert not any(name.startswith("circlip") for name in parts_of(free))


def test_rails_are_screwed_on_the_base_from_below():
    found = design("slider-crank-machine")
    parts, motion = parts_of(found), found.solve(3)
    screws = parts["rail-screw"]
    assert screws.bought.designation == "ISO 4762 - M4 x 10 - 8.8"
    threads = [one for one in parts["rail"].details if one.diameter == 4]
    assert len(threads) == 2
    clear = [one for one in parts["base"].features if getattr(one, "diameter", 0) == 4.5]
    assert len(clear) == 4
    # Every screw stands in a hole of the base and under a thread of a rail.
    holes = {tuple(round(x, 6) for x in one.centre) for one in clear}
    base = motion.poses["base"]
    places = set()
    for at in screws.instances:
        x, y, _ = (motion.poses[at.body].position[1] - base.position[1]) @ base.rotation[1]
        places.add((round(float(x), 6), round(float(y), 6)))
    assert places == holes
    # Base and rail are 6 mm each: the screw ends where the rail does.
    assert {one.z for one in screws.instances} == {0.0}
    assert {one.z for one in parts["rail"].instances} == {6.0}


def test_discs_hold_the_gears_of_a_train_and_a_ring_its_input():
    parts = parts_of(design("figure-eight-machine"))
    coupler = parts["coupler"].instances[0].z
    for name, ring in (("4", "shim-12x18x1"), ("5", "shim-12x18x0_3")):
        disc, screw = parts[f"disc-{name}"], parts[f"disc-screw-{name}"]
        shaft = parts[f"shaft-{name}"]
        assert disc.instances[0].z == pytest.approx(shaft.instances[0].z + shaft.turned.length)
        assert parts[ring].instances[0].z == pytest.approx(24.0), "on the upper gear"
        head = screw.instances[0].z + 4.0
        assert head < coupler
        assert disc.turned.greatest > 16.0, "wider than the bore of a bush in its gear"
        (thread,) = shaft.turned.threads
        assert thread.end == "upper"
    (ring,) = parts["ring-2"].instances
    assert ring.z + 1.0 == pytest.approx(-20.0 - 0.6)
    assert parts["circlip-10"].instances[0].z + 1.0 == pytest.approx(ring.z)


def test_a_train_without_a_frame_and_one_with_a_low_coupler_have_no_discs():
    for changes in ({"phase_joint": None, "phases": None}, {"screw_hole": None}):
        content = design("figure-eight-machine").content
        parameters = {**content["parameters"], **changes}
        parameters = {key: value for key, value in parameters.items() if value is not None}
        bare = {**content, "parameters": parameters}
        del bare["machine"]
        found = design_of(bare, Path("x.toml"), "", host())
        assert not any(part.name.startswith("disc") for part in found.parts())
        if "screw_hole" in changes:
            assert found.stacks == ()

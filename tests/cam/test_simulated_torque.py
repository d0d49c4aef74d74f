"""Torque of the drive while MuJoCo runs the file, and what gravity, friction and play change in files."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from by_night import by_night
from mujoco_run import EXAMPLES, Case, example, rubbed

from mechwright import host
from mechwright.designs.design import load
from mechwright.errors import DesignError, GeometryError
from mechwright.machine import MachineSettings
from mechwright.machine.reactions import carried_of
from mechwright.pipeline import Build, Wanted
from mechwright_cad.exporters.simulation import mjcf, sdf, urdf
from mechwright_cad.exporters.simulation.bearings import bearings_of, pins_of
from mechwright_cad.exporters.simulation.settings import Options, SimulationSettings
from mechwright_cad.solid_models import Work, exporters_of

CLOSE = 0.01
"""Share of the greatest torque by which the simulated one may be off."""
FOUR_BAR = "crank-rocker-three-poles"


def case(name, up="none"):
    return Case.of(load(example(name), host()), up)


@pytest.mark.parametrize(
    ("name", "up"),
    [pytest.param(*one, marks=() if one[0] == FOUR_BAR else by_night) for one in EXAMPLES],
)
def test_the_simulated_torque_is_ours(name, up):
    for direction in (up,) if name == "rack-and-pinion" else ("none", up):
        one = case(name, direction)
        np.testing.assert_allclose(one.run(), one.ours, rtol=0, atol=CLOSE * np.abs(one.ours).max())


def test_friction_adds_the_torque_of_virtual_power():
    one = case(FOUR_BAR, "y")
    loss = rubbed(one, 0.5)
    assert np.abs(loss).max() > 10 * CLOSE * np.abs(one.ours).max()
    found = one.run(friction=0.5) - one.ours
    np.testing.assert_allclose(found, loss, rtol=0, atol=CLOSE * np.abs(one.ours).max())


def test_play_rattles_and_leaves_the_mean():
    one = case(FOUR_BAR, "y")
    found, ours, most = one.run(play=True), one.ours, np.abs(one.ours).max()
    assert np.sqrt(np.mean((found - ours) ** 2)) > CLOSE * most
    assert abs(np.mean(found - ours)) < CLOSE * most


def files(*, up="none", **wanted):
    """All three files of the four-bar, with gravity where something points up."""
    one = case(FOUR_BAR, up)
    rest = (
        exporter.assembly("f", one.parts, one.motion, 0, one.options(**wanted)) for exporter in (urdf, sdf)
    )
    return [text.decode() for text in (one.file(**wanted), *rest)]


@pytest.mark.parametrize("wanted", [{"up": "y"}, {"friction": 0.1}, {"play": True}])
def test_each_option_changes_each_file(wanted):
    for plain, changed in zip(files(), files(**wanted), strict=True):
        assert plain != changed


def test_gravity_is_said_or_told():
    mjcf, robot, world = files(up="y")
    assert '<option gravity="0 -9.80665 0"' in mjcf
    assert "<!-- left out: gravity of 0 -9.80665 0 m/s^2: it is the simulator's -->" in robot
    root = ElementTree.fromstring(world)  # noqa: S314 - our own
    assert root.find("world/gravity").text == "0 -9.80665 0"
    assert root.find("world/model/link") is not None


def test_friction_is_that_of_pins_and_what_they_carry():
    one = case(FOUR_BAR)
    found, pins = (
        bearings_of(one.parts, one.motion, one.options(friction=0.2)),
        pins_of(one.parts, one.motion),
    )
    double = bearings_of(one.parts, one.motion, one.options(friction=0.4))
    assert set(found.friction) == {"A0", "A", "B", "B0"} == set(pins)
    for name, value in found.friction.items():
        assert double.friction[name] == pytest.approx(2 * value)
        assert pins[name].radius == 3.0
    mjcf, robot, _ = files(friction=0.2)
    said = {
        joint.attrib["name"]: float(joint.attrib["frictionloss"])
        for joint in ElementTree.fromstring(mjcf).iter("joint")  # noqa: S314 - our own
        if "frictionloss" in joint.attrib
    }
    (loop,) = ElementTree.fromstring(mjcf).iter("fixed")  # noqa: S314 - our own
    said[loop.attrib["name"].removeprefix("friction-")] = float(loop.attrib["frictionloss"])
    assert said == pytest.approx(found.friction)
    assert "<!-- left out: friction of B: its loop is cut -->" in robot


def test_play_is_that_of_the_fits():
    """A hole of +0.02 to +0.032 on a pin h6, 0 to -0.008: 0.03 mm in the middle, half of it either way."""
    mjcf, robot, _ = files(play=True)
    assert len(re.findall(r'<spatial .*range="0 1.5e-05"', mjcf)) == 5  # two points of the pin that closes
    assert "<connect" not in mjcf
    assert "<!-- left out: play of B: 0.030 mm -->" in robot


def test_a_ball_bearing_has_its_own_friction():
    design = load(example("spur-gears-machine"), host())
    parts, motion = design.parts(), design.solve(361)
    pins, machine = pins_of(parts, motion), MachineSettings(speed=60.0)
    forces = carried_of(motion, parts, machine).forces
    found = bearings_of(parts, motion, Options(SimulationSettings(friction=0.2), machine)).friction
    assert set(found) == {"o1", "o2"}
    for name, value in found.items():
        assert pins[name].rolling
        assert value == pytest.approx(0.0015 * 0.005 * forces[name].mean())  # a bore of 10 mm


def test_a_slide_rubs_by_the_force_across_its_way():
    one = case("slider-crank-quick-return")
    force = carried_of(one.motion, one.parts, one.machine).forces["guide"]
    found = bearings_of(one.parts, one.motion, one.options(friction=0.2)).friction["guide"]
    assert found == pytest.approx(0.2 * force.mean())
    root = ElementTree.fromstring(one.file(friction=0.2))  # noqa: S314 - our own
    (slide,) = (joint for joint in root.iter("joint") if joint.get("name") == "guide")
    assert (slide.get("type"), float(slide.get("frictionloss"))) == ("slide", pytest.approx(found))


def test_a_roller_rubs_on_its_wall():
    design = load(example("geneva-straight"), host())
    parts, motion = design.parts(), design.solve(361)
    for friction, kind, said in ((0.0, "1", None), (0.2, "3", "0.2 0 0")):
        options = Options(SimulationSettings(friction=friction), MachineSettings(speed=60.0))
        root = ElementTree.fromstring(mjcf.assembly("g", parts, motion, 0, options))  # noqa: S314 - our own
        touching = [geom for geom in root.iter("geom") if geom.get("group") == "3"]
        assert touching
        assert {(geom.get("condim"), geom.get("friction")) for geom in touching} == {(kind, said)}


def written(tmp_path, tables, formats=("mjcf",)):
    path = tmp_path / "d.toml"
    path.write_text(example("spherical-crank-rocker").read_text() + tables)
    design = load(path, host())
    with Build(design, host(), Wanted("model", formats=formats)) as build:
        exporters = [one for one in exporters_of(host(), build.wanted) if one.name in formats]
        return Work(design, exporters, design.solve(2), 0).files()


def test_the_table_of_the_design_is_obeyed(tmp_path):
    plain = written(tmp_path, "")
    table = '\n[machine]\nup = "z"\n\n[simulation]\ngravity = true\n'
    (text,) = written(tmp_path, table).values()
    assert {text} != set(plain.values())
    assert b'gravity="0 0 -9.80665"' in text


def test_gravity_without_up_is_refused(tmp_path):
    with pytest.raises((DesignError, GeometryError)) as caught:
        written(tmp_path, "\n[simulation]\ngravity = true\n")
    assert str(caught.value).endswith(
        'simulation.gravity: nothing says which way is up; set machine.up = "y"'
    )


def test_friction_of_a_pin_that_closes_a_loop_on_a_sphere_is_told(tmp_path):
    (text,) = written(tmp_path, "\n[machine]\nspeed = 60\n\n[simulation]\nfriction = 0.1\n").values()
    assert b"<!-- left out: friction of c: it closes a loop of axes that are not parallel -->" in text

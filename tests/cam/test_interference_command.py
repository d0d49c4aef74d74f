"""The check as the command line and the testing kit run it."""

import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.geometry import Loop, Outline
from mechwright.plugins.host import host
from mechwright.testing import commands
from mechwright_cad.interference import check as module
from mechwright_cad.interference import interference, report, slabs, smooth_motion, surface

PAGE = Path(__file__).parents[2] / "docs" / "interference.md"
DESIGN = 'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\n'


@pytest.fixture
def design(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(DESIGN)
    return file


def twisted(family, params, samples, solve):
    """The pair with gear 4 two degrees ahead."""
    motion = solve(family, params, samples)
    ahead = Poses.planar(0, 0, np.full(samples, np.radians(2.0))).rotation
    gear = motion.poses["gear-4"]
    poses = {**motion.poses, "gear-4": Poses(gear.position, gear.rotation @ ahead)}
    return Motion(motion.input_name, motion.channels, poses, motion.scalars)


@pytest.fixture
def ahead(monkeypatch):
    """All pairs have gear 4 two degrees ahead."""
    family = type(host().family("elliptic-gears"))
    solve = family.solve
    monkeypatch.setattr(family, "solve", lambda self, params, samples: twisted(self, params, samples, solve))


@pytest.mark.parametrize(
    "command",
    [
        "check",
        pytest.param("cam", marks=by_night),
        pytest.param("model", marks=by_night),
        pytest.param("build", marks=by_night),
    ],
)
@pytest.mark.usefixtures("ahead")
def test_a_collision_stops_every_command_and_names_the_bodies(command, design, tmp_path, monkeypatch):
    monkeypatch.setattr(
        "mechwright_cad.solid_models.available_cores", lambda: 1
    )  # a second process would not be twisted
    folder = tmp_path / "out"
    words = [command, str(design)] + ([] if command == "check" else ["-o", str(folder)])
    done = CliRunner().invoke(make_app(), words)
    assert done.exit_code == 1
    assert re.search(
        r"error \[interference.collision\] gear-2 and gear-4 stand in each other, \d\.\d{3} mm deep at "
        r"theta2 = \d+\.\d{3} deg, near X.* Y.* Z5\.00; give them heights",
        done.output,
    )
    assert not folder.exists()


def test_the_elliptic_pair_is_clear(design):
    done = CliRunner().invoke(make_app(), ["check", str(design), "--figures"])
    assert done.exit_code == 0, done.output
    said = next(line for line in done.output.splitlines() if line.startswith("interference.clear"))
    assert "no two bodies collide over the whole motion (one pair compared)" in said


def test_the_kit_lists_collisions(tmp_path):
    file = {"format": 1, "family": "elliptic-gears", "parameters": {"teeth": 21}}
    assert commands.collisions(file, tmp_path, solids=False) == []
    assert commands.collisions(file, tmp_path, solids=True) == []
    with pytest.raises(AssertionError, match="'teeths'"):
        commands.collisions({**file, "parameters": {"teeths": 21}}, tmp_path, solids=False)


@pytest.mark.usefixtures("ahead")
@pytest.mark.parametrize("solids", [True, pytest.param(False, marks=by_night)])
def test_the_kit_tells_of_a_collision_once(solids, tmp_path):
    file = {"format": 1, "family": "elliptic-gears", "parameters": {"teeth": 21}}
    (told,) = commands.collisions(file, tmp_path, solids=solids)
    assert told.startswith("gear-2 and gear-4 stand in each other")


def test_samples_are_added_until_the_motion_is_smooth_between_them():
    asked = []

    class Jerky:
        def solve(self, params, samples):
            asked.append(samples)
            t = np.linspace(0, 2 * np.pi, samples)
            return Motion("t", {"t": Channel(t, "rad")}, {"a": Poses.planar(50 * np.sin(9 * t), 0.0, 9 * t)})

    motion = smooth_motion(partial(Jerky().solve, None), [])
    assert asked[0] == module.FEWEST_SAMPLES
    assert motion.samples == asked[-1] > module.FEWEST_SAMPLES
    # Half-way between two samples the cubic is as near as is promised.
    from mechwright_cad.interference.path import space_path

    poses = motion.poses["a"]
    path = space_path(poses.rotation, poses.position)
    middle = np.arange(2, motion.samples - 3) + 0.5
    t = middle / (motion.samples - 1) * 2 * np.pi
    assert np.abs(path.at(middle)[1][:, 0] - 50 * np.sin(9 * t)).max() < 2 * module.FAITHFUL


def test_at_most_five_collisions_are_printed_and_the_rest_counted():
    square = Outline(Loop.polygon([(0, 0), (9, 0), (9, 9), (0, 9)]))
    parts = [Part(f"p{i}", square, 2.0, "pom", (Instance("frame", 0.1 * i),)) for i in range(4)]
    still = Motion("t", {"t": Channel(np.linspace(0, 1, 5), "s")}, {"frame": Poses.planar(0, 0, np.zeros(5))})
    found = interference(parts, still)
    assert len(found.collisions) == 6
    printed = list(found.findings())
    assert len(printed) == report.MOST
    assert printed[-1].message.endswith("1 more pairs collide")
    depths = [hit.depth for hit in found.collisions]
    assert depths == sorted(depths, reverse=True)
    assert depths[0] == pytest.approx(1.9)


def test_the_page_lists_every_finding_and_the_limits():
    text = PAGE.read_text(encoding="utf-8")
    source = Path(report.__file__).read_text(encoding="utf-8")
    assert set(re.findall(r"\| `(interference\.[a-z]+)`", text)) == set(
        re.findall(r'"(interference\.[a-z]+)"', source)
    )
    assert f"| plates | up to {slabs.TOUCH:.3f} mm | deeper than {slabs.SURE_IN_PLAN:.3f} mm |" in text
    assert f"| solids | up to {surface.SKIN:.3f} mm | deeper than {surface.SURE_IN_SPACE:.3f} mm |" in text
    assert f"{module.FAITHFUL:g} mm, at most {module.MOST_SAMPLES} a turn" in text

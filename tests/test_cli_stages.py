"""Errors stop their own stage and the later ones: what `solve` writes of a design whose parts cannot be made."""

import json
import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from by_night import by_night

from mechwright.contracts.finding import Finding, Severity, Stage, errors, of_stage
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.remedies import Limits

Run = Callable[..., tuple[int, str, str]]
TRAIN = tomllib.loads((Path(__file__).parents[1] / "examples" / "figure-eight-train.toml").read_text())[
    "parameters"
]


@pytest.fixture
def run(command_line: Run, monkeypatch: pytest.MonkeyPatch) -> Run:
    """The command line; remedies are sought for a moment only, for they are not what is asked here."""
    monkeypatch.setattr(import_module("mechwright.remedies.remedied"), "CHECKED", Limits(tries=2))
    return command_line


HIDDEN = {
    "undercut of a pair": ("elliptic-gears", {"eccentricity": 0.9, "teeth": 25}, "gear.undercut"),
    "joints of a round train": ("elliptic-gears", TRAIN | {"eccentricity": 0.2}, "train.joint"),
    "undercut of a long train": ("elliptic-gears", TRAIN | {"eccentricity": 0.8}, "gear.undercut"),
    "a point off the coupler": ("elliptic-gears", {"stages": 2, "point_along": 1.5}, "point.off-coupler"),
    "bores of short links": (
        "four-bar",
        {"crank": 3, "coupler": 7, "follower": 8, "ground": 9, "pin_diameter": 6},
        "four-bar.bores",
    ),
    "bores of short links, other way round": (
        "four-bar",
        {"crank": 3, "coupler": 8, "follower": 7, "ground": 9, "pin_diameter": 6},
        "four-bar.bores",
    ),
    "web of a short crank": (
        "slider-crank",
        {"crank": 3, "rod": 10, "offset": 1, "pin": 2},
        "slider-crank.crank-web",
    ),
    "no order of layers": (
        "slider-crank",
        {"crank": 30, "rod": 41, "offset": 10, "rail_overhang": 8},
        "slider-crank.layers",
    ),
    "driver of eight straight slots": (
        "geneva",
        {"law": "straight", "slots": 8, "entry_radius": 100, "driver_bore": 30},
        "geneva.driver",
    ),
    "undercut slots": (
        "geneva",
        {"entry_radius": 100, "crank_half_angle": 50, "offset_angle": -10, "roller_radius": 10},
        "geneva.undercut",
    ),
    "mouths that overlap": (
        "geneva",
        {"entry_radius": 100, "crank_half_angle": 50, "offset_angle": 5, "roller_radius": 20},
        "geneva.mouth",
    ),
    "no length of the rollers": ("geneva", {"thickness": 2, "floor": 1.8}, "geneva.floor"),
    "pins too near on a small sphere": ("spherical", {"radius": 10}, "spherical.shafts"),
}
"""Design to its family, its parameters, and one of the errors that forbid its parts."""


def pages(family: str, parameters: Mapping[str, object]) -> list[str]:
    """The pages that a family adds to a motion."""
    if family == "elliptic-gears":
        return ["figure-eight.html"] if parameters.get("stages") == 2 else []
    return {"four-bar": ["poles.html"], "slider-crank": ["construction.html", "poles.html"]}.get(family, [])


def design(folder: Path, family: str, parameters: Mapping[str, object]) -> Path:
    path = folder / "d.toml"
    lines = [f"{name} = {json.dumps(value)}" for name, value in parameters.items()]
    path.write_text("\n".join(["format = 1", f'family = "{family}"', 'name = "d"', "[parameters]", *lines]))
    return path


def data_of(page: Path) -> dict[str, Any]:
    found = re.search(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page.read_text(), re.S)
    assert found
    return dict(json.loads(found[1]))


@pytest.mark.parametrize("case", HIDDEN)
def test_the_motion_is_written_where_parts_cannot_be_made(case: str, run: Run, tmp_path: Path) -> None:
    family, parameters, code = HIDDEN[case]
    path, out = design(tmp_path, family, parameters), tmp_path / "o"
    status, said, err = run("solve", path, "-o", out)
    assert status == 0, err
    written = sorted({"motion.csv", "summary.json", "motion.html", *pages(family, parameters)})
    assert f"{out}: {len(written)} files written: {', '.join(written)}\n" in said
    assert sorted(item.name for item in out.iterdir()) == sorted([*written, "manifest.json"])
    assert f"error [{code}]" in err
    assert "written up to the motion; the errors above forbid what follows" in err
    for line in err.splitlines():
        reason = line.partition("] ")[2]
        assert not reason or err.count(reason) == 1
    assert (
        "motion.html shows joints and lines, no bodies; mechwright fix looks for a change that helps" in err
    )
    wrong = [line for line in err.splitlines() if ": error [" in line]
    assert wrong
    assert not re.search(r"; (set|use|make) ", "".join(wrong)), "nobody has tried that here"
    page = data_of(out / "motion.html")
    assert page["channels"]
    rows = (out / "motion.csv").read_text().splitlines()
    assert len(rows) >= 722
    assert not re.search(r"\b(nan|inf)\b", "".join(rows[2:]))

    status, said, _ = run("check", path, "--json")
    found = json.loads(said)
    assert (status, found["ok"]) == (1, False)
    wrong = [one for one in found["findings"] if one["severity"] == "error"]
    assert {one["stage"] for one in wrong} == {"parts"}
    for command in ("model", "cam", "build") if case == next(iter(HIDDEN)) else ("build",):
        status, _, err = run(command, path, "-o", tmp_path / command)
        assert status == 1
        assert f"error [{code}]" in err
        assert not (tmp_path / command).exists()


def test_an_error_of_the_motion_stops_everything(run: Run, tmp_path: Path) -> None:
    path = design(tmp_path, "four-bar", {"crank": 30, "coupler": 7, "follower": 8, "ground": 9})
    for command in ("solve", "build"):
        status, said, err = run(command, path, "-o", tmp_path / "o")
        assert (status, said) == (1, "")
        assert "error [four-bar.closure]" in err
        assert not (tmp_path / "o").exists()
    found = json.loads(run("check", path, "--json")[1])["findings"]
    assert [one["stage"] for one in found] == ["motion"]


def test_a_page_without_bodies_still_has_its_points(run: Run, tmp_path: Path) -> None:
    path = design(tmp_path, "slider-crank", {"crank": 30, "rod": 41, "offset": 10, "pin": 30})
    assert run("solve", path, "-o", tmp_path / "o")[0] == 0
    page = data_of(tmp_path / "o" / "motion.html")
    assert [layer["name"] for layer in page["layers"]] == ["ground", "crank", "rod", "slider"]
    assert all(layer["bones"] for layer in page["layers"])
    assert (list(page["poses"]), list(page["traces"])) == (["", "crank", "rod", "slider"], ["P"])
    assert page["window"][2] > 20


@by_night
def test_plates_that_collide_are_drawn_and_told_of(run: Run, tmp_path: Path, monkeypatch) -> None:
    from mechwright_geneva.family import Geneva

    plain = Geneva.parts

    def doubled(self: Geneva, params: object) -> list[Part]:
        return [
            replace(part, instances=tuple(replace(one, z=0.0) for one in part.instances))
            for part in plain(self, params)
        ]

    monkeypatch.setattr(Geneva, "parts", doubled)
    path = design(tmp_path, "geneva", {})
    status, _, err = run("solve", path, "-o", tmp_path / "o")
    assert status == 0
    assert "error [interference.collision]" in err
    assert "written up to the motion" in err
    assert data_of(tmp_path / "o" / "motion.html")["layers"]
    assert run("check", path)[0] == 1
    assert run("model", path, "-o", tmp_path / "m")[0] == 1


def test_where_parts_fail_though_no_finding_says_so_the_motion_is_written(run, tmp_path, monkeypatch) -> None:
    from mechwright_geneva.family import Geneva

    def none(self: Geneva, params: object) -> list[Part]:
        raise GeometryError("the wheel crosses itself")

    monkeypatch.setattr(Geneva, "parts", none)
    status, _, err = run("solve", design(tmp_path, "geneva", {}), "-o", tmp_path / "o")
    assert status == 0
    assert err.count("the wheel crosses itself") == 1
    assert err.endswith(": motion.html shows joints and lines, no bodies\n")


def finding(stage: Stage, severity: Severity = Severity.ERROR) -> Finding:
    return Finding("a.b", severity, "p", "m", remedy="r", stage=stage)


def test_an_error_stops_its_stage_and_the_later_ones() -> None:
    motion, parts, _, machining, _ = every = [finding(stage) for stage in Stage]
    assert errors(every, Stage.MOTION) == [motion]
    assert errors(every, Stage.PARTS) == [motion, parts]
    assert errors(every, Stage.MACHINING) == every[:4]
    assert errors(every, Stage.OUTPUT) == errors(every) == every
    assert errors([finding(Stage.MOTION, Severity.WARNING), machining], Stage.PARTS) == []


def test_a_finding_of_a_plugin_that_knows_no_stages_stops_everything() -> None:
    old = Finding("a.b", Severity.ERROR, "p", "m", 1.0, 2.0, "mm", "r")
    assert all(errors([old], stage) == [old] for stage in Stage)
    assert old.as_dict()["stage"] == "motion"


def test_a_check_says_its_stage_once() -> None:
    @of_stage(Stage.PARTS)
    def walls(_: object) -> list[Finding]:
        return [finding(Stage.MOTION)]

    assert [one.stage for one in walls(None)] == [Stage.PARTS]

"""From a design file to a proven program: the elliptic pair, its reference gear, and planted defects."""

import re
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_control import interpret, prove
from by_night import by_night, examples
from hypothesis import event, given, settings
from hypothesis import example as known_design
from hypothesis import strategies as st
from rs274 import needs_rs274, run_rs274
from step_read import read_step_outline
from test_rs274 import LAST_DECIMAL, distinct, our_ends

from mechwright.contracts.finding import Stage, errors
from mechwright.designs.design import Design, load
from mechwright.errors import MechwrightError, ProgramError
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright_cad.exporters import StepExporter
from mechwright_cam.commands.verify import scene_of
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machined, Machining, machine
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.proof.judge import judge
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import CamTable, JobSettings, settings_of
from mechwright_elliptic_gears.parts.mesh_proof import prove_outlines

READ_ALLOWANCE = 4e-4
"""Fit and chords of two outlines read back, 0.1 µm each, mm."""
EXAMPLE = Path(__file__).parents[2] / "examples" / "elliptic-pair.toml"


def with_cam(design: Design, cam: CamSettings) -> Design:
    return replace(design, tables={**design.tables, CamTable.name: JobSettings(cam)})


def design_of(text: str) -> Design:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "design.toml"
        path.write_text(text, encoding="utf-8")
        return load(path, host())


def machined(design: Design) -> Machined:
    assert not errors(design.family.check(design.params))
    findings, jobs = prepare(design, design.family.parts(design.params))
    assert not errors(findings), findings
    (job,) = jobs
    return machine(job, host().get(Control, settings_of(design).cam.control))


@pytest.fixture(scope="module")
def example() -> Machined:
    return machined(load(EXAMPLE, host()))


REFERENCE = """
family = "elliptic-gears"
[parameters]
eccentricity = 0.4
module = 2
teeth = 39
thickness = 10
[cam]
tools = ["spot-6", "drill-8", "mill-8", "{mill}"]
"""


def test_the_example_builds_without_a_warning_and_is_proven(example: Machined) -> None:
    design = load(EXAMPLE, host())
    findings = [*design.family.check(design.params), *Build(design, host()).made(Machining).findings]
    assert {finding.severity.value for finding in findings} == {"note"}
    proof = example.proof
    assert proof.ok
    assert proof.gouge_max_mm <= 0.005
    assert 0 < proof.leftover_reachable_max_mm <= 0.010
    assert proof.unreachable_max_mm == 0
    assert proof.rapids_in_stock == 0


def test_the_page_of_checks_lists_just_the_checks_that_are_made(example: Machined) -> None:
    page = (EXAMPLE.parents[1] / "docs" / "machining" / "checks.md").read_text(encoding="utf-8")
    asked = page.split("\n## What the proof asks\n")[1].split("\n## ")[0]
    rows = "".join(re.findall(r"^\| `.*?\|", asked, re.MULTILINE))
    assert set(re.findall(r"`([a-z-]+)`", rows)) == set(example.proof.checks)


@needs_rs274
def test_linuxcnc_accepts_the_program_and_reads_what_we_read(example: Machined, tmp_path: Path) -> None:
    post = host().get(Control, "linuxcnc")
    canon = run_rs274(example.text, tmp_path, post.tool_table(example.program.tools)[1])
    assert canon.ok, canon.error
    assert len(canon.ends) > 1000
    ours, theirs = distinct(our_ends(interpret(example.text))), distinct(canon.ends)
    np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL, rtol=0)


@by_night
def test_a_two_millimetre_mill_leaves_22_micrometres_in_the_fillets() -> None:
    made = machined(design_of(REFERENCE.format(mill="mill-2")))
    assert made.proof.ok
    assert made.proof.unreachable_max_mm == pytest.approx(0.0223, abs=0.003)
    assert len(made.proof.unreachable) >= 39  # somewhere in every tooth space
    assert made.proof.leftover_reachable_max_mm <= 0.010


def test_a_mill_of_two_and_a_half_is_refused_because_the_pair_would_collide() -> None:
    design = design_of(REFERENCE.format(mill="mill-2.5"))
    assert not errors(design.family.check(design.params))
    found = errors(Build(design, host()).made(Machining).findings)
    assert [finding.parameter for finding in found] == ["cam.tools"]
    assert "collide" in found[0].message or "overlap" in found[0].message
    assert found[0].remedy


@pytest.mark.parametrize("axis", ["x", "y"])
def test_a_machine_too_small_for_the_part_is_found_by_the_check(axis: str) -> None:
    design = load(EXAMPLE, host())
    for travel, parameters in ((400.0, []), (60.0, [f"cam.machine.travel_{axis}"])):
        machine = settings_of(design).cam.machine.model_copy(update={f"travel_{axis}": travel})
        small = with_cam(design, settings_of(design).cam.model_copy(update={"machine": machine}))
        assert [
            finding.parameter for finding in errors(Build(small, host()).made(Machining).findings)
        ] == parameters


def test_the_pair_read_back_from_its_step_files_meshes() -> None:
    for text in (EXAMPLE.read_text(), REFERENCE.format(mill="mill-1.6")):
        design = design_of(text)
        (part,) = design.family.parts(design.params)
        (outline,) = read_step_outline(StepExporter().part(part))
        points = shapely.get_coordinates(outline.exterior)[:-1]
        result = prove_outlines(design.params, points, READ_ALLOWANCE)
        assert not result.collides
        assert result.mesh.overlap == 0
        assert result.error * 1e6 <= 25


# Planted defects: each spoils the example's program in one way, and is found under its own name.


def spoilt_spindle(text: str) -> str:
    return re.sub(r" M3\b", "", text)


def spoilt_offset(text: str) -> str:
    return re.sub(r"G43 H\d+ ", "", text, count=1)


def spoilt_rapid(text: str) -> str:
    head, up, tail = text.rpartition("\nG0 Z")  # the last move up
    return f"{head}\nG0 X0 Y0{up}{tail}"


def spoilt_arc(text: str) -> str:
    return re.sub(r"I-(\S+) J0\b", lambda word: f"I-{float(word[1]) - 0.01:.4f} J0", text, count=1)


DEFECTS: dict[str, tuple[Callable[[str], str], str]] = {
    "a spindle that never starts": (spoilt_spindle, "spindle"),
    "a missing G43": (spoilt_offset, "length-offset"),
    "a rapid at depth": (spoilt_rapid, "rapid-height"),
    "an arc off by 0.01 mm": (spoilt_arc, "arcs"),
}


@pytest.mark.parametrize(("spoil", "check"), DEFECTS.values(), ids=DEFECTS.keys())
def test_a_planted_defect_is_found_under_its_own_name(
    example: Machined, spoil: Callable[[str], str], check: str
) -> None:
    text = spoil(example.text)
    assert text != example.text
    proof = judge(*scene_of(Build(EXAMPLE, host()), example.job.part.name, text))
    failed = {failure.name for failure in proof.failures}
    assert check in failed
    assert all(failure.message and "\n" not in failure.message for failure in proof.failures)


def test_a_gouge_of_20_micrometres_is_found_and_one_of_none_is_not(example: Machined) -> None:
    # A cutter 0.04 mm larger than the program was made for cuts 0.02 mm deeper on both flanks.
    finisher = example.program.sections[-1].tool
    thicker = finisher.model_copy(update={"diameter": finisher.diameter + 0.04})
    tools = tuple(thicker if tool.name == finisher.name else tool for tool in example.job.tools)
    proof = prove(example.text, replace(example.job, tools=tools))
    assert {failure.name for failure in proof.failures} >= {"gouge"}
    assert proof.gouge_max_mm == pytest.approx(0.02, abs=0.004)
    assert prove(example.text, example.job).ok


def test_a_program_that_cannot_be_read_is_refused_with_its_line(example: Machined) -> None:
    with pytest.raises(ProgramError, match="line 3"):
        judge(*scene_of(Build(EXAMPLE, host()), example.job.part.name, "G21\nG90\nG1 X1..2 F100\nM30\n"))


# Random designs are built with a proof that passes, or refused by name; nothing else happens.

DESIGNS = st.fixed_dictionaries(
    {
        "eccentricity": st.floats(0, 0.7),
        "teeth": st.integers(15, 45),
        "module": st.floats(1.0, 5.0),
        "thickness": st.floats(2, 25),
        "bore": st.one_of(st.just(0.0), st.floats(2, 30)),
        "backlash": st.floats(0, 0.2),
        "material": st.sampled_from(["aluminium", "steel", "brass", "pom"]),
    }
)
SETTINGS = st.fixed_dictionaries(
    {
        "hold": st.fixed_dictionaries(
            {
                "method": st.sampled_from(["tabs", "bore"]),
                "tabs": st.integers(2, 8),
                "tab_width": st.none() | st.floats(0.3, 3),
                "tab_height": st.floats(0.3, 3),
            }
        ),
        "origin": st.sampled_from(["axis", "corner", "centre"]),
        "climb": st.booleans(),
        "stock_to_leave": st.floats(0, 0.6),
        "spring_passes": st.integers(0, 2),
        "work_offset": st.sampled_from(["G54", "G57", "G59.3"]),
        "breakthrough": st.floats(0, 1),
    }
)


# Tooth spaces in whose ends the 5 mm mill would be held back by a multiple of its distance from the wall.
WEDGES = {
    "parameters": {
        "eccentricity": 0.1298769099389706,
        "teeth": 32,
        "module": 4.344471959716109,
        "thickness": 20.11349707730774,
        "bore": 13.0,
        "backlash": 0.1848339457715587,
        "material": "brass",
    },
    "cam": {
        "hold": {"method": "tabs", "tabs": 8, "tab_width": None, "tab_height": 2.8915435746399027},
        "origin": "axis",
        "climb": False,
        "stock_to_leave": 0.27808126319167625,
        "spring_passes": 2,
        "work_offset": "G57",
        "breakthrough": 0.0,
    },
}


# The clamp of 20 mm is wider than the gear's root allows.
WIDE_CLAMP = {
    "parameters": WEDGES["parameters"]
    | {"eccentricity": 0.37, "teeth": 33, "module": 1.11, "thickness": 7.3, "bore": 2.8, "backlash": 0.07},
    "cam": {"hold": {"method": "bore"}},
}


@settings(max_examples=examples(1, 25))
@known_design(**WEDGES)
@known_design(**WIDE_CLAMP)
@given(parameters=DESIGNS, cam=SETTINGS)
def test_a_random_design_is_proven_or_refused_by_name(parameters: dict, cam: dict) -> None:
    family = host().family("elliptic-gears")
    params = family.Params.model_validate(parameters)
    base = load(EXAMPLE, host())
    design = with_cam(replace(base, params=params), CamSettings.model_validate(cam))
    found = errors(family.check(params), Stage.PARTS)
    if found:
        with pytest.raises(MechwrightError):
            family.parts(params)
    else:
        findings, jobs = prepare(design, family.parts(params))
        found = errors(findings)
        if not found:
            made = machine(jobs[0], host().get(Control, "linuxcnc"))
            assert made.proof.ok
            event("proven")
            return
    event(f"refused: {found[0].code}")
    known = {*family.Params.model_fields, "cam"}
    assert all(finding.parameter.split(".")[0] in known for finding in found)

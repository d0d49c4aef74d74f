"""Both figure-eight trains from their design files to proven programs, and their solids read back from STEP."""

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_control import interpret
from by_night import by_night
from rs274 import needs_rs274, run_rs274
from step_read import parts_from_step, read_step_outline
from test_rs274 import LAST_DECIMAL, distinct, our_ends

from mechwright.contracts.finding import Severity
from mechwright.contracts.part import Instance, Part
from mechwright.designs.design import Design, load
from mechwright.designs.requirement import load_requirement
from mechwright.pipeline.process import plates_of
from mechwright.plugins.host import host
from mechwright.tolerances import TOLERANCES
from mechwright_cad.exporters import StepExporter
from mechwright_cad.interference import interference, smooth_motion
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machined, machine
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.shop.table import settings_of
from mechwright_elliptic_gears.parts.mesh_proof import prove_outlines

EXAMPLES = Path(__file__).parents[2] / "examples"
READ_ALLOWANCE = 4e-4
"""Fit and chords of two outlines read back, 0.1 µm each, mm."""


@dataclass(frozen=True)
class Built:
    """A design, its parts, its plates read back from their STEP files, and their programs."""

    design: Design
    parts: tuple[Part, ...]
    read: dict[str, shapely.Polygon]
    made: dict[str, Machined]
    findings: tuple[object, ...]


@pytest.fixture(scope="module", params=["train", pytest.param("best", marks=by_night)])
def built(request: pytest.FixtureRequest) -> Built:
    design = load(EXAMPLES / f"figure-eight-{request.param}.toml", host())
    parts = tuple(design.family.parts(design.params))
    milled = plates_of(parts)
    findings, jobs = prepare(design, milled)
    post = host().get(Control, settings_of(design).cam.control)
    made = {job.part.name: machine(job, post) for job in jobs}
    read = {part.name: read_step_outline(StepExporter().part(part))[0] for part in milled}
    return Built(design, parts, read, made, (*design.family.check(design.params), *findings))


def test_there_is_no_warning(built: Built) -> None:
    severities = {finding.severity for finding in built.findings}
    assert severities == {Severity.NOTE}
    assert any(finding.code == "gear.cut-mesh" for finding in built.findings)


def test_every_plate_has_a_proven_program(built: Built) -> None:
    assert set(built.made) == {part.name for part in built.parts if part.outline is not None}
    assert {"coupler", "base", "gear-4", "gear-5"} < set(built.made)
    for name, made in built.made.items():
        assert made.proof.ok, name
        assert made.proof.gouge_max_mm <= TOLERANCES.gouge
        assert made.proof.leftover_reachable_max_mm <= TOLERANCES.leftover


@needs_rs274
def test_linuxcnc_accepts_every_program_and_reads_what_we_read(built: Built, tmp_path: Path) -> None:
    post = host().get(Control, "linuxcnc")
    for name, made in built.made.items():
        folder = tmp_path / name
        folder.mkdir()
        canon = run_rs274(made.text, folder, post.tool_table(made.program.tools)[1])
        assert canon.ok, f"{name}: {canon.error}"
        ours, theirs = distinct(our_ends(interpret(made.text))), distinct(canon.ends)
        np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL, rtol=0, err_msg=name)


def test_both_pairs_read_back_from_step_mesh(built: Built) -> None:
    rings = {
        instance.body: shapely.get_coordinates(built.read[part.name].exterior)[:-1]
        for part in built.parts
        for instance in part.instances
        if part.name in built.read
    }
    for one, other in (("gear-2", "gear-3"), ("gear-4", "gear-5")):
        proof = prove_outlines(built.design.params, rings[one], READ_ALLOWANCE, rings[other])
        assert not proof.collides
        assert proof.mesh.overlap == 0
        assert proof.error * 1e6 <= 25


def test_no_two_solids_read_back_from_step_meet_over_a_turn(built: Built, tmp_path: Path) -> None:
    files = {part.name: tmp_path / f"{part.name}.step" for part in built.parts}
    for part in built.parts:
        files[part.name].write_bytes(StepExporter().part(part))
    parts = parts_from_step(built.parts, files)
    motion = smooth_motion(partial(built.design.family.solve, built.design.params), parts)
    report = interference(parts, motion)
    assert report.clear, report.collisions
    # Every pair of twenty bodies: four gears, two plates, and the round parts with their keys or dowels.
    assert report.pairs == 20 * 19 // 2
    assert report.skipped == ()


@by_night
def test_a_coupler_as_high_as_the_gears_it_joins_is_found() -> None:
    design = load(EXAMPLES / "figure-eight-train.toml", host())
    parts = {part.name: part for part in design.family.parts(design.params)}
    low = replace(parts["coupler"], instances=(Instance("coupler", 16.0),))
    motion = design.family.solve(design.params, 181)
    (hit,) = interference([parts["gear-5"], low], motion, solids=False).collisions
    assert {hit.first, hit.second} == {"gear-5", "coupler"}
    assert hit.depth > 1


def test_the_best_example_is_what_its_requirement_file_finds() -> None:
    asked = load_requirement(EXAMPLES / "figure-eight-requirement.toml", host())
    table = asked.table.model_copy(update={"designs": 1})
    result = asked.family.synthesise(asked.kind, table, lambda done, what: None)
    best = load(EXAMPLES / "figure-eight-best.toml", host()).params
    assert result.candidates[0].params == best

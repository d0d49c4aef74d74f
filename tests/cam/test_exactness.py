"""Each operation is run as loosely as the part allows, and no looser."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from by_control import BY_NAME, settled
from planning_parts import bore, job, plate

from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.exactness import LIKELY, posted
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Program
from mechwright_cam.proof import Scene
from mechwright_cam.proof.cutting_state import path_tolerance
from mechwright_cam.proof.off_path import OffPath, deepest_off_path, reaching, too_deep
from mechwright_cam.proof.paths import Paths
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.posting import Posting


@cache
def planned(acceleration: float = 1.0) -> tuple[Job, Program]:
    made = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", machine={"acceleration": acceleration})
    return made, replace(plan(made), machine=made.settings.machine)


def tolerances(program: Program) -> dict[str, float | None]:
    return {o.name: o.tolerance for section in program.sections for o in section.operations}


def test_what_leaves_stock_is_looser_than_what_finishes() -> None:
    made, program = planned()
    found = tolerances(settled(program, made))
    rough = {name: value for name, value in found.items() if "rough" in name}
    finish = {name: value for name, value in found.items() if "finish" in name}
    assert rough
    assert finish
    assert set(rough.values()) == {LinuxCnc.tolerances[0]}
    assert max(value for value in finish.values() if value is not None) <= TOLERANCES.arc_fit
    assert {value for name, value in found.items() if "drill" in name} == {None}


def test_the_text_asks_for_it_where_it_changes() -> None:
    made, program = planned()
    text = LinuxCnc().write(settled(program, made))
    mode, name, modes = "", "", {}
    for line in text.splitlines():
        if line.startswith("(operation: "):
            name = line.removeprefix("(operation: ").rstrip(")")
        if line.startswith(("G64", "G61")):
            assert line != mode  # only where it changes
            mode = line
        elif line.startswith(("G1 ", "G2 ", "G3 ")):
            modes.setdefault(name, set()).add(mode)
    assert all(len(found) == 1 for found in modes.values())
    assert modes["outside: rough"] == {"G64 P0.02 Q0"}


@pytest.mark.parametrize("share", [1.0, *LIKELY])
def test_the_program_does_on_machines_that_are_likely(share: float) -> None:
    made, program = planned()
    text = LinuxCnc().write(settled(program, made))
    assert path_tolerance(Scene(text, planned(share)[0], LinuxCnc())).passed


def test_too_loose_everywhere_would_cut_the_part() -> None:
    made, program = planned()
    loose = LinuxCnc().write(settled(program, made))
    for words in ("G64 P0.002 Q0", "G61"):
        loose = loose.replace(words, "G64 P0.02 Q0")
    found = path_tolerance(Scene(loose, made, LinuxCnc()))
    assert not found.passed
    assert "off the path there" in found.message


def test_a_job_that_wants_exact_stops_gets_them_everywhere() -> None:
    made, program = planned()
    exact = replace(program, posting=Posting(exact_stop=True))
    assert settled(exact, made, LinuxCnc()) is exact
    assert "G64" not in LinuxCnc().write(exact)


@pytest.mark.parametrize("control", ["fanuc", "haas", "mach3", "grbl"])
def test_controls_that_cannot_be_asked_are_not(control: str) -> None:
    made, program = planned()
    assert settled(program, made, BY_NAME[control]) is program


@pytest.mark.parametrize("more", [0.0, 0.004, 0.02, 0.5])
def test_the_quick_answer_is_that_of_the_full_one(more: float) -> None:
    """Whether anything is too deep, from distances alone, against the depth of the deepest cut."""
    made, program = planned()
    scene = Scene(LinuxCnc().write(program), made, LinuxCnc())
    off = np.full(len(scene.run), more)
    cut = deepest_off_path(scene.paths, made, off)
    for limit in (0.001, 0.005, 0.1):
        assert too_deep(scene.paths, made, off, limit).any() == (cut is not None and cut.depth > limit)


def test_what_is_not_named_as_finishing_is_found_by_what_it_cuts() -> None:
    made, program = planned()
    sections = tuple(
        replace(s, operations=tuple(replace(o, name=o.name.replace("finish", "last")) for o in s.operations))
        for s in program.sections
    )
    found = tolerances(settled(replace(program, sections=sections), made))
    last = [value for name, value in found.items() if name.endswith("last")]
    assert last
    assert max(value for value in last if value is not None) <= TOLERANCES.arc_fit


def test_what_has_been_found_clear_is_told_alike_when_it_is_asked_again() -> None:
    """In any order of deviations and limits, also when a limit gets lower."""
    made, program = planned()
    scene = Scene(LinuxCnc().write(program), made, LinuxCnc())
    random = np.random.default_rng(7)
    for limit in (0.004, 0.005, 0.001, 0.02):
        for most in (0.3, 0.02, 0.004, 0.0):
            off = most * random.random(len(scene.run))
            direct = too_deep(scene.paths, made, off, limit)
            assert (scene.off_path.too_deep(off, limit) == direct).all()
            some = scene.paths.steps[::3]
            assert (scene.off_path.too_deep(off, limit, some)[some] == direct[some]).all()


def test_what_is_clear_stays_so_when_the_program_is_written_again() -> None:
    """With other words for corners, and not with other moves."""
    made, program = planned()
    text = LinuxCnc().write(settled(program, made))
    one = Scene(text, made, LinuxCnc())
    off = np.full(len(one.run), 0.004)
    direct = one.off_path.too_deep(off, 0.005)
    assert (one.off_path.clear > -np.inf).any()
    other = Scene(text.replace("G64 P0.02 Q0", "G61"), made, LinuxCnc())
    assert other.text != text
    other.off_path.learn(one.off_path)
    assert (other.off_path.clear == one.off_path.clear).all()
    assert (other.off_path.too_deep(off, 0.005) == direct).all()
    shifted = replace(one.run, start=one.run.start + 0.001, end=one.run.end + 0.001)
    strange = OffPath(Paths(shifted, made.tools), made)
    strange.learn(one.off_path)
    assert (strange.clear == -np.inf).all()


def test_a_program_with_lower_feeds_begins_with_the_tolerances_that_it_had() -> None:
    made, program = planned()
    first, _, scene = posted(program, made, LinuxCnc())
    exact = replace(
        first,
        sections=tuple(
            replace(
                section,
                operations=tuple(
                    replace(one, tolerance=0.0) if "finish" in one.name else one for one in section.operations
                ),
            )
            for section in first.sections
        ),
    )
    found, files, _ = posted(exact, made, LinuxCnc(), scene)
    assert tolerances(found) == tolerances(exact)
    assert "G61" in next(iter(files.values()))


def test_lots_change_nothing_and_any_one_is_one_of_all(monkeypatch: pytest.MonkeyPatch) -> None:
    made, program = planned()
    scene = Scene(LinuxCnc().write(settled(program, made)), made, LinuxCnc())
    more = np.full(len(scene.run), 0.25)  # as far as from roughed walls to finished ones
    whole = reaching(scene.paths, made, more, TOLERANCES.gouge)
    assert 0 < whole.sum() < whole.size
    monkeypatch.setattr("mechwright_cam.proof.gouge.MOST_CORNERS", 40)
    assert np.array_equal(reaching(scene.paths, made, more, TOLERANCES.gouge), whole)
    some = reaching(scene.paths, made, more, TOLERANCES.gouge, any_one=True)
    assert 0 < some.sum() < whole.sum()
    assert not (some & ~whole).any()

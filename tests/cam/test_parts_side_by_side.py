"""Parts of one design side by side: the programs, proofs and scenes are those of one after the other."""

import functools
import re
from dataclasses import asdict, replace
from itertools import chain

import numpy as np
import pytest
import shapely
from by_night import by_night
from planning_parts import LIBRARY, bore, rounded_box

from mechwright.contracts.finding import Severity
from mechwright.contracts.part import Bore, Part, Profile
from mechwright.errors import ToolError
from mechwright.geometry import Outline
from mechwright.worker_pool import sharing
from mechwright.worker_pool.budget import limited_cores
from mechwright.worker_pool.sharing import shared
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import Setups
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.proof.judge import RULES
from mechwright_cam.shop.settings import CamSettings

CAM = CamSettings.model_validate({"tools": ("spot-6", "drill-8", "mill-6", "mill-4")})
THICK = 8.0


def plate(name: str, width: float) -> Part:
    """A plate with a hole that is counterbored from below."""
    rim = rounded_box(width, 30, 6)
    machined = (
        Bore("bore", (0.0, 0.0), 10.0, 0.0, THICK),
        Bore("counterbore", (0.0, 0.0), 16.0, 5.0, 3.0),
        Profile("outside", rim, "outside", 0.0, THICK),
    )
    return Part(name, Outline(rim, (bore(10.0),)), THICK, "aluminium", machined=machined)


def setups_of(parts: list[Part]) -> list[Setups]:
    assignments, found, first = Assignments((), LinuxCnc()), [], 0
    for part in parts:
        jobs, findings = lay_out_setups(part, CAM, LIBRARY, assignments)
        assert not [one for one in findings if one.severity is Severity.ERROR]
        found.append(Setups(first, tuple(jobs), LinuxCnc(), assignments, RULES))
        first += len(jobs)
    return found


@pytest.fixture
def planned_here(monkeypatch):
    """The parts that this process has planned, with others that begin at once."""
    here, made = [], Setups.proven_programs

    @functools.wraps(made)
    def noted(self: Setups):
        here.append(self.jobs[0].part.name)
        return made(self)

    monkeypatch.setattr(Setups, "proven_programs", noted)
    monkeypatch.setattr(sharing, "START", 0.0)
    return here


def test_programs_proofs_and_scenes_are_those_of_one_process(planned_here):
    found = {}
    for count in (1, 2):
        setups = setups_of([plate("short", 30), plate("long", 34)])
        assert [job.side for one in setups for job in one.jobs] == ["top", "underside"] * 2
        with limited_cores(count):
            found[count] = shared(Setups.proven_programs, setups, [1.0, 1.1], Setups.known)
        for one, items in zip(setups, found[count], strict=True):
            assert items[0].job is one.jobs[0]
            assert items[1].job.part is one.jobs[1].part
            assert all(item.scene.control is one.control for item in items)
    assert planned_here == ["short", "long", "long"]
    for alone, beside in zip(*(chain.from_iterable(found[count]) for count in (1, 2)), strict=True):
        assert alone.files == beside.files
        assert asdict(alone.proof) == asdict(beside.proof)
        assert np.array_equal(alone.scene.simulation.heights, beside.scene.simulation.heights)
        level = -THICK
        for a, b in zip(*(one.scene.sweeps.at(level, level) for one in (alone, beside)), strict=True):
            assert shapely.equals_identical(a.chains, b.chains).all()


@pytest.mark.parametrize("order", [1, pytest.param(-1, marks=by_night)])
def test_a_part_that_fails_elsewhere_tells_what_it_tells_here(planned_here, order):
    setups = setups_of([plate("short", 30), plate("long", 34)])
    job = setups[0].jobs[0]
    bad = replace(setups[0], jobs=(replace(job, tools=job.tools[:1]),))
    with pytest.raises(ToolError) as alone:
        bad.proven_programs()
    with limited_cores(2), pytest.raises(ToolError, match=f"^{re.escape(str(alone.value))}$"):
        shared(Setups.proven_programs, [setups[1], bad][::order], [1.0, 1.0], Setups.known)

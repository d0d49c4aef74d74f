"""What the proof asks of mills whose flutes do not reach through the plate."""

from dataclasses import replace

import pytest
from by_control import posted, prove
from planning_parts import job, part, rounded_box

from mechwright.contracts.part import Pocket, Profile
from mechwright.geometry import Loop
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import plan


def notched(thickness):
    """A plate with inside corners of 1 mm radius in its rim, and a recess with corners like them."""
    rim = Loop.polygon([(-30, -20), (30, -20), (30, 20), (10, 20), (10, 8), (-10, 8), (-10, 20), (-30, 20)])
    recess = Pocket("recess", rounded_box(30, 12, 1.0).moved(0.0, -8.0, 0.0), (), 0.0, 2.0)
    return part(
        rim, thickness=thickness, machined=(recess, Profile("outside", rim, "outside", 0.0, thickness))
    )


def proven(of):
    return prove(posted(of), of)


def tools_of(of, name):
    return {s.tool.name for s in plan(of).sections for o in s.operations if o.name.startswith(name)}


def test_a_mill_counts_as_deep_as_its_flutes_are_long():
    """mill-1 has flutes of 6 mm, cuts go 0.3 mm below the plate: it makes the corners of the recess, and those of the rim of a thin plate."""
    thick, thin = job(notched(6.0), "mill-8", "mill-1"), job(notched(3.0), "mill-8", "mill-1")
    for of, there in ((thick, {"mill-8"}), (thin, {"mill-8", "mill-1"})):
        proof = proven(of)
        assert proof.ok, [check.message for check in proof.failures]
        assert tools_of(of, "outside") == there
        assert "mill-1" in tools_of(of, "recess")
    assert proven(thick).unreachable_max_mm == pytest.approx(4 * (1 - 0.5**0.5), abs=0.005)
    assert proven(thin).unreachable_max_mm < 0.5


def test_what_a_short_mill_left_in_a_recess_is_found():
    of = job(notched(6.0), "mill-8", "mill-1")
    coarse = LinuxCnc().write(plan(job(notched(6.0), "mill-8")))
    assert prove(coarse, of).ok  # mill-1 is not in the program
    program = plan(of)
    sections = []
    for section in program.sections:
        fine = section.tool.name == "mill-1"
        kept = tuple(o for o in section.operations if not (fine and o.name.endswith("finish")))
        sections.append(replace(section, operations=kept))
    found = prove(posted(of, replace(program, sections=tuple(sections))), of)
    assert [check.name for check in found.failures] == ["leftover"]

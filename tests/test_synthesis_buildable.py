"""Designs that the shop cannot build make room for others that were found, in every family."""

from dataclasses import replace
from pathlib import Path

import pytest

from mechwright import Candidate, Rejected, Scalar, Synthesis
from mechwright.contracts.parameters import Parameters
from mechwright.designs.requirement import requirement_of
from mechwright.plugins.host import host
from mechwright.scripting.synthesis import Found, sought
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams

TRAVEL = 180.0
"""Of the machine, mm: enough for plates of the small linkages, not for those of the large ones."""


class Drawer(FourBars):
    """Gives crank-rockers of prescribed sizes, as many as are asked for, and counts what it is asked."""

    def __init__(self, sizes: tuple[float, ...], phases: int = 1) -> None:
        self.sizes, self.phases, self.asked = sizes, phases, list[int]()

    def synthesise(self, kind: str, requirement: Parameters, progress: object) -> Synthesis[FourBarParams]:
        wanted = requirement.designs  # type: ignore[attr-defined]
        self.asked.append(wanted)
        machines = [self.sizes[k : k + self.phases] for k in range(0, len(self.sizes), self.phases)]
        rejected = Rejected()
        rejected.beyond(wanted, len(machines) - wanted)
        given = [
            Candidate(linkage(size), Scalar(0.0, "mm"), {"phase": Scalar(float(phase), "")})
            for machine in machines[:wanted]
            for phase, size in enumerate(machine, start=1)
        ]
        return Synthesis(tuple(given), (), rejected.reasons)


class Holder(Drawer):
    """Tells of one design more each time."""

    def synthesise(self, kind: str, requirement: Parameters, progress: object) -> Synthesis[FourBarParams]:
        whole = super().synthesise(kind, requirement, progress)
        rejected = Rejected()
        rejected.beyond(requirement.designs, 1 + len(self.asked) - 1)  # type: ignore[attr-defined]
        return replace(whole, rejected=rejected.reasons)


def linkage(size: float) -> FourBarParams:
    return FourBarParams(crank=0.3 * size, coupler=size, follower=0.8 * size, ground=0.9 * size)


def found(family: Drawer, designs: int) -> Found:
    """What is found with a machine of so much travel."""
    asked = {
        "family": "four-bar",
        "requirement": {"kind": "poses", "designs": designs},
        "cam": {"machine": {"travel_x": TRAVEL, "travel_y": TRAVEL}},
    }
    read = requirement_of(asked, Path("wanted.toml"), "", host())
    return sought(replace(read, family=family), host())


def sizes(one: Found) -> list[float]:
    return [candidate.params.coupler for candidate in one.result.candidates]


def test_the_next_that_can_be_built_is_given() -> None:
    """None of the first two fits the machine; two of the four others do, in their order."""
    family = Drawer((220.0, 230.0, 120.0, 240.0, 125.0, 130.0))
    result = found(family, 2)
    assert sizes(result) == [120.0, 125.0]
    assert family.asked == [2, 6]
    assert {one.code: one.count for one in result.result.rejected} == {
        "cam.travel": 3, "synthesis.beyond-the-number": 1
    }  # fmt: skip
    assert result.told.startswith("6 found, 2 given: ")
    assert "designs = 2" in next(one.message for one in result.result.rejected if "beyond" in one.code)
    assert not result.result.findings


def test_nobody_is_asked_again_where_all_can_be_built() -> None:
    family = Drawer((120.0, 125.0, 130.0))
    assert sizes(found(family, 2)) == [120.0, 125.0]
    assert family.asked == [2]


def test_what_is_still_not_looked_at_is_said() -> None:
    """Some can be built: the family is asked for the others that it has found once, and no more."""
    family = Holder((220.0, 120.0, 220.0, 120.0, 120.0))
    result = found(family, 2)
    assert (len(result), family.asked) == (1, [2, 3])
    (more,) = result.result.findings
    assert (more.code, more.value) == ("synthesis.more", 2.0)
    assert "2 of 3 designs cannot be built" in more.message


def test_as_long_as_none_can_be_built_every_design_that_was_found_is_looked_at() -> None:
    """A requirement file can ask for 50 designs; here 51 were found, and the last can be built."""
    family = Drawer((220.0,) * 50 + (120.0,))
    result = found(family, 1)
    assert (sizes(result), family.asked) == ([120.0], [1, 51])
    assert result.result.findings == ()


@pytest.mark.parametrize("large", [1, 2])
def test_a_machine_is_given_with_all_its_phases_or_not(large: int) -> None:
    first = tuple(220.0 if phase == large else 120.0 for phase in (1, 2))
    result = found(Drawer((*first, 125.0, 130.0, 121.0, 122.0), phases=2), 1)
    assert sizes(result) == [125.0, 130.0]
    assert {one.code: one.count for one in result.result.rejected} == {
        "cam.travel": 1, "synthesis.beyond-the-number": 1
    }  # fmt: skip

"""The kit of families sees what is wrong with all designs: solids, programs and synthesis."""

import itertools
from dataclasses import replace
from typing import ClassVar, Literal

import numpy as np
import pytest
from disc_family import Disc, DiscParams
from pydantic import Field
from test_testing_family import assert_refused, contract, run, with_channel, with_params

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding, Severity
from mechwright.errors import GeometryError, PluginFaultError
from mechwright.units import Millimetres
from mechwright_cam.controls.contract import Control


def test_a_family_that_remembers():
    class Counter(Disc):
        seen: ClassVar[list[int]] = []

        def solve(self, params, samples):
            self.seen.append(1)
            return with_channel("count", lambda n: np.full(n, len(self.seen) * 1.0), "")().solve(
                params, samples
            )

    assert_refused(Counter, "test_deterministic", "motion")


def test_a_parameter_that_does_nothing():
    idle = with_params(
        gloss=(Millimetres, Field(1.0, ge=0, le=9, description="Nothing.")),
        polish=(int, Field(1, ge=0, le=9, description="Nothing.")),
    )
    assert_refused(idle, "test_every_parameter_counts", "no result depends on gloss, polish;")


def test_a_parameter_with_one_value_does_not_have_to_count():
    one = with_params(kind=(Literal["disc"], Field("disc", description="The one kind.")))
    run(one, "test_every_parameter_counts")
    two = with_params(kind=(Literal["disc", "ring"], Field("disc", description="Nothing.")))
    assert_refused(two, "test_every_parameter_counts", "no result depends on kind;")


def test_a_parameter_that_matters_seldom_needs_a_variation():
    class Seldom(with_params(flag=(int, Field(0, ge=0, le=10_000, description="Matters at 4321 only.")))):
        def found(self, params):
            found = super().found(params)
            if params.flag == 4321:
                found.append(Finding("disc.flag", Severity.NOTE, "flag", "x"))
            return found

    assert_refused(Seldom, "test_every_parameter_counts", "no result depends on flag;")
    run(Seldom, "test_every_parameter_counts", variations={"flag": [4321]})
    run(Seldom, "test_every_parameter_counts", examples=({}, {"flag": 4320}))


def test_refusals_that_do_not_come():
    assert_refused(Disc, "test_refused", "{'diameter': 41} builds", refused=(({"diameter": 41}, "diameter"),))
    assert_refused(Disc, "test_refused", "not for holes", refused=(({"diameter": 1}, "holes"),))
    with pytest.raises(pytest.skip.Exception):
        run(Disc, "test_refused")


def test_a_family_that_falls_over():
    class Falls(Disc):
        def parts(self, params):
            if params.holes < 2:
                raise ZeroDivisionError("the pitch of one hole")
            return super().parts(params)

    with pytest.raises(PluginFaultError, match="ZeroDivisionError: the pitch of one hole"):
        run(Falls, "test_random_designs_build_or_are_refused", max_examples=300)


def test_a_family_that_gives_up_without_a_finding():
    class GivesUp(Disc):
        def parts(self, params):
            if params.thickness > 20:
                raise GeometryError("too thick")
            return super().parts(params)

    with pytest.raises(GeometryError, match="too thick"):
        run(GivesUp, "test_random_designs_build_or_are_refused", max_examples=300)


def test_a_family_that_refuses_everything():
    class Sour(Disc):
        def found(self, params):
            return [Finding("disc.no", Severity.ERROR, "bore", "no", remedy="none")]

    assert_refused(Sour, "test_random_designs_build_or_are_refused", "no random table is a design")


def test_a_rule_that_names_no_parameter():
    class Params(DiscParams):
        def model_post_init(self, context):
            if self.holes > 6:
                raise ValueError("too many")

    other = type("Other", (Disc,), {"Params": Params})
    assert_refused(
        other, "test_random_designs_build_or_are_refused", "without naming a parameter", max_examples=300
    )


def test_solids_need_the_exporter(monkeypatch):
    from mechwright.plugins.host import Host, Registered
    from mechwright.testing import family as kit

    class Step:
        def part(self, part):
            return self.data

    step, empty = Step(), Host()
    monkeypatch.setattr(kit, "host", lambda: empty)
    with pytest.raises(pytest.skip.Exception, match="'step' is not installed"):
        run(Disc, "test_solids")
    monkeypatch.setattr(kit, "host", lambda: Host({Exporter: {"step": Registered(step, "x", "y")}}))
    step.data = b"ISO-10303-21;\n"
    run(Disc, "test_solids")
    step.data = b""
    assert_refused(Disc, "test_solids", "part disc is no STEP file")


def test_programs_need_an_installed_family_and_a_post(monkeypatch, tmp_path):
    from mechwright.plugins.host import Host, Registered
    from mechwright.testing import family as kit

    design = contract(Disc)

    class Other(Disc):
        """Takes the name of the family under test."""

    for found, reason in (
        (Host(), "family disc is not installed"),
        (Host({Family: {"disc": Registered(Other(), "x", "y")}}), "family disc is not installed"),
        (Host({Family: {"disc": Registered(Disc(), "x", "y")}}), "no control is installed"),
    ):
        monkeypatch.setattr(kit, "host", lambda found=found: found)
        with pytest.raises(pytest.skip.Exception, match=reason):
            design.test_programs_are_proven({}, tmp_path)


@pytest.mark.parametrize(
    ("proofs", "words"),
    [
        ({"disc": {"gouge_max_mm": 0.001, "leftover_reachable_max_mm": 0.0}}, None),
        ({"disc": {"gouge_max_mm": 0.02, "leftover_reachable_max_mm": 0.0}}, "disc"),
        ({"disc": {"gouge_max_mm": 0.0, "leftover_reachable_max_mm": 0.02}}, "disc"),
        ({}, "a plate part without a program"),
    ],
)
def test_programs_are_judged_by_their_proof(monkeypatch, tmp_path, proofs, words):
    from mechwright.plugins.host import Host, Registered
    from mechwright.testing import family as kit

    found = Host(
        {
            Family: {"disc": Registered(Disc(), "x", "y")},
            Control: {"mill": Registered(object(), "x", "y")},
        }
    )
    asked = []
    monkeypatch.setattr(kit, "host", lambda: found)
    monkeypatch.setattr(kit.commands, "machine", lambda design, folder: asked.append(design) or proofs)
    test = contract(Disc, cam={"work_offset": "G55"}).test_programs_are_proven
    if words is None:
        test({"diameter": 50}, tmp_path)
    else:
        with pytest.raises(AssertionError, match=words):
            test({"diameter": 50}, tmp_path)
    assert asked[0]["family"] == "disc"
    assert asked[0]["parameters"]["diameter"] == 50.0
    assert asked[0]["cam"] == {"work_offset": "G55"}


def test_a_design_without_programs_shows_what_is_said(tmp_path):
    from mechwright.testing.commands import machine

    with pytest.raises(AssertionError, match=r"there are no programs:\n.+no-such-family"):
        machine({"format": 1, "family": "no-such-family", "parameters": {}, "cam": {}}, tmp_path)


_COUNT = itertools.count(1)


def with_synthesis(change):
    class Other(Disc):
        def synthesise(self, kind, requirement, progress):
            return change(super().synthesise(kind, requirement, progress), progress)

    return Other


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda result, progress: replace(result, candidates=()), "no design"),
        (lambda result, progress: replace(result, candidates=result.candidates[:1] * 2), "twice"),
        (lambda result, progress: [progress(0.2, ""), progress(0.1, ""), result][2], "backwards"),
        (lambda result, progress: [progress(1.1, ""), result][1], "leaves 0 to 1"),
        (
            lambda result, progress: replace(
                result, candidates=(replace(result.candidates[0], params=DiscParams(bore=39)),)
            ),
            "cannot be built",
        ),
        (
            lambda result, progress: replace(result, candidates=result.candidates[: next(_COUNT)]),
            "another result",
        ),
    ],
)
def test_synthesis(change, words):
    assert_refused(with_synthesis(change), "test_synthesis", words)


def test_a_requirement_of_an_unknown_kind_is_seen():
    assert_refused(Disc, "test_synthesis", "unknown kinds", requirements={"wheel": ({},)})
    assert_refused(Disc, "test_synthesis", "finds no design", requirements={"rim": ({"rim_speed": 90_000},)})

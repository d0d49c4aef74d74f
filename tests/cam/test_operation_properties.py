"""Whatever is drawn, and with whatever cutters: proven, or refused with a reason; never empty, never in part."""

import re

import numpy as np
import pytest
from by_night import by_night, examples, thinned
from hypothesis import example, given, settings
from hypothesis import strategies as st
from random_outcomes import Outcome, named, run, without
from random_parts import OPERATIONS

from mechwright_plane.contour import LEFT

REASON = re.compile(r"(error \[cam\.[a-z-]+\] )?(cam\.[a-z_.]+: |part plate)")
"""How the reasons of planning begin: with the key of the design file, or with the part."""


def check(outcome: Outcome) -> None:
    if outcome.refusal:
        assert "\n" not in outcome.refusal
        assert REASON.match(outcome.refusal), outcome.refusal
        part = outcome.drawn.part
        names = [f.name for f in part.features] + [d.name for d in part.details]
        assert "cam." in outcome.refusal or any(name in outcome.refusal for name in names), outcome.refusal
        return
    assert not outcome.failures, (outcome.control, outcome.failures)
    assert outcome.made
    done = set()
    for one in outcome.made:
        assert one.proof.cutting_length_mm > 0
        operations = [o for section in one.program.sections for o in section.operations]
        assert all(o.moves for o in operations)
        done |= {o.name.split(":")[0] for o in operations}
    for one in outcome.made:
        assert named(one.job, one.program.tools) <= done


@pytest.mark.parametrize("operation", thinned(2, OPERATIONS))
def test_any_part_is_proven_or_refused(operation: str) -> None:
    @settings(max_examples=examples(1, 10))
    @given(seed=st.integers(0, 10**9))
    def every(seed: int) -> None:
        check(run(operation, seed))

    every()


def test_a_ramp_to_and_fro_beside_a_wall_is_no_climb_milling() -> None:
    outcome = run("underside-rim", 725)
    assert any(not one.job.settings.climb for one in outcome.made)
    check(outcome)


@pytest.mark.parametrize(
    "operation",
    [pytest.param(one, marks=by_night if number % 6 else ()) for number, one in enumerate(OPERATIONS)],
)
def test_a_program_without_one_feature_is_not_proven(operation: str) -> None:
    """Each is found that is missing, whatever it is: the first proven part of each operation is taken apart."""
    outcome = next(o for o in (run(operation, seed) for seed in range(50)) if o.made and not o.failures)
    looked = 0
    for place, one in enumerate(outcome.made):
        for name in sorted(named(one.job, one.program.tools)):
            proof = without(outcome, place, name)
            if proof is not None:
                looked += 1
                found = {check.name for check in proof.failures}
                assert found & {"leftover", "depth", "details"}, (name, found)
    # Where a side has one feature only, a program without it is none.
    assert looked or operation in {"outside", "underside-rim"}


TABLES = st.fixed_dictionaries(
    {
        "inner_tolerance": st.sampled_from([0.0, 0.001, 0.003]),
        "outer_tolerance": st.sampled_from([0.003, 0.004, 0.008]),
        "lines_per_arc": st.sampled_from([1, 3, 100]),
    }
)


@settings(max_examples=examples(1, 24))
@given(
    operation=st.sampled_from(sorted(OPERATIONS)),
    seed=st.integers(0, 10**9),
    compensation=st.sampled_from(["computer", "control", "wear"]),
    path=TABLES,
)
@example("adaptive", 11, "wear", {"inner_tolerance": 0.003, "outer_tolerance": 0.004})
@example("outside", 10, "wear", {"inner_tolerance": 0.0})
def test_any_accuracy_and_compensation_is_proven_or_refused(operation, seed, compensation, path):
    outcome = run(operation, seed, compensation=compensation, path=path)
    if outcome.control == "grbl" and compensation != "computer":
        assert "Grbl 1.1 has no cutter compensation" in outcome.refusal or "cam." in outcome.refusal
        return
    check(outcome)
    for one in outcome.made:
        inner, most = (getattr(one.job.settings.path, f"{side}_tolerance") for side in ("inner", "outer"))
        decimals = 0.0015
        assert one.proof.gouge_max_mm <= inner + decimals
        assert one.proof.leftover_reachable_max_mm <= most + LEFT + decimals


def test_refusals_are_rare_and_cuts_are_many() -> None:
    """The properties above would hold for a planner that refuses everything."""
    outcomes = [run("pocket", int(seed)) for seed in np.arange(examples(4, 8))]
    assert sum(bool(o.made) for o in outcomes) >= 0.75 * len(outcomes)

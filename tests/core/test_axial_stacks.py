"""Axial stacks: worst case, statistics, shims, against numbers of an independent script."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.contracts.axial_stack import AxialStack, Shimming, StackLength
from mechwright.contracts.turned import Length
from mechwright.errors import GeometryError
from mechwright.machine.stack_inspection import stack_findings
from mechwright.mechanics.tolerance.axial_stacks import nearest_nominal, stack_result

CASES = (
    ("float of the frame's shaft as drawn today", (
        ('seat depth, lower', 1, 8, -0.2, 0.2),
        ('seat depth, upper', 1, 8, -0.2, 0.2),
        ('pillar', 1, 23, -0.05, 0.05),
        ('shoulder to shoulder', -1, 22.8, -0.05, 0.05),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
    ), 0.2, 0.32, (-0.3, 0.94), 0.303644529, 0.0007845472),
    ('the same, depths toleranced', (
        ('seat depth, lower', 1, 8, 0, 0.05),
        ('seat depth, upper', 1, 8, 0, 0.05),
        ('pillar', 1, 23, -0.02, 0.02),
        ('shoulder to shoulder', -1, 22.9, -0.05, 0),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
    ), 0.1, 0.295, (0.08, 0.51), 0.09733961167, 4.867086e-20),
    ('the same after a shim: gap measured +-0.02, shims in steps of 0.1, aim 0.05 least', (
        ('gap left after choosing the shim', 1, 0.1, -0.05, 0.05),
        ('measuring', 1, 0, -0.02, 0.02),
    ), 0.1, 0.1, (0.03, 0.17), 0.05385164807, 1.267424e-08),
    ('inner ring between shoulder and circlip 10 x 1', (
        ('shoulder to far wall of the groove', 1, 9.1, 0, 0.1),
        ('circlip', -1, 1, -0.06, 0),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
    ), 0.1, 0.24, (0.1, 0.38), 0.08366600265, 3.794407e-18),
    ('the same with a shim DIN 988 10x16x0.1 when measured above 0.2', (
        ('shoulder to far wall of the groove', 1, 9.1, 0, 0.1),
        ('circlip', -1, 1, -0.06, 0),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
        ('shim', -1, 0.1, -0.03, 0),
    ), 0.0, 0.155, (0.0, 0.31), 0.085, 2.242722e-08),
    ('outer ring of the locating bearing in its seat under a cover', (
        ('seat depth', 1, 8, -0.02, 0.02),
        ('spigot of the cover', -1, 0.3, -0.02, 0.02),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
        ('gasket or shim', 1, 0.4, -0.02, 0.02),
    ), 0.1, 0.16, (0.04, 0.28), 0.0692820323, 2.131096e-12),
    ('free bearing: way to the wall of its seat', (
        ('seat depth', 1, 10, -0.1, 0.1),
        ('bearing width, 0/-0.120 (ISO 492 Normal)', -1, 8, -0.12, 0),
        ('outer ring stands out of its seat', -1, 1, -0.2, 0.2),
    ), 1.0, 1.06, (0.7, 1.42), 0.2315167381, 3.110908e-43),
    ('hub between collar and circlip', (
        ('collar to far wall of the groove', 1, 11.1, 0, 0.1),
        ('circlip', -1, 1, -0.06, 0),
        ('hub', -1, 10, -0.1, 0),
    ), 0.1, 0.23, (0.1, 0.36), 0.07681145748, 1.316995e-19),
    ('two links on a shouldered pin', (
        ('shoulder to far wall of the groove', 1, 14.6, 0, 0.1),
        ('link 1', -1, 6, -0.1, 0),
        ('link 2', -1, 6, -0.1, 0),
        ('washer', -1, 0.5, -0.05, 0.05),
        ('washer', -1, 0.5, -0.05, 0.05),
        ('circlip', -1, 0.8, -0.05, 0),
        ('washer between', -1, 0.5, -0.05, 0.05),
    ), 0.3, 0.475, (0.15, 0.8), 0.125, 2.090595e-30),
    ('roller on its stud', (
        ("stud's shoulder", 1, 8.1, 0, 0.05),
        ('roller', -1, 8, -0.05, 0),
    ), 0.1, 0.15, (0.1, 0.2), 0.03535533906, 2.068516e-37),
    ('gap of shafts in a coupling', (
        ('pillars of the bracket', 1, 40, -0.05, 0.05),
        ('bearing plate under the lower bearing', 1, 2.5, -0.1, 0.1),
        ("shaft stub beyond the bearing's seat", -1, 17, -0.1, 0.1),
        ('motor shaft', -1, 24, -0.5, 0.5),
        ("motor plate, motor's face on its far side", 1, 6, -0.1, 0.1),
        ('shaft float', -1, 0, -0.1, 0.1),
    ), 7.5, 7.5, (6.55, 8.45), 0.5408326913, 0.0),
    ('thread engaged: M5 x 16 through a plate of 10, washer, into a pillar', (
        ('screw length (js15)', 1, 16, -0.35, 0.35),
        ('washer ISO 7089', -1, 1, -0.1, 0.1),
        ('plate 10 rolled, EN 485-3', -1, 10, -0.45, 0.45),
        ('countersink of the thread', -1, 0.4, -0.1, 0.1),
    ), 4.6, 4.6, (3.6, 5.6), 0.5873670062, 2.311428e-122),
)  # fmt: skip
"""Name, lengths, nominal, middle, worst case, half by statistics, share below 0."""


def stack_of(parts, **other):
    return AxialStack("stack", tuple(StackLength(*one) for one in parts), **other)


@pytest.mark.parametrize(
    ("name", "parts", "nominal", "middle", "worst", "half", "below"), CASES, ids=lambda one: str(one)[:24]
)
def test_stacks_have_the_gaps_of_an_independent_script(name, parts, nominal, middle, worst, half, below):
    stack = stack_of(parts)
    found = stack_result(stack)
    assert (stack.nominal, stack.middle) == pytest.approx((nominal, middle), abs=1e-6)
    assert found.worst == pytest.approx(worst, abs=1e-6)
    assert found.half == pytest.approx(half, abs=1e-6)
    assert found.statistical == pytest.approx((middle - half, middle + half), abs=1e-6)
    assert found.below_zero == pytest.approx(below, rel=1e-6, abs=1e-300)
    assert sum(found.shares) == pytest.approx(1)


def test_seat_depths_are_most_of_the_float_of_a_shaft_without_limits_of_its_own():
    found = stack_result(stack_of(CASES[0][1]))
    assert found.shares[0] + found.shares[1] == pytest.approx(0.87, abs=0.005)


def test_a_bought_part_widens_the_statistical_gap_by_half():
    plain = stack_of(CASES[3][1])
    first, *others = plain.lengths
    bought = replace(plain, lengths=(replace(first, bought=True), *others))
    low, high = stack_result(bought).statistical
    assert (low, high) == pytest.approx((0.24 - 1.5 * 0.08366600265, 0.24 + 1.5 * 0.08366600265))
    assert stack_result(bought).worst == stack_result(plain).worst


def test_rings_leave_what_the_facts_of_measuring_leave():
    shims = Shimming("DIN 988 - 20 x 28", (0.1, 0.15, 0.2, 0.3, 0.5, 1.0), "in the seat", 0.05, thinner=0.0)
    stack = stack_of(CASES[1][1], shimming=shims)
    assert stack.play == pytest.approx((0.03, 0.17))
    assert [shims.rings(gap) for gap in (0.08, 0.15, 0.49, 1.05)] == [(), (0.1,), (0.3, 0.1), (1.0,)]
    # A ring of 0.1 and one of 0.3 may both be thinner.
    assert replace(stack, shimming=replace(shims, thinner=0.03)).play[1] == pytest.approx(0.17 + 0.06)


@given(gap=st.floats(-0.5, 2.0), least=st.floats(0.0, 0.3))
def test_rings_never_take_more_than_a_gap_leaves(gap, least):
    shims = Shimming("DIN 988 - 20 x 28", (0.1, 0.2, 0.3, 0.5, 1.0), "in the seat", least)
    rings = shims.rings(gap)
    left = gap - sum(rings)
    assert left == pytest.approx(gap - shims.thickness(gap))
    assert left >= min(gap, least) - 1e-6
    assert left < max(least + 0.1 + 1e-6, gap) or not rings


FRAME, TOLERANCED = CASES[0][1], CASES[1][1]


def test_a_stack_that_pinches_is_an_error_with_the_length_that_works():
    stack = stack_of(FRAME, least=0.0, adjustable="shoulder to shoulder")
    (found,) = stack_findings([stack])
    assert (found.code, found.value, found.limit) == ("stack.pinched", pytest.approx(-0.3), 0.0)
    assert "closes to -0.300 mm with all lengths at their limits; at least 0 mm are meant" in found.message
    assert found.remedy == "make shoulder to shoulder 22.5 mm, now 22.8"
    mended = stack_of(
        [
            (what, sign, 22.5 if sign * nominal == -22.8 else nominal, *limits)
            for what, sign, nominal, *limits in FRAME
        ]
    )
    assert list(stack_findings([mended])) == []


def test_a_stack_that_rattles_is_an_error_and_one_that_no_length_mends_says_so():
    stack = stack_of(TOLERANCED, least=0.0, greatest=0.45, adjustable="shoulder to shoulder")
    (found,) = stack_findings([stack])
    assert (found.code, found.remedy) == ("stack.loose", "make shoulder to shoulder 22.96 mm, now 22.9")
    assert nearest_nominal(replace(stack, greatest=0.3)) is None
    (found,) = stack_findings([replace(stack, greatest=0.3)])
    assert found.remedy.endswith("the widest is bearing width, 0/-0.120 (ISO 492 Normal), -0.12 to 0 mm")
    assert list(stack_findings([stack_of(TOLERANCED)])) == []


@given(
    parts=st.lists(
        st.tuples(
            st.just("part"), st.sampled_from([1, -1]), st.floats(1, 90), st.floats(-0.3, 0), st.floats(0, 0.3)
        ),
        min_size=1,
        max_size=7,
    ),
    least=st.floats(-1, 1),
    room=st.floats(0, 3),
)
def test_the_nearest_length_closes_the_stack(parts, least, room):
    stack = stack_of(parts, least=least, greatest=least + room)
    works = nearest_nominal(stack)
    if works is None:
        assert stack.play[1] - stack.play[0] > room
        return
    first, *others = stack.lengths
    low, high = replace(stack, lengths=(replace(first, nominal=works), *others)).play
    assert least - 1e-9 <= low <= high <= least + room + 1e-9


def test_a_length_takes_the_limits_of_a_drawing():
    found = StackLength.of(Length("shoulder to shoulder", 9.0, 32.0, -0.05, 0.0), -1, "shaft-2")
    assert (found.nominal, found.middle, found.half) == (23.0, pytest.approx(22.975), 0.025)
    assert found.part == "shaft-2"


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: StackLength("hub", 0, 10, 0, 0.1), "'hub' has the sign 0; take 1 or -1"),
        (lambda: StackLength("hub", 1, 10, 0.1, 0), "the lower limit comes first"),
        (lambda: StackLength("hub", 1, math.nan, 0, 0.1), "'hub': nan mm"),
        (lambda: AxialStack("float", ()), "'float' has no lengths"),
        (lambda: stack_of(FRAME, least=0.2, greatest=0.1), "a play of 0.2 to 0.1 mm is no interval"),
    ],
)
def test_what_is_no_stack_is_refused(make, words):
    with pytest.raises(GeometryError, match=words):
        make()

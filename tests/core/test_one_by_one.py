"""Designs for which no formula holds leave their table, and are asked one by one."""

import numpy as np
from test_design_rules import rule, table

from mechwright import Finding, Procedure, Stage, in_turn
from mechwright.contracts.rule_list import OneByOne


def sorted_out(rules, some, stage=Stage.PARTS):
    """The places of designs that are forbidden, left and allowed."""
    forbidden, alone = [], []
    _, places = rules.allowed(some, stage, lambda _, which: forbidden.extend(which), leave=alone.extend)
    return forbidden, alone, places.tolist()


def test_they_leave_between_the_rules():
    rules = in_turn(rule("a"), OneByOne(lambda t: t.params.b > 1), rule("b", value=lambda t: 2 - t.params.a))
    some = table(a=[-1, 1, 1, 3, 3], b=[2, 2, 0, 0, 2])
    assert sorted_out(rules, some) == ([0, 3], [1, 4], [2])
    assert rules.allowed(some, Stage.PARTS, lambda *_: None)[1].tolist() == [1, 2], "nobody takes them"
    assert [one.code for one in rules.findings(some.row(0))] == ["a"]


def test_they_stay_where_no_rule_of_the_stage_lacks_a_formula():
    rules = in_turn(OneByOne(lambda t: True, Stage.PARTS), rule("a"))
    some = table(a=[-1, 1])
    assert sorted_out(rules, some) == ([], [0, 1], [])
    assert sorted_out(rules.__class__((rules.every[0],), turns=True), some, Stage.MOTION) == ([], [], [0, 1])
    assert np.array_equal(some.params.a, [[-1], [1]])


def test_a_procedure_that_lists_no_codes_forbids_rows_with_those_that_it_finds():
    def inspect(t):
        return [Finding.error("found", "a", "bad")] if t.params.a < 0 else []

    codes = {}
    in_turn(Procedure((), inspect)).allowed(table(a=[-1, 1]), Stage.PARTS, codes.setdefault)
    assert {code: places.tolist() for code, places in codes.items()} == {"found": [0]}

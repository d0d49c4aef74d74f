"""Rules that are declared once: of one design, of a table, in order, with items and faults."""

import math
import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import Field

from mechwright import DesignRule, DesignTable, Figure, Note, Parameters, Procedure, Stage, all_of, in_turn
from mechwright.contracts.design_table import by_row, column, plain, rows_of, with_columns
from mechwright.contracts.evaluation import Batch
from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.rule_list import by_design
from mechwright.contracts.standing import Standing
from mechwright.errors import PluginFaultError


class Inner(Parameters):
    """A table of a table."""

    depth: float = Field(1.0, description="d")


class Params(Parameters):
    """Three numbers, a count, a text, a table."""

    a: float = Field(1.0, ge=-1e6, le=1e6, description="a")
    b: float = Field(1.0, ge=-1e6, le=1e6, description="b")
    c: float = Field(1.0, ge=-1e6, le=1e6, description="c")
    n: int = Field(2, description="n")
    kind: str = Field("x", description="kind")
    inner: Inner = Field(Inner(), description="inner")
    fit: float = Field(0.0, description="twice a", json_schema_extra={"fitted": True})

    def fitted(self):
        """Twice a."""
        return {} if "fit" in self.model_fields_set else {"fit": 2 * self.a}


Rule = DesignRule[DesignTable[Params]]


def table(**columns):
    """A table whose columns these are."""
    arrays = {name: np.asarray(values, dtype=float)[:, None] for name, values in columns.items()}
    return DesignTable(with_columns(Params(), arrays), len(next(iter(arrays.values()))))


def rule(code="r", parameter="a", message="{value:g} of {limit:g}", **more):
    more.setdefault("value", lambda t: t.params.a)
    more.setdefault("limit", 0.0)
    return Rule(code, parameter, message, **more)


def allowed(rules, some, stage=Stage.PARTS):
    """What forbids each design of a table first, '' for none."""
    found = np.full(some.size, "", dtype=object)

    def forbid(code, places):
        assert (found[places] == "").all(), "a design is forbidden once"
        found[places] = code

    _, left = rules.allowed(some, stage, forbid)
    assert (found[left] == "").all()
    assert np.count_nonzero(found == "") == left.size
    return found.tolist()


class TestTables:
    def test_columns_stand_in_place_of_numbers_and_a_row_has_numbers(self):
        some = table(a=[1, 2, 3], **{"inner.depth": [4, 5, 6]})
        assert some.params.a.shape == some.params.inner.depth.shape == (3, 1)
        assert (some.params.b, some.params.kind) == (1.0, "x")
        one = some.row(1)
        assert one.single
        assert (one.params.a, one.params.inner.depth, one.params.fit) == (2.0, 5.0, 4.0)
        assert isinstance(one.params.a, float)
        assert hash(one.params) == hash(plain(some.params, 1, 3))

    def test_what_follows_from_a_column_is_a_column(self):
        some = table(a=[1, 2])
        np.testing.assert_array_equal(some.params.fit, [[2.0], [4.0]])
        assert "fit" not in some.row(0).params.model_fields_set

    def test_rows_take_along_what_was_computed(self):
        some, calls = table(a=[1, 2, 3]), []
        find = lambda t: t.once("square", lambda: calls.append(1) or (t.params.a**2, {"k": [t.params.a]}))  # noqa: E731
        find(some)
        part = some.rows(np.array([2, 0]))
        square, nested = find(part)
        assert len(calls) == 1
        np.testing.assert_array_equal(square, [[9.0], [1.0]])
        np.testing.assert_array_equal(nested["k"][0], [[3.0], [1.0]])
        assert len(part) == 2
        assert some.size == 3

    def test_arrays_with_one_axis_are_common_to_all(self):
        shared = np.arange(3.0)
        assert rows_of(shared, np.array([1]), 3) is shared

    def test_blocks_are_the_designs_in_their_order(self):
        some = table(a=range(10))
        found = some.each(lambda t: t.params.a * t.size, 4)
        np.testing.assert_array_equal(found[:, 0], [0, 4, 8, 12, 16, 20, 24, 28, 16, 18])

    def test_a_number_fills_a_column(self):
        assert column(2.5, 3).tolist() == [[2.5]] * 3


class TestOneRule:
    @pytest.mark.parametrize(
        ("must_be", "fails"),
        [
            ("at least", [True, False, False]),
            ("at most", [False, False, True]),
            ("above", [True, True, False]),
            ("below", [False, True, True]),
        ],
    )
    def test_each_comparison(self, must_be, fails):
        one = rule(limit=5.0, must_be=must_be)
        assert one.forbids(table(a=[4, 5, 6]), Stage.PARTS).tolist() == fails
        singly = [bool(list(one.findings(DesignTable(Params(a=a)), quick=False))) for a in (4, 5, 6)]
        assert singly == fails

    @pytest.mark.parametrize("must_be", ["at least", "at most"])
    def test_a_limit_is_reached_whatever_rounding_made_of_it(self, must_be):
        one = rule(value=lambda t: t.params.a + t.params.b, limit=0.3, must_be=must_be)
        assert not one.forbids(table(a=[0.1], b=[0.2]), Stage.PARTS).any()

    def test_words_are_filled_in_and_a_change_is_proposed(self):
        one = rule(
            message="a is {value:g}, at least {limit:g}; b {m.params.b:g}",
            limit=lambda t: 2 * t.params.b,
            unit="mm",
            remedy=lambda f: f"make a {f.limit:g}",
            proposed=lambda f: [{"parameters.a": f.limit}],
        )
        (found,) = one.findings(DesignTable(Params(a=1, b=3)), quick=False)
        assert found.message == "a is 1, at least 6; b 3"
        assert (found.value, found.limit, found.unit, found.remedy) == (1.0, 6.0, "mm", "make a 6")
        assert found.proposed == ({"parameters.a": 6.0},)
        assert (found.stage, found.severity, found.parameter) == (Stage.PARTS, Severity.ERROR, "a")

    def test_what_is_reported_may_be_another_number_than_what_is_compared(self):
        one = rule(value=lambda t: t.params.a - 3, reported=lambda f: (f.m.params.a, 3.0))
        (found,) = one.findings(DesignTable(Params(a=1)), quick=False)
        assert (found.value, found.limit) == (1.0, 3.0)

    def test_it_is_asked_where_it_applies_and_only_there_it_needs_a_value(self):
        one = rule(value=lambda t: np.sqrt(t.params.a), limit=2.0, when=lambda t: np.asarray(t.params.a) >= 0)
        with np.errstate(all="raise"):
            assert one.forbids(table(a=[-1, 1, 9]), Stage.PARTS).tolist() == [False, True, False]
        assert not list(one.findings(DesignTable(Params(a=-1)), quick=False))

    def test_each_item_that_breaks_it_is_a_finding_or_the_first(self):
        def of(each):
            return rule(
                parameter=lambda f: "abc"[f.item],
                value=lambda t: np.concatenate(
                    [np.atleast_2d(x) for x in (t.params.a, t.params.b, t.params.c)], 1
                ),
                each=each,
            )

        some = DesignTable(Params(a=-1, b=1, c=-2))
        assert [one.parameter for one in of(True).findings(some, quick=False)] == ["a", "c"]
        assert [one.parameter for one in of(False).findings(some, quick=False)] == ["a"]
        assert of(True).forbids(table(a=[1, -1], b=[1, 1], c=[1, 1]), Stage.PARTS).tolist() == [False, True]

    def test_a_bound_leaves_the_value_to_the_rows_that_it_does_not_decide(self):
        seen = []

        def exact(t):
            seen.extend(np.ravel(t.params.a).tolist())
            return t.params.a

        one = rule(value=exact, worst=lambda t: t.params.a - 2, best=lambda t: t.params.a + 2)
        assert allowed(all_of(one), table(a=[-5, -1, 1, 5])) == ["r", "r", "", ""]
        assert seen == [-1, 1]
        seen.clear()
        assert not list(one.findings(DesignTable(Params(a=5)), quick=False))
        assert seen == []
        assert list(one.findings(DesignTable(Params(a=-5)), quick=False))

    def test_a_bound_of_what_may_be_at_most_a_limit(self):
        seen = []
        one = rule(
            value=lambda t: seen.extend(np.ravel(t.params.a)) or t.params.a,
            best=lambda t: t.params.a - 2,
            worst=lambda t: t.params.a + 2,
            must_be="at most",
        )
        assert allowed(all_of(one), table(a=[-5, -1, 1, 5])) == ["", "", "r", "r"]
        assert seen == [-1, 1]

    def test_warnings_and_later_stages_forbid_nothing(self):
        some = table(a=[-1.0])
        assert rule(severity=Severity.WARNING).forbids(some, Stage.MACHINING) is None
        assert rule(stage=Stage.MACHINING).forbids(some, Stage.PARTS) is None
        assert rule(stage=Stage.MOTION).forbids(some, Stage.MOTION).tolist() == [True]

    def test_what_is_slow_the_quick_judge_leaves_out(self):
        some = DesignTable(Params(a=-1))
        slow = rule(slow="remedy", remedy="r", proposed=lambda f: [{"parameters.a": f.limit}])
        assert [(one.remedy, one.proposed) for one in slow.findings(some, quick=True)] == [("", ())]
        assert [one.remedy for one in slow.findings(some, quick=False)] == ["r"]
        assert not list(rule(slow="value").findings(some, quick=True))
        assert rule(slow="value").forbids(table(a=[-1]), Stage.PARTS) is None

    def test_a_value_that_is_no_number_is_a_fault(self):
        with pytest.raises(Exception, match="rule r: its value is no number"):
            rule(value=lambda t: t.params.a * math.nan).forbids(table(a=[1, 2]), Stage.PARTS)

    def test_a_function_of_one_design_is_called_for_each_row(self):
        one = rule(value=by_row(lambda t: math.floor(t.params.a)), limit=1)
        assert one.forbids(table(a=[0.5, 1.5]), Stage.PARTS).tolist() == [True, False]
        assert [f.value for f in one.findings(DesignTable(Params(a=0.5)), quick=False)] == [0.0]


def test_rules_by_design_are_all_asked_of_one_design_before_the_next():
    asked = []

    def watched(name):
        def value(t):
            asked.append((name, t.params.a))
            return getattr(t.params, name)

        return value

    late = rule("machined", value=lambda _: -1.0, stage=Stage.MACHINING)
    inner = all_of(rule("a", value=watched("a")), rule("b", value=watched("b")))
    some = table(a=[1, -1, 2], b=[1, -1, -1])
    rules = in_turn(rule("c", value=lambda t: t.params.c), by_design(inner, late))
    assert allowed(rules, some) == ["", "a", "b"]
    assert asked == [(name, a) for a in (1, -1, 2) for name in "ab"]
    assert allowed(rules, table(a=[1.0], b=[1.0]), Stage.MACHINING) == ["machined"]
    assert [one.code for one in rules.findings(some.row(1))] == ["a", "b"]
    assert rules.codes == ("c", "a", "b", "machined")


def test_a_procedure_is_asked_of_each_row_or_once_for_all():
    def inspect(t):
        seen.append(t.params.a)
        if t.params.a < 0 or t.params.n > 5:
            yield Finding.error("p", "a", "bad", stage=Stage.PARTS)

    seen = []
    some = table(a=[-1, 1, 2])
    each = Procedure(("p",), inspect, when=lambda t: np.asarray(t.params.a) < 2)
    assert each.forbids(some, Stage.PARTS).tolist() == [True, False, False]
    assert each.forbids(some, Stage.MOTION).tolist() == [False, False, False]
    assert seen[:2] == [-1.0, 1.0]
    seen.clear()
    assert Procedure(("p",), inspect, common=True).forbids(some, Stage.PARTS).tolist() == [True] * 3
    assert len(seen) == 1
    assert Procedure(("p",), inspect, slow=True).forbids(some, Stage.PARTS) is None


def test_a_procedure_of_several_codes_forbids_each_row_with_its_own():
    def inspect(t):
        yield Finding.warning("third", "a", "odd")
        if t.params.a < 1:
            yield Finding.error("second" if t.params.a < 0 else "first", "a", "bad", stage=Stage.PARTS)

    some, codes = table(a=[-1, 0, 1, -2]), ("first", "second", "third")
    assert allowed(in_turn(each := Procedure(codes, inspect)), some) == ["second", "first", "", "second"]
    assert allowed(in_turn(each), some, Stage.MOTION) == [""] * 4
    assert allowed(in_turn(Procedure(codes, inspect, common=True)), some) == ["second"] * 4
    with pytest.raises(UnsoundError, match="gives 3; findings are wanted"):
        in_turn(Procedure(codes, lambda _: 3)).findings(some)


class TestLists:
    NOTE = Note("n", "a is {value:g}", lambda t: t.params.a, "mm")

    def test_all_are_asked_or_each_in_turn(self):
        one, two = rule("one"), rule("two", value=lambda t: t.params.b)
        bad = DesignTable(Params(a=-1, b=-1))
        assert [f.code for f in all_of(one, two, self.NOTE).findings(bad)] == ["one", "two", "n"]
        assert [f.code for f in in_turn(one, two, self.NOTE).findings(bad)] == ["one"]
        assert [f.code for f in in_turn(all_of(one, two), self.NOTE).findings(bad)] == ["one", "two"]

    def test_a_warning_stops_nothing(self):
        warning = rule("w", severity=Severity.WARNING)
        assert [f.code for f in in_turn(warning, self.NOTE).findings(DesignTable(Params(a=-1)))] == ["w", "n"]

    def test_a_list_may_be_for_some_structures_only(self):
        some = all_of(rule(), when=lambda t: t.params.kind == "y")
        assert some.findings(DesignTable(Params(a=-1))) == []
        assert len(some.findings(DesignTable(Params(a=-1, kind="y")))) == 1
        assert allowed(all_of(some), table(a=[-1])) == [""]

    @settings(deadline=None, max_examples=60)
    @given(st.data())
    def test_the_first_error_of_a_row_is_that_of_the_design_by_itself(self, data):
        """Whatever the list: nested, in turn or all, at each stage."""
        size = data.draw(st.integers(1, 12))
        numbers = st.lists(st.integers(-2, 2), min_size=size, max_size=size)
        some = table(a=data.draw(numbers), b=data.draw(numbers), c=data.draw(numbers))

        def leaf(number):
            name = data.draw(st.sampled_from("abc"))
            limit = data.draw(st.integers(-2, 2))
            more = {"when": lambda t: np.asarray(t.params.c) > 0} if data.draw(st.booleans()) else {}
            if data.draw(st.booleans()):
                more["worst"] = lambda t: getattr(t.params, name) - 1
            if data.draw(st.booleans()):
                more["best"] = lambda t: getattr(t.params, name) + 1
            return rule(f"r{number}", value=lambda t: getattr(t.params, name), limit=limit, **more)

        def rules(depth, start):
            count = data.draw(st.integers(1, 3))
            every = [
                rules(depth - 1, f"{start}.{k}")
                if depth and data.draw(st.booleans())
                else leaf(f"{start}.{k}")
                for k in range(count)
            ]
            return data.draw(st.sampled_from((all_of, in_turn)))(*every)

        found = rules(2, "")
        singly = [found.findings(some.row(k)) for k in range(size)]
        assert allowed(found, some) == [one[0].code if one else "" for one in singly]


class Odd(Standing[Params]):
    """A family whose formulas fail for some designs."""

    name, title, summary = "odd", "Odd", "Formulas that fail."
    Params = Params
    bodies = ("b",)
    registered_by = "plugin odd of odd-families"

    def rules(self):
        """No number below 0; above 8 a formula raises."""

        def raising(t):
            if np.any(np.asarray(t.params.a) > 8):
                raise ZeroDivisionError("above 8")
            return t.params.b

        return in_turn(
            rule("odd.root", value=lambda t: np.sqrt(t.params.a), limit=1.0), rule("odd.b", value=raising)
        )

    def figures(self, table):
        """A figure that fails at 5."""
        if np.any(np.asarray(table.params.a) == 5):
            raise ValueError("five")
        return {"twice": Figure(2 * table.params.a)}

    def parts(self, params):
        """None."""
        return ()


class TestFaults:
    def evaluated(self, values):
        batch = Batch(Params, {}, {"a": np.array(values, dtype=float), "b": np.arange(1.0, len(values) + 1)})
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            found = Odd().evaluate(batch, ["twice"])
        codes = [found.codes[number] for number in found.forbidden]
        return codes, found.values["twice"], [str(one.message) for one in heard]

    def test_the_rest_of_the_table_stands(self):
        codes, twice, said = self.evaluated([4, -1, 9, 0.25, 5, 6, -2])
        assert codes == [
            "",
            "fault.odd.root",
            "fault.odd.b",
            "odd.root",
            "fault.figures",
            "",
            "fault.odd.root",
        ]
        np.testing.assert_array_equal(twice, [8, np.nan, np.nan, np.nan, np.nan, 12, np.nan])
        assert said == [
            "odd.root fails for the design a = -1.0, b = 2.0 (row 2): rule odd.root: its value is no number",
            "odd.b fails for the design a = 9.0, b = 3.0 (row 3): ZeroDivisionError: above 8",
            "figures fails for the design a = 5.0, b = 5.0 (row 5): ValueError: five",
        ]

    def test_where_none_fails_nothing_is_said(self):
        assert self.evaluated([1, 2, 3])[2] == []

    def test_a_check_names_plugin_and_rule(self):
        with pytest.raises(
            PluginFaultError, match=r"plugin odd .* check\(\): rule odd.root: its value is no number"
        ):
            Odd().check(Params(a=-1))

    def test_what_a_formula_raises_is_told_with_the_plugin(self):
        with pytest.raises(PluginFaultError, match=r"plugin odd .*ZeroDivisionError: above 8"):
            Odd().check(Params(a=9))

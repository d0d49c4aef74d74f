"""The search for remedies, on a family whose limits are known exactly."""

import importlib
import io
import math
from dataclasses import replace
from pathlib import Path

import pytest
from beam_family import Beam, bench, design, error, told
from disc_family import Disc
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from mechwright.cli.telling import block
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.designs.design import Design
from mechwright.plugins.host import host
from mechwright.remedies import MOST_CHANGES, Bench, nearest, remedied
from mechwright.remedies.keys import Key, keys_of
from mechwright.remedies.values import closest, distance, ladder
from mechwright.testing.fixes import fix_faults


def test_a_value_past_its_limit_is_set_to_the_limit():
    (slender,) = told(design(length=437.5))
    assert slender.fix == {"parameters.width": 44}
    assert slender.remedy == "set width = 44 (now 20.0, by default)"


def test_what_the_file_says_is_what_is_told_with_its_unit():
    (slender,) = told(design(length='"40 cm"', width='"1 in"'))
    assert slender.remedy == 'set width = 40 (now "1 in")'


def test_a_bound_of_an_angle_and_another_choice_are_found():
    tilt, kind = sorted(told(design(tilt=77.0, kind='"forked"')), key=lambda one: one.code)[::-1]
    assert tilt.fix == {"parameters.tilt": 30}
    assert kind.fix in ({"parameters.kind": "plain"}, {"parameters.kind": "bent"})


def test_a_key_that_only_the_remedy_names_is_tried():
    (holes,) = [one for one in told(design(holes=30, length=280, width=30)) if one.severity is Severity.ERROR]
    assert holes.fix is not None
    assert (
        errors(
            Beam().check(
                design().changed(dict(holes.fix) | {"parameters.length": 280, "parameters.width": 30}).params
            )
        )
        == []
    )


def test_a_finding_behind_another_is_part_of_the_remedy():
    (slender,) = told(design(length=380, holes=40, width=30))
    assert set(slender.fix) >= {"parameters.width"}
    assert errors(Beam().check(design(length=380, holes=40, width=30).changed(slender.fix).params)) == []
    assert len(slender.fix) == 2


def test_what_has_to_go_together_goes_together():
    change = nearest(bench(design(collar=3, collar_width=2)))
    assert change in ({"parameters.collar": 40}, {"parameters.width": 10}, {"parameters.width": 1.5})


def test_where_keys_are_too_many_another_value_of_one_stands_for_two(monkeypatch):
    module = importlib.import_module("mechwright.remedies.nearest")
    one = bench(design(collar=3, collar_width=2, tilt=77.0))
    back = {"parameters.collar": None, "parameters.collar_width": None, "parameters.tilt": 0}
    assert one.builds(back)
    assert module._joined(one, back) == back, "not too many"
    monkeypatch.setattr(module, "MOST_CHANGES", 2)
    assert module._joined(one, back) == {"parameters.collar": 40, "parameters.tilt": 30}
    monkeypatch.setattr(module, "MOST_CHANGES", 1)
    assert one.builds(module._joined(one, back))


def test_the_first_proposal_that_holds_is_taken_and_one_that_does_not_is_not():
    class Proposing(Beam):
        def found(self, params):
            proposed = (
                {"parameters.width": 25},
                {"parameters.nothing": 1},
                {"parameters.width": 45},
                {"parameters.width": 44},
            )
            found = [*super().found(params)]
            return [
                one
                if one.severity is Severity.NOTE
                else error(one.code, one.parameter, "x", proposed=proposed)
                for one in found
            ]

    (slender,) = told(design(Proposing, length=437.5))
    assert slender.fix == {"parameters.width": 45}


def test_a_proposal_is_written_without_the_last_digits_of_its_reckoning():
    class Reckoning(Beam):
        def found(self, params):
            return [
                error(one.code, one.parameter, "x", proposed=({"parameters.width": 3 * 14.7},))
                for one in errors(super().found(params))
            ]

    assert 3 * 14.7 != 44.1
    (slender,) = told(design(Reckoning, length=437.5))
    assert slender.fix == {"parameters.width": 44.1}


def test_where_nothing_helps_it_says_what_was_tried():
    class Hopeless(Beam):
        def found(self, params):
            return [error("beam.never", "width", "try holes or pins.first")]

    (never,) = told(design(Hopeless))
    assert never.fix is None
    assert never.remedy == "no remedy found by changing width, holes, pins.first"
    (never,) = told(design(Hopeless), tries=5)
    assert never.remedy.endswith("in 5 tries")


def test_what_gets_past_an_error_of_the_motion_says_where_it_leads():
    class Standing(Beam):
        """Stands at every width but one, with which it is seen to be hopeless."""

        def found(self, params):
            if params.width == 45:
                return [error("beam.never", "length", "try holes")]
            moving = error("beam.stands", "width", "x", proposed=({"parameters.width": 45},))
            return [replace(moving, stage=Stage.MOTION)]

    (stands,) = told(design(Standing))
    assert stands.fix is None
    assert stands.remedy == "set width = 45 (now 20.0, by default), which leads to beam.never: it is wrong"


def test_a_remedy_that_spoils_something_else_is_none():
    class Squeezed(Beam):
        """Width is too small below 40, and too large above: nothing but length helps."""

        def found(self, params):
            found = [error("beam.slender", "width", "make width larger")] if params.width < 40 else []
            return [*found, *([error("beam.wide", "width", "smaller")] if params.width > 30 else [])]

    assert [one.fix for one in told(design(Squeezed))] == [None]


def test_what_raises_is_no_remedy():
    class Fragile(Beam):
        def found(self, params):
            if params.width > 20:
                raise ZeroDivisionError
            return [error("beam.never", "width", "no")]

    assert [one.fix for one in told(design(Fragile))] == [None]


def test_a_search_ends_after_its_tries_and_its_time():
    one = bench(design(length=4000), tries=3)
    nearest(one)
    assert (one.tries, one.spent) == (3, True)
    assert bench(design(length=4000), seconds=0.0).spent


def test_the_same_search_finds_the_same():
    of = design(length=4000, holes=39, tilt=80.0, kind='"forked"', collar=3, collar_width=2)
    assert nearest(bench(of)) == nearest(bench(of))


@given(
    st.fixed_dictionaries(
        {
            "length": st.floats(1, 5000),
            "width": st.floats(0.1, 500),
            "holes": st.integers(0, 40),
            "tilt": st.floats(-90, 90),
            "kind": st.sampled_from(['"plain"', '"forked"']),
        }
    )
)
def test_every_design_of_this_family_is_mended(table):
    of = design(**table)
    change = nearest(bench(of))
    assert change is not None
    assert len(change) <= MOST_CHANGES
    assert errors(Beam().check(of.changed(change).params)) == []
    keys = {
        "parameters.length",
        "parameters.width",
        "parameters.holes",
        "parameters.tilt",
        "parameters.kind",
        "parameters.pins.first",
    }
    assert set(change) <= keys, "a key that no finding is about"


@given(st.floats(5, 500), st.floats(1, 400), st.integers(0, 12))
def test_remedies_of_the_disc_hold(diameter, bore, holes):
    assert fix_faults(Disc(), {"diameter": diameter, "bore": bore, "holes": holes}) == []


def test_a_remedy_that_does_not_hold_is_named(monkeypatch):

    from mechwright.testing import fixes

    def lying(design, findings, limits):
        return [
            replace(one, fix={"parameters.bore": 38.5}) for one in findings if one.severity is Severity.ERROR
        ]

    monkeypatch.setattr(fixes, "tried", lying)
    assert "found all the same" in fix_faults(Disc(), {"bore": 39})[0]


def test_the_kit_refuses_a_family_whose_printed_remedies_do_not_hold(monkeypatch):
    """By its refused tables and by random ones, and a family whose judge says other things than its check."""
    from mechwright.testing import fixes

    class Lying(Disc):
        def judge(self, params):
            return [replace(one, message="another") for one in self.check(params)]

    class Kit(fixes.FixTests):
        family = Disc
        refused = (({"bore": 39}, "bore"),)

        def strategy(self):
            return st.just({"bore": 39})

    Kit().test_fixes_of_refused_designs()
    Kit().test_fixes_of_random_designs()
    Kit().test_judge_says_what_check_says()
    with monkeypatch.context() as patch:
        patch.setattr(Kit, "family", Lying)
        with pytest.raises(AssertionError, match="is not in check"):
            Kit().test_judge_says_what_check_says()
    holds = importlib.import_module("mechwright.remedies.remedied")
    monkeypatch.setattr(holds, "refined", lambda *_: {"parameters.bore": 38.5})
    Kit().test_fixes_of_refused_designs()  # what does not hold is not told
    monkeypatch.setattr(holds, "holds", lambda *_: True)
    for test in (Kit().test_fixes_of_refused_designs, Kit().test_fixes_of_random_designs):
        with pytest.raises(AssertionError, match="found all the same"):
            test()


def test_a_note_that_stays_is_no_finding_that_stays():
    class Telling(Beam):
        def found(self, params):
            note = Finding("beam.slender", Severity.NOTE, "width", "so slender it is")
            return [note, *super().found(params)]

    slender = told(design(Telling, length=437.5))[1]
    assert slender.fix == {"parameters.width": 44}


def test_keys_have_their_bounds_choices_and_tables():
    keys = keys_of(design())
    assert (keys["parameters.width"].low, keys["parameters.width"].high) == (pytest.approx(1e-3), 500)
    assert keys["parameters.kind"].choices == ("plain", "bent", "forked")
    assert keys["parameters.pins.first"].default == 5
    assert keys["parameters.collar"].default is None
    assert keys["parameters.pins.first"].now({"parameters": {"pins": {"first": "1 in"}}}) == pytest.approx(
        25.4
    )


@given(st.floats(1, 100), st.floats(1, 100), st.booleans())
def test_closest_never_gives_a_value_that_fails(now, limit, whole):
    key = Key("parameters.x", "integer" if whole else "number", 1, 1000)
    now = float(round(now)) if whole else now
    good = float(math.ceil(limit + 1))
    if now >= limit:
        return
    found = closest(key, now, good, lambda x: x >= limit)
    assert limit <= found <= max(good, limit * 1.04)
    assert found <= max(limit * 1.04 + (good - now) / 16, math.ceil(limit))


@given(st.floats(1, 5000), st.sampled_from(["number", "integer"]))
def test_values_that_are_tried_are_within_the_bounds(now, kind):
    key = Key("parameters.x", kind, 1, 5000, default=80)
    values = ladder(key, round(now) if kind == "integer" else now)
    assert values
    assert all(1 <= value <= 5000 for value in values)
    assert all(distance(key, now, value) >= 0 for value in values)


def shown(width, colour, monkeypatch):
    if not colour:
        monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    file = io.StringIO()
    finding = Finding.error(
        "gear.root", "teeth", "a long sentence " * 8, 9, 11, remedy="set teeth = 11 (now 9)"
    )
    block(
        finding,
        Console(
            file=file,
            force_terminal=True,
            width=width,
            highlight=False,
            color_system="standard" if colour else None,
        ),
    )
    return file.getvalue()


@pytest.mark.parametrize("width", [40, 80])
def test_on_a_terminal_a_finding_is_a_block_of_its_width(width, monkeypatch):
    lines = [line.rstrip() for line in shown(width, False, monkeypatch).splitlines()]
    assert lines[0] == "error gear.root teeth"
    assert lines[-1] == "  set teeth = 11 (now 9)"
    assert all(len(line) <= width and line.startswith("  ") for line in lines[1:])
    assert "\x1b[3" not in shown(width, False, monkeypatch)


def test_on_a_terminal_it_is_coloured(monkeypatch):
    assert "\x1b[1;31merror" in shown(80, True, monkeypatch)


def test_what_could_steer_a_terminal_is_escaped(monkeypatch):
    file = io.StringIO()
    block(Finding.note("a.b", "bell \x07 and \x1b[31m red [bold]b[/bold]"), Console(file=file, width=80))
    assert "\x1b" not in file.getvalue()
    assert "\\x07" in file.getvalue()
    assert "[bold]b[/bold]" in file.getvalue()


def test_remedied_keeps_the_order_and_the_notes():
    of = design(length=437.5, kind='"forked"')
    found = list(Beam().check(of.params))
    assert [one.code for one in remedied(bench(of), found)] == [one.code for one in found]


def test_what_is_asked_for_is_changed_last():
    """The width that the file does not say, and not the length that it does."""
    free, both = design(length=437.5), design(length=437.5, width=20.0)
    assert nearest(bench(free)) == {"parameters.width": 44}
    length, width = ({"parameters.length": 200}, {"parameters.width": 44})
    assert bench(free).size(width) < bench(both).size(width)
    assert bench(free).size(length) == bench(both).size(length)
    crank = host().family("four-bar")
    said = Design(
        "a", crank, crank.Params(), Path("a.toml"), "", content={"parameters": {"crank": 30, "rim": 4}}
    )
    weigh = Bench(said, lambda _: ()).weight
    assert weigh("parameters.crank") > weigh("parameters.rim") > weigh("parameters.washer")


@pytest.mark.parametrize("now", [400.0, -400.0])
def test_a_number_with_a_sign_is_lowered_by_ratios(now):
    values = ladder(Key("parameters.load", "number", -1e6, 1e6), now)
    assert {now / 40, now / 5, now * 40, 0, -now} <= set(values)
    assert closest(Key("parameters.load", "number", -1e6, 1e6), now, now / 600, lambda x: abs(x) < 7.3) == (
        pytest.approx(math.copysign(7.0, now))
    )


@pytest.mark.parametrize("now", [-170.0, -3.0, 0.0, 42.0, 175.0])
def test_the_ladder_of_an_angle_keeps_its_bounds_and_goes_both_ways(now):
    values = ladder(Key("parameters.angle", "number", -180, 180, default=0, unit="deg"), now)
    assert all(-180 <= value <= 180 for value in values)
    assert min(values) < now < max(values)
    away = [abs(value - now) for value in values[:2]]
    assert max(away) <= 10

"""What a search remembers, and that it brings near no change that cannot be the best."""

import importlib

import pytest
from beam_family import Beam, bench, design, error, told
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.remedies import Bench

NEAREST = importlib.import_module("mechwright.remedies.nearest")
LEAST = NEAREST._least


def counted(**table):
    """A bench, and the contents of the designs that its judge is asked of."""
    asked = []

    def judge(one):
        asked.append(one.content["parameters"])
        return Beam().check(one.params)

    return Bench(design(**table), judge), asked


def test_a_change_that_changes_nothing_is_the_design_as_it_is():
    one, asked = counted(width=9, kind='"forked"')
    found = one.found({})
    for change in (
        {"parameters.width": 9},
        {"parameters.width": 9.0},
        {"parameters.kind": "forked"},
        {"parameters.tilt": None},
        {"parameters.width": 9.0, "parameters.tilt": None},
    ):
        assert one.found(change) is found
    assert len(asked) == one.tries == 1


def test_answers_are_kept_by_what_differs_whatever_its_order():
    one, asked = counted(width=9)
    first = one.found({"parameters.width": 12, "parameters.holes": 3})
    assert one.found({"parameters.holes": 3, "parameters.width": 12.0}) is first
    assert one.found({"parameters.holes": 3, "parameters.width": 12, "parameters.tilt": None}) is first
    assert len(asked) == 1


@pytest.mark.parametrize(
    "change",
    [
        {"parameters.width": 9.001},
        {"parameters.width": None},
        {"parameters.holes": 9},
        {"parameters.length": 9},
        {"parameters.width": 9, "parameters.pins.first": 9},
        {"parameters.tilt": 0.0},
        {"parameters.kind": "plain"},
        {"parameters.pins.second": 9},
    ],
)
def test_what_differs_has_an_answer_of_its_own(change):
    """So has a default that the file would say: a family may tell it from what is left out."""
    one, asked = counted(width=9)
    assert one.found({}) is not None
    assert one.found(change) is not None
    assert len(asked) == 2
    assert asked[0] != asked[1]
    everything = [{}, {"parameters.width": 9.5}, change]
    assert len({one._differing(each) for each in everything}) == 3


TABLES = st.fixed_dictionaries(
    {
        "length": st.floats(1, 5000),
        "width": st.floats(0.1, 500),
        "holes": st.integers(0, 40),
        "tilt": st.floats(-90, 90),
        "kind": st.sampled_from(['"plain"', '"forked"']),
    },
    optional={"collar": st.just(3), "collar_width": st.just(2)},
).filter(lambda table: ("collar" in table) == ("collar_width" in table))


@settings(deadline=None)
@given(TABLES)
def test_the_first_candidate_is_that_of_all_brought_near(table):
    lazy = bench(design(**table))
    first = next(NEAREST.candidates(lazy), None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(NEAREST, "_least", lambda *_: (False, False, -1.0))
        eager = bench(design(**table))
        every = list(NEAREST.candidates(eager))
    assert first == (every[0] if every else None)
    assert lazy.tries <= eager.tries
    if first is not None:
        assert lazy.builds(first)


@settings(deadline=None)
@given(TABLES)
def test_no_change_brought_near_is_ranked_before_what_was_said_of_it(table):
    one = bench(design(**table))
    by_steps = NEAREST._by_steps(one)
    for change in [*([by_steps] if by_steps else []), *NEAREST._from_known(one)]:
        given_back = NEAREST._given_back(one, change)
        assert LEAST(one, given_back)[2] <= one.size(NEAREST._near(one, given_back)) + 1e-9


def test_a_change_that_cannot_be_the_best_is_not_brought_near(monkeypatch):
    """Of two ways that both build, drawing numbers back is paid for once."""
    near = []
    monkeypatch.setattr(NEAREST, "_near", lambda _, change: near.append(change) or change)
    monkeypatch.setattr(NEAREST, "_by_steps", lambda _: {"parameters.width": 21})
    far = {"parameters.kind": "bent", "parameters.collar": None, "parameters.tilt": 3, "parameters.holes": 1}
    monkeypatch.setattr(NEAREST, "_from_known", lambda _: iter([far]))
    monkeypatch.setattr(NEAREST, "_given_back", lambda _, change: dict(change))
    one = bench(design(width=20, kind='"plain"', tilt=2, holes=2))
    found = NEAREST.candidates(one)
    assert next(found) == {"parameters.width": 21}
    assert near == [{"parameters.width": 21}]
    assert next(found) == far
    assert near[1:] == [far], "the next best, where it is asked for"


def test_what_is_proposed_is_tried_before_the_tries_are_spent_on_another_finding():
    class Proposing(Beam):
        def _first(self, params):
            yield error("beam.never", "length", "try holes or pins.first")
            if params.tilt > 30:
                yield error("beam.tilt", "tilt", "less", proposed=({"parameters.tilt": 30},))

    never, tilt = told(design(Proposing, tilt=77.0), tries=6, seconds=60.0)
    assert never.fix is None
    assert "in 6 tries" in never.remedy
    assert tilt.fix == {"parameters.tilt": 30}

"""What ``fix`` does beyond the family: what a dearer judgement proposes is followed before lengths are changed."""

from beam_family import design
from disc_family import Disc

from mechwright.contracts.finding import Finding, Stage
from mechwright.pipeline import Inspection
from mechwright.remedies import repair, repaired

MADE = 22.2
"""The one bore that the cutter of these tests makes."""


class Bores(Inspection):
    """A workshop that makes one size of bore, and any in a disc that is large."""

    name = "bores"
    stage = Stage.MACHINING

    def __init__(self, proposes: bool = True) -> None:
        self.proposed = ({"parameters.bore": MADE},) if proposes else ()

    def findings(self, build):
        params = build.design.params
        if params.hole == MADE or params.diameter > 50:
            return []
        return [Finding.error("cam.none", "cam.tools", "no cutter makes it", proposed=self.proposed)]


class Shop:
    """A host that has one inspection."""

    def __init__(self, look):
        self.look = look

    def all(self, contract):
        return [self.look] if contract is Inspection else []


def two_ways(monkeypatch):
    found = [{"parameters.bore": 24}, {"parameters.diameter": 60}]
    monkeypatch.setattr(repair, "candidates", lambda bench: found)
    return design(Disc, bore=39)


def test_what_a_cutter_proposes_comes_before_another_length(monkeypatch):
    done = repaired(two_ways(monkeypatch), Shop(Bores()), Stage.MACHINING)
    assert [one.code for one in done.found] == ["disc.wall"]
    assert done.change == {"parameters.bore": MADE}


def test_where_nothing_is_proposed_the_other_length_is_taken(monkeypatch):
    done = repaired(two_ways(monkeypatch), Shop(Bores(proposes=False)), Stage.MACHINING)
    assert done.change == {"parameters.diameter": 60}


def test_what_stands_in_a_design_that_pleases_its_family_is_told_with_its_proposal():
    done = repaired(design(Disc, bore=24), Shop(Bores()), Stage.MACHINING)
    assert [one.code for one in done.found] == ["cam.none"]
    assert done.change == {"parameters.bore": MADE}


def test_a_design_that_builds_is_not_changed():
    done = repaired(design(Disc, bore=MADE), Shop(Bores()), Stage.MACHINING)
    assert (done.found, done.change, done.left) == ([], {}, [])


def test_where_keys_are_too_many_the_nearest_design_is_told_and_not_taken(monkeypatch):
    monkeypatch.setattr(repair, "MOST_CHANGES", 0)
    of = design(Disc, bore=39)
    done = repaired(of, Shop(Bores()), Stage.PARTS)
    assert not done.builds
    assert [one.code for one in done.left] == ["disc.wall"]
    assert len(done.nearest) == 1
    assert repaired(of.changed(done.nearest), Shop(Bores()), Stage.PARTS).change == {}


def test_a_design_that_only_pleases_its_family_is_no_nearest(monkeypatch):
    monkeypatch.setattr(repair, "MOST_CHANGES", 0)
    done = repaired(design(Disc, bore=39), Shop(Bores()), Stage.MACHINING)
    assert (done.change, done.nearest) == (None, None)

"""What a search asks, what it tells only when that was proven, and what it tells of warnings."""

from dataclasses import replace

from beam_family import Beam, bench, design, error, told

from mechwright.contracts.finding import Finding, errors
from mechwright.remedies import Limits, nearest, of_family
from mechwright.remedies.remedied import with_proposed
from mechwright.testing.fixes import fix_faults


class Proven(Beam):
    """Its judge does not prove that holes are few, and seeks no remedy for a slender beam."""

    name = "proven"

    def found(self, params):
        found = super().found(params)
        return found if errors(found) else [*found, *self._proof(params)]

    def found_fast(self, params):
        return [
            Finding.error(one.code, one.parameter, one.message) if one.code == "beam.slender" else one
            for one in super().found(params)
        ]

    def _proof(self, params):
        if params.width > 30 and params.pins.second > 4:
            yield error("beam.proof", "pins.second", "smaller", params.pins.second, 4.0)


def test_what_the_judge_leaves_out_is_proven_before_it_is_told():
    """Width alone pleases the judge; the proof wants a thinner pin besides."""
    of = design(Proven, length=437.5)
    assert not of_family(of, Limits()).sure.builds({"parameters.width": 44})
    change = nearest(of_family(of, Limits()))
    assert change == {"parameters.width": 44, "parameters.pins.second": 4}
    (slender,) = told(of)
    assert slender.fix == change
    assert "parameters.width" in slender.fix
    assert not fix_faults(Proven(), {"length": 437.5})


def test_what_only_the_proof_finds_has_a_remedy_too():
    (proof,) = [one for one in told(design(Proven, width=40)) if one.code == "beam.proof"]
    assert proof.fix == {"parameters.pins.second": 4}


def test_a_search_asks_the_judge_and_its_last_word_is_that_of_the_check():
    asked = []

    class Counted(Proven):
        name = "counted"

        def found(self, params):
            asked.append(params)
            return super().found(params)

    of = design(Counted, length=437.5, width=20, holes=20, pins="{second = 3}")
    search = of_family(of, Limits())
    assert nearest(search)
    assert search.tries > 3 * len(asked) > 0


def test_advice_is_called_too_little_only_where_it_was_tried():
    of = design(length=437.5)
    advised = replace(Beam().check(of.params)[0], remedy="use at most 30")
    told = with_proposed(bench(of), advised).remedy
    assert told == "use at most 30; what is proposed was tried, and is not enough by itself"
    assert with_proposed(bench(of, tries=0), advised) == advised

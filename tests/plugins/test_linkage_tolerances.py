"""Tolerances of linkages: the families four-bar and slider-crank, differences of the motion, any topology."""

import numpy as np
import pytest
from by_night import by_night
from drawn_bars import four_bar, slider_crank

from mechwright import Tolerances, Turning
from mechwright.contracts.tolerance_settings import ToleranceSettings
from mechwright.mechanics.linkage.made_error import EXACT
from mechwright.mechanics.linkage.tolerance.model import LinkageTolerances
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.sensitivity import Change, Pose, changed, sensitivities
from mechwright.mechanics.tolerance import analyse
from mechwright.testing.tolerances import tolerance_faults
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.tolerances import FourBarTolerances
from mechwright_four_bar.table import FourBarTable
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable
from mechwright_slider_crank.as_made.tolerances import SliderCrankTolerances
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.table import SliderCrankTable

INPUT = Tolerances(ToleranceSettings(input=0.1))
AT = np.linspace(0.1, 6.2, 41)
POINT = {"coupler_point_x": 30.0, "coupler_point_y": 20.0}
BARS = [{"frame": "one", **POINT}, {"frame": "two", **POINT}]
OTHER_NAMES = {"point-along": "p-along", "point-across": "p-across", "shaft-b0": "pin-b0"}


def rows(model, output, at):
    return dict(zip((one.name for one in model.contributors), model.sensitivities(output, at), strict=True))


def gram(row):
    """Products of a row's directions: a pin has no directions of its own."""
    return np.einsum("im...,jm...->ij...", row, row)


def same(found, wanted):
    assert gram(found) == pytest.approx(gram(wanted), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("table", BARS)
def test_a_drawn_four_bar_has_the_sensitivities_of_its_family(table):
    bar = FourBarParams(**table)
    known, model = (
        FourBarTolerances(FourBarTable.of(bar), INPUT),
        LinkageTolerances(LinkageTable.of(four_bar(bar)), INPUT),
    )
    zones = {one.name: one for one in model.contributors}
    for output, own in zip(known.outputs, model.outputs, strict=True):
        assert (own.unit, own.components) == (output.unit, output.components)
        assert model.nominal(own.name, AT) == pytest.approx(known.nominal(output.name, AT), abs=1e-9)
        found = rows(model, own.name, AT)
        wanted = rows(known, output.name, AT)
        assert len(found) == len(wanted)
        for one in known.contributors:
            name = OTHER_NAMES.get(one.name, one.name)
            same(found[name], wanted[one.name])
            assert (zones[name].lower, zones[name].upper) == pytest.approx((one.lower, one.upper))
            assert zones[name].nominal == pytest.approx(one.nominal, abs=1e-9)
            if not one.directions:
                assert found[name] == pytest.approx(wanted[one.name], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("contact", ["any", "loaded"])
def test_worst_case_and_sigma_of_a_drawn_four_bar_are_those_of_its_family(contact):
    bar = FourBarParams(**BARS[0])
    asked = Tolerances(ToleranceSettings(contact=contact, samples=100))
    known = analyse(FourBarTolerances(FourBarTable.of(bar), asked), asked)
    found = analyse(Linkages().tolerances(four_bar(bar), asked), asked)
    for one, two in zip(known.results, found.results, strict=True):
        assert two.band.sigma == pytest.approx(one.band.sigma, rel=1e-9)
        assert two.band.high == pytest.approx(one.band.high, rel=1e-9)


def test_exact_errors_of_a_drawn_four_bar_are_those_of_its_family():
    bar = FourBarParams(**BARS[0])
    known, model = (
        FourBarTolerances(FourBarTable.of(bar), INPUT),
        LinkageTolerances(LinkageTable.of(four_bar(bar)), INPUT),
    )
    rng = np.random.default_rng(7)
    sizes = {one.name: rng.uniform(-0.3, 0.3, (one.components, 9)) for one in known.contributors}
    sizes["input"] *= 0.1
    for one in known.contributors:
        if one.directions:
            sizes[one.name] *= 0
    own = {OTHER_NAMES.get(name, name): value for name, value in sizes.items()}
    for output, mine in zip(known.outputs, model.outputs, strict=True):
        wanted = known.errors(output.name, [sizes[one.name] for one in known.contributors], AT[:9])
        found = model.errors(mine.name, [own[one.name] for one in model.contributors], AT[:9])
        assert found == pytest.approx(wanted, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("sizes", [{}, {"offset": -20.0, "slide_direction": 30.0, "assembly": "behind"}])
def test_a_drawn_slider_crank_has_the_sensitivities_of_its_family(sizes):
    params = SliderCrankParams(coupler_x=40, coupler_y=15, **sizes)
    known, model = (
        SliderCrankTolerances(SliderCrankTable.of(params), INPUT),
        LinkageTolerances(LinkageTable.of(slider_crank(params)), INPUT),
    )
    named = {
        "crank": "crank", "rod": "rod", "offset": "slide-1", "shaft": "shaft", "crank-pin": "pin-a",
        "wrist-pin": "pin-b", "point-along": "p-along", "point-across": "p-across", "input": "input",
    }  # fmt: skip
    for output, own in zip(known.outputs, model.outputs, strict=True):
        found, wanted = rows(model, own.name, AT), rows(known, output.name, AT)
        for theirs, mine in named.items():
            same(found[mine], wanted[theirs])
        # Both guide pins off by the same are the slider off by that.
        same(found["slide-1-play-1"] + found["slide-1-play-2"], wanted["guide"])
        same(found["slide-1-slider"], wanted["offset"])
        assert found["slide-1"] == pytest.approx(wanted["offset"], rel=1e-9, abs=1e-12)


CLOSED = [
    "watt-1", "watt-2", "stephenson-1", "stephenson-3", "whitworth", "crank-shaper", "scotch-yoke",
    "pantograph", "parallel-guide", "peaucellier", "hoecken", "chebyshev", "roberts", "watt-line", "jansen",
    "klann", "toggle-press", "wiper", "scissor-lift",
]  # fmt: skip


@pytest.mark.parametrize("name", CLOSED)
def test_sensitivities_are_slopes_of_the_exact_errors(name):
    assert tolerance_faults(LinkageTolerances(LinkageTable.of(LinkageParams(linkage=name)), INPUT)) == []


@by_night
def test_so_they_are_of_links_that_are_followed():
    assert (
        tolerance_faults(LinkageTolerances(LinkageTable.of(LinkageParams(linkage="stephenson-2")), INPUT))
        == []
    )


@pytest.mark.parametrize(
    ("size", "contributor"), [("j", "j"), ("k", "k"), ("c", "c"), ("f", "f"), ("m", "crank")]
)
def test_sensitivities_of_a_leg_are_differences_of_its_motion(size, contributor):
    """The catalogue draws the linkage anew from other dimensions: nothing of the model is used."""
    params, step = LinkageParams(linkage="jansen"), 1e-4
    model = LinkageTolerances(LinkageTable.of(params), EXACT)

    def moved(off):
        leg = params.jansen.model_copy(update={size: getattr(params.jansen, size) + off})
        table = LinkageTable.of(params.model_copy(update={"jansen": leg}))
        link, point = table.linkage.traces["F"]
        body = table.solved(Turning.of(AT)).bodies[link]
        return body.point(table.linkage.points[link][point], 0).position

    slope = (moved(step) - moved(-step)) / (2 * step)
    found = rows(model, "point F", AT)[contributor][:, 0]
    assert found[0] + 1j * found[1] == pytest.approx(slope, abs=1e-6 * np.abs(slope).max())


def test_links_that_are_solved_together_have_the_errors_of_the_closed_form():
    params = LinkageParams(linkage="stephenson-3")
    model, other = (LinkageTolerances(LinkageTable.of(params), EXACT) for _ in range(2))
    other.closed_form = False
    rng = np.random.default_rng(3)
    off = [rng.uniform(-0.05, 0.05, (one.components, AT.size)) for one in model.contributors]
    for output in model.outputs:
        found, wanted = (one.errors(output.name, off, AT) for one in (other, model))
        assert found == pytest.approx(wanted, abs=1e-8)
        assert np.abs(wanted).max() > 1e-3


def test_a_pin_of_three_links_has_a_play_for_each_that_turns_on_it():
    names = {
        one.name
        for one in LinkageTolerances(LinkageTable.of(LinkageParams(linkage="jansen")), EXACT).contributors
    }
    assert {"pin-m-j", "pin-m-k", "pin-b0-shoulder", "pin-b0-c", "pin-z-k", "pin-z-foot"} <= names
    model = LinkageTolerances(LinkageTable.of(LinkageParams(linkage="jansen")), EXACT)
    found = rows(model, "point F", AT)
    # A pin displaced in a bar of two pins counts as much as the bar's length, along it.
    along = np.sqrt(np.einsum("c...,c...->...", found["j"][:, 0], found["j"][:, 0]))
    pin = np.sqrt(np.linalg.eigvalsh(np.moveaxis(gram(found["pin-m-j"]), (0, 1), (-2, -1))).max(axis=-1))
    assert pin == pytest.approx(along, rel=1e-9)


def test_a_third_pin_of_a_plate_has_two_coordinates():
    params = LinkageParams(linkage="watt-1")
    found = {one.name: one for one in LinkageTolerances(LinkageTable.of(params), EXACT).contributors}
    points = LinkageTable.of(params).linkage.points["coupler"]
    a, b, c = (complex(points[name]) for name in ("A", "B", "C"))
    seen = (c - a) / (b - a) * abs(b - a)
    assert found["coupler"].nominal == pytest.approx(abs(b - a))
    assert found["coupler-c-along"].nominal == pytest.approx(seen.real)
    assert found["coupler-c-across"].nominal == pytest.approx(seen.imag)


GEARED = {
    "linkage": "drawn",
    "points": {
        "A0": {"x": 0, "y": 0}, "D0": {"x": 60, "y": 0}, "A": {"x": 20, "y": 5}, "D": {"x": 75, "y": 12},
        "C": {"x": 50, "y": 60},
    },
    "links": {
        "ground": ["A0", "D0"], "crank": ["A0", "A"], "wheel": ["D0", "D"], "left": ["A", "C"],
        "right": ["D", "C"],
    },
    "gears": [{"one": "crank", "two": "wheel", "ratio": -2.0}],
    "output": "left",
}  # fmt: skip


def test_geared_links_have_an_analysis_that_names_what_it_lacks():
    model = LinkageTolerances(LinkageTable.of(LinkageParams.model_validate(GEARED)), INPUT)
    assert tolerance_faults(model) == []
    assert "teeth" in model.told[0]
    assert {"crank", "wheel", "left", "right", "ground", "pin-c", "shaft"} <= {
        one.name for one in model.contributors
    }


def test_near_a_dead_point_there_is_no_first_order():
    model = LinkageTolerances(LinkageTable.of(LinkageParams(linkage="watt-line")), EXACT)
    row = model.sensitivities(model.outputs[0].name, model.positions)[0]
    gone = np.isnan(row[0, 0])
    assert gone[[0, -1]].all()
    assert gone.sum() == 2
    assert "near a dead point" in model.told[0]


def test_a_slide_that_drives_counts_in_mm():
    table = {
        "linkage": "drawn", "driver": "ram", "output": "lever", "stroke_from": -10, "stroke_to": 10,
        "points": {"A": {"x": 0}, "B": {"x": 60, "y": 50}, "C": {"x": 60}},
        "links": {"ground": ["C"], "ram": ["A"], "rod": ["A", "B"], "lever": ["C", "B"]},
        "slides": [{"block": "ram", "point": "A"}],
    }  # fmt: skip
    model = LinkageTolerances(LinkageTable.of(LinkageParams.model_validate(table)), INPUT)
    assert (model.input_unit, model.input_name) == ("mm", "stroke")
    assert (model.positions.min(), model.positions.max()) == (-10, 10)
    assert "input" not in {one.name for one in model.contributors}
    assert tolerance_faults(model) == []
    # The rod's law: 50 mm of lever, at the drawn pose upright, and the rod at 60 : 50.
    length = rows(model, "lever angle", np.zeros(1))["rod"].item()
    assert length == pytest.approx(-np.hypot(60, 50) / 60 / 50)


def test_both_ground_plates_have_half_of_what_is_between_them():
    one, two = (LinkageTolerances(LinkageTable.of(four_bar(FourBarParams(**BARS[n]))), EXACT) for n in (0, 1))
    names = {model: {c.name for c in model.contributors} for model in (one, two)}
    assert names[two] - names[one] == {"ground-2"}
    halves = rows(two, "follower angle", AT)
    assert halves["ground"] == pytest.approx(halves["ground-2"])


def test_changes_of_a_geared_machine_are_differences_of_its_motion():
    joints = [
        Revolute("A0", "ground", "arm", 0j, 0j),
        Revolute("B", "arm", "planet", 40 + 0j, 0j),
        Revolute("S", "ground", "sun", 0j, 0j),
        GearPair("mesh", "sun", "planet", "arm", -2.0, 0.3),
    ]
    machine = Machine(joints, [Drive("arm"), Drive("sun")])
    change = Change({("B", "arm"): 1 + 2j})

    def stands(by):
        inputs = [Turning.of([0.4]), Turning.of([0.9])]
        found = solve(changed(machine, change.scaled(by)), inputs).bodies
        return {name: Pose(body.origin.position, body.turning.theta) for name, body in found.items()}

    (moved,) = sensitivities(machine, stands(0.0), [change])
    for link in ("arm", "planet", "sun"):
        slope = (stands(1e-3)[link].origin - stands(-1e-3)[link].origin) / 2e-3
        assert moved[link].origin == pytest.approx(slope, abs=1e-9)
    assert abs(moved["planet"].origin.item()) == pytest.approx(5**0.5)


def test_at_a_dead_point_no_change_moves_links_in_proportion():
    joints = [
        Revolute("A0", "ground", "crank", 0, 0), Revolute("A", "crank", "rod", 30, 0),
        Revolute("B", "rod", "rocker", 50, 60), Revolute("B0", "ground", "rocker", 140, 0),
    ]  # fmt: skip
    machine = Machine(joints, [Drive("crank")])
    poses = {
        "ground": Pose(np.zeros(1, complex), np.zeros(1)), "crank": Pose(np.zeros(1, complex), np.zeros(1)),
        "rod": Pose(np.array([30 + 0j]), np.zeros(1)), "rocker": Pose(np.array([140 + 0j]), np.array([np.pi])),
    }  # fmt: skip
    (moved,) = sensitivities(machine, poses, [Change({("A", "crank"): 1 + 0j})])
    assert not (np.abs(moved["rocker"].angle) < 1e6).any()


def test_guide_pins_tilt_their_block():
    """A point over the second pin goes up with that pin alone; one over the first with the first."""
    params = slider_crank(SliderCrankParams(), guide_length=30.0)
    b = params.points["B"]
    points = {"Q1": type(b)(x=b.x - 15, y=b.y), "Q2": type(b)(x=b.x + 15, y=b.y)}
    links = {**params.links, "slider": ("B", "Q1", "Q2")}
    model = LinkageTolerances(
        LinkageTable.of(params.model_copy(update={"points": {**params.points, **points}, "links": links})),
        EXACT,
    )
    for point, gap, other in (("Q1", 1, 2), ("Q2", 2, 1)):
        found = rows(model, f"point {point}", AT)
        assert found[f"slide-1-play-{gap}"][1, 0] == pytest.approx(np.ones(AT.size))
        assert found[f"slide-1-play-{other}"][1, 0] == pytest.approx(np.zeros(AT.size), abs=1e-9)


def test_a_block_that_tilts_about_a_point_off_its_origin_has_sensitivities_that_are_slopes():
    params = slider_crank(SliderCrankParams())
    b = params.points["B"]
    points = {**params.points, "Q": type(b)(x=b.x + 5, y=b.y + 40)}
    links = {**params.links, "slider": ("Q", "B")}
    model = LinkageTolerances(
        LinkageTable.of(params.model_copy(update={"points": points, "links": links})), INPUT
    )
    assert model.outputs[0].name == "slider position"
    assert tolerance_faults(model) == []


def test_a_traced_pin_moves_with_the_length_of_its_link():
    """D of the inversor is where two circles meet: dD · (D - A) = |D - A|, dD · (D - C) = 0."""
    params = LinkageParams(linkage="peaucellier")
    model = LinkageTolerances(LinkageTable.of(params), EXACT)
    at = model.positions[20:-20:20]
    found = rows(model, "point D", at)["ad"][:, 0]
    bodies = LinkageTable.of(params).solved(Turning.of(at)).bodies
    points = LinkageTable.of(params).linkage.points
    a, c, d = (
        bodies[link].point(points[link][name], 0).position
        for link, name in (("AD", "A"), ("CD", "C"), ("AD", "D"))
    )
    moved = found[0] + 1j * found[1]
    assert (moved * np.conj(d - a)).real == pytest.approx(np.abs(d - a), rel=1e-9)
    assert (moved * np.conj(d - c)).real == pytest.approx(
        np.zeros(at.size), abs=1e-9 * np.abs(moved).max() * 100
    )


def test_whole_turns_count_alike():
    model = LinkageTolerances(LinkageTable.of(LinkageParams(linkage="watt-1")), EXACT)
    for closed_form in (True, False):
        model.closed_form = closed_form
        model._kept = None
        for output in model.outputs:
            off = [np.full((one.components, 1), 0.01) for one in model.contributors]
            there, here = (model.errors(output.name, off, AT[:5] + turn) for turn in (-4 * np.pi, 0.0))
            assert there == pytest.approx(here, abs=1e-9)


def test_changes_of_a_slide_on_a_moving_guide_are_differences_of_the_motion():
    joints = [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("B0", "ground", "lever", -60 + 10j, 0j),
        Revolute("A", "crank", "block", 25 + 0j, 3 + 2j),
        Prismatic("slide", "lever", "block", 5 + 8j, 1 - 4j, 0.2, 0.5),
    ]
    machine = Machine(joints, [Drive("crank")])
    change = Change(
        {("slide", "lever"): 1 - 2j, ("slide", "block"): 3 + 1j, ("A", "block"): 0.5j}, {"slide": 0.04}
    )
    at = np.array([0.3, 1.7, 4.0])

    def stands(by):
        found = solve(changed(machine, change.scaled(by)), [Turning.of(at)]).bodies
        return {name: Pose(body.origin.position, body.turning.theta) for name, body in found.items()}

    (moved,) = sensitivities(machine, stands(0.0), [change])
    ends = stands(1e-3), stands(-1e-3)
    for link in ("lever", "block"):
        assert moved[link].origin == pytest.approx(
            (ends[0][link].origin - ends[1][link].origin) / 2e-3, rel=1e-5
        )
        assert moved[link].angle == pytest.approx(
            (ends[0][link].angle - ends[1][link].angle) / 2e-3, rel=1e-5
        )


def test_a_link_without_bores_is_measured_from_its_first_slide():
    found = [
        one.name
        for one in LinkageTolerances(
            LinkageTable.of(LinkageParams(linkage="scotch-yoke")), EXACT
        ).contributors
    ]
    assert found == [
        "crank", "guide-yoke", "guide", "guide-2", "shaft", "slot-play", "guide-play-1", "guide-play-2",
    ]  # fmt: skip


def test_pins_of_a_bar_without_load_are_pressed_along_it():
    asked = Tolerances(ToleranceSettings(contact="loaded"))
    found = {
        one.name: one.directions
        for one in LinkageTolerances(LinkageTable.of(LinkageParams(linkage="watt-1")), asked).contributors
    }
    # link6 is a bar of two pins; coupler and rocker have three, link5 is the output.
    assert {name for name, count in found.items() if count == 1} == {"pin-d", "pin-e"}
    load = {"link": "link6", "force_x": 1.0}
    loaded = LinkageParams.model_validate({"linkage": "watt-1", "loads": [load]})
    assert 1 not in {one.directions for one in LinkageTolerances(LinkageTable.of(loaded), asked).contributors}

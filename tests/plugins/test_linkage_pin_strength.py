"""Strength of linkages: pins through several plates, guide pins, slots; the four-bar and the slider-crank."""

import math

import numpy as np
import pytest
from drawn_bars import four_bar, slider_crank

from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Severity, Stage
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage.kinematics.forces import period_forces
from mechwright.mechanics.linkage.kinematics.pin_loads import PinLoads, PlateLoad, pin_loads
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.rules import strength
from mechwright.mechanics.strength.allowed import PIN_BENDING
from mechwright.mechanics.strength.hertz import contact_modulus
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.rules import strength as four
from mechwright_four_bar.table import FourBarTable
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.rules.loads import pairs_of
from mechwright_slider_crank.table import SliderCrankTable

CODES = {"linkage.pin", "linkage.eye", "linkage.bushing", "linkage.guide", "linkage.bearing-pressure"}


PIN, EYE, *_ = strength.strength_rules(LinkageTable).every


def values(stresses):
    return sorted(one.value for one in stresses)


def found(params):
    return {one.code: one for one in Linkages().check(params) if one.code in CODES}


@pytest.mark.parametrize(
    "table",
    [
        {},
        {"load_torque": 20.0, "frame": "one", "speed": 300.0},
        {"load_torque": -5.0, "frame": "two", "bushing_wall": 0.0, "material": "pom"},
    ],
)
def test_a_drawn_four_bar_bears_what_its_family_says(table):
    bar = FourBarParams(**table)
    params = four_bar(bar)
    m, own = LinkageTable.of(params), FourBarTable.of(bar)
    assert values(strength.pin_stresses(m)) == pytest.approx(values(four.pins(own)), rel=1e-6)
    assert values(strength.bushings(m)) == pytest.approx(values(four.bushes(own)), rel=1e-6)
    bores = [one.value for one in strength.eyes(m) if " in " not in one.what]
    assert sorted(bores) == pytest.approx(values(four.eyes(own)), rel=1e-6)
    # The bores that hold the pins carry the same.
    held = {
        one.what.split("beside ")[1].split(" is")[0]: one.value
        for one in strength.eyes(m)
        if " in " in one.what
    }
    (shaft,) = (pair for pair in strength.pairs_of(LinkageTable.of(params)) if pair.name == "shaft A0")
    assert held["shaft A0 in crank"] == pytest.approx(shaft.greatest / (2 * params.rim * params.thickness))
    assert len(held) == 4
    widths, limits = (
        {(p.width, p.bore, p.rim) for p in pairs}
        for pairs in (strength.pairs_of(LinkageTable.of(params)), four.pairs_of(own).values())
    )
    assert widths == limits
    pressure = max(pair.greatest / (pair.pin * pair.width) for pair in four.pairs_of(own).values())
    assert strength.most_pressed(m)[1] == pytest.approx(pressure, rel=1e-6)


def slow_slider(force, **table):
    params = SliderCrankParams(load=force, speed=0.01)
    return params, slider_crank(params, **table)


def test_a_slow_slider_crank_carries_its_load():
    params, drawn = slow_slider(-500.0)
    pairs = {pair.name: pair for pair in strength.pairs_of(LinkageTable.of(drawn))}
    wanted = {pair.name: pair.greatest for pair in pairs_of(SliderCrankTable.of(params))}
    for mine, theirs in (("shaft A0", "the shaft"), ("pin A", "the crank pin"), ("pin B", "the wrist pin")):
        assert pairs[mine].greatest == pytest.approx(wanted[theirs], rel=1e-4)


def test_guide_pins_share_the_slides_force_and_turn_its_moment_into_a_pair():
    """Statics: the rod leans by β and presses with F tan β; a load h off the line has the moment F h."""
    force, h, length = -500.0, 25.0, 40.0
    _, drawn = slow_slider(0.0, guide_length=length)
    b = drawn.points["B"]
    point = type(b)(x=b.x, y=b.y + h)
    drawn = drawn.model_copy(
        update={
            "points": {**drawn.points, "Q": point},
            "links": {**drawn.links, "slider": ("B", "Q")},
            "loads": (
                slider_crank(SliderCrankParams(load=force)).loads[0].model_copy(update={"point": "Q"}),
            ),
        }
    )
    one, two = (pin for pin in pin_loads(LinkageTable.of(drawn)) if pin.pin.number)
    period, _ = period_forces(LinkageTable.of(drawn))
    rod = period.solution.bodies["rod"].turning.theta
    normal = np.abs(force * np.tan(rod))
    sums = np.abs(one.loads[0].force + two.loads[0].force)
    assert sums == pytest.approx(normal, abs=1e-3)
    pair = (one.loads[0].force - two.loads[0].force).imag / 2
    assert np.abs(pair) == pytest.approx(np.full(pair.shape, abs(force) * h / length), abs=1e-3)
    # The load pushes the upper end back and so the front up: the slot presses the front pin down.
    assert pair.mean() > 0
    slides = LinkageTable.of(drawn).solved(period.drive).bodies["slider"].origin.velocity
    assert one.loads[0].turning == pytest.approx(
        np.abs(slides) / (LinkageTable.of(drawn).layout.sizes.roller / 2), abs=1e-12
    )


def pin_with(pressed, *loads):
    pin = Pin("pin-x", "a", {"a": 0j}, tuple(pressed), (), (), "X")
    return PinLoads(
        pin,
        pressed,
        tuple(
            PlateLoad(f"p{n}", height, 4.0, np.array([force]), np.zeros(1))
            for n, (height, force) in enumerate(loads)
        ),
    )


def test_bending_of_a_pin_is_that_of_a_cantilever():
    held = {"a": (0.0, 6.0)}
    one = pin_with(held, (9.0, 100.0))
    assert (one.bending, one.shear) == (300.0, 100.0)
    # Two plates on one side: the forces add up as vectors.
    both = pin_with(held, (9.0, 100.0), (15.0, 100j))
    assert both.bending == pytest.approx(abs(300 + 900j))
    assert both.shear == pytest.approx(abs(100 + 100j))
    # Opposite ones: the moment is greatest under the nearer plate, or the shear beyond it.
    couple = pin_with(held, (9.0, -200.0), (15.0, 100.0))
    assert couple.bending == pytest.approx(600.0)
    assert couple.shear == pytest.approx(100.0)
    # One on each side: each side is a cantilever of its own.
    sides = pin_with(held, (9.0, 100.0), (-2.0, 100.0))
    assert (sides.bending, sides.shear) == (300.0, 100.0)
    assert np.abs(sides.carried("a")) == 200.0


def test_a_pin_in_two_plates_is_bent_as_if_the_nearer_one_had_the_load():
    held = {"a": (0.0, 4.0), "a-2": (20.0, 24.0)}
    pin = pin_with(held, (8.0, 100.0), (15.0, 60.0))
    assert pin.bending == pytest.approx(400.0)
    assert [abs(pin.carried(plate).item()) for plate in held] == [100.0, 60.0]


@pytest.mark.parametrize("name", ["jansen", "klann", "toggle-press", "crank-shaper"])
def test_forces_of_the_pins_move_every_link(name):
    """Newton's law of each link: what its pins get from it, it gets from them, and nothing else moves it."""
    params = LinkageParams(linkage=name, speed=200.0)
    pins, layout = pin_loads(LinkageTable.of(params)), LinkageTable.of(params).layout
    period, masses = period_forces(LinkageTable.of(params))[0], LinkageTable.of(params).masses
    for link in layout.linkage.machine.links:
        plates = {plate for plate in layout.outlines if layout.link(plate) == link}
        if not plates:
            continue
        force = 0j
        for pin in pins:
            force = force - sum(load.force for load in pin.loads if load.plate in plates)
            force = force + sum(load.force for load in pin.loads) * (pin.pin.body == link)
        mass = masses[link]
        wanted = mass.mass * period.solution.bodies[link].point(mass.centre, 2).acceleration / 1000
        # A bushing in a slot is a link of its own, with some grams.
        rollers = [
            one.mass
            for one_link, one in masses.items()
            if one_link not in {layout.link(p) for p in layout.outlines}
        ]
        slack = 1e-9 + sum(rollers) * 15
        assert np.abs(force - wanted).max() < slack + 1e-9 * np.abs(wanted).max()


def test_slots_and_pins_grow_with_the_load_by_their_laws():
    one, two = (LinkageTable.of(slow_slider(force)[1]) for force in (-300.0, -600.0))
    assert values(strength.pin_stresses(two)) == pytest.approx(
        [2 * v for v in values(strength.pin_stresses(one))], rel=1e-4
    )
    walls = [[s.value for s in strength.guides(m) if "slot" in s.what] for m in (one, two)]
    assert len(walls[0]) == 2
    assert walls[1] == pytest.approx([math.sqrt(2) * v for v in walls[0]], rel=1e-4)


def test_the_wall_of_a_slot_has_the_hertz_pressure_of_its_roller():
    _, params = slow_slider(-500.0)
    guide = next(pin for pin in pin_loads(LinkageTable.of(params)) if pin.pin.number)
    force, plate = np.abs(guide.loads[0].force).max(), material("aluminium")
    modulus = contact_modulus(plate, material("brass"))
    wanted = math.sqrt(force * modulus / (math.pi * params.ground_thickness * 4.0))
    (wall, *_) = [one for one in strength.guides(LinkageTable.of(params)) if "slot" in one.what]
    assert wall.value == pytest.approx(wanted, rel=1e-9)
    assert wall.breaks > wall.limit
    bare = params.model_copy(update={"bushing_wall": 0.0})
    (wall, *_) = [one for one in strength.guides(LinkageTable.of(bare)) if "slot" in one.what]
    modulus = contact_modulus(plate, material("steel"))
    assert wall.value == pytest.approx(math.sqrt(force * modulus / (math.pi * 8.0 * 3.0)), rel=1e-3)


@pytest.mark.parametrize(
    ("table", "code"),
    [
        ({"load_torque": 100.0}, "linkage.pin"),
        ({"load_torque": -150.0}, "linkage.eye"),
        ({"load_torque": 40.0, "speed": 600.0}, "linkage.bushing"),
        ({"load_torque": 40.0}, "linkage.bearing-pressure"),
    ],
)
def test_too_much_load_has_remedies_that_work(table, code):
    params = four_bar(FourBarParams(**table))
    one = found(params)[code]
    assert one.severity is not Severity.NOTE
    assert one.value > one.limit
    assert one.proposed
    if code != "linkage.bearing-pressure":
        for change in one.proposed:
            better = found(
                params.model_copy(update={k.removeprefix("parameters."): v for k, v in change.items()})
            )
            assert better[code].severity is Severity.NOTE


def test_a_slide_with_too_much_moment_wants_a_longer_guide():
    _, params = slow_slider(-300.0)
    turned = params.model_copy(update={"loads": (params.loads[0].model_copy(update={"torque": 6.0}),)})
    one = found(turned)["linkage.guide"]
    assert one.severity is not Severity.NOTE
    assert any(
        "parameters.guide_length" in change or "parameters.pin_diameter" in change for change in one.proposed
    )


def test_what_a_linkage_of_the_catalogue_bears_is_noted():
    notes = found(LinkageParams(linkage="whitworth"))
    assert set(notes) == CODES - {"linkage.bearing-pressure"}
    assert {one.severity for one in notes.values()} == {Severity.NOTE}
    assert "linkage.guide" not in found(LinkageParams(linkage="klann"))
    (forces,) = [
        one for one in Linkages().check(LinkageParams(linkage="klann")) if one.code == "linkage.forces"
    ]
    drive = np.abs(period_forces(LinkageTable.of(LinkageParams(linkage="klann")))[1].drive).max() / 1000
    assert (forces.value, forces.unit) == (pytest.approx(drive), "N*m")


def test_of_many_designs_those_are_forbidden_whose_plates_break():
    base = four_bar(
        FourBarParams(load_torque=300.0, pin_diameter=12.0, thickness=10.0, ground_thickness=10.0)
    )
    rims = np.array([[1.0], [12.0], [1.5]])
    table = LinkageTable(with_columns(base, {"rim": rims}), 3)
    wanted = []
    for rim in rims.ravel().tolist():
        m = LinkageTable.of(base.model_copy(update={"rim": rim}))
        wanted.append(any(one.severity is Severity.ERROR for one in EYE.findings(m, quick=True)))
    assert EYE.forbids(table, Stage.PARTS).tolist() == wanted
    assert set(wanted) == {True, False}
    assert EYE.forbids(table, Stage.MOTION) is None
    assert PIN.forbids(table, Stage.PARTS) is None


def test_the_limit_of_bending_is_that_of_hardened_pins():
    (bent, *_) = [
        one for one in strength.pin_stresses(LinkageTable.of(LinkageParams())) if "bent" in one.what
    ]
    assert bent.limit == PIN_BENDING

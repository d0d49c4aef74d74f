"""Frames: bearings that have room, shafts that go together, pillars clear of what moves; closed forms."""

import cmath
import math
from dataclasses import replace
from itertools import combinations, pairwise
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mechwright import (
    Channel,
    Hub,
    Instance,
    Loop,
    Motion,
    Mounting,
    Outline,
    Part,
    Poses,
    Rates,
    Spindle,
    circle,
)
from mechwright.contracts.holes import joined
from mechwright.contracts.surroundings import OVER, Place, Surroundings, turned
from mechwright.contracts.turned import TAP_RUN, EndThread, Step, Turned
from mechwright.errors import GeometryError, KinematicsError
from mechwright.machine import MachineSettings
from mechwright.machine.frame import findings
from mechwright.machine.frame.bracket import bracket_for
from mechwright.machine.frame.coupled import SHAFT_GAP, Coupled
from mechwright.machine.frame.decided import Wanted
from mechwright.machine.frame.designing import frame_around
from mechwright.machine.frame.findings import bent
from mechwright.machine.frame.pillars import EDGE, PILLAR, SCREW, cap_screw, least_height, pillar, stud
from mechwright.machine.frame.plates import least_thickness, thickness_for
from mechwright.machine.frame.seats import candidates, circlip_over, needed, seats
from mechwright.machine.frame.shafts import PLAY, Levels, highest, key_of, lowest, ring_room, sections
from mechwright.machine.frame.standing import CLEARANCE, Disc, stand
from mechwright.standards.bearings import bearings
from mechwright.standards.motors import motors
from mechwright.standards.stock import plate_stock

PLATES = MachineSettings(frame="plates")
BORES = (5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0)


def test_rates_of_a_body_are_those_of_what_it_carries():
    """Of a body that turns with 3 rad/s a point at 2 mm has 6 mm/s, and 18 mm/s² to the axis."""
    t = np.linspace(0, 1, 5)
    frames = np.zeros((2, 5, 3, 4))
    c, s = np.cos(3 * t), np.sin(3 * t)
    frames[0, :, 0, 0], frames[0, :, 0, 1], frames[0, :, 1, 0], frames[0, :, 1, 1] = (
        -3 * s,
        -3 * c,
        3 * c,
        -3 * s,
    )
    frames[1, :, 0, 0], frames[1, :, 0, 1], frames[1, :, 1, 0], frames[1, :, 1, 1] = (
        -9 * c,
        9 * s,
        -9 * s,
        -9 * c,
    )
    poses = replace(Poses.planar(0.0, 0.0, 3 * t), rates=Rates(*frames))
    still = Motion("t", {"t": Channel(t, "s")}, {"crank": poses})
    pin = Surroundings(places={"pin": Place((2.0, 0.0, 0.0), on="crank")}).around(still).poses["pin"]
    assert pin.rates is not None
    np.testing.assert_allclose(np.linalg.norm(pin.rates.first[:, :, 3], axis=1), 6)
    np.testing.assert_allclose(pin.rates.second[:, :, 3], -9 * pin.position, atol=1e-12)


def hub(bore, low=0.0, high=10.0, **more):
    return Hub(low, high, bore, **more)


def two(distance, one=12.0, other=12.0, **more):
    """Two discs that turn a little apart, and the mounting of their shafts."""
    return Mounting(
        (
            Spindle("a", "a", (0.0, 0.0), hub(one, **more), "parameters.one", drives=True, force=20.0),
            Spindle("b", "b", (distance, 0.0), hub(other, **more), "parameters.other", force=20.0),
        )
    )


def discs(distance, radius):
    """Two plates that turn once, and their motion."""
    angle = np.linspace(0, math.tau, 121)
    parts = [
        Part(name, Outline(Loop((circle((0.0, 0.0), radius),))), 10.0, "steel", (Instance(name, 0.0),))
        for name in "ab"
    ]
    poses = {"a": Poses.planar(0.0, 0.0, angle), "b": Poses.planar(distance, 0.0, -angle)}
    return parts, Motion("phi", {"phi": Channel(angle, "rad")}, poses)


@given(st.floats(15, 120), st.sampled_from(BORES), st.sampled_from(BORES))
def test_bearings_fit_their_shafts_and_have_walls_between_them_or_a_refusal_says_how_much_is_missing(a, d, e):
    mounting = two(a, d, e)
    found, faults = seats(mounting, PLATES)
    if faults:
        (fault,) = faults
        assert fault.code == "frame.bearing-room"
        assert fault.value == a < fault.limit
        # No pair of bearings for these shafts has room.
        every = [(one, other) for one in candidates(d, "auto") for other in candidates(e, "auto")]
        assert all(needed(*pair, "aluminium") > a for pair in every)
        return
    for one, other in combinations(found, 2):
        assert needed(one.bearing, other.bearing, "aluminium") <= a
    for seat in found:
        assert seat.bearing.bore < seat.bearing.shoulder <= seat.circlip.size <= seat.spindle.hub.bore


def test_less_room_takes_thinner_bearings():
    series = [[seat.bearing.name for seat in seats(two(a), PLATES)[0]] for a in (60, 31, 27, 24)]
    assert series[0] == ["6000", "6000"]
    outside = {one.name: one.outside for one in bearings()}
    sizes = [sum(outside[name] for name in names) for names in series]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] < sizes[0]


def test_axes_that_are_too_near_name_what_there_is_room_for_and_a_bore_that_works():
    ((fault),) = seats(two(20.0), PLATES)[1]
    assert "stand 20.00 mm apart" in fault.message
    assert "there is room for" in fault.message
    works = fault.proposed[0]
    again, faults = seats(two(20.0, *works.values()), PLATES)
    assert faults == []
    assert len(again) == 2


@pytest.mark.parametrize(("bore", "works"), [(3.0, 5.0), (40.0, 30.0)])
def test_a_hub_that_no_bearing_or_circlip_fits_names_the_nearest_bore_that_works(bore, works):
    fault = seats(two(200.0, bore), PLATES)[1][0]
    assert (fault.parameter, fault.value, fault.limit) == ("parameters.one", bore, works)
    assert seats(two(200.0, works), PLATES)[1] == []


def test_a_series_that_the_shaft_has_not_is_refused_with_auto():
    fault = seats(two(200.0, 5.0), MachineSettings(frame="plates", bearing="61" + "8"))[1][0]
    assert fault.proposed == ({"machine.bearing": "auto"},)


@given(st.sampled_from(BORES), st.floats(4, 60), st.floats(0, 30), st.floats(0, 30))
def test_everything_goes_onto_a_shaft_from_its_upper_end(bore, length, below, above):
    (seat, _), _ = seats(two(300.0, bore, high=length), PLATES)
    levels = Levels(lowest(seat) - below, highest(seat) + above)
    steps = sections(seat, levels)
    # Both inner rings are held, and the shaft has its play between the plates.
    room = levels.height - ring_room(seat)
    assert sum(step.length for step in steps) == pytest.approx(room + 2 * seat.bearing.width)
    assert steps[0].diameter == steps[-1].diameter == seat.bearing.bore
    assert steps[-1].length == pytest.approx(seat.bearing.width + PLAY)
    for shoulder in (steps[1], steps[-2]):
        assert shoulder.diameter == pytest.approx(min(seat.bearing.shoulder, seat.circlip.size))
    # Diameters rise to the collar and fall after it.
    wide = [step.diameter for step in steps]
    top = wide.index(max(wide))
    assert all(one <= other for one, other in pairwise(wide[: top + 1]))
    assert all(one >= other for one, other in pairwise(wide[top:]))
    assert all(step.length > 0 for step in steps)


@pytest.mark.parametrize(("bore", "length", "found"), [(12.0, 10.0, 8), (12.0, 30.0, 28), (12.0, 6.0, None)])
def test_a_key_is_the_longest_sold_that_the_hub_covers(bore, length, found):
    key = key_of(hub(bore, high=length, key=4.0))
    assert (None if key is None else key.length) == found
    assert key_of(hub(bore, high=length)) is None


@given(st.floats(5, 80), st.floats(30, 150), st.floats(10, 30))
def test_pillars_stand_clear_of_what_moves_in_a_plate_that_holds_its_bearings(radius, distance, boss):
    swept = shapely.union_all([shapely.Point(x, 0).buffer(radius) for x in (0, distance)])
    held = [Disc((0.0, 0.0), boss), Disc((distance, 0.0), boss)]
    found = stand(swept, held, PILLAR / 2, EDGE)
    for corner in found.corners:
        assert shapely.distance(shapely.Point(corner), swept) >= PILLAR / 2 + CLEARANCE - 0.05
        assert all(math.dist(corner, one.point) >= one.radius + PILLAR / 2 - 0.05 for one in held)
    assert found.left - EDGE <= -boss
    assert found.right + EDGE >= distance + boss
    assert found.below - EDGE <= -boss < boss <= found.above + EDGE


def test_the_plate_of_one_disc_is_the_smallest_square_about_it():
    # Corners of a square stand clear at half a side of (40 + 3 + 6)/sqrt(2) = 34.65, so 35 mm.
    found = stand(shapely.Point(0, 0).buffer(40, 256), [Disc((0.0, 0.0), 10.0)], 6.0, EDGE)
    area = (found.size[0] + 2 * EDGE) * (found.size[1] + 2 * EDGE)
    assert area <= (70 + 2 * EDGE) ** 2 * 1.01


@given(st.sampled_from([t for t in plate_stock("aluminium").thicknesses if 10 <= t <= 40]))
def test_screws_reach_into_pillars_by_a_diameter_and_two_of_them_have_room(thickness):
    screw = cap_screw(thickness)
    deep = screw.length - thickness
    assert deep >= SCREW
    height = least_height(thickness)
    for spigot in (False, True):
        form = pillar(height, deep, deep, spigot=spigot)
        assert form.length > sum(thread.drilled for thread in form.threads)
    joint = stud(thickness, deep + 0.5)
    assert (joint.length - thickness) / 2 >= SCREW
    with pytest.raises(GeometryError, match="threads need"):
        pillar(height - 2.0, deep, deep, spigot=False)


def test_threads_in_the_ends_take_their_holes_away_and_a_screw_more():
    form = Turned((Step(12.0, 40.0),), threads=(EndThread("upper", 5.0, 0.8, 10.0),))
    core = 5.0 - 1.0825 * 0.8
    drilled = 10.0 + TAP_RUN * 0.8
    whole = math.pi * 36 * 40
    assert form.shape.solid().Volume() == pytest.approx(whole - math.pi / 4 * core**2 * drilled)
    met = joined(Part("leg", None, 0.0, "steel", turned=form))
    assert met.build is not None
    assert met.build().Volume() == pytest.approx(whole - math.pi / 4 * 25 * drilled)
    with pytest.raises(GeometryError, match="less than one pitch of wall"):
        Turned((Step(6.0, 40.0),), threads=form.threads)


@given(st.floats(0, math.tau), st.floats(-50, 50))
def test_what_stands_on_a_body_goes_along_with_it(angle, x):
    turning = np.linspace(0, math.tau, 13)
    poses = {"crank": Poses.planar(x, 2.0, turning)}
    still = Motion("phi", {"phi": Channel(turning, "rad")}, poses)
    places = {
        "shaft": Place((3.0, 0.0, 1.0), turned(angle), "crank"),
        "plate": Place((1.0, 2.0, 3.0), OVER),
    }
    moved = Surroundings(places=places).around(still).poses
    at = moved["shaft"].transform(np.array([[1.0, 0.0, 0.0]]))[:, 0]
    both = turning + angle
    wanted = np.column_stack(
        [
            x + 3 * np.cos(turning) + np.cos(both),
            2 + 3 * np.sin(turning) + np.sin(both),
            np.ones(13),
        ]
    )
    np.testing.assert_allclose(at, wanted, atol=1e-12)
    np.testing.assert_allclose(moved["plate"].transform(np.array([[1.0, 1.0, 1.0]]))[0, 0], [2.0, 1.0, 2.0])
    with pytest.raises(KinematicsError, match="crank"):
        Surroundings(places={"crank": Place()}).around(still)


@given(st.sampled_from(BORES), st.floats(10, 60), st.floats(1, 500))
def test_bearings_carry_the_force_and_the_moment_is_that_of_a_beam(bore, length, force):
    (seat, _), _ = seats(two(300.0, bore, high=length), PLATES)
    levels = Levels(lowest(seat) - 3, highest(seat) + 5)
    near, far, moment, slope = bent(seat, levels, force)
    span = levels.height - ring_room(seat) + seat.bearing.width
    a = length / 2 - levels.lower + seat.bearing.width / 2
    assert near + far == pytest.approx(force)
    assert moment == pytest.approx(force * a * (span - a) / span / 1000)
    # No steeper than a plain shaft of the bearings' bore, no flatter than one of the collar's diameter.
    plain = [
        force * a * (span - a) * (span + max(a, span - a)) / (6 * 210000 * math.pi * d**4 / 64 * span)
        for d in (seat.bearing.bore, bore + 4)
    ]
    assert plain[1] < slope < plain[0]


def test_a_mounting_has_one_driver_and_hubs_to_put_on_a_shaft():
    with pytest.raises(GeometryError, match="one spindle that drives"):
        Mounting((Spindle("a", "a", (0.0, 0.0), hub(10.0)),))
    with pytest.raises(GeometryError, match="no bore"):
        two(50.0, 0.0)
    with pytest.raises(GeometryError, match="have one point"):
        two(0.0)


@pytest.mark.parametrize("motor", [None, *motors()], ids=lambda motor: getattr(motor, "name", "none"))
def test_a_machine_has_every_hole_that_its_screws_want(motor):
    parts, motion = discs(90.0, 44.0)
    keys = MachineSettings(frame="base")
    made = frame_around(keys, two(90.0), parts, motion, Wanted(motor, 0.3, 0.2, 60.0))
    assert [one for one in made.findings if one.severity != "note"] == []
    bodies = made.around(motion).poses
    assert all(one.body in bodies for part in made.parts for one in part.instances)
    count = {part.name: len(part.instances) for part in made.parts}
    assert count["leg"] == count["foot"] == 4
    base = next(part for part in made.parts if part.name == "base-plate")
    assert {f"leg-{k}" for k in (1, 2, 3, 4)} <= {one.name for one in base.features}
    assert count["pillar"] == count["plain-pillar"] == 2
    assert ("motor" in count) == (motor is not None)
    # Screws, studs and threads: each column has three screws, each foot one, each motor pillar two.
    screws = sum(number for name, number in count.items() if name.startswith(("screw", "stud")))
    pillars = count.get("motor-pillar", 0)
    assert screws == 4 * 3 + 4 + 2 * pillars + (0 if motor is None else motor.face.holes)


@pytest.mark.parametrize("motor", motors(), ids=lambda motor: motor.name)
def test_motor_and_shaft_meet_in_the_middle_of_their_coupling(motor):
    """The bearing plate above lies from 40 to 52 mm; the shaft's bearing of 8 mm reaches down to its inner face."""
    found = bracket_for(motor, ((3.0, -2.0), 10.0, 8.0), (52.0, 40.0), 0.1, [])
    middle = found.coupling_low + found.coupling.of.length / 2
    assert 52.0 - 8.0 - found.stub[1] == pytest.approx(middle + SHAFT_GAP)
    assert found.coupling_low + found.coupling.of.length < 40.0
    shaft = found.face + motor.face.shaft_length
    assert found.coupling_low < shaft <= found.coupling_low + found.coupling.of.length / 2
    assert found.low == pytest.approx(found.face - motor.length)


@given(st.floats(-math.pi, math.pi), st.tuples(*[st.floats(-50, 50)] * 4))
def test_places_of_a_motors_plate_turn_about_the_axis(angle, numbers):
    axis, place = complex(*numbers[:2]), complex(*numbers[2:])
    plate = SimpleNamespace(axis=numbers[:2], angle=angle)
    assert complex(*Coupled.at(plate, numbers[2:])) == pytest.approx(axis + place * cmath.exp(1j * angle))


def test_a_life_of_bearings_is_told_with_two_digits_up_to_a_million_hours():
    told = [findings._hours(hours) for hours in (2100.0, 0.99e6, 1.01e6, math.inf)]
    assert told == ["L10 2.1e+03 h", "L10 9.9e+05 h", "L10 above 1e6 h", "no load"]


@pytest.mark.parametrize("motor", motors(), ids=lambda motor: motor.name)
def test_both_threads_of_a_motors_pillars_are_alike_and_two_pitches_deeper_than_their_screws_go(motor):
    """A screw is ±0.35 mm long and a plate ±0.2 mm thick: neither end meets a bottom, whichever is up."""
    parts, motion = discs(90.0, 44.0)
    made = frame_around(
        MachineSettings(frame="base"), two(90.0), parts, motion, Wanted(motor, 0.3, 0.2, 60.0)
    )
    (pillar,) = [part for part in made.parts if part.name == "motor-pillar"]
    low = pillar.instances[0].z
    high = low + pillar.turned.length
    depths = {}
    for part in made.parts:
        for one in part.instances if part.name.startswith("screw") else ():
            length = float(part.bought.designation.split(" x ")[-1].split()[0])
            if one.body == pillar.instances[0].body:
                depths["upper"] = high - (one.z - length)
            elif one.body == f"{pillar.instances[0].body}-below":  # which is turned over
                depths["lower"] = -one.z + length - low
    (deep,) = {thread.depth for thread in pillar.turned.threads}
    assert set(depths) == {"upper", "lower"}
    assert 1.6 <= deep - max(depths.values()) < 1.6 + 0.5
    (flat,) = pillar.turned.flats
    assert flat.across == 10.0
    assert flat.at == pytest.approx((pillar.turned.length - flat.length) / 2)


def test_a_plate_that_is_too_thin_for_its_bearings_is_refused_with_the_size_that_works():
    parts, motion = discs(90.0, 44.0)
    keys = MachineSettings(frame="plates", plate_thickness=9.0)
    (fault,) = frame_around(keys, two(90.0), parts, motion, Wanted()).findings
    assert (fault.code, fault.value, fault.limit) == ("frame.plate-thickness", 9.0, 12.0)
    chosen = seats(two(90.0), keys)[0]
    assert least_thickness(chosen) <= thickness_for(chosen, "aluminium")


def test_what_passes_an_axis_is_named_with_the_gap_that_frees_it():
    # A disc at 10.2 mm over b's plane that passes b's axis at 8 mm: a circlip of 18.6 mm does not pass under it.
    parts, motion = discs(60.0, 20.0)
    arm = Part("arm", Outline(Loop((circle((0.0, 0.0), 52.0),))), 4.0, "steel", (Instance("a", 10.2),))
    mounting = Mounting(two(60.0).spindles, ("parameters.gap", 0.2))
    (fault,) = frame_around(PLATES, mounting, [*parts, arm], motion, Wanted()).findings
    assert fault.code == "frame.in-the-way"
    assert fault.message.startswith("arm passes the axis of spindle b at 8.00 mm, and its circlip")
    gap = fault.proposed[0]["parameters.gap"]
    higher = Part("arm", arm.outline, 4.0, "steel", (Instance("a", 10.0 + gap),))
    assert frame_around(PLATES, mounting, [*parts, higher], motion, Wanted()).parts
    # The shaft itself passes no arm that goes over the axis.
    over = Part("arm", Outline(Loop((circle((0.0, 0.0), 62.0),))), 4.0, "steel", (Instance("a", 12.0),))
    (fault,) = frame_around(PLATES, mounting, [*parts, over], motion, Wanted()).findings
    assert "its shaft of 12 mm" in fault.message


@pytest.mark.parametrize(
    ("torque", "code"),
    [(300.0, "frame.shaft-fatigue"), (40.0, "frame.bond"), (40.0, "frame.bearing-load")],
)
def test_more_torque_than_the_shaft_bears_is_refused_with_the_bore_that_works(torque, code):
    parts, motion = discs(200.0, 60.0)
    spindles = tuple(
        Spindle(one.name, one.body, one.point, one.hub, one.bore_key, one.drives, 1.0, 150.0)
        for one in two(200.0).spindles
    )
    found = frame_around(PLATES, Mounting(spindles), parts, motion, Wanted(None, torque, torque, 60.0))
    assert found.parts == ()
    assert code in {one.code for one in found.findings}


def test_a_circlip_is_never_much_smaller_than_its_hub():
    assert circlip_over(13.0).size == 12
    assert circlip_over(31.0).size == 30
    assert circlip_over(33.0) is None

"""Stacks of a frame: shafts float and never bind, circlips close, and drawings state the lengths they need."""

import math
from types import SimpleNamespace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from mechwright.contracts.mounting import Hub, Mounting, Spindle
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.play import coupling_stack, shaft_stacks
from mechwright.machine.frame.seats import bores, seats
from mechwright.machine.frame.shafts import (
    COLLAR_EDGE,
    LOADED_WALL,
    RING,
    Levels,
    add_shaft,
    highest,
    hub_ring,
    hub_room,
    key_of,
    lowest,
    ring_of,
)
from mechwright.machine.settings import MachineSettings
from mechwright.machine.stack_inspection import stack_findings
from mechwright.standards.bearings import bearings
from mechwright.standards.shims import shim_behind, shim_on, shims

PLATES = MachineSettings(frame="plates")


def shaft_on(bore, length, key=0.0, below=2.0, above=3.0, recess=math.inf):
    """A spindle with its seat, what is on it, and its shaft."""
    hubs = Hub(0.0, length, bore, key, recess=recess)
    mounting = Mounting((Spindle("one", "one", (0.0, 0.0), hubs, drives=True),))
    (seat,), _ = seats(mounting, PLATES)
    levels, kit = Levels(lowest(seat) - below, highest(seat) + above), Kit()
    return seat, levels, kit, add_shaft(kit, seat, levels, None)


@given(bore=st.sampled_from(bores()[2:]), length=st.floats(3, 60), above=st.floats(0, 20))
def test_shafts_of_all_sizes_float_and_their_hubs_hold(bore, length, above):
    seat, levels, _, shaft = shaft_on(bore, length, above=above)
    stacks = tuple(shaft_stacks(seat, shaft, levels))
    assert list(stack_findings(stacks)) == []
    float_, hub = stacks
    # The widths of both bearings, both depths, the shoulders and the pillars: 0.43 mm, whatever the shaft.
    low, high = float_.worst
    assert high - low == pytest.approx(2 * seat.bearing.narrower + 0.05 + 2 * 0.05 + 0.04)
    ring = RING if ring_of(seat) else 0.0
    assert (float_.nominal, low) == pytest.approx((0.15 + ring, 0.08 + ring), abs=2e-6)
    assert hub.worst[0] == pytest.approx(0.1, abs=2e-6), "a circlip closes over the thickest hub"
    if ring_of(seat):
        assert 0.1 - 1e-9 <= float_.play[0] <= float_.play[1] <= 0.31
    if hub_ring(seat):
        assert 0 < hub.play[0] <= hub.play[1] <= 0.25


def test_a_shaft_has_the_lengths_of_its_stacks_from_the_faces_that_bear():
    seat, levels, kit, shaft = shaft_on(12.0, 10.0, key=4.0)
    foot = levels.lower - seat.bearing.width
    loaded, shoulders = shaft.length_of(LOADED_WALL), shaft.length_of(COLLAR_EDGE)
    # Collar, hub and its tolerance, circlip, 0.1 mm: to the wall that the ring is pressed against.
    assert (loaded.nominal, loaded.lower, loaded.upper) == (pytest.approx(10 + 0.2 + 1.0 + 0.1), 0.0, 0.1)
    (groove,) = shaft.grooves
    assert loaded.high == pytest.approx(groove.at + groove.width)
    assert loaded.low == pytest.approx(-foot), "the collar's upper face"
    assert (shoulders.lower, shoulders.upper) == (-0.05, 0.0)
    assert shoulders.nominal == pytest.approx(levels.height - RING - 0.15)
    (key_seat,) = shaft.seats
    assert key_seat.round_ends(shaft.length) == (True, True)
    assert key_seat.length == key_of(seat.spindle.hub).length == 8
    assert kit.parts["key-4x4x8"].bought.designation == "DIN 6885 - A 4 x 4 x 8"
    # Both rings are in the list as they are drawn.
    rings = {part.bought.designation for part in kit.parts.values() if part.name.startswith("shim")}
    assert rings == {"DIN 988 - 12 x 18 x 0.2", "DIN 988 - 19 x 26 x 0.2"}


def test_bodies_of_a_shaft_touch_one_after_the_other():
    seat, levels, kit, _ = shaft_on(12.0, 10.0)
    at = {name: [one.z for one in part.instances] for name, part in kit.parts.items()}
    low, upper = at["bearing-6000"]
    assert low == levels.lower - 8
    assert upper == pytest.approx(levels.upper - RING)
    assert at["shim-19x26x0_2"] == [pytest.approx(upper + 8)], "the ring fills the seat behind the bearing"
    assert at["shim-12x18x0_2"] == [10.0]
    assert at["circlip-12"] == [pytest.approx(10.0 + hub_room(seat))]


def test_a_narrow_recess_has_no_shim_ring_and_the_circlip_closes_all_the_same():
    seat, levels, _, shaft = shaft_on(12.0, 10.0, recess=17.0)
    assert hub_ring(seat) is None
    _, hub = shaft_stacks(seat, shaft, levels)
    assert hub.shimming is None
    assert hub.play == pytest.approx((0.1, 0.66))
    assert list(stack_findings([hub])) == []


@given(gap=st.floats(0.5, 8), thickness=st.floats(10, 30), out=st.floats(12, 30))
def test_the_gap_in_a_coupling_is_what_the_heights_leave(gap, thickness, out):
    seat, levels, _, _ = shaft_on(12.0, 10.0)
    inner, under = levels.lower, levels.lower - thickness
    middle = under - 14.0
    face = SimpleNamespace(shaft_length=out)
    assume(inner - seat.bearing.width - middle - gap > 1)
    bracket = SimpleNamespace(
        motor=SimpleNamespace(face=face),
        top=middle - out + 6.0,
        stub=(10.0, inner - seat.bearing.width - middle - gap),
    )
    stack = coupling_stack(bracket, seat, inner, thickness)
    assert stack.nominal == pytest.approx(gap)
    assert list(stack_findings([stack])) == [] or stack.worst[0] < 0.5


def test_rings_fit_the_shafts_and_seats_that_they_are_for():
    sizes = [(one.inner, one.outer) for one in shims()]
    assert sizes == sorted(sizes)
    assert len(set(sizes)) == len(sizes)
    for inner, outer in sizes:
        assert 2.5 <= outer - inner <= 21
    for one in bearings():
        ring = shim_behind(one.bore, one.outside)
        if ring is not None:
            assert ring.outer == one.outside
            assert one.shoulder <= ring.inner < one.outside - 2, "it lies on the outer ring alone"
    assert shim_on(12, 17) is None
    assert shim_on(12, 30).bought(0.3).designation == "DIN 988 - 12 x 18 x 0.3"
    assert shim_on(12, 30).bought(0.3).shape.solid().Volume() == pytest.approx(math.pi * (81 - 36) * 0.3)

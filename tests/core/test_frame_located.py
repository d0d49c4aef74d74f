"""Locating and free bearings of a frame: one holds its shaft both ways, the other slides, whatever the size."""

import math
import tomllib
from pathlib import Path

import pytest
from by_night import by_night
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.mounting import Hub, Mounting, Spindle
from mechwright.machine.frame.findings import bent
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.located import (
    ABOVE,
    BELOW,
    FREE,
    LEAST_WAY,
    circlip_of,
    drawn_ring,
    has_room,
    inner_shim,
    proud,
    retainer_diameter,
    retainer_places,
    thermal_way,
)
from mechwright.machine.frame.plates import bearing_hole, least_thickness, retainer_holes, seat_depth
from mechwright.machine.frame.play import shaft_stacks
from mechwright.machine.frame.seats import bores, candidates, plate_radius, seats, wall
from mechwright.machine.frame.shafts import (
    AxialLocation,
    Levels,
    add_shaft,
    collar,
    highest,
    lowest,
    sections,
)
from mechwright.machine.settings import MachineSettings
from mechwright.machine.stack_inspection import stack_findings
from mechwright.standards.bearings import bearings

ROOT = Path(__file__).parents[2]
KEYS = MachineSettings(frame="plates", bearing_arrangement="locating-free")


def shaft_on(bore, length=10.0, below=2.0, above=3.0, stub=None, keys=KEYS):
    mounting = Mounting((Spindle("one", "one", (0.0, 0.0), Hub(0.0, length, bore), drives=True),))
    (seat,), _ = seats(mounting, keys)
    levels, kit = Levels(lowest(seat) - below, highest(seat) + above), Kit()
    return seat, levels, kit, add_shaft(kit, seat, levels, stub)


def two(distance, bore=12.0):
    return Mounting(
        tuple(
            Spindle(name, name, (x, 0.0), Hub(0.0, 10.0, bore), f"parameters.{name}", drives=name == "a")
            for name, x in (("a", 0.0), ("b", distance))
        )
    )


@given(
    bore=st.sampled_from(bores()[2:]),
    length=st.floats(3, 60),
    above=st.floats(0, 20),
    stub=st.sampled_from([None, 25.0]),
)
def test_shafts_of_all_sizes_are_held_at_one_end_and_free_at_the_other(bore, length, above, stub):
    ends = None if stub is None else (4.0, stub)
    seat, levels, kit, shaft = shaft_on(bore, length, above=above, stub=ends)
    stands, lower, upper, outwards, inwards, _ = stacks = tuple(shaft_stacks(seat, shaft, levels))
    assert list(stack_findings(stacks)) == []
    # The outer ring is clamped: even the narrowest one stands out of the deepest seat.
    assert stands.worst == pytest.approx((0.025, 0.075 + seat.bearing.narrower))
    # 0.1 mm and the tolerances of groove, ring and bearing: build-it.json, "inner ring under its circlip".
    zone = 0.1 + circlip_of(seat.bearing).thinner + seat.bearing.narrower
    assert upper.worst == pytest.approx((0.1, 0.1 + zone), abs=1e-6)
    ring = drawn_ring(seat.bearing)
    assert lower.worst == pytest.approx((0.1 + ring, 0.1 + ring + zone), abs=1e-6)
    if ring:
        assert 0 < lower.play[0] <= lower.play[1] <= 0.25
    for way in (outwards, inwards):
        assert way.nominal == pytest.approx(FREE, abs=1e-6)
        assert way.worst[0] >= LEAST_WAY + thermal_way(levels.height) - 1e-3
    # All grooves lie on the journals, and the land behind each outlives the chamfer.
    lengths = {one.name: one for one in shaft.lengths}
    foot = AxialLocation.of(seat, levels).foot(ends)
    assert lengths[BELOW].high + foot == pytest.approx(AxialLocation.of(seat, levels).shoulders[0])
    assert shaft.length - lengths[ABOVE].high >= 1.5
    assert sum(
        one.bought is not None and one.name == circlip_of(seat.bearing).part_name
        for one in kit.parts.values()
    )


def test_figures_of_a_6000_as_computed_by_hand():
    seat, levels, kit, shaft = shaft_on(12.0)
    assert seat.bearing.name == "6000"
    assert seat_depth(seat, upper=False) == 7.83  # 8 - 0.12 - 0.05
    assert seat_depth(seat, upper=True) == 10.6
    assert least_thickness([seat]) == 13.1
    assert shaft.length_of(BELOW).nominal == pytest.approx(8 + 0.1 + 1.0 + 0.1)
    assert shaft.length_of(ABOVE).nominal == pytest.approx(8 + 1.0 + 0.1)
    at = {name: [one.z for one in part.instances] for name, part in kit.parts.items()}
    low, up = at["bearing-6000"]
    assert low + 8 == pytest.approx(levels.lower + 0.17)
    assert up == pytest.approx(levels.upper + FREE)
    assert at["circlip-10"] == [pytest.approx(low - 0.1 - 1.0), pytest.approx(up + 8)]
    assert at["shim-10x16x0_1"] == [pytest.approx(low - 0.1)]
    assert thermal_way(100.0) == pytest.approx(0.046)


@given(st.sampled_from(bores()))
def test_bearings_leave_room_for_circlips_and_retainers_for_collars(bore):
    for one in candidates(bore, "auto", "locating-free"):
        assert has_room(one)
        assert circlip_of(one).size == one.bore
        assert circlip_of(one).room <= one.abutment - 1
        ring = inner_shim(one)
        assert ring is None or one.bore < ring.outer < one.outside - 0.3 * (one.outside - one.bore)
        # Screws stand outside of the seat, and heads within the rim.
        radii = {round(math.hypot(*at), 3) for at in retainer_places(one)}
        assert radii == {one.outside / 2 + 3.0}
        assert retainer_diameter(one) / 2 - max(radii) >= 5.5 / 2


def test_thin_bearings_whose_circlip_would_rub_are_no_choice():
    floating = {one.name for bore in bores() for one in candidates(bore, "auto")}
    located = {one.name for bore in bores() for one in candidates(bore, "auto", "locating-free")}
    assert located < floating
    assert not {"61800", "623"} & located  # 17 mm over a ring of 16.6; no ring for 3 mm
    assert {"608", "6000", "6202"} <= located
    assert {one.name for one in bearings() if has_room(one)} >= located


def test_retainers_of_neighbours_keep_apart_or_the_floating_arrangement_is_proposed():
    found, faults = seats(two(45.0), KEYS)
    assert not faults
    assert sum(retainer_diameter(seat.bearing) for seat in found) / 2 + 1 <= 45.0
    assert all(plate_radius(seat, "aluminium") >= wall(seat.bearing.outside, "aluminium") for seat in found)
    _, (fault,) = seats(two(30.0), KEYS)
    assert fault.code == "frame.bearing-room"
    assert fault.proposed[0] == {"machine.bearing_arrangement": "floating"}
    assert seats(two(30.0), MachineSettings(frame="plates"))[1] == []


def test_the_plates_have_seats_of_their_own_and_the_lower_one_threads():
    seat, _, _, _ = shaft_on(12.0)
    low, up = (bearing_hole(seat, 15.0, upper=upper).bores()[-1] for upper in (False, True))
    assert (low.depth, up.depth) == (7.83, 10.6)
    assert low.fit.name == up.fit.name == "H7"
    assert len(retainer_holes(seat, 15.0)) == 3
    floating = shaft_on(12.0, keys=MachineSettings(frame="plates"))[0]
    assert retainer_holes(floating, 15.0) == []
    assert bearing_hole(floating, 15.0, upper=True) == bearing_hole(floating, 15.0, upper=False)


def test_collar_and_hub_keep_clear_of_the_retainer_and_its_heads():
    seat, levels, _, _ = shaft_on(12.0, below=0.0)
    steps = sections(seat, levels)
    top = levels.lower + proud(seat.bearing) + 3.0
    held = AxialLocation.of(seat, levels)
    # The shoulder, thinner than the retainer's opening, reaches beyond it; the collar begins above.
    assert steps[1].diameter < seat.bearing.abutment
    assert held.shoulders[0] + steps[1].length >= top
    assert collar(seat.spindle.hub) > steps[1].diameter


def test_the_force_on_a_hub_is_shared_by_the_distances_of_both_bearings():
    seat, levels, _, _ = shaft_on(12.0, below=10.0, above=0.0)
    held, half = AxialLocation.of(seat, levels), seat.bearing.width / 2
    low, high = held.lower + half, held.upper + half
    near, far, moment, _ = bent(seat, levels, 100.0)
    assert far == pytest.approx(100 * (5.0 - low) / (high - low))
    assert near + far == pytest.approx(100)
    assert moment == pytest.approx(near * (5.0 - low) / 1000)


@pytest.mark.parametrize("name", ["elliptic-pair-machine", "geneva-machine"])
@by_night
def test_a_machine_with_locating_bearings_is_built(name, tmp_path):
    text = (ROOT / "examples" / f"{name}.toml").read_text()
    text = text.replace("[machine]\n", '[machine]\nbearing_arrangement = "locating-free"\n')
    assert tomllib.loads(text)["machine"]["bearing_arrangement"] == "locating-free"
    file = tmp_path / "machine.toml"
    file.write_text(text)
    done = CliRunner().invoke(make_app(), ["build", str(file), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    guide = (tmp_path / "out/assembly.html").read_text()
    # Each play is measured once both rings of that bearing are there.
    assert (
        guide.index("in its lower bearing")
        < guide.index("in its upper bearing")
        < guide.index("turns by hand")
    )
    assert list((tmp_path / "out").glob("retainer-*.nc"))

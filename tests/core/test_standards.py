"""Bought parts: tables against their own sums, solids against closed forms, and lookups at their limits."""

import math
from itertools import pairwise

import pytest
from cadquery import Location, Vector

from mechwright.contracts.bought import Bought
from mechwright.contracts.materials import material
from mechwright.contracts.turned import KeySeat
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry.keyway import KEYS, Opening, key_for_bore
from mechwright.standards.bearings import bearing, bearing_for, bearings, thinner
from mechwright.standards.bushes import bush_for, bushes
from mechwright.standards.circlips import bore_circlip, bore_circlips, shaft_circlip, shaft_circlips
from mechwright.standards.couplings import BORES, coupling_for, couplings
from mechwright.standards.dowels import dowel, dowel_for, dowels
from mechwright.standards.keys import RANGES, depth_tolerance, key, length_tolerance
from mechwright.standards.motors import gear_motors, motor_face, motor_faces, steppers
from mechwright.standards.screws import lengths, screw, screw_size, screw_sizes, washer
from mechwright.standards.table import names, table

STEEL = material("steel").density / 1000
"""g/mm³."""


@pytest.mark.parametrize("name", names())
def test_every_table_says_its_standard_and_where_its_numbers_are_from(name):
    found = table(name)
    assert len(found.source.split()) > 8
    assert found.standard or "no standard fixes" in found.source.replace("\n", " ").lower()
    assert len(found.rows) > 1


@pytest.mark.parametrize("one", bearings(), ids=lambda one: one.name)
def test_a_bearing_goes_together_with_itself(one):
    assert one.bore < one.shoulder < one.abutment < one.outside
    assert one.shoulder - one.bore >= 2 * one.fillet, "the shoulder is higher than its fillet"
    assert 0 < one.c0 < one.c
    ring = math.pi / 4 * (one.outside**2 - one.bore**2) * one.width * STEEL
    assert 0.5 < one.mass / ring < 0.85, "steel of an envelope is a third more than a bearing"


def test_bearings_of_one_bore_go_from_heavy_to_thin():
    assert len({one.name for one in bearings()}) == 32
    for one, other in pairwise(bearings()):
        if one.bore == other.bore:
            assert (one.outside, one.width, one.c, one.mass) > (
                other.outside,
                other.width,
                other.c,
                other.mass,
            )
            assert one.outside > other.outside
            assert one.c > other.c
            assert thinner(one) == other
        else:
            assert one.bore < other.bore
            assert thinner(one) is None


def test_the_heaviest_bearing_that_fits_is_taken_and_the_limit_told():
    assert [bearing_for(10, room).name for room in (30, 29, 25, 21)] == ["6200", "6000", "61900", "61800"]
    assert bearing_for(8, 22, dynamic=3000).name == "608"
    with pytest.raises(DesignError, match="the thinnest, 61800, is 19 mm outside"):
        bearing_for(10, 18)
    with pytest.raises(DesignError, match="608 carries C 3450 N and C0 1370 N; 4000 N"):
        bearing_for(8, 22, dynamic=4000)
    with pytest.raises(DesignError, match="no bearing has a bore of 11 mm"):
        bearing_for(11)
    with pytest.raises(DesignError, match="no bearing '688'"):
        bearing("688")


@pytest.mark.parametrize("ring", [*shaft_circlips(), *bore_circlips()], ids=lambda ring: f"{ring.size:g}")
def test_a_circlip_goes_together_with_its_groove(ring):
    assert (ring.groove > ring.size) is ring.inside
    assert ring.thickness < ring.width
    assert ring.depth > ring.tolerance / 2
    assert ring.height > 2 * ring.depth, "the ring stands over the groove"


@pytest.mark.parametrize("row", table("circlips-shaft").rows, ids=lambda row: f"{row['size']}")
def test_the_rules_for_grooves_give_what_the_standard_prints(row):
    ring = shaft_circlip(row["size"])
    assert ring.width == pytest.approx(row["width"])
    assert ring.edge == pytest.approx(row["edge"], abs=0.051)
    assert ring.groove_load() / 1000 == pytest.approx(row["groove_load"], rel=0.025)


@pytest.mark.parametrize(
    ("size", "width", "edge", "load"), [(22, 1.1, 1.5, 5.9), (28, 1.3, 2.1, 10.5), (35, 1.6, 3, 18.8)]
)
def test_the_rules_for_grooves_hold_in_bores_too(size, width, edge, load):
    ring = bore_circlip(size)
    assert (ring.width, ring.edge) == pytest.approx((width, edge))
    assert ring.groove_load() / 1000 == pytest.approx(load, rel=0.01)


@pytest.mark.parametrize("rings", [shaft_circlips(), bore_circlips()])
def test_larger_rings_have_larger_grooves_and_bear_more(rings):
    for one, other in pairwise(rings):
        assert one.size < other.size
        assert one.groove < other.groove
        assert one.thickness <= other.thickness
        assert one.groove_load() < other.groove_load()
        assert one.mass < other.mass


def test_sizes_without_a_ring_are_told():
    with pytest.raises(DesignError, match="DIN 471 has no ring for a shaft of 11 mm"):
        shaft_circlip(11)
    with pytest.raises(DesignError, match="DIN 472 has no ring for a bore of 21 mm"):
        bore_circlip(21)


@pytest.mark.parametrize("of", [one for one in screw_sizes() if one.head], ids=lambda one: f"M{one.size:g}")
def test_a_screw_goes_together_with_its_holes(of):
    assert of.head_height == of.size, "the head of ISO 4762 is as high as the thread is wide"
    assert of.size < of.hexagon * 2 / math.sqrt(3) * 1.6 < of.head * 1.6
    assert of.size / 2 > of.socket * 0.79
    assert of.tap_drill < of.size < of.fine < of.medium < of.coarse
    assert of.head < of.counterbore
    assert of.counterbore_depth > of.head_height
    if of.washer:
        assert of.washer[0] >= of.fine - 1e-9
        assert of.head <= of.washer[1]
    if of.sunk_head:
        assert of.sunk_head == pytest.approx(2.24 * of.size), "theoretical head of ISO 10642"


def test_tap_drills_are_the_usual_ones():
    drills = {3: 2.5, 4: 3.3, 5: 4.2, 6: 5, 8: 6.8, 10: 8.5, 12: 10.2}
    assert {size: screw_size(size).tap_drill for size in drills} == drills


def test_all_columns_of_screws_grow_with_the_thread():
    for column in ("fine", "medium", "coarse", "head", "hexagon", "sunk_head", "set_hexagon", "counterbore"):
        values = [getattr(one, column) for one in screw_sizes() if getattr(one, column)]
        assert values == sorted(set(values)), column


def test_a_screw_is_never_shorter_than_asked():
    assert [screw(4, length).length for length in (1, 6, 6.1, 40)] == [6, 6, 8, 40]
    assert screw(6, 5, "countersunk").bought.designation == "ISO 10642 - M6 x 5 - 8.8"
    assert screw(5, 7, "set").bought.designation == "ISO 4026 - M5 x 8 - 45H"
    with pytest.raises(DesignError, match="the longest cap screw M4 is 40 mm long; 41 mm are needed"):
        screw(4, 41)
    with pytest.raises(DesignError, match="no set screws M8; one of: M3, M4, M5, M6"):
        screw(8, 10, "set")
    with pytest.raises(DesignError, match="no screws M7"):
        screw(7, 10)
    with pytest.raises(DesignError, match=r"no washer for M2\.5"):
        washer(2.5)


def test_dowels_are_sold_in_steps():
    for of in dowels():
        assert of.chamfer < of.diameter / 2
        for standard in ("ISO 2338", "ISO 8734"):
            assert len(of.lengths(standard)) >= 6
            assert of.lengths(standard)[0] > of.diameter
    assert dowel_for(6, 21.9).length == 20
    assert dowel(6, 22, "ISO 2338").bought.designation == "ISO 2338 - 6 m6 x 22 - St"
    assert dowel(6, 21) is None
    assert dowel(7, 20) is None
    with pytest.raises(DesignError, match="the shortest ISO 8734 of 6 mm is 14 mm long"):
        dowel_for(6, 13)
    with pytest.raises(DesignError, match="ISO 8734 has no 7 mm"):
        dowel_for(7, 20)


@pytest.mark.parametrize("size", KEYS, ids=lambda size: f"{size.width:g}")
def test_a_key_stands_on_its_seat_and_does_not_reach_the_floor(size):
    opening = Opening(size.bore_to, size.width, size.hub_depth)
    seat = size.bore_to / 2 - opening.seat_depth
    assert opening.key_top - seat == pytest.approx(size.height)
    gap = size.shaft_depth + size.hub_depth - size.height
    assert opening.floor - opening.key_top == pytest.approx(gap)
    assert opening.mouth < opening.key_top < opening.floor
    assert max(x for x, _ in opening.key_section()) == opening.key_top


@pytest.mark.parametrize("size", KEYS[:8:3], ids=lambda size: f"{size.width:g}")
@pytest.mark.parametrize("share", [0.0, 0.3, 0.999])
def test_the_opening_of_a_shaft_has_the_area_of_its_parts(size, share):
    radius, half = size.bore_to / 2, size.width / 2
    assert Opening(size.bore_to).loop().area == pytest.approx(-math.pi * radius**2)
    sharp = Opening(size.bore_to, size.width, size.hub_depth)
    deep = sharp.floor - sharp.mouth
    assert sharp.greatest_relief == pytest.approx(math.sqrt(2) * min(half, deep))
    relief = share * sharp.greatest_relief
    # A disc without what lies beyond the chord of the keyway's mouth, the keyway, and in both corners half a
    # disc outside of the right angle over its diameter.
    angle = math.asin(half / radius)
    disc = radius**2 * (math.pi - angle + math.sin(angle) * math.cos(angle))
    corners = 2 * (math.pi / 8 - 1 / 4) * relief**2
    loop = Opening(size.bore_to, size.width, size.hub_depth, relief).loop()
    assert -loop.area == pytest.approx(disc + 2 * half * deep + corners)


@pytest.mark.parametrize(("depth", "gap"), [(2.0, 0.2), (0.4, 0.2), (0.3, 0.15), (0.1, 0.05)])
def test_a_key_of_no_standard_width_leaves_a_gap_of_a_fifth_or_half_its_depth(depth, gap):
    opening = Opening(20.0, 5.5, depth)
    assert opening.floor == 10 + depth
    assert opening.floor - opening.key_top == pytest.approx(gap)
    assert opening.seat_depth == depth


def test_keys_are_those_of_the_keyways():
    widths = [size.width for size in KEYS]
    assert set(RANGES) <= {int(width) for width in widths}
    for size in KEYS:
        if size.width in RANGES:
            assert RANGES[int(size.width)][0] >= size.width
    found = key(key_for_bore(12).width, 16)
    assert found.bought(12).designation == "DIN 6885 - A 4 x 4 x 16"
    assert key(4, 16, "B").bought(12).designation == "DIN 6885 - B 4 x 4 x 16"
    assert key(25, 100) is None, "no lengths in the table"


def test_a_key_with_round_ends_fills_a_closed_seat_and_bears_a_width_less():
    found = key(4, 16)
    assert (found.seat_length, found.bears) == (16, 12)
    solid = found.bought(12).shape.solid()
    assert solid.Volume() == pytest.approx(4 * (4 * 12 + math.pi * 4))
    seat = KeySeat(7.0, found.seat_length, 4.0, 3.5).piece(6.0, 30.0).solid()
    left = solid.moved(Location(Vector(0, 0, 7))).intersect(seat)
    assert left.Volume() == pytest.approx(seat.Volume()), "nothing of the seat is left empty"


@pytest.mark.parametrize(
    ("width", "depth", "length", "over"),
    [(6, 0.1, 28, 0.2), (8, 0.2, 32, 0.3), (32, 0.2, 90, 0.5), (36, 0.3, 90, 0.5), (58.2, 0.3, 90, 0.5)],
)
def test_seats_of_keys_have_tolerances_of_depth_and_length(width, depth, length, over):
    assert depth_tolerance(width) == depth
    assert length_tolerance(length) == over


def test_a_key_with_square_ends_stands_in_its_open_seat():
    found = key(4, 16, "B")
    assert (found.seat_length, found.bears) == (18, 16)
    solid = found.bought(12).shape.solid()
    box = solid.BoundingBox()
    assert (box.xmin, box.xmax) == pytest.approx((6 - 2.5, 6 - 2.5 + 4))
    assert (box.zmin, box.zmax) == pytest.approx((0, 16), abs=1e-6)
    assert solid.Volume() == pytest.approx((16 - 2 * 0.16**2) * 16)


@pytest.mark.parametrize("face", motor_faces(), ids=lambda face: face.name)
def test_a_motors_solid_is_as_large_as_its_table(face):
    box = face.shape(30.0).solid().BoundingBox()
    half = face.across / 2
    assert (box.xmin, box.xmax) == pytest.approx((-face.offset - half, half - face.offset), abs=1e-6)
    assert (box.ymin, box.ymax) == pytest.approx((-half, half), abs=1e-6)
    assert (box.zmin, box.zmax) == pytest.approx((-30, face.shaft_length), abs=1e-6)


@pytest.mark.parametrize("face", motor_faces(), ids=lambda face: face.name)
def test_a_motor_face_has_room_for_its_holes(face):
    assert face.shaft < face.pilot < face.spread * (math.sqrt(2) if face.holes == 4 else 1) < 2 * face.across
    assert face.spread + (face.thread or face.hole) < face.across
    assert face.pilot_height < face.shaft_length


def test_larger_motors_hold_more():
    for one, other in pairwise(steppers()):
        assert (one.size, one.length) < (other.size, other.length)
        assert one.hold < other.hold
        assert one.rotor < other.rotor
        assert one.mass < other.mass
    for one, other in pairwise(gear_motors()):
        assert one.ratio < other.ratio
        assert one.no_load > other.no_load > other.best
        assert one.stall < other.stall
    motors = [one.ratio * one.no_load for one in gear_motors()]
    assert max(motors) / min(motors) < 1.07, "one motor behind all gears"
    with pytest.raises(DesignError, match="no motor face 'NEMA 34'; one of: NEMA 17"):
        motor_face("NEMA 34")


def test_couplings_join_two_shafts_and_carry_a_torque():
    assert [one.torque for one in couplings()] == [0.5, 2.0]
    assert coupling_for(5, 8, 0.6).of.outside == 25
    for lower, upper in ((5, 8), (8, 5), (6, 6)):
        found = coupling_for(lower, upper, 0.6)
        solid, (r, high) = found.bought.shape.solid(), (found.of.outside / 2, found.of.length)
        bores = math.pi / 4 * (lower**2 + upper**2) * high / 2
        assert solid.Volume() == pytest.approx(math.pi * r**2 * high - bores)
        box = solid.BoundingBox()
        assert (box.xmax, box.zmin, box.zmax) == (
            pytest.approx(r),
            pytest.approx(0, abs=1e-9),
            pytest.approx(high),
        )
        more = (solid.Center().z - high / 2) * (lower - upper)  # more is left where the bore is smaller
        assert more > 0 or lower == upper
    with pytest.raises(DesignError, match="carry 2 N m; 3 N m are asked for"):
        coupling_for(5, 10, 3)
    with pytest.raises(DesignError, match="no coupling for 12 mm"):
        coupling_for(12, 5, 0.1)


def test_bushes_are_sold_in_three_lengths():
    for of in bushes():
        assert of.outside - of.bore == 4
        assert 0.45 * of.bore < of.lengths[0] < of.lengths[-1] <= 1.7 * of.bore
    with pytest.raises(DesignError, match="the shortest bush on a shaft of 8 mm is 6 mm long"):
        bush_for(8, 5)
    with pytest.raises(DesignError, match="no bush has a bore of 7 mm"):
        bush_for(7, 5)


def every_bought_part():
    yield from (one.bought for one in bearings())
    yield from (bush_for(of.bore, of.lengths[0]).bought for of in bushes())
    yield from (one.bought for one in (*shaft_circlips(), *bore_circlips()))
    yield from (dowel_for(of.diameter, 60).bought for of in dowels())
    for head in ("cap", "countersunk", "set"):
        yield from (screw(s.size, 1, head).bought for s in screw_sizes() if lengths(s.size, head))
    yield from (washer(of.size).bought for of in screw_sizes() if of.washer)
    yield from (one.bought for one in (*steppers(), *gear_motors()))
    yield from (coupling_for(bore, 6.0, 0.2).bought for bore in BORES)


def test_every_bought_part_is_one_sound_solid():
    for one in every_bought_part():
        solid = one.shape.solid()
        assert solid.ShapeType() == "Solid", one.designation
        assert solid.isValid(), one.designation
        # Between plastics and steel: a mass that belongs to another size is none of these.
        assert one.mass is None or 1e-3 < one.mass / solid.Volume() < 8.5e-3, one.designation
    for of in bushes():
        bush = bush_for(of.bore, of.lengths[-1]).bought
        assert bush.mass == pytest.approx(6.6e-3 * bush.shape.solid().Volume(), abs=1e-3)


def test_orders_are_told_apart():
    words = [one.designation for one in every_bought_part()]
    assert len(set(words)) == len(words)


D_SHAFT = 2.5**2 * math.acos(2.0 / 2.5) - 2.0 * math.sqrt(2.5**2 - 2.0**2)
"""What the flat takes of the section of a shaft of 5 mm that is 4.5 mm over it."""


@pytest.mark.parametrize(
    ("bought", "volume"),
    [
        (screw(4, 12).bought, math.pi * (4 * 12 + 12.25 * 4) - 2 * math.sqrt(3) * 1.5**2 * 2),
        (screw(5, 8, "set").bought, math.pi * 6.25 * 8 - 2 * math.sqrt(3) * 1.25**2 * 2),
        (
            screw(4, 12, "countersunk").bought,
            math.pi * (4 * (12 - 2.48) + 2.48 / 3 * (4 + 2 * 4.48 + 4.48**2))
            - 2 * math.sqrt(3) * 1.25**2 * 1.5,
        ),
        (washer(4).bought, math.pi / 4 * (81 - 4.3**2) * 0.8),
        (shaft_circlip(10).bought, math.pi / 4 * (16.6**2 - 9.6**2)),
        (bore_circlip(22).bought, math.pi / 4 * (23**2 - 13.6**2)),
        (steppers()[0].bought, 42.3**2 * 34 + math.pi * (121 * 2 + 6.25 * 22) - D_SHAFT * 22),
    ],
    ids=lambda value: value.designation if isinstance(value, Bought) else "",
)
def test_solids_have_the_volumes_of_closed_forms(bought, volume):
    assert bought.shape.solid().Volume() == pytest.approx(volume, rel=1e-9)


def test_a_cap_screws_head_rests_on_its_origin_and_its_shank_is_as_thick_as_its_thread():
    box = screw(6, 20).bought.shape.solid().BoundingBox()
    assert (box.zmin, box.zmax, box.xmax) == pytest.approx((-20, 6, 5), abs=1e-6)
    ring = bearing("608").bought.shape.solid()
    assert ring.Volume() == pytest.approx(2300.6, abs=0.05), "annulus with chamfers"


def test_what_is_no_order_is_refused():
    with pytest.raises(DesignError, match="needs the designation"):
        Bought(" ")
    with pytest.raises(DesignError, match="608-2Z: a mass of 0 g"):
        Bought("608-2Z", mass=0.0)


def test_a_shape_in_pieces_is_refused():
    from mechwright.contracts.shape import Shape, ring

    with pytest.raises(GeometryError, match="falls into 2 pieces"):
        Shape((ring(0, 4, 1), ring(0, 4, 1, low=2))).solid()

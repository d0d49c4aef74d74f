"""Plates, pins and slots of planar linkages keep apart over their motion, as shapes that are moved show."""

import itertools
import time

import numpy as np
import pytest
import shapely
from built import discs, fine, laid_out, placed, polygon, shapes
from drawn_linkages import LINKAGES

from mechwright import Channel, GeometryError, Motion
from mechwright.mechanics.linkage.parts.frames import frames_of, joints_of
from mechwright.mechanics.linkage.parts.layout import layout_of
from mechwright.mechanics.linkage.parts.parts import parts_of
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright_cad.interference import interference

every = pytest.mark.parametrize("name", list(LINKAGES))


@every
def test_it_lays_out_in_no_time(name):
    linkage = LINKAGES[name].linkage()
    bodies = LINKAGES[name].moved(linkage)
    start = time.perf_counter()
    layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0


@every
def test_plates_of_one_layer_stay_apart(name):
    layout, bodies = laid_out(name), fine(name)
    for one, two in itertools.combinations(layout.outlines, 2):
        if layout.stack.layer[one] == layout.stack.layer[two]:
            near = shapely.distance(shapes(layout, bodies, one), shapes(layout, bodies, two))
            assert near.min() >= layout.sizes.clearance, (one, two)


@every
def test_pins_meet_no_plate_that_is_not_theirs(name):
    layout, bodies = laid_out(name), fine(name)
    layer, radius = layout.stack.layer, layout.sizes.pin_diameter / 2
    for pin in layout.pins:
        ends = [layer[plate] for plate in pin.plates]
        for plate in set(layout.outlines) - set(pin.plates):
            through = min(ends) <= layer[plate] <= max(ends)
            over = layer[plate] > max(ends) and (pin.head or pin.above)
            under = layer[plate] < min(ends) and (pin.foot or pin.below)
            top = layout.stack.bottom(plate) + layout.sizes.thickness_of(plate)
            if under and top < layout.stack.spans[pin.name][0] - HEAD_HEIGHT * 2 * radius:
                continue
            if through or over or under:
                around = HEAD * radius if not through and (pin.head or pin.foot) else radius
                near = shapely.distance(discs(pin, bodies, around), shapes(layout, bodies, plate))
                assert near.min() > 0, (pin.name, plate)


@pytest.mark.parametrize("name", ["crank-shaper", "whitworth", "jansen", "stephenson1"])
def test_nothing_stands_in_anything_else(name):
    """The solids of all parts, over the whole motion."""
    layout = laid_out(name)
    bodies = LINKAGES[name].moved(layout.linkage)
    channels = {"phi": Channel(np.linspace(0.0, np.pi * 2, 361), "rad", "input")}
    motion = Motion("phi", channels, frames_of(layout, bodies), joints=joints_of(layout))
    found = interference(parts_of(layout), motion)
    assert found.collisions == ()
    assert found.skipped == ()


def test_what_slides_cannot_fall_out_of_its_slot():
    """A head below the slot, or above it where the slot is on top."""
    for name, ends in (("crank-shaper", "foot"), ("whitworth", "foot"), ("scotch-yoke", "head")):
        guides = [pin for pin in laid_out(name).pins if pin.number]
        assert len(guides) == 2
        assert all(getattr(pin, ends) for pin in guides)


@every
def test_posts_stand_outside_of_all_that_moves(name):
    layout, bodies = laid_out(name), fine(name)
    for at, plate in itertools.product(layout.posts, layout.outlines):
        post = shapely.Point(at.real, at.imag).buffer(layout.sizes.corner)
        if layout.link(plate) != "ground":
            assert shapely.distance(post, shapes(layout, bodies, plate)).min() > 0, plate


@every
def test_slots_hold_their_pins_with_a_rim_around(name):
    layout, bodies = laid_out(name), fine(name)
    sizes, found = layout.sizes, 0
    for slot in layout.slots:
        (plate,) = layout.scheme.plates(slot.link, slot.slide)
        wall = shapely.Polygon(np.column_stack([(w := polygon(slot.loop())).real, w.imag]))
        frame = bodies[slot.link]
        along = (slot.last - slot.first) / abs(slot.last - slot.first)
        for pin in layout.pins:
            if plate not in (one for one, _ in pin.rolling):
                continue
            world = placed([pin.place], bodies[pin.body])[:, 0]
            own = (world - frame.origin.position) / frame.turning.direction
            room = ((own - slot.first) / along).real, ((slot.last - own) / along).real
            assert np.abs(((own - slot.first) / along).imag).max() < 1e-9
            assert min(room[0].min(), room[1].min()) > 0.9 * sizes.clearance
            roller = shapely.buffer(shapely.points(own.real, own.imag), sizes.roller / 2 - 0.011)
            assert shapely.covers(wall, roller).all()
            found += 1
        outside = shapely.Polygon(
            np.column_stack([(o := polygon(layout.outlines[plate].outer)).real, o.imag])
        )
        assert outside.exterior.distance(wall) > sizes.rim - 0.03
    assert found >= len(layout.slots)


@every
def test_openings_leave_a_rim(name):
    layout = laid_out(name)
    for outline in layout.outlines.values():
        holes = [shapely.Polygon(loop.flatten(0.01)) for loop in outline.inner]
        rim = shapely.Polygon(outline.outer.flatten(0.01)).exterior
        for one, two in itertools.combinations(holes, 2):
            assert one.distance(two) > layout.sizes.rim - 0.03
        assert all(rim.distance(hole) > layout.sizes.rim - 0.03 for hole in holes)


@pytest.mark.parametrize("frame", ["one", "two"])
def test_the_four_bar_stands_as_its_own_family_has_it(frame):
    from mechwright_four_bar.parameters import FourBarParams
    from mechwright_four_bar.table import FourBarTable

    params = FourBarParams(
        crank=40, coupler=120, follower=80, ground=100, coupler_point_x=50, coupler_point_y=30, frame=frame
    )
    family, own = FourBarTable.of(params).layout, laid_out("fourbar", frame=frame)
    again = {"rocker": "follower"}
    assert {again.get(plate, plate): layer for plate, layer in own.stack.layer.items()} == family.stack.layer
    assert own.stack.layers == family.stack.layers
    spans = {name: span for name, span in own.stack.spans.items() if not name.startswith("post")}
    if frame == "one":
        assert spans == {pin.name: family.stack.spans[pin.name] for pin in family.pins}
    for plate, outline in own.outlines.items():
        if frame == "two" and plate.startswith("ground"):
            continue  # their posts stand as far to both sides
        assert outline.area == pytest.approx(family.outlines[again.get(plate, plate)].area, rel=1e-12), plate
    if frame == "one":
        bores = {part.name: part for part in parts_of(family)}
        for part in parts_of(own):
            other = bores[again.get(part.name, part.name)]
            assert len(part.instances) == len(other.instances), part.name
            assert sorted(i.z for i in part.instances) == sorted(i.z for i in other.instances)
            assert part.turned == other.turned


def test_a_refusal_names_the_pair_that_no_layer_keeps_apart():
    start = time.perf_counter()
    with pytest.raises(GeometryError, match="no order of layers keeps the plates apart") as refused:
        laid_out("whitworth", frame="one")
    assert "crank" in str(refused.value)
    assert "\n" not in str(refused.value)
    assert time.perf_counter() - start < 5.0


def test_bores_that_are_too_near_are_named_with_their_limit():
    with pytest.raises(
        GeometryError, match=r"crank: the bores of A0 and A are 10 mm apart, and the limit is 16"
    ):
        laid_out("crank-shaper", pin_diameter=12.0)


def test_slots_that_cross_a_bore_of_one_plate_are_refused():
    with pytest.raises(GeometryError, match="ground: the slot of guide and the bore of A0"):
        laid_out("scotch-yoke", frame="one")


def test_a_link_that_does_not_close_is_named():
    linkage = LINKAGES["toggle-press"].linkage()
    bodies = LINKAGES["toggle-press"].moved(linkage)
    bodies["ram"].origin.position[3:5] = np.nan
    with pytest.raises(GeometryError, match="link ram does not close at 2 of 361 positions"):
        layout_of(linkage, Sizes(), bodies)

"""Outlines of links against shapely's hulls and buffers, masses against the CAD kernel."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mechwright.contracts.part import Instance
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Line
from mechwright.mechanics.linkage import (
    Boss,
    Mass,
    bent_link,
    bushing_part,
    cylinder_mass,
    disc,
    hull_link,
    pin_part,
    plate_mass,
    rectangle,
    together,
    web_link,
)

CHORD = 1e-3
FINE = 64
"""Quarter-circle segments of shapely's buffers: 1e-4 of the radius and 2e-4 of the area off."""

COORDINATES = st.floats(-80, 80)
BOSSES = st.lists(
    st.builds(Boss, st.builds(complex, COORDINATES, COORDINATES), st.floats(2, 30)), min_size=1, max_size=4
)


def buffers(bosses):
    return shapely.union_all(
        [shapely.Point(b.centre.real, b.centre.imag).buffer(b.radius, quad_segs=FINE) for b in bosses]
    )


@settings(max_examples=150, deadline=None)
@given(BOSSES)
def test_a_hull_link_is_the_convex_hull_of_its_bosses(bosses):
    link = hull_link(bosses)
    hull = shapely.convex_hull(buffers(bosses))
    polygon = link.polygon(CHORD)
    assert polygon.hausdorff_distance(hull) < 0.02
    assert link.area == pytest.approx(hull.area, rel=3e-4)
    assert_smooth(link.outer)


@pytest.mark.parametrize("bend", [0.0, 1e-12, 1e-7])
def test_three_bosses_in_a_row_make_a_straight_link(bend):
    row = [Boss(0j, 5), Boss(complex(20, bend), 5), Boss(40 + 0j, 5)]
    assert hull_link(row).area == pytest.approx(40 * 10 + 25 * math.pi, rel=1e-6)


def test_a_boss_inside_another_does_not_show():
    link = hull_link([Boss(0j, 10), Boss(3 + 0j, 5, 4)])
    assert link.outer.is_circle
    assert len(link.inner) == 1


def test_bores_are_where_they_were_asked_for():
    link = hull_link([Boss(0j, 8, 6, "crank-pin"), Boss(50 + 10j, 7, 5)])
    (one,), (two,) = (loop.segments for loop in link.inner)
    assert (one.tag, one.centre, one.radius) == ("crank-pin", (0.0, 0.0), 3.0)
    assert (two.centre, two.radius) == ((50.0, 10.0), 2.5)


def assert_smooth(loop):
    """Neighbouring segments of a hull meet without a corner."""
    if loop.is_circle:
        return
    for one, two in zip(loop.segments, (*loop.segments[1:], loop.segments[0]), strict=True):
        out, into = one.derivative(1.0)[0], two.derivative(0.0)[0]
        cross = out[0] * into[1] - out[1] * into[0]
        assert abs(cross) <= 1e-6 * np.linalg.norm(out) * np.linalg.norm(into)
        assert out @ into > 0


@settings(max_examples=60, deadline=None)
@given(
    st.floats(4, 12),
    st.floats(4, 12),
    st.floats(20, 120),
    st.floats(0.2, 0.95),
    st.floats(1, 8),
    st.floats(-0.9, 0.9),
    st.floats(0, 6.28),
)
def test_webs_have_their_width_and_fillets(r1, r2, length, share, fillet, bend, turn):
    width = 2 * share * min(r1, r2)
    along = complex(math.cos(turn), math.sin(turn))
    one, two = Boss(3 - 2j, r1, 3), Boss(3 - 2j + length * along, r2, 3)
    elbow = one.centre + (two.centre - one.centre) * complex(0.5, bend / 2)
    for straight in (True, False):
        try:
            link = (
                web_link(one, two, width, fillet)
                if straight
                else bent_link(one, two, elbow, width, fillet, width)
            )
        except GeometryError:
            continue
        assert_smooth(link.outer)
        points = [one.centre, two.centre] if straight else [one.centre, elbow, two.centre]
        spine = shapely.LineString([(z.real, z.imag) for z in points])
        polygon = link.polygon(CHORD)
        solid = shapely.Polygon(polygon.exterior)
        if straight:  # without its fillets: bosses and a band along the spine
            plain = shapely.union_all([buffers([one, two]), spine.buffer(width / 2, quad_segs=FINE)])
            assert solid.buffer(0.01).covers(plain)
            # A fillet between a boss and a web at most as wide covers no more than the square of its radius.
            assert solid.area - plain.area < 4 * fillet**2
            assert solid.within(shapely.convex_hull(plain).buffer(0.01))
        bosses = shapely.union_all(
            [shapely.Point(b.centre.real, b.centre.imag).buffer(b.radius - 0.01) for b in (one, two)]
        )
        assert solid.covers(bosses)
        tags = [segment.tag for segment in link.outer.segments]
        assert tags.count("fillet") == 4
        assert all(s.radius == fillet for s in link.outer.segments if s.tag == "fillet")


def test_a_bent_web_is_parallel_to_its_legs():
    link = bent_link(Boss(0j, 8), Boss(80 + 0j, 8), 40 + 20j, 8, 5, 12)
    webs = [segment for segment in link.outer.segments if segment.tag == "web"]
    spine = shapely.LineString([(0, 0), (40, 20), (80, 0)])
    for web in webs:
        assert isinstance(web, Line)
        for t in (0.0, 0.5, 1.0):
            x, y = web.at(t)[0]
            assert spine.distance(shapely.Point(x, y)) == pytest.approx(4.0, abs=1e-9)
    radii = sorted(segment.radius for segment in link.outer.segments if segment.tag == "bend")
    assert radii == [8.0, 16.0]


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: hull_link([]), "at least one boss"),
        (lambda: web_link(Boss(0j, 5), Boss(30 + 0j, 5), 10, 3), "below 10 mm"),
        (lambda: web_link(Boss(0j, 5), Boss(12 + 0j, 5), 4, 8), "fillets"),
        (lambda: bent_link(Boss(0j, 5), Boss(30 + 0j, 5), 15 + 5j, 6, 2, 3), "bend's radius"),
        (lambda: bent_link(Boss(0j, 41), Boss(80 + 0j, 41), 40 - 158j, 10, 8, 20), "run into each other"),
        (lambda: bent_link(Boss(0j, 5), Boss(30 + 0j, 5), 15 + 15j, 6, 2, 30), "leg of the bent link"),
        (lambda: rectangle(0j, 10 + 4j, 2.0), "corners of 2 mm"),
    ],
)
def test_impossible_links_are_named(make, words):
    with pytest.raises(GeometryError, match=words):
        make()


def test_plates_of_simple_shape():
    assert disc(10.0, [Boss(4 + 0j, 5, 6)]).area == pytest.approx(math.pi * (100 - 9), rel=1e-12)
    plate = rectangle(-10 - 5j, 20 + 15j, 2.0, [Boss(0j, 0, 4)])
    assert plate.area == pytest.approx(600 - 16 + 4 * math.pi - 4 * math.pi, rel=1e-12)
    arcs = [segment for segment in plate.outer.segments if isinstance(segment, Arc)]
    assert [arc.radius for arc in arcs] == [2.0] * 4


def solid_mass(solid, density):
    """Mass, centre and inertia about z from the CAD kernel."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    props = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid.wrapped, props)
    centre = props.CentreOfMass()
    inertia = props.MatrixOfInertia().Value(3, 3)
    return props.Mass() * density, complex(centre.X(), centre.Y()), inertia * density


def test_plate_masses_are_those_of_the_solids():
    from mechwright_cad.solids.solid import plate

    link = hull_link([Boss(0j, 8, 6), Boss(60 + 5j, 6, 5), Boss(20 + 30j, 5, 3)])
    found = plate_mass(link, 6.0, "aluminium")
    mass, centre, inertia = solid_mass(plate(link, 6.0), 2.7e-6)
    assert found.mass == pytest.approx(mass, rel=1e-6)
    assert found.centre == pytest.approx(centre, rel=1e-6)
    assert found.inertia == pytest.approx(inertia, rel=1e-6)


def test_turned_masses_are_those_of_the_solids():
    at = (Instance("ground"),)
    pin = pin_part("pin", 6.0, 20.0, at, 10.0, 2.0)
    mass, centre, inertia = solid_mass(pin.build(), 7.85e-6)
    found = together([cylinder_mass(6, 20, "steel"), cylinder_mass(10, 2, "steel")])
    assert (found.mass, found.inertia) == pytest.approx((mass, inertia), rel=1e-9)
    assert abs(centre) < 1e-9
    ring = bushing_part("bushing", 6.0, 8.0, 5.0, at)
    mass, _, inertia = solid_mass(ring.build(), 8.5e-6)
    found = cylinder_mass(8, 5, "brass", bore=6)
    assert (found.mass, found.inertia) == pytest.approx((mass, inertia), rel=1e-9)
    assert ring.material == "brass"


def test_pins_stand_on_their_foot():
    box = pin_part("pin", 6.0, 20.0, (), 10.0, 2.0).build().BoundingBox()
    assert (box.zmin, box.zmax, box.xlen) == pytest.approx((0, 22, 10), abs=1e-6)
    assert pin_part("plain", 6.0, 20.0, ()).build().BoundingBox().zmax == pytest.approx(20)


@settings(max_examples=50, deadline=None)
@given(
    st.lists(
        st.tuples(st.floats(0.01, 5), COORDINATES, COORDINATES, st.floats(0, 100)), min_size=1, max_size=5
    )
)
def test_masses_together_keep_all_moments(rows):
    masses = [Mass(m, complex(x, y), i) for m, x, y, i in rows]
    total = together(masses)
    assert total.mass == pytest.approx(sum(m.mass for m in masses))
    for place in (0j, 7 - 3j):
        assert total.about(place) == pytest.approx(sum(m.about(place) for m in masses), rel=1e-9)
    assume(abs(total.centre) > 1e-6)
    assert total.centre * total.mass == pytest.approx(sum(m.mass * m.centre for m in masses), rel=1e-9)


def test_nothing_weighs_nothing():
    assert together([]) == Mass(0.0)

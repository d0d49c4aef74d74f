"""Walls as envelopes, undercut, loops: against brute force that knows no derivative of the motion."""

import math

import geneva_undercut as undercut
import numpy as np
import pytest
import shapely
from by_night import examples
from geneva_slots import valid_slots
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mechwright.contracts.design_table import with_columns
from mechwright.mechanics.laws import LAWS, Polynomial
from mechwright_geneva.defaults.dimensions import mechanism_of, table_of
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Frame, regime, stroke
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES, measure
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.slot_outline import Slot

LAW_NAMES = list(LAWS)


def columns(slots, half, offset, rim):
    return Frame(
        np.array(math.pi / slots),
        np.radians(half)[:, None],
        np.radians(offset)[:, None],
        np.array(float(rim)),
    )


def random_designs(rng, count, slots):
    """Angles and rollers of which about half are undercut, in both regimes."""
    half = rng.uniform(0.6, 1.4, count) * (90 - 180 / slots)
    offset = rng.uniform(1, 16, count) * np.where(rng.random(count) < 0.5, 1, -1)
    reach = 180 / slots + offset + half / 2
    keep = (reach < 86) & (180 / slots + offset > 4)
    return half[keep], offset[keep], rng.uniform(0.5, 10, int(keep.sum()))


def way(frame, law, u):
    """The roller's centre in the wheel's frame, straight from the definition of the motion."""
    rates = law.at(u)
    theta = 2 * frame.wheel_half * rates.s
    phi = frame.crank_half * (1 - 2 * u)
    return (frame.axes - frame.crank * np.exp(1j * phi)) * np.exp(-1j * theta)


def turns_back(track, radius, side):
    """Whether a wall runs backwards anywhere, from nothing but points of the way.

    The wall's points are those of circles about the way, on the normals of its chords; where the wall turns
    back, a step of it goes against the chord.
    """
    chord = np.diff(track, axis=1)
    normal = 1j * chord / np.abs(chord)
    # At the middle of a chord, so that the wall lies between two of its points.
    wall = (track[:, 1:] + track[:, :-1]) / 2 + side * radius * normal
    step = np.diff(wall, axis=1)
    along = chord[:, 1:] + chord[:, :-1]
    return ((step * np.conj(along)).real < 0).any(axis=1)


@pytest.mark.parametrize("law", LAW_NAMES)
def test_undercut_is_decided_as_by_brute_force(law):
    """Over 2,000 random designs in all, in both regimes, with every law."""
    rng = np.random.default_rng(LAW_NAMES.index(law))
    u = np.linspace(0, 1, 4001)
    seen = {-1: [0, 0], 1: [0, 0]}
    for slots in (3, 4, 5, 6, 8, 12):
        half, offset, radius = random_designs(rng, 90, slots)
        frame, of = columns(slots, half, offset, 100), LAWS[law]()
        found = measure(frame, of, radius[:, None], FINE_SAMPLES)
        limit = np.minimum(found.island_limit, found.hub_limit)[:, 0]
        cut = limit <= radius
        track = way(frame, of, u)
        brute = turns_back(track, radius[:, None], 1) | turns_back(track, radius[:, None], -1)
        # Within a thousandth of the limit neither the samples nor the chords can tell.
        clear = np.abs(limit / radius - 1) > 1e-3
        assert (cut == brute)[clear].all()
        for side in (-1, 1):
            for value in (0, 1):
                seen[side][value] += int((clear & (found.side[:, 0] == side) & (cut == value)).sum())
    assert sum(map(sum, seen.values())) >= 350
    assert min(map(min, seen.values())) >= 5, seen


@pytest.mark.parametrize("law", LAW_NAMES)
def test_walls_are_where_neighbouring_circles_meet(law):
    """Second order: with a hundredth of the step the intersection comes 10,000 times nearer."""
    frame = Frame.of(math.pi / 4, math.radians(50), math.radians(6), 100.0)
    u = np.array([0.11, 0.33, 0.47, 0.71, 0.9])
    misses = []
    for step in (1e-3, 1e-4):
        one, two = way(frame, LAWS[law](), u - step / 2), way(frame, LAWS[law](), u + step / 2)
        middle, half = (one + two) / 2, np.abs(two - one) / 2
        along = 1j * (two - one) / np.abs(two - one)
        run = stroke(frame, LAWS[law](), u)
        misses.append(
            max(
                np.abs(middle + side * np.sqrt(25 - half**2) * along - run.wall(5, side)).max()
                for side in (LEFT, RIGHT)
            )
        )
    assert misses[1] < misses[0] / 50
    assert misses[1] < 1e-3


@st.composite
def clean_designs(draw):
    slots = draw(st.integers(3, 12))
    law = draw(st.sampled_from(LAW_NAMES))
    half = draw(st.floats(0.7, 1.3)) * (90 - 180 / slots)
    offset = draw(st.floats(2, 14)) * draw(st.sampled_from([1, -1]))
    radius = draw(st.floats(1, 8))
    assume(180 / slots + offset > 2)
    assume(valid_slots(law, slots, half, offset, 100.0, radius).item())
    return slots, law, half, offset, radius


@settings(deadline=None, max_examples=examples(8, 120))
@given(clean_designs())
def test_no_wall_comes_nearer_to_the_way_than_the_roller(design):
    """The distance of every wall point from the whole centre line is r."""
    slots, law, half, offset, radius = design
    frame = Frame.of(math.pi / slots, math.radians(half), math.radians(offset), 100.0)
    law = LAWS[law]()
    # Dense where the way bends most; chords of 1/20,000 stand off by far less than the limit.
    u = np.sin(np.linspace(0, np.pi, 20_001) - np.pi / 2) / 2 + 0.5
    u = np.unique(np.concatenate((u, np.linspace(0.4, 0.6, 10_001))))
    track = stroke(frame, law, u).track
    edges = shapely.linestrings(
        np.stack(
            (
                np.column_stack((track[:-1].real, track[:-1].imag)),
                np.column_stack((track[1:].real, track[1:].imag)),
            ),
            1,
        )
    )
    tree = shapely.STRtree(edges)
    at = np.linspace(0, 1, 601)
    for side in (LEFT, RIGHT):
        wall = stroke(frame, law, at).wall(radius, side)
        _, distance = tree.query_nearest(
            shapely.points(wall.real, wall.imag), return_distance=True, all_matches=False
        )
        assert np.abs(distance - radius).max() < 1e-6 * max(1.0, radius)


@settings(deadline=None, max_examples=60)
@given(clean_designs())
def test_singularity_is_the_square_of_the_regularity(design):
    """F = (D/b)⁴ (1 ∓ κ r)²: the source's condition, corrected, and the sign that the checks use."""
    slots, law, half, offset, radius = design
    frame = Frame.of(math.pi / slots, math.radians(half), math.radians(offset), 100.0)
    run = stroke(frame, LAWS[law](), np.linspace(0, 1, 201))
    for side in (LEFT, RIGHT):
        ours = (run.speed / frame.crank) ** 4 * run.regularity(radius, side) ** 2
        assert undercut.singularity(run, radius, side) == pytest.approx(ours, rel=1e-9, abs=1e-12)
        assert (run.regularity(radius, side) > 0).all()


def test_the_middle_is_a_closed_form():
    rng = np.random.default_rng(5)
    half, offset, _ = random_designs(rng, 200, 5)
    for law in LAWS.values():
        frame = columns(5, half, offset, 100)
        run = stroke(frame, law(), np.array([0.5]))
        ours = 1 / np.abs(run.curvature[:, 0]) / frame.crank[:, 0]
        assert undercut.critical_at_middle(frame, run.first)[:, 0] == pytest.approx(ours, rel=1e-7)


def test_regimes_follow_the_turning_ratio():
    law = LAWS["cycloidal"]()
    for half, offset, side in ((50, 5, -1), (45, 12, -1), (45, -12, 1), (60, -20, 1)):
        frame = Frame.of(math.pi / 4, math.radians(half), math.radians(offset), 100.0)
        p = float(stroke(frame, law, np.array(0.5)).first)
        assert int(regime(frame, law)) == side == (1 if p > float(frame.turning_ratio) else -1)


def test_the_wrong_sign_of_the_offset_crosses_the_ways():
    """The island's walls of a design with the other sign overlap: brute force on the two ways."""
    law, u = LAWS["cycloidal"](), np.linspace(0, 0.49, 400)
    for half, offset in ((50.0, 5.0), (45.0, -12.0)):
        for sign, crossing in ((1, False), (-1, True)):
            frame = Frame.of(math.pi / 4, math.radians(half), math.radians(sign * offset), 100.0)
            into, out = way(frame, law, u), way(frame, law, 1 - u)
            meet = shapely.LineString(np.column_stack((into.real, into.imag))).intersects(
                shapely.LineString(np.column_stack((out.real, out.imag)))
            )
            assert meet == crossing or int(regime(frame, law)) != int(
                regime(Frame.of(math.pi / 4, math.radians(half), math.radians(offset), 100.0), law)
            )


LOPSIDED = Polynomial((0, 0, 0, 10 + 6, -15 - 18, 6 + 18, -6))
"""3-4-5 and 6 u³ (1 - u)³: more of the way before mid stroke than after it."""


class TestLopsided:
    def test_is_a_law(self):
        assert not LOPSIDED.symmetric
        assert LOPSIDED.least_velocity >= -1e-12

    def test_measures_agree_with_the_mirrored_ones_where_both_apply(self):
        """A symmetric law measured point by point gives the figures of the mirror."""
        from mechwright_geneva.kinematics import slot_limits as limits

        law = LAWS["3-4-5"]()
        for half, offset, radius in ((50, 6, 4), (45, -12, 5), (50, 2, 6)):
            frame = columns(4, np.array([float(half)]), np.array([float(offset)]), 100)
            mirror = measure(frame, law, np.array([[float(radius)]]), 161)
            u = limits.samples_of(law, 161)
            u = np.concatenate((u, 1 - u[-2::-1]))
            run = stroke(frame, law, u)
            side = mirror.side
            wall = (run.centre + side * radius * run.normal) * run.to_wheel
            neck, width, web = limits._compared(run, wall, run.track)
            assert neck[0] == pytest.approx(mirror.neck.item(), abs=0.02)
            assert (width[0] > 0) == (mirror.width.item() > 0)
            assert web[0] - 2 * radius == pytest.approx(mirror.web.item(), abs=0.02)

    @pytest.mark.parametrize(("half", "offset", "radius"), [(50, 8, 4), (45, -12, 5), (60, 3, 7)])
    def test_run_backwards_it_has_the_same_neck_width_and_web(self, half, offset, radius):
        """The way out is then the way in, as in a mirror."""
        backwards = Polynomial((0, 0, 0, 10 - 6, -15 + 18, 6 - 18, 6))
        frame = columns(4, np.array([float(half)]), np.array([float(offset)]), 100)
        one, other = (measure(frame, law, np.array([[float(radius)]]), 161) for law in (LOPSIDED, backwards))
        for name in ("neck", "width", "web"):
            np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-9)

    def test_walls_keep_the_roller_free(self):
        frame = Frame.of(math.pi / 4, math.radians(50), math.radians(8), 100.0)
        u = np.linspace(0, 1, 20_001)
        track = stroke(frame, LOPSIDED, u).track
        assert abs(track[10_000] * np.exp(1j * math.pi / 4) - abs(track[10_000])) > 3, (
            "not on the slot's axis"
        )
        line = shapely.LineString(np.column_stack((track.real, track.imag)))
        found = measure(
            Frame(*(np.array([[float(v)]]) for v in (math.pi / 4, frame.crank_half, frame.offset, 100))),
            LOPSIDED,
            np.array([[4.0]]),
            161,
        )
        assert found.width[0] > 0
        for side in (LEFT, RIGHT):
            wall = stroke(frame, LOPSIDED, np.linspace(0, 1, 301)).wall(4, side)
            assert shapely.distance(line, shapely.points(wall.real, wall.imag)).min() > 4 - 1e-5


@pytest.mark.parametrize(
    "table",
    [
        {},
        {"law": "modified-trapezoid", "offset_angle": 6},
        {"law": "4-5-6-7", "offset_angle": 9},
        {"offset_angle": -12, "crank_half_angle": 45, "entry_radius": 70},
        {"slots": 3},
        {"law": "polynomial", "polynomial": [0, 0, 0, 12, -21, 12, -2]},
    ],
)
def test_the_fitted_walls_are_within_what_they_say(table):
    m = mechanism_of(GenevaParams(**table))
    slot = Slot(m)
    for side in (LEFT, RIGHT):
        wall = slot.wall(side, trimmed=False)
        assert 0 < wall.deviation <= 0.0005
        exact = slot.exact(side, np.linspace(0, 1, 4001))
        line = shapely.LineString(np.column_stack((exact.real, exact.imag)))
        fitted = np.concatenate([s.flatten(1e-4) for s in wall.segments if s.tag == "wall"])
        assert shapely.distance(line, shapely.points(fitted)).max() < wall.deviation + 2e-4
        trimmed = slot.wall(side, trimmed=True)
        assert [math.hypot(*end) for end in (trimmed.start, trimmed.end)] == pytest.approx(
            [m.rim] * 2, abs=1e-9
        )


@pytest.mark.parametrize("table", [{}, {"law": "straight"}, {"offset_angle": -12, "crank_half_angle": 45}])
def test_the_groove_is_the_union_of_its_discs(table):
    """Area and shape of the groove, leads included, against discs along the way."""
    m = mechanism_of(GenevaParams(**table))
    loop, _ = Slot(m).loop()
    groove = shapely.Polygon(loop.flatten())
    disc = shapely.Point(0, 0).buffer(m.rim, quad_segs=512)
    lead = np.linspace(Slot(m).cap_angle, m.crank_half, 200)
    before = m.axes - m.crank * np.exp(1j * lead)
    after = (m.axes - m.crank * np.exp(-1j * lead[::-1])) * np.exp(-2j * m.wheel_half)
    if m.straight:
        before = np.linspace(m.rim + 8, m.rim, 2) * np.exp(-1j * m.wheel_half)
        after = before[::-1]
    track = np.concatenate((before, m.stroke(np.linspace(0, 1, 4001)).track, after))
    swept = shapely.LineString(np.column_stack((track.real, track.imag))).buffer(m.groove, quad_segs=256)
    missing = groove.intersection(disc).symmetric_difference(swept.intersection(disc)).area
    assert missing < 1e-3 * groove.length


@pytest.mark.parametrize("law", [{}, {"law": "polynomial", "polynomial": [0, 0, 0, 12, -21, 12, -2]}])
@pytest.mark.parametrize("side", [LEFT, RIGHT])
def test_a_wall_passes_the_rim_at_its_mouth_or_on_its_lead(law, side):
    half, offset = np.linspace(40, 64, 9)[:, None], np.linspace(16, 6, 9)[:, None]
    params = with_columns(GenevaParams(slots=6, **law), {"crank_half_angle": half, "offset_angle": offset})
    table = table_of(params, 9)
    angle = Slot(table).lead_angle(side)
    for end in (0, 1):
        mouth = Slot(table).mouth(side, end)
        inside = angle == table.crank_half
        assert 0 < inside.sum() < 9 or side == LEFT
        np.testing.assert_array_equal(mouth != end, inside)
        place = np.where(
            inside,
            Slot(table).exact(side, mouth),
            table.axes - (table.crank + side * table.groove) * np.exp(1j * angle),
        )
        np.testing.assert_allclose(np.abs(place), np.broadcast_to(table.rim, (9, 1)), rtol=1e-13)
        for row, one in enumerate(mouth.ravel()):
            assert Slot(table.row(row)).mouth(side, end).item() == pytest.approx(one, abs=1e-15)


class Whole:
    """A law of which nobody says that it is its own mirror image."""

    symmetric = False

    def __init__(self, law):
        self.law = law

    def __getattr__(self, name):
        return getattr(self.law, name)


@pytest.mark.parametrize("slots", [4, 6])
def test_a_whole_stroke_is_judged_as_its_half_and_the_mirror_image(slots):
    half, offset, radius = random_designs(np.random.default_rng(slots), 40, slots)
    frame, law = columns(slots, half, offset, 100), LAWS["modified-sine"]()
    one, other = (measure(frame, each, radius[:, None], 161) for each in (law, Whole(law)))
    for figure in ("side", "mouth", "web", "nearest"):
        ours, theirs = getattr(one, figure), getattr(other, figure)
        some = (ours > 0) | (theirs > 0) | (figure != "web")  # below 0 there is no web
        np.testing.assert_allclose(theirs[some], ours[some], atol=0.02, err_msg=figure)
    bends = radius[:, None] < 0.9 * one.island_limit
    assert ((other.width > 0) == (one.width > 0))[bends].all()

"""The catalogue of named linkages: the reference's numbers, columns, and what each linkage is known for."""

from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from reference_linkages import case

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.assembly_order import assembly_order
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.relative_motion import relative
from mechwright.mechanics.planar.rigid import Turning
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.catalogue.three_bars import assemblies

EXACT = 1e-10
"""Of max(1, |value|)."""

WIPER = {
    "b0_x": 150, "b0_y": 20, "c0_x": 620, "c0_y": 30, "crank": 40, "rod1": 160, "b_x": -30, "b_y": 50, "d_x": 27, "d_y": -48, "t_x": -194,
    "t_y": 373, "rod2": 468, "lever2": 58, "u_x": -430, "u_y": -20,
}  # fmt: skip
PUBLISHED = {
    "base": hypot(16, 6), "c0_x": np.real((38 + 13j) / (16 + 6j) * hypot(16, 6)),
    "c0_y": np.imag((38 + 13j) / (16 + 6j) * hypot(16, 6)), "crank": hypot(2, 12), "coupler": hypot(20, 9),
    "c_x": np.real((13 + 19j) / (20 + 9j) * hypot(20, 9)), "c_y": np.imag((13 + 19j) / (20 + 9j) * hypot(20, 9)),
    "rocker": hypot(2, 15), "link5": hypot(25, 3), "link6": hypot(2, 15), "k_x": 0.0, "k_y": 0.0,
}  # fmt: skip
"""Published for a Stephenson III with its ground turned: here A0 is the origin and B0 on X."""

REFERENCE = {
    "watt-1": ("watt1", {}, {}),
    "watt-2": ("watt2", {}, {}),
    "stephenson-1": ("stephenson1", {"g_x": 60}, {}),
    "stephenson-2": (
        "stephenson2",
        {},
        {"T1": "crank", "b1": "rod1", "b2": "rod2", "T2": "coupler", "b3": "rocker"},
    ),
    "stephenson-3": ("stephenson3", {"c0_y": 130}, {"Pc": "C"}),
    "whitworth": ("whitworth", {}, {}),
    "crank-shaper": (
        "crank_shaper",
        {"crank": 10, "centre_distance": 25, "lever": 65, "rod": 30, "ram_height": 50},
        {},
    ),
    "scotch-yoke": ("scotch_yoke", {"slot_angle": np.degrees(1.39626340159546), "guide_height": 5}, {}),
    "pantograph": ("pantograph", {}, {"a": "arm", "b": "long-side", "c": "short-side", "d": "tie"}),
    "peaucellier": ("peaucellier", {"crank": 40}, {}),
    "hoecken": ("hoecken", {"crank": 10}, {}),
    "chebyshev": ("chebyshev", {"base": 40}, {}),
    "roberts": ("roberts", {}, {}),
    "jansen": ("jansen", {}, {"tri1": "shoulder", "tri2": "foot"}),
    "klann": ("klann", {"lower": hypot(26.8, 17.6), "upper": hypot(50, 13.4)}, {}),
    "toggle-press": ("toggle_press", {}, {}),
    "wiper": ("wiper_tandem", WIPER, {}),
}
"""Name of an entry to that of the reference, its dimensions there, and what links and pins are called here."""

TURNED = {("klann", "lower"), ("klann", "upper")}
"""Links whose frame in the reference is turned against ours."""


def near(found, expected, exact=EXACT) -> bool:
    found, expected = np.asarray(found), np.asarray(expected)
    return bool((abs(found - expected) <= exact * np.maximum(1, abs(expected))).all())


def around(entry, half=0.3, samples=31):
    """The motion about the drawn position."""
    linkage = entry.linkage()
    theta = np.radians(entry.start) + np.linspace(-half, half, samples)
    return linkage, solve(linkage.machine, [Turning.of(theta, 1.0)])


@pytest.mark.parametrize("name", REFERENCE)
def test_entries_move_as_the_reference(name):
    other, dimensions, names = REFERENCE[name]
    one = case(other)
    linkage = ENTRIES[name](**dimensions).linkage()
    found = solve(linkage.machine, one.inputs)
    for link in one.machine.links:
        turning = found.bodies[names.get(link, link)].turning
        for order in ("omega", "alpha", "jerk"):
            expected = np.array([position[order][link] for position in one.positions])
            assert near(getattr(turning, order), expected), (link, order)
        off = np.exp(1j * (turning.theta - np.array([position["angle"][link] for position in one.positions])))
        assert near(off, off[0] if (name, link) in TURNED else 1), link
    pins = {joint.name: joint for joint in linkage.machine.joints}
    for pin in one.positions[0]["joints"]:
        expected = np.array([complex(*position["joints"][pin]) for position in one.positions])
        assert near(found.place(pins[names.get(pin, pin)]).position, expected), pin
    if other == "scotch_yoke":
        way = np.array([position["slides"]["guide"][0] for position in one.positions])
        assert near(found.bodies["yoke"].origin.position, way + 5j)


def test_stephenson_three_as_published():
    one = case("stephenson3_published")
    linkage = ENTRIES["stephenson-3"](**PUBLISHED).linkage()
    turn = np.angle(16 + 6j)
    law = one.inputs[0]
    theta = law.theta + np.angle(-2 + 12j) - turn
    found = solve(linkage.machine, [Turning.of(theta, law.omega, law.alpha, law.jerk)])
    for link, there in (("coupler", "BCE"), ("rocker", "CD"), ("link5", "EF"), ("link6", "FG")):
        for order in ("omega", "alpha", "jerk"):
            expected = np.array([position[order][there] for position in one.positions])
            assert near(getattr(found.bodies[link].turning, order), expected), (link, order)


@pytest.mark.parametrize("name", ENTRIES)
def test_defaults_close_where_they_are_drawn(name):
    entry = ENTRIES[name]()
    linkage, found = around(entry)
    assert found.closes.all()
    near = {**found.sines, **found.pivots}
    assert min(float(np.min(one)) for one in near.values()) > 1e-3
    assert linkage.output in found.bodies
    for link, point in linkage.traces.values():
        assert point in linkage.points[link]
    assert entry.title
    assert entry.source
    inner = {group.inner.name for group in assembly_order(linkage.machine) if hasattr(group, "inner")}
    free = {"slot"} if name == "scotch-yoke" else set()  # a group that closes in one way
    assert inner - free == set(linkage.machine.branches), "every dyad states its sign"


@pytest.mark.parametrize("name", ENTRIES)
def test_joints_lie_where_the_points_of_their_links_are(name):
    linkage = ENTRIES[name]().linkage()
    for joint in linkage.machine.joints:
        for link in joint.links:
            if isinstance(joint, Revolute):
                assert joint.place(link) == linkage.points[link][joint.name.split("-")[0]]
            else:
                assert joint.place(link) in linkage.points[link].values()


@pytest.mark.parametrize("name", ENTRIES)
def test_descriptions_say_what_every_dimension_is(name):
    for key, field in ENTRIES[name].model_fields.items():
        assert field.description, key
        assert field.description.endswith("."), key
        assert not field.is_required(), key


def varied(entry, rows, seed=1):
    """Columns (rows, 1) for every number of an entry, some hundredths from its default."""
    rng = np.random.default_rng(seed)
    return {
        key: value * (1 + 0.01 * rng.uniform(-1, 1, (rows, 1))) + 0.1 * rng.uniform(-1, 1, (rows, 1))
        for key, value in entry
        if isinstance(value, float)
    }


@pytest.mark.parametrize("name", ENTRIES)
def test_columns_are_the_same_as_one_by_one(name):
    entry = ENTRIES[name]()
    columns = varied(entry, 3)
    assert columns
    _, every = around(entry.model_copy(update=columns))
    assert every.closes.shape == (3, 31)
    assert every.closes.all()
    for row in range(3):
        _, single = around(entry.model_copy(update={key: float(one[row, 0]) for key, one in columns.items()}))
        for link, body in single.bodies.items():
            many = every.bodies[link]
            for part in ("theta", "omega", "alpha", "jerk"):
                expected = getattr(body.turning, part)
                assert near(np.broadcast_to(getattr(many.turning, part), (3, 31))[row], expected, 1e-9), link
            for part in ("position", "velocity", "acceleration", "jerk"):
                expected = getattr(body.origin, part)
                assert near(np.broadcast_to(getattr(many.origin, part), (3, 31))[row], expected, 1e-9), link


@pytest.mark.parametrize("name", ENTRIES)
def test_a_single_column_among_numbers(name):
    entry = ENTRIES[name]()
    for key, column in varied(entry, 2, seed=2).items():
        linkage, found = around(entry.model_copy(update={key: column}), samples=5)
        assert found.closes.all(), key
        traced = [
            found.bodies[link].point(linkage.points[link][point]) for link, point in linkage.traces.values()
        ]
        assert all(one.position.shape in {(5,), (2, 5)} for one in traced), key


@given(st.sampled_from(sorted(ENTRIES)), st.integers(0, 10**6))
def test_joints_hold_at_every_sample(name, seed):
    entry = ENTRIES[name]()
    single = {key: float(one[0, 0]) for key, one in varied(entry, 1, seed).items()}
    linkage, found = around(entry.model_copy(update=single))
    for joint in linkage.machine.joints:
        one, two = (found.bodies[link] for link in joint.links)
        if isinstance(joint, Revolute):
            gap = one.point(joint.place_one).position - two.point(joint.place_two).position
            assert abs(gap).max() < 1e-9, joint.name
        elif isinstance(joint, Prismatic):
            seen = relative(two, one)
            lever = (seen.point(joint.point).position - joint.line) * np.exp(-1j * joint.line_angle)
            assert abs(lever.imag).max() < 1e-9, joint.name
            direction = np.exp(1j * (seen.turning.theta + joint.block_angle - joint.line_angle))
            assert abs(direction - 1).max() < 1e-9, joint.name


lengths = st.floats(20, 200)


@given(lengths, lengths)
def test_parallel_guide_does_not_turn(crank, base):
    _, found = around(ENTRIES["parallel-guide"](crank=crank, base=base), half=1.4)
    assert abs(found.bodies["platform"].turning.theta).max() < 1e-9
    assert near(found.bodies["follower"].turning.omega, 1, 1e-9)


@given(st.floats(1.1, 6), st.floats(-3, 3))
def test_pantograph_enlarges_by_its_ratio(ratio, theta):
    linkage = ENTRIES["pantograph"](ratio=ratio).linkage()
    found = solve(linkage.machine, [Turning.of([theta], 1.0)])
    small, large = (
        found.bodies[link].point(linkage.points[link][point])
        for link, point in (linkage.traces["D"], linkage.traces["F"])
    )
    for order in ("position", "velocity", "acceleration", "jerk"):
        assert near(getattr(large, order), ratio * getattr(small, order)), order


@given(lengths, st.floats(0.2, 0.6), st.floats(0.2, 0.9))
def test_peaucellier_draws_its_line(arm, side, part):
    side *= arm
    low, high = arm - side, min(arm + side, np.sqrt(arm**2 - side**2))
    crank = (low + part * (high - low)) / 2
    if not low + 0.02 * arm < 2 * crank < high - 0.02 * arm:
        return
    linkage = ENTRIES["peaucellier"](arm=arm, side=side, crank=crank).linkage()
    limit = 2 * np.arccos((arm - side) / (2 * crank))
    found = solve(linkage.machine, [Turning.of(np.linspace(-0.95, 0.95, 41) * limit, 1.0)])
    place = found.bodies["AD"].point(side).position
    assert abs(place.real - (arm**2 - side**2) / (2 * crank)).max() < 1e-9 * arm / (1 - side / arm)


@given(st.floats(40, 200), st.floats(0.3, 1.2))
def test_watt_line_draws_watts_curve(arm, ratio):
    """r² = b² - (a sin φ ± √(c² - a² cos² φ))² about the middle of the pivots, φ from the line through them."""
    coupler = ratio * arm
    linkage = ENTRIES["watt-line"](arm=arm, coupler=coupler).linkage()
    found = solve(linkage.machine, [Turning.of(np.linspace(-0.2, 0.2, 41), 1.0)])
    middle = (2 * arm - 1j * coupler) / 2
    z = (found.bodies["coupler"].point(coupler / 2).position - middle) / (middle / abs(middle))
    a, b, c = abs(middle), arm, coupler / 2
    root = np.sqrt(np.maximum(c**2 - (a * z.real / np.maximum(abs(z), 1e-300)) ** 2, 0))
    sine = a * z.imag / np.maximum(abs(z), 1e-300)
    off = [abs(abs(z) ** 2 - b**2 + (sine + sign * root) ** 2) for sign in (1, -1)]
    away = abs(z) > 1e-3 * arm
    assert np.min(off, axis=0)[away].max() < 1e-7 * arm**2
    assert abs(z).min() < 1e-9 * arm, "the middle of both pivots is on it"


@given(st.floats(105, 200), st.integers(2, 6), st.floats(-3, 3))
def test_scissor_platform_stays_level(arm, stages, theta):
    entry = ENTRIES["scissor-lift"](arm=arm, stages=stages)
    linkage = entry.linkage()
    found = solve(linkage.machine, [Turning.of([theta, theta + 0.1], 1.0)])
    platform = found.bodies["platform"]
    assert abs(platform.turning.theta).max() < 1e-9
    foot = found.bodies["slider"].origin.position.real
    assert near(platform.origin.position, 1j * stages * np.sqrt(arm**2 - foot**2), 1e-9)


def test_scotch_yoke_moves_by_the_cosine():
    found = solve(ENTRIES["scotch-yoke"]().linkage().machine, [Turning.of(np.linspace(0, 6, 50), 1.0)])
    assert near(found.bodies["yoke"].origin.position, 40 * np.cos(np.linspace(0, 6, 50)))


@given(st.integers(0, 10**6))
def test_every_way_to_put_a_plate_on_three_bars_is_found(seed):
    """A drawn plate is among them, and they are as many as the closing error has changes of sign."""
    rng = np.random.default_rng(seed)
    p, c = 100 * (rng.uniform(-1, 1, (2, 3)) + 1j * rng.uniform(-1, 1, (2, 3)))
    c[0], angle, x = 0, rng.uniform(-3, 3), 100 * complex(*rng.uniform(-1, 1, 2))
    l = abs(x + c * np.exp(1j * angle) - p)
    found = assemblies(tuple(p), (c[1], c[2]), tuple(l))[0]
    ways = found[np.isfinite(found)]
    assert abs(np.exp(1j * ways) - np.exp(1j * angle)).min() < 1e-6
    phi = np.linspace(-np.pi, np.pi, 20001)
    d2, d3 = (p[k] - p[0] - c[k] * np.exp(1j * phi) for k in (1, 2))
    m2, m3 = ((l[0] ** 2 + abs(d) ** 2 - l[k] ** 2) / 2 for k, d in ((1, d2), (2, d3)))
    error = abs(m2 * d3 - m3 * d2) ** 2 - (l[0] * (np.conj(d2) * d3).imag) ** 2
    changes = np.count_nonzero(error[:-1] * error[1:] < 0)
    together = np.min(np.abs(np.diff(np.sort(ways))), initial=1) < 1e-3  # the grid may step over both
    assert together or len(ways) == changes
    assert len(ways) % 2 == 0


def test_stephenson_two_takes_the_assembly_that_is_named():
    drawn = [ENTRIES["stephenson-2"](coupler_angle=angle).drawn()["coupler"].angle for angle in (-36, 120)]
    assert np.degrees(drawn[0]) == pytest.approx(-35.740, abs=1e-3)
    assert abs(drawn[0] - drawn[1]) > 0.5


def test_stephenson_two_that_cannot_be_put_together_is_refused_by_name():
    with pytest.raises(
        KinematicsError, match="stephenson-2: no coupler fits rod1 72, rod2 66 and rocker 9 mm"
    ):
        ENTRIES["stephenson-2"](rocker=9.0).linkage()
    entry = ENTRIES["stephenson-2"]().model_copy(update={"rocker": np.array([[98.0], [9.0]])})
    _, found = around(entry)
    assert found.closes.all(axis=1).tolist() == [True, False]
    assert not found.closes[1].any()


@pytest.mark.parametrize(
    ("name", "dimensions", "words"),
    [
        ("jansen", {"e": 90.0}, "e = 90 mm has to be less than b \\+ d = 81.6 mm"),
        ("jansen", {"i": 10.0}, "h = 65.7 mm has to be less than g \\+ i = 46.7 mm"),
        ("peaucellier", {"crank": 20.0}, "2 crank is 40 mm"),
        ("peaucellier", {"crank": 45.0}, "below √\\(arm² - side²\\) = 89.3"),
        ("roberts", {"arm": 30.0}, "arm = 30 mm has to be 0.55 to 1.5 times base"),
    ],
)
def test_dimensions_that_cannot_close_are_refused(name, dimensions, words):
    with pytest.raises(ValidationError, match=words):
        ENTRIES[name](**dimensions)


def test_the_ground_is_in_every_entry():
    assert all(GROUND in entry().points() for entry in ENTRIES.values())

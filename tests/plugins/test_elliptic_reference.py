"""Every published or independently derived figure of the pair and of the reference gear."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from mechwright.mechanics.gearing import SIDES, gear_loop
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse
from mechwright_elliptic_gears.kinematics.equations import (
    Turning,
    coupler,
    driven,
    phase_offset,
    pitch_radii,
    steepest_shaft_pressure_angle,
    train,
)
from mechwright_elliptic_gears.kinematics.figures import point_peaks, point_window
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import point_of_coupler
from mechwright_elliptic_gears.kinematics.window import near_constant
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of, teeth_of

DATA = Path(__file__).parents[1] / "data"
FACTS = json.loads((DATA / "elliptic-gears.json").read_text(encoding="utf-8"))["facts"]
GEAR = json.loads((DATA / "elliptic-gear-z39-m2.json").read_text(encoding="utf-8"))
REFERENCE = EllipticGearParams(eccentricity=0.4, teeth=39, module=2.0, bore=0.0, backlash=0.0)
TEETH = teeth_of(REFERENCE)
CENTRE = np.array([TEETH.curve.focal_distance, 0.0])


ANGLES = {"0": 0.0, "pi/4": math.pi / 4, "pi/2": math.pi / 2, "3pi/4": 3 * math.pi / 4, "pi": math.pi}


def angle(value):
    return ANGLES[value] if isinstance(value, str) else float(value)


def gears(inputs):
    return train(Turning.of(inputs["theta2"], inputs["omega2"]), inputs["e"], angle(inputs["gamma"]))


def q_of_train(inputs):
    return point_of_coupler(*gears(inputs)[1:], inputs["a"], inputs["e"])


def xy(number):
    return [float(number.real), float(number.imag)]


def design(inputs):
    return EllipticGearParams(
        backlash=0.0,
        stages=2,
        phase=math.degrees(angle(inputs["gamma"])),
        eccentricity=inputs["e"],
        semi_major=inputs["a"],
        speed=inputs["omega2"] * 60 / math.tau,
        band=inputs.get("band"),
        bore=12,
    )


def window(inputs):
    return point_window(design(inputs))


def middle(inputs, theta):
    """The middle's path about its centre, which does not depend on the phase."""
    return point_of_coupler(*train(Turning.of(theta, 1.0), inputs["e"], 1.0)[1:], inputs["a"], inputs["e"])


def farthest(inputs, of):
    return peak(lambda theta: np.abs(of(middle(inputs, theta).position - inputs["a"]))).value


def lobes(inputs):
    """Area of both lobes, which are run round in opposite ways: ∮ |x dy - y dx| / 2."""
    theta = np.linspace(0, math.tau, 20000, endpoint=False)
    path = middle(inputs, theta)
    swept = np.conj(path.position - inputs["a"]) * path.velocity
    return float(np.abs(swept.imag).mean() * math.pi)


def pair(inputs):
    gear2 = Turning.of(angle(inputs["theta2"]), inputs.get("omega2", 10.0), inputs.get("alpha2", 0.0))
    return gear2, driven(gear2, inputs["e"])


def speed_of_q(inputs):
    def speed(theta2):
        gear2 = Turning.of(theta2, inputs["omega2"])
        return point_of_coupler(gear2, driven(gear2, inputs["e"]), inputs["a"], inputs["e"]).speed

    return speed


def tooth_centre(inputs):
    return TEETH.curve.frame_at(TEETH.tooth_arcs[inputs["k"]]).point


def flank_point(inputs):
    pitch, side = TEETH.rack.pitch, inputs["side"]
    start = np.array(inputs["space_centre_arc_in_pitches"] * pitch + side * TEETH.rack.half_space)
    frame = TEETH.curve.frame_at(start + inputs["u"])
    return TEETH.rack.flank(frame, start, np.array(side)) - CENTRE


def fillet_bottom(inputs):
    space = inputs["space_centre_arc_in_pitches"] * TEETH.rack.pitch
    centre = np.array(space + inputs["side"] * TEETH.rack.half_land)
    return TEETH.rack.fillet(TEETH.curve.frame_at(centre), centre) - CENTRE


def polar(inputs):
    x, y = tooth_centre(inputs)
    return math.degrees(math.atan2(y, x)) % 360


def zmin(inputs):
    """Conservative number of teeth for a straight depth of one module: 4 E / (π (1 - e²) sin²α)."""
    e = inputs["e"]
    integral = Ellipse(1.0, e).complete_integral
    return 4 * integral / (math.pi * (1 - e * e) * math.sin(math.radians(inputs.get("alpha", 20))) ** 2)


def slot_width(column):
    return min(row[column] for row in slot_widths())


def slot_widths():
    """Chords of each space: at the pitch curve, at the end of the straight flank, and of the root land."""
    ellipse, rack = TEETH.curve, TEETH.rack
    at_pitch = ellipse.frame_at(TEETH.flank_arcs).point
    u = -SIDES * rack.straight_depth / (math.sin(rack.pressure_angle) * math.cos(rack.pressure_angle))
    straight = TEETH.rack.flank(ellipse.frame_at(TEETH.flank_arcs + u), TEETH.flank_arcs, SIDES)
    root = ellipse.frame_at(TEETH.arc_centres).offset(-rack.dedendum)
    return np.stack([np.hypot(*(c[:, 1] - c[:, 0]).T) for c in (at_pitch, straight, root)], axis=1)


def seated_discs():
    """Radius of the largest disc in each space that touches the middle of the root, from the outline."""
    middle = TEETH.curve.frame_at(TEETH.space_arcs)
    foot = middle.offset(-TEETH.rack.dedendum)
    points = outline_of(REFERENCE).outer.flatten(1e-6)
    radii = []
    for root, normal in zip(foot, middle.normal, strict=True):
        to = points - root
        height = to @ normal
        # A disc through the root's middle holds a point if |to|² < 2 R height.
        ahead = height > 0.05
        radii.append(((to[ahead] ** 2).sum(axis=1) / (2 * height[ahead])).min())
    return np.array(radii)


def fillet_radius():
    """Least radius of curvature over all fillets, by central differences on the exact curves."""
    teeth, h = TEETH, 1e-3
    reach = np.linspace(0, teeth.rack.arc_depth / math.tan(teeth.rack.pressure_angle), 60)
    centre = teeth.arc_centres[..., None, None]
    arcs = centre - SIDES[:, None, None] * reach[:, None] + h * np.array([-1, 0, 1])
    points = teeth.rack.fillet(teeth.curve.frame_at(arcs), np.broadcast_to(centre, arcs.shape))
    first = (points[..., 2, :] - points[..., 0, :]) / (2 * h)
    second = (points[..., 2, :] - 2 * points[..., 1, :] + points[..., 0, :]) / h**2
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return float((np.hypot(first[..., 0], first[..., 1]) ** 3 / np.abs(cross)).min())


def uncut(diameter):
    """Deepest remainder of an end mill in the fillets."""
    target = outline_of(REFERENCE).polygon(1e-5)
    left = target.buffer(diameter / 2, quad_segs=64).buffer(-diameter / 2, quad_segs=64).difference(target)
    edge = shapely.get_coordinates(target.exterior)
    edges = shapely.STRtree(shapely.linestrings(np.stack((edge[:-1], edge[1:]), axis=1)))
    _, away = edges.query_nearest(shapely.points(shapely.get_coordinates(left)), return_distance=True)
    return float(away.max())


CASES = {
    "pair.theta4": lambda i: float(pair(i)[1].theta),
    "pair.omega4": lambda i: float(pair(i)[1].omega),
    "pair.alpha4": lambda i: float(pair(i)[1].alpha),
    "pair.omega_ratio_max": lambda i: -float(driven(Turning.of(0.0, 1.0), i["e"]).omega),
    "pair.s2": lambda i: float(pitch_radii(Turning.of(i["theta2"], 0), i["a"], i["e"])[0]),
    "pair.s4": lambda i: float(pitch_radii(Turning.of(i["theta2"], 0), i["a"], i["e"])[1]),
    "pair.coupler_angle_mod_2pi": lambda i: float(coupler(*pair(i)).theta) % math.tau,
    "pair.omega3_coupler": lambda i: float(coupler(*pair(i)).omega),
    "train.phi_mod_2pi": lambda i: phase_offset(angle(i["gamma"]), i["e"]) % math.tau,
    "train.theta4": lambda i: float(gears(i)[1].theta) % math.tau,
    "train.theta5": lambda i: float(gears(i)[2].theta) % math.tau,
    "train.omega4": lambda i: float(gears(i)[1].omega),
    "train.omega5": lambda i: float(gears(i)[2].omega),
    "train.alpha4": lambda i: float(gears(i)[1].alpha),
    "train.alpha5": lambda i: float(gears(i)[2].alpha),
    "train.Q_xy": lambda i: xy(q_of_train(i).position),
    "train.vQ_xy": lambda i: xy(q_of_train(i).velocity),
    "train.aQ_xy": lambda i: xy(q_of_train(i).acceleration),
    "trace.half_length_x": lambda i: farthest(i, np.real),
    "trace.half_height_y": lambda i: farthest(i, np.imag),
    "trace.area_both_lobes": lobes,
    "table3.vQ_max": lambda i: point_peaks(design(i))["speed"].value,
    "table3.aQ_max": lambda i: point_peaks(design(i))["acceleration"].value / 1000,
    "table2.window_length": lambda i: window(i).length,
    "table2.window_start_end": lambda i: [window(i).start, window(i).start + window(i).length],
    "table2.window_vmin": lambda i: window(i).low,
    "single.window_length": lambda i: near_constant(speed_of_q(i), i["band"]).length,
    "single.vQ_max": lambda i: peak(speed_of_q(i)).value,
    "gear.a": lambda i: TEETH.curve.semi_major,
    "gear.b": lambda i: TEETH.curve.semi_minor,
    "gear.c": lambda i: TEETH.curve.focal_distance,
    "gear.E_complete": lambda i: TEETH.curve.complete_integral,
    "gear.perimeter": lambda i: TEETH.curve.perimeter,
    "gear.pitch": lambda i: TEETH.rack.pitch,
    "gear.rho_min": lambda i: TEETH.curve.least_radius,
    "gear.rho_max": lambda i: TEETH.curve.greatest_radius,
    "gear.m_max_no_undercut": lambda i: TEETH.curve.least_radius * math.sin(math.radians(20)) ** 2,
    "gear.zmin_no_undercut": zmin,
    "gear.zmin_no_undercut_1m": zmin,
    "gear.max_pressure_angle_deg": lambda i: math.degrees(
        steepest_shaft_pressure_angle(i["e"], math.radians(i["alpha"]))
    ),
    "gear.center_distance": lambda i: 2 * TEETH.curve.semi_major,
    "gear.tooth_centre_xy": lambda i: tooth_centre(i) - CENTRE,
    "gear.tooth_polar_about_axis_deg": polar,
    "gear.area": lambda i: outline_of(REFERENCE).area,
    "gear.volume_10mm_no_bore": lambda i: outline_of(REFERENCE).area * i["thickness"],
    "gear.min_fillet_curvature_radius": lambda i: fillet_radius(),
    "gear.min_slot_width_end_of_straight_flank": lambda i: slot_width(1),
    "gear.min_slot_width_pitch": lambda i: slot_width(0),
    "gear.max_disc_radius_seated_on_root_centre": lambda i: seated_discs().min(),
    "gear.uncut_depth_2mm_endmill": lambda i: uncut(2.0),
    "gear.flank_point_xy": flank_point,
    "gear.fillet_bottom_point_xy": fillet_bottom,
}


@pytest.mark.parametrize("fact", FACTS, ids=lambda fact: f"{fact['name']}-{fact['inputs']}")
def test_fact(fact):
    found = CASES[fact["name"]](fact["inputs"])
    np.testing.assert_allclose(found, fact["expected"], rtol=0, atol=fact["tolerance"])


def test_every_fact_is_looked_at():
    assert {fact["name"] for fact in FACTS} == set(CASES)
    assert len(FACTS) == 158


def test_gear_teeth():
    frame = TEETH.curve.frame_at(TEETH.tooth_arcs)
    u = TEETH.curve.parameter(TEETH.tooth_arcs)
    x, y = (frame.point - CENTRE).T
    found = {
        "u": u,
        "x": x,
        "y": y,
        "polar_deg": np.degrees(np.arctan2(*frame.point.T[::-1])) % 360,
        "radius_from_axis": np.hypot(*frame.point.T),
        "rho": frame.radius,
    }
    for name, values in found.items():
        np.testing.assert_allclose(values, [tooth[name] for tooth in GEAR["teeth"]], rtol=0, atol=1e-9)


def test_gear_sizes():
    names = {
        "a": "gear.a",
        "b": "gear.b",
        "c": "gear.c",
        "E_complete": "gear.E_complete",
        "perimeter": "gear.perimeter",
        "pitch": "gear.pitch",
        "rho_min": "gear.rho_min",
        "rho_max": "gear.rho_max",
        "m_max_no_undercut": "gear.m_max_no_undercut",
        "zmin_no_undercut": "gear.zmin_no_undercut",
        "center_distance": "gear.center_distance",
    }
    assert {key for key in GEAR["R"] if key not in ("e", "z", "m")} == set(names)
    for key, name in names.items():
        assert CASES[name]({"e": 0.4}) == pytest.approx(GEAR["R"][key], abs=1e-9)


def test_gear_slots():
    np.testing.assert_allclose(slot_widths(), GEAR["W"], rtol=0, atol=1e-9)


def test_gear_seated_discs():
    # The file's values come from sampled points, and so lie above the least one by up to 0.0004.
    np.testing.assert_allclose(seated_discs(), GEAR["rr"], rtol=0, atol=2e-3)
    assert (seated_discs() < np.array(GEAR["rr"])).all()


def test_gear_area_length_and_fillet():
    outline = outline_of(REFERENCE)
    assert outline.area == pytest.approx(GEAR["area"], abs=1e-3)
    ring = shapely.LinearRing(outline.outer.flatten(1e-6))
    assert ring.length == pytest.approx(GEAR["length"], abs=2e-3)
    assert fillet_radius() == pytest.approx(GEAR["filletmin"], abs=1e-4)
    # The closed form at the flattest place of the pitch curve, which no fillet quite reaches.
    rack, rho = TEETH.rack, TEETH.curve.greatest_radius
    closed = rack.tip_radius + rack.arc_depth**2 / (rho + rack.arc_depth)
    assert 0 <= fillet_radius() - closed < 1e-4


def test_gear_tips_and_margin():
    # Tip lands as arcs of the pitch curve, and the margin of the no-undercut rule.
    first, last = TEETH.tip_lands
    arcs = TEETH.curve.arc(last) - TEETH.curve.arc(first)
    assert (arcs.min(), arcs.max()) == pytest.approx((1.414, 1.469), abs=6e-4)
    assert 1 - 2.0 / (TEETH.curve.least_radius * math.sin(math.radians(20)) ** 2) == pytest.approx(
        0.4997, abs=1e-4
    )
    loop, deviation = gear_loop(TEETH)
    assert deviation < 1e-4
    assert len(loop.segments) == 6 * 39

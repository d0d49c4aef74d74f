"""Every number of the checked reference, computed by the family."""

import json
import math
import re
from pathlib import Path

import geneva_printed as printed
import geneva_undercut as undercut
import numpy as np
import pytest
import shapely
from geneva_slots import valid_slots

from mechwright.mechanics.laws import LAWS
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.contact_forces import contact, loads
from mechwright_geneva.kinematics.figures import straight_peaks
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Frame, stroke
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES, measure
from mechwright_geneva.kinematics.straight_slot import StraightSlot
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.locking_disc import lock_loop
from mechwright_geneva.parts.parts import Wheel
from mechwright_geneva.parts.slot_outline import Slot

FACTS = json.loads((Path(__file__).parents[1] / "data" / "geneva.json").read_text(encoding="utf-8"))["facts"]
NAMES = {
    "cycloidal": "cycloidal",
    "simple_harmonic": "simple-harmonic",
    "poly345": "3-4-5",
    "poly4567": "4-5-6-7",
    "modified_sine": "modified-sine",
    "modified_trapezoid": "modified-trapezoid",
}

BARE = {
    "roller_radius": 5,
    "groove_clearance": 0,
    "bore": 0,
    "driver_bore": 0,
    "least_wall": 0.2,
    "fixing": 0,
}
"""The facts know no clearance of the groove."""
REFERENCE = GenevaParams(**BARE, crank_half_angle=50, offset_angle=5, lock_radius=70, thickness=13.5)
FIGURE_6 = Frame.of(math.pi / 4, math.radians(60), 0.0, 100.0)


def proto(slots, half, offset=12.0):
    return mechanism_of(
        GenevaParams(**BARE, slots=slots, crank_half_angle=half, offset_angle=offset, entry_radius=70)
    )


def pair(z):
    return [float(z.real), float(z.imag)]


def limit(frame, law, radius):
    """Smaller of both critical radii."""
    one = Frame(*(np.array([[float(v)]]) for v in (frame.wheel_half, frame.crank_half, frame.offset, 100.0)))
    found = measure(one, law, np.array([[radius]]), FINE_SAMPLES)
    return min(found.island_limit.item(), found.hub_limit.item())


def law_facts(name):
    what, law = re.fullmatch(r"law_(\w+?(?:_at_0\.2)?)__(\w+)", name).groups()
    law = LAWS[NAMES[law]]()
    if what == "s_at_0.2":
        return float(law.at(0.2).s)
    return getattr(law.peaks, {"Cv": "v", "Ca": "a", "Cj": "j"}[what])


def document_facts(name):
    law = LAWS["3-4-5"]()
    if name in ("doc_a", "doc_b"):
        return float(FIGURE_6.axes if name == "doc_a" else FIGURE_6.crank)
    angle, point = printed.loop(FIGURE_6, law, 4.0, printed=True)
    if name == "doc_bug_max_wall_error_0_40deg_mm":
        u = np.linspace(0, 1 / 3, 4001)
        wrong = printed.wall(FIGURE_6, law, u, 4.0, RIGHT)
        return float(np.abs(wrong - stroke(FIGURE_6, law, u).wall(4.0, RIGHT)).max())
    if name == "doc_printed_point_distance_to_true_centreline_mm":
        return float(np.abs(stroke(FIGURE_6, law, np.linspace(0, 1, 40_001)).track - point).min())
    return {
        "doc_printed_theta_d1_deg": math.degrees(angle),
        "doc_printed_theta_d2_deg": 120 - math.degrees(angle),
        "doc_printed_x": point.real,
        "doc_printed_y": point.imag,
    }[name]


def loop_facts(name):
    what, law = name.split("__")
    law = LAWS[NAMES[law]]()
    if what == "Mcrit_inner":
        return limit(FIGURE_6, law, 4.0) / float(FIGURE_6.crank)
    angle, point = printed.loop(FIGURE_6, law, 4.0, printed=False)
    assert point.imag == pytest.approx(-point.real, abs=1e-9)
    return math.degrees(angle) if "theta_d1" in what else point.real


def row_facts(name):
    what, row = re.fullmatch(r"ref_(theta_w_deg|centre|outer_wall|inner_wall)_(\d)", name).groups()
    run = mechanism_of(REFERENCE).stroke(np.array(int(row) / 8))
    if what == "theta_w_deg":
        return math.degrees(float(run.theta))
    z = {
        "centre": lambda: run.track,
        "outer_wall": lambda: run.wall(5, LEFT),
        "inner_wall": lambda: run.wall(5, RIGHT),
    }
    return pair(z[what]())


def island_area():
    m = mechanism_of(REFERENCE)
    return Wheel(m).island()[0].area


def steep(degrees):
    m = mechanism_of(REFERENCE)
    angle = contact(m, m.stroke(np.linspace(0, 1, 100_001))).pressure_angle
    return 100 * float(np.mean(angle > math.radians(degrees)))


def least_offset_without_undercut():
    law = LAWS["cycloidal"]()
    low, high = 0.0, 5.0
    for _ in range(50):
        middle = (low + high) / 2
        frame = Frame.of(math.pi / 4, math.radians(50), math.radians(middle), 100.0)
        low, high = (low, middle) if limit(frame, law, 5.0) > 5 else (middle, high)
    return high


def relief_circle():
    """The least circle about a point a on the crank line that takes in all of the exact relief."""
    m = mechanism_of(REFERENCE)
    points = lock_loop(m)[0].flatten(1e-4) @ np.array([1, 1j])
    relief = points[np.abs(np.angle(points)) < m.crank_half - 1e-9]
    return float(np.abs(relief - m.axes).max())


REF = {
    "a": lambda m: m.axes,
    "b": lambda m: m.crank,
    "N": lambda m: m.axes / m.crank,
    "M": lambda m: m.roller / m.crank,
    "slot_bottom_radius_a_minus_b": lambda m: m.bottom,
    "peak_velocity_ratio": lambda m: m.law.peaks.v * 0.9,
    "peak_accel_ratio": lambda m: m.law.peaks.a * (math.pi / 2) / math.radians(100) ** 2,
    "peak_jerk_ratio": lambda m: m.law.peaks.j * (math.pi / 2) / math.radians(100) ** 3,
    "Mcrit_inner": lambda m: m.measures.island_limit.item() / m.crank,
    "Mcrit_outer": lambda m: m.measured(m.measures.hub_limit).hub_limit.item() / m.crank,
    "r_undercut_limit_mm": lambda m: m.measures.island_limit.item(),
    "Fmin_inner": lambda m: undercut.singularity(m.stroke(np.linspace(0, 1, 2001)), 5, RIGHT).min(),
    "Fmin_outer": lambda m: undercut.singularity(m.stroke(np.linspace(0, 1, 2001)), 5, LEFT).min(),
    "F_at_0_inner": lambda m: undercut.singularity(m.stroke(np.array(0.0)), 5, RIGHT),
    "F_at_0_outer": lambda m: undercut.singularity(m.stroke(np.array(0.0)), 5, LEFT),
    "F_at_mid_inner": lambda m: undercut.singularity(m.stroke(np.array(0.5)), 5, RIGHT),
    "F_at_mid_outer": lambda m: undercut.singularity(m.stroke(np.array(0.5)), 5, LEFT),
    "loop": lambda m: bool(m.measures.width.item() <= 0),
    "loop_at_r_6.42": lambda m: bool(m.measured(6.42).width.item() <= 0),
    "island_neck_half_width_mm": lambda m: (
        -float((m.stroke(np.linspace(0, 0.4, 4001)).wall(5, RIGHT) * np.exp(1j * m.wheel_half)).imag.max())
    ),
    "island_half_width_at_mouth_mm": lambda m: m.measures.mouth.item(),
    "theta_off_min_no_undercut_deg": lambda m: least_offset_without_undercut(),
    "theta_off_min_mouth_rule_deg": lambda m: math.degrees(math.asin(0.05 * math.sin(math.radians(95)))),
    "min_concave_wall_radius_mm": lambda m: m.measures.island_limit.item() + 5,
    "min_convex_island_radius_mm": lambda m: m.measures.island_limit.item() - 5,
    "max_end_mill_diameter_mm": lambda m: 2 * m.groove,
    "web_between_slots_mm": lambda m: m.measures.web.item(),
    "min_slot_distance_from_O1_mm": lambda m: m.nearest,
    "horn_web_mm": lambda m: m.nearest - m.groove - m.arc,
    "lock_arc_rim_polar_deg": lambda m: math.degrees(m.horn_angle),
    "locking_arc_angle_deg": lambda m: math.degrees(lock_loop(m)[0].segments[-1].sweep),
    "relief_radius_safe_mm": lambda m: m.axes - m.rim - m.params.lock_clearance,
    "lead_in_crank_angle_deg": lambda m: (
        math.degrees(math.acos((m.axes**2 + m.crank**2 - 105**2) / (2 * m.axes * m.crank))) - 50
    ),
    "relief_circle_min_radius_mm": lambda m: relief_circle(),
    "sweep_min_outside_relief_mm": lambda m: m.arc,
    "through_cut_components": lambda m: pieces(m),
    "island_area_mm2": lambda m: island_area(),
    "pressure_angle_entry_deg": lambda m: math.degrees(
        contact(m, m.stroke(np.array([0.0]))).pressure_angle[0]
    ),
    "pressure_angle_quarter_deg": lambda m: math.degrees(
        contact(m, m.stroke(np.array([0.25]))).pressure_angle[0]
    ),
    "pressure_angle_mid_deg": lambda m: math.degrees(contact(m, m.stroke(np.array([0.5]))).pressure_angle[0]),
    "crank_range_with_pressure_angle_over_30_deg": lambda m: steep(30),
    "crank_range_with_pressure_angle_over_45_deg": lambda m: steep(45),
    "crank_range_with_pressure_angle_over_60_deg": lambda m: steep(60),
    "contact_force_max_N": lambda m: loads(m).force,
    "hertz_max_MPa": lambda m: loads(m).pressure,
    "contact_force_mid_limit_N": lambda m: contact(m, m.stroke(np.array([0.5]))).force[0],
    "contact_on_inner_wall_always": lambda m: bool(
        (contact(m, m.stroke(np.linspace(0.001, 0.999, 999))).wall == RIGHT).all()
    ),
    "crank_torque_max_Nm": lambda m: loads(m).crank_torque,
    "wall_min_distance_to_centreline_0": lambda m: to_way(m, LEFT),
    "wall_min_distance_to_centreline_1": lambda m: to_way(m, RIGHT),
}


def to_way(m, side):
    way = m.stroke(np.linspace(0, 1, 4001)).track
    line = shapely.LineString(np.column_stack((way.real, way.imag)))
    wall = m.stroke(np.linspace(0, 1, 401)).wall(5, side)
    return float(shapely.distance(line, shapely.points(wall.real, wall.imag)).min())


def pieces(m):
    """How many pieces stay when the slots are cut through."""
    disc = shapely.Polygon(Wheel(m).disc().flatten())
    for k in range(4):
        disc = disc.difference(shapely.Polygon(Slot(m).loop()[0].moved(0, 0, k * math.pi / 2).flatten()))
    return len(disc.geoms)


def straight_facts(name):
    if name == "straight_slot_wall_distance_from_axis_mm":
        m = mechanism_of(GenevaParams(**BARE, law="straight"))
        u = np.concatenate((np.linspace(0, 0.49, 50), np.linspace(0.51, 1, 50)))
        walls = [m.stroke(u).wall(5, side) * np.exp(1j * m.wheel_half) for side in (LEFT, RIGHT)]
        distances = np.abs(np.concatenate(walls).imag)
        assert np.ptp(distances) < 1e-9
        return float(distances.mean())
    what, n = re.fullmatch(r"straight_(\w+)_n(\d+)", name).groups()
    n = int(n)
    peaks, m = straight_peaks(n), mechanism_of(GenevaParams(slots=n, law="straight"))
    law = StraightSlot(n)
    return {
        "a_over_l": lambda: m.axes / m.rim,
        "b_over_l": lambda: m.crank / m.rim,
        "peak_velocity": lambda: peaks.v,
        "peak_accel": lambda: peaks.a,
        "entry_accel": lambda: law.jumps[0] * law.wheel_half_angle / (2 * law.crank_half_angle**2),
        "mid_jerk": lambda: peaks.j,
    }[what]()


def curved_facts(name):
    what, law = re.fullmatch(r"curved_n4_td0_45_(vel|acc|jerk)_(\w+)", name).groups()
    peaks, k = LAWS[NAMES[law]]().peaks, {"vel": 1, "acc": 2, "jerk": 3}[what]
    return (peaks.v, peaks.a, peaks.j)[k - 1] / (math.pi / 2) ** (k - 1)


def prototype_facts(name):
    if name == "proto_n4_60_infeasible_a_minus_b":
        return proto(4, 60).bottom
    negative = re.fullmatch(r"proto_neg_(\w+)_n(\d)", name)
    if negative:
        what, n = negative.groups()
        m = proto(int(n), 90 - 180 / int(n), -12.0)
        assert m.side == 1
    else:
        what, n, half = re.fullmatch(r"proto_(\w+?)_n(\d)_([\d.]+)", name).groups()
        m = proto(int(n), float(half))
        assert m.side == -1
    u = np.linspace(0.01, 0.49, 99)
    return {
        "a": lambda: m.axes,
        "b": lambda: m.crank,
        "web": lambda: m.measures.web.item(),
        "loop": lambda: bool(m.measures.width.item() <= 0),
        "r_undercut": lambda: m.measures.island_limit.item(),
        "r_crit": lambda: m.measures.island_limit.item(),
        "clean": lambda: valid_slots(
            "cycloidal", m.slots, math.degrees(m.crank_half), math.degrees(m.frame.offset), 70.0, 5.0
        ).item(),
        "inertia_on_branch_alpha_plus_pi": lambda: bool((contact(m, m.stroke(u)).wall == RIGHT).all()),
    }[what]()


def least_offset_figure_6(fact):
    """The numeric least offset angle: neither mouth nor loop nor undercut."""
    law, low, high = LAWS["cycloidal"](), 0.0, math.radians(5)
    for _ in range(60):
        middle = (low + high) / 2
        frame = Frame(*(np.array([[v]]) for v in (math.pi / 4, math.radians(60), middle, 100.0)))
        found = measure(frame, law, np.array([[4.0]]), FINE_SAMPLES)
        good = found.mouth > 0 and found.width > 0 and found.island_limit > 4
        low, high = (low, middle) if good else (middle, high)
    return math.degrees(high)


def computed(fact):
    name = fact["name"]
    if name.startswith("law_"):
        return law_facts(name)
    if name.startswith("doc_"):
        return document_facts(name)
    if name.startswith(("loop_true", "Mcrit_inner__")):
        return loop_facts(name)
    if name.startswith("straight_"):
        return straight_facts(name)
    if name.startswith("curved_"):
        return curved_facts(name)
    if name.startswith("proto_"):
        return prototype_facts(name)
    if re.fullmatch(r"ref_(theta_w_deg|centre|outer_wall|inner_wall)_\d", name):
        return row_facts(name)
    if name == "Mcrit_mid_closed_form":
        return float(undercut.critical_at_middle(mechanism_of(REFERENCE).frame, 1.8))
    if name == "printed_F_at_mid_inner_WRONG":
        return float(printed.singularity(mechanism_of(REFERENCE).stroke(np.array(0.5)), 5.0, RIGHT))
    if name == "theta_off_min_entry_rule_deg":
        return math.degrees(math.asin(0.04 * math.sin(math.radians(105))))
    if name == "theta_off_min_numeric_deg":
        return least_offset_figure_6(fact)
    return REF[name.removeprefix("ref_")](mechanism_of(REFERENCE))


def test_the_reference_is_all_there():
    assert len(FACTS) == 269


@pytest.mark.parametrize("fact", FACTS, ids=[fact["name"] for fact in FACTS])
def test_fact(fact):
    found, expected = computed(fact), fact["expected"]
    if isinstance(expected, bool):
        assert found is expected
        return
    assert np.asarray(found, dtype=float) == pytest.approx(expected, abs=max(fact["tolerance"], 1e-12), rel=0)


def test_the_printed_loop_point_is_not_on_the_wall():
    """The source prints 11.7177, 108.2823 and (57.9668, -57.9668): wrong law and a missing factor of the chain
    rule. Each repaired alone still gives another point, and the printed one lies inside the roller's way."""
    shown = [
        printed.loop(FIGURE_6, LAWS[law](), 4.0, printed=wrong)
        for law in ("3-4-5", "cycloidal")
        for wrong in (True, False)
    ]
    angles = [math.degrees(angle) for angle, _ in shown]
    assert angles[0] == pytest.approx(11.7177, abs=5e-5)
    assert shown[0][1] == pytest.approx(57.9668 - 57.9668j, abs=1e-4)
    assert all(abs(angle - 11.7177) > 0.1 for angle in angles[1:])
    assert angles[3] == pytest.approx(13.552958847, abs=1e-8)


def test_alpha_is_the_angle_of_equation_3():
    """Equation (2) with atan2 of equation (3) gives the walls that the complex numbers give."""
    for law in LAWS.values():
        for half, offset in ((50, 5), (45, -12), (65, 3)):
            frame = Frame.of(math.pi / 4, math.radians(half), math.radians(offset), 100.0)
            run = stroke(frame, law(), np.linspace(0, 1, 101))
            for side, more in ((LEFT, 0.0), (RIGHT, math.pi)):
                turn = run.phi + undercut.alpha(run) + more
                point = (
                    frame.axes - frame.crank * np.exp(1j * run.phi) - 5 * np.exp(1j * turn)
                ) * run.to_wheel
                assert np.abs(point - run.wall(5, side)).max() < 1e-9

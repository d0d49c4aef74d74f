"""Every number of the reference: centre distances, pitch curves, teeth, sensitivities, verdicts."""

import math
import re

import numpy as np
import pytest
from noncircular import REFERENCE, TABLES, design

from mechwright import Stage
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing import Rolling
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import extremes_of, law_of
from mechwright_noncircular_gears.table import table_of

FACTS = {
    name: {
        fact["name"].removeprefix("chain.").split(".", 1)[1]: fact
        for fact in REFERENCE["facts"]
        if fact["design"] == name
    }
    for name in TABLES
}
MICRO = 1e6


def value(name, key):
    """A figure of the reference by what the family computes."""
    params = design(name)
    pair, law, teeth = table_of(params).pair, law_of(params), table_of(params).teeth
    a, found = pair.distance, extremes_of(params)
    if "@" in key:
        what, at = key.split("@")
        phi = np.array(float(at))
        now = Rolling.of(law, phi, params.side)
        return {
            "i": lambda: law.rates(phi)[0],
            "psi": lambda: law.angle(phi),
            "r1": lambda: a * now.r1,
            "r2": lambda: a * now.r2,
            "kappa1": lambda: now.curvature1 / a,
            "kappa2": lambda: now.curvature2 / a,
            "s": lambda: -pair.driver.arc(-phi),
            "nu_deg": lambda: np.degrees(np.arctan(now.r1_rate / now.r1)),
            "crank": lambda: law._crank(phi),
        }[what]()
    if key.startswith(("tooth", "flank")):
        return place(key, teeth, params.side)
    if key.startswith("lamina"):
        return lamina(key, pair)
    if re.fullmatch(r"c\d", key):
        return returned(law)[int(key[1])]
    gear = int(key[-1]) - 1 if key[-1] in "12" else 0
    simple = {
        "a": lambda: a,
        "m": lambda: table_of(params).rack.module,
        "p": lambda: table_of(params).rack.pitch,
        "L1": lambda: pair.driver.perimeter,
        "L2": lambda: pair.driven.perimeter,
        "z1": lambda: params.teeth,
        "z2": lambda: params.mate_teeth,
        "i_min": lambda: found.slowest.value,
        "i_max": lambda: found.fastest.value,
        "nu_max_deg": lambda: math.degrees(found.steepest.value),
        "pressure_max_deg": lambda: math.degrees(found.steepest.value) + params.pressure_angle,
        "a_kappa1_min": lambda: found.curvatures[0].value,
        "a_kappa2_min": lambda: found.curvatures[1].value,
        "V_over_R": lambda: law.speed,
        "i_end": lambda: law.rates(np.array(law.width / 2))[0],
        "di_end": lambda: law.rates(np.array(law.width / 2))[1],
        "d2i_end": lambda: law.rates(np.array(law.width / 2))[2],
        "i_dwell": lambda: law.beyond,
        "wheel_peak_Ca": lambda: law.constant,
        "tip_cusp_margin": lambda: min(1.0, teeth[gear].least_tip_regularity.min()),
        "undercut_margin": lambda: teeth[gear].least_regularity.min(),
        "eta_root": lambda: teeth[gear].rack.straight_depth,
        "eta_tip_max": lambda: teeth[gear].tip_height,
        "tip_chord_min": lambda: chords(teeth[gear]).min(),
        "tip_chord_max": lambda: chords(teeth[gear]).max(),
        "te_per_um_centre_max_urad": lambda: centre(params)[0],
        "play_per_um_centre_max_urad": lambda: centre(params)[1],
        "te_per_um_wall_max_urad": lambda: centre(params)[2],
    }
    if key in {f"kappa{n}_{end}" for n in "12" for end in ("min", "max")}:
        both = found.curvatures if key.endswith("min") else found.sharpest
        return both[int(key[5]) - 1].value / a
    if key in simple:
        return simple[key]()
    return simple[key[:-1]]()


def returned(law):
    """Coefficients of the slider's return over the angle past the stroke's end, from its values."""
    past = np.linspace(0.0, math.tau - law.width, 7)
    return np.linalg.solve(np.vander(past, increasing=True), law.rates(law.width / 2 + past)[0])


def centre(params):
    """The greatest error and play by the centre distance, and error by a wall, µrad for a micrometre."""
    pair, law = table_of(params).pair, law_of(params)
    phi = np.linspace(0, law.period, 7201)
    alpha, r2 = math.radians(params.pressure_angle), pair.pitch_radii(phi)[1]
    i, first, _ = law.rates(phi)
    nu = np.arctan2(first, i * (1 + params.side * i))
    one, two = np.tan(alpha + nu) / r2, np.tan(alpha - nu) / r2
    walls = 1 / (r2 * np.cos(alpha + np.abs(nu)))
    return max(np.abs(one).max(), np.abs(two).max()) * 1e3, (one + two).max() * 1e3, walls.max() * 1e3


def place(key, teeth, side):
    """A tooth's centre, or a flank's point; arcs of driver and ring are counted against the contact's way."""
    kind, which, axis = key.split(".")
    one = teeth[int(kind[-1]) - 1]
    sense = -1 if kind[-1] == "1" else side
    p, rack = one.rack.pitch, one.rack
    if kind.startswith("tooth"):
        shift = 0.0 if kind[-1] == "1" else 0.5
        point = one.curve.frame_at(np.array(sense * (int(which) + shift) * p)).point
    else:
        side = int(which)
        crossing = sense * ((p / 2 if kind[-1] == "1" else p) + side * rack.half_space)
        frame = one.curve.frame_at(np.array(crossing + sense * side * 1.0))
        point = rack.flank(frame, np.array(crossing), np.array(float(sense * side)))
    return point["xy".index(axis)]


def lamina(key, pair):
    """Area, distance of the middle, and polar moment of the disc within a pitch curve."""
    curve = (pair.driver, pair.driven)[int(key[-1]) - 1]
    # The trapezoid rule, over the curve's own parameter.
    t = np.linspace(0, math.tau, 8001)[:-1]
    frame = curve.frame(t)
    x, y = frame.point.T
    rate = frame.tangent[:, 1] * x - frame.tangent[:, 0] * y  # r² dθ/ds
    step = curve.arc_rate(t) * math.tau / t.size
    r2 = x * x + y * y
    area = float((rate * step).sum()) / 2
    if key.startswith("lamina_area"):
        return area
    if key.startswith("lamina_J"):
        return float((rate * r2 * step).sum()) / 4
    return abs(complex((rate * x * step).sum(), (rate * y * step).sum())) / 3 / area


def chords(one):
    first, last = (one.curve.frame(t).offset(one.rack.addendum) for t in one.tip_lands)
    return np.linalg.norm(last - first, axis=1)


@pytest.mark.parametrize("name", TABLES)
def test_every_number(name):
    missed = []
    for key, fact in FACTS[name].items():
        got = value(name, key)
        if not abs(float(got) - fact["expected"]) <= fact["tolerance"]:
            missed.append((key, float(got), fact["expected"]))
    assert not missed


@pytest.mark.parametrize(
    ("name", "code"),
    [(name, "") for name in ("D1", "D2", "D3", "D4", "D5", "D6", "D7", "D8", "SL")]
    + [("D9", "gear.undercut"), ("D10", "gear.convexity")],
)
def test_the_verdict(name, code):
    params = design(name, backlash=None, **({"cutter": "rack"} if name == "D10" else {}))
    found = errors(NoncircularGears().check(params), Stage.MACHINING)
    assert [one.code for one in found] == ([code] if code else [])


def test_a_rack_refuses_what_a_shaper_cuts():
    found = errors(NoncircularGears().check(design("D8", cutter="rack")))
    assert [one.code for one in found] == ["gear.convexity"]
    assert found[0].proposed[0] == {"parameters.cutter": "shaper"}

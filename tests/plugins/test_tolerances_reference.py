"""Tolerances of every family against numbers that were worked out without this program."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from mechwright import Tolerances
from mechwright.contracts.tolerance_settings import OwnTolerance, ToleranceSettings
from mechwright.contracts.tolerances import CUT_VARIANCE
from mechwright.mechanics.tolerance import analyse
from mechwright.mechanics.tolerance.places import place_at
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams
from mechwright_geneva.as_made.play import Play, drawn_room
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.parameters import GenevaParams
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_spherical.family import Spherical
from mechwright_spherical.parameters import SphericalParams

DATA = json.loads((Path(__file__).parents[1] / "data" / "as-made.json").read_text(encoding="utf-8"))["facts"]

F1 = {
    "crank": 29.9864888895368,
    "coupler": 79.98996674541814,
    "follower": 69.99688382152353,
    "ground": 89.99472798474908,
}
F2 = {"crank": 25.0, "coupler": 60.0, "follower": 50.0, "ground": 70.0}
S1 = {"crank": 51.23710482942299, "rod": 113.28305527097054, "offset": 50.0}
S2 = {"crank": 50.0, "rod": 150.0, "offset": 0.0}
H1 = {"ground": 80.0, "input": 30.0, "coupler": 70.0, "output": 60.0}
H2 = {"ground": 90.0, "input": 25.0, "coupler": 80.0, "output": 75.0}
G1 = {
    "slots": 4,
    "law": "cycloidal",
    "entry_radius": 100,
    "crank_half_angle": 50,
    "offset_angle": 5,
    "roller_radius": 5,
    "lock_radius": 70,
}
G2 = {"slots": 6, "law": "straight", "entry_radius": 80, "roller_radius": 4, "lock_radius": 30}
DESIGNS = {"F1": F1, "F2": F2, "S1": S1, "S2": S2, "H1": H1, "H2": H2, "G1": G1, "G2": G2}
REFERENCE = ToleranceSettings(length=0.02, clearance=0.02)
"""Links ±20 µm, pins 10 µm of radial clearance each."""
ARCS = ToleranceSettings(angle=0.02, clearance=0.02)
"""Arcs ±0.02°, pins the same."""


def facts(*names):
    found = [fact for fact in DATA if fact["name"] in names]
    assert {fact["name"] for fact in found} == set(names)
    return found


def close(fact, value):
    assert value == pytest.approx(fact["expected"], abs=fact["tolerance"], rel=0), fact


def four_bar(sizes, settings=REFERENCE):
    return FourBars().tolerances(FourBarParams(**sizes, pin_diameter=8), Tolerances(settings))


def slider(sizes, settings=REFERENCE):
    tolerances = Tolerances(settings, {"guide": OwnTolerance(lower=0, upper=0)})
    return SliderCrankFamily().tolerances(SliderCrankParams(**sizes), tolerances)


def spherical(arcs, settings=ARCS):
    params = SphericalParams(kind="four-bar", radius=60, four_bar=arcs)
    return Spherical().tolerances(params, Tolerances(settings))


def rate(model, output, name, theta):
    number = [one.name for one in model.contributors].index(name)
    return float(model.sensitivities(output, np.array(theta))[number][0, 0])


@pytest.mark.parametrize("link", ["crank", "coupler", "follower", "ground"])
def test_follower_angle_by_links(link):
    for fact in facts(f"four-bar.dpsi_d{link}"):
        sizes = {key: fact["inputs"][key] for key in F1}
        close(fact, rate(four_bar(sizes), "follower angle", link, fact["inputs"]["theta"]))


@pytest.mark.parametrize("link", ["crank", "rod", "offset"])
def test_slider_by_links(link):
    for fact in facts(f"slider-crank.dx_d{link}"):
        sizes = {key: fact["inputs"][key] for key in S1}
        close(fact, rate(slider(sizes), "slider position", link, fact["inputs"]["theta"]))


@pytest.mark.parametrize("link", ["ground", "input", "coupler", "output"])
def test_output_angle_by_arcs(link):
    for fact in facts(f"spherical.dpsi_d{link}"):
        arcs = {key: round(fact["inputs"][f"{key}_deg"], 9) for key in H1}
        close(fact, rate(spherical(arcs), "output angle", link, fact["inputs"]["theta"]))


@pytest.mark.parametrize(
    ("name", "model", "settings"),
    [
        ("four-bar.worst_case", four_bar, REFERENCE),
        ("four-bar.pins_only", four_bar, ToleranceSettings(length=0.0, clearance=0.02)),
        ("slider-crank.worst_case", slider, REFERENCE),
        ("spherical.worst_case", spherical, ARCS),
    ],
)
def test_worst_cases(name, model, settings):
    for fact in facts(name):
        quick = settings.model_copy(update={"samples": 100})
        built = model(DESIGNS[fact["inputs"]["design"]], quick)
        result = analyse(built, Tolerances(quick)).results[0]
        close(fact, result.worst.high)
        assert result.worst.low == pytest.approx(-result.worst.high)


def test_pins_in_random_directions():
    for fact in facts("four-bar.pins_sigma_random_direction"):
        settings = ToleranceSettings(length=0.0, clearance=0.02)
        model = four_bar(DESIGNS[fact["inputs"]["design"]], settings)
        close(fact, place_at(model, model.outputs[0], fact["inputs"]["theta"]).sigma)


def test_a_million_mechanisms():
    """Lengths ±20 µm, pins 8H7/g6 in any direction, at 1 rad, an error of 0.4 mrad allowed."""
    settings = ToleranceSettings(
        length=0.02, fit="H7/g6", at=(math.degrees(1.0),), limit_angle=math.degrees(4e-4), samples=1_000_000
    )
    result = analyse(four_bar(F1, settings), Tolerances(settings)).results[0]
    (place,), (trial,) = result.places, result.trials
    (first,) = facts("mc.sigma_first_order")
    close(first, place.sigma)
    (sampled,) = facts("mc.sigma_sampled")
    close(sampled, trial.sigma)
    (kept,) = facts("mc.yield")
    close(kept, trial.kept.value)
    (worst,) = facts("mc.worst_case")
    close(worst, place.high)
    for name, share in zip(("crank", "coupler", "follower", "ground"), place.shares, strict=False):
        (fact,) = facts(f"mc.share.{name}")
        close(fact, share)
    (pin,) = facts("mc.share.one_pin")
    for share in place.shares[4:]:
        close(pin, share)
    assert trial.greatest < place.high
    assert sum(place.shares) == pytest.approx(1, abs=1e-12)
    (factor,) = facts("mc.truncated_variance_factor")
    close(factor, CUT_VARIANCE)


def gears(inputs):
    params = EllipticGearParams(
        eccentricity=inputs["e"],
        teeth=inputs["teeth"],
        semi_major=inputs["semi_major"],
        backlash=inputs["backlash"],
    )
    exact = {
        "wall-2": inputs["left_per_wall"],
        "wall-4": inputs["left_per_wall"],
        "centre-2-4": inputs["centre_error"],
    }
    own = {name: OwnTolerance(lower=value, upper=value) for name, value in exact.items()}
    return EllipticGears().tolerances(params, Tolerances(ToleranceSettings(eccentricity=0.0), own))


def test_play_and_transmission_error_of_gears():
    for fact in facts("gear.play_total_min", "gear.play_total_max", "gear.te_one_flank"):
        model = gears(fact["inputs"])
        mean = [np.full((one.components, 1), one.mean) for one in model.contributors]
        at = model.positions

        def over(name, model=model, mean=mean, at=at):
            return (model.nominal(name, at) + model.errors(name, mean, at).reshape(1, -1))[0]

        found = {
            "gear.play_total_min": over("play").min(),
            "gear.play_total_max": over("play").max(),
            "gear.te_one_flank": np.ptp(over("transmission error")),
        }
        close(fact, found[fact["name"]])


def test_the_least_backlash_is_that_with_no_play_in_the_worst_case():
    for fact in facts("gear.least_backlash"):
        off, left = fact["inputs"]["centre_and_eccentricities"], fact["inputs"]["left_sum"]
        params = EllipticGearParams(eccentricity=fact["inputs"]["e"], backlash=fact["expected"])
        settings = ToleranceSettings(
            leftover=left / 2, gouge=0.0, centre=off / 2, eccentricity=off / 4, samples=100
        )
        model = EllipticGears().tolerances(params, Tolerances(settings))
        worst = analyse(model, Tolerances(settings)).results[0].worst
        # 1e-9 mm of backlash over a lever of 25 mm
        assert abs(worst.low) < 1e-9


@pytest.mark.parametrize("design", ["G1", "G2"])
def test_the_wheel_turns_as_far_as_the_tube_lets_it(design):
    wanted = [fact for fact in facts("geneva.play_total") if fact["inputs"]["design"] == design]
    at = np.radians([fact["inputs"]["theta_d_deg"] for fact in wanted])
    m = mechanism_of(GenevaParams(**DESIGNS[design]))
    there, back = Play.of(m.way(at), drawn_room(m, 0.025)).turns()
    for fact, play in zip(wanted, there + back, strict=True):
        close(fact, play)


def test_the_wheel_by_axes_and_crank():
    """β is measured against the wheel's turning."""
    model = Geneva().tolerances(GenevaParams(**G2), Tolerances())
    for name, key in (("geneva.straight.dbeta_da", "centre"), ("geneva.straight.dbeta_db", "crank")):
        for fact in facts(name):
            assert model.m.axes == pytest.approx(fact["inputs"]["a"])
            close(fact, -rate(model, "wheel angle", key, math.radians(fact["inputs"]["theta_d_deg"])))


def test_the_play_of_the_lock():
    for fact in facts("geneva.lock_play_half"):
        inputs = fact["inputs"]
        model = Geneva().tolerances(GenevaParams(**DESIGNS[inputs["design"]]), Tolerances())
        off = np.zeros(1)
        named = [np.zeros((one.components, 1)) for one in model.contributors]
        named[[one.name for one in model.contributors].index("centre")][0] = off + inputs.get(
            "centre_distance_error", 0.0
        )
        play = model.nominal("play in the lock", off) + model.errors("play in the lock", named, off)
        close(fact, float(play[0, 0]))

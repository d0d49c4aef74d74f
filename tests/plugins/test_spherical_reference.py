"""The reference numbers, each computed by the model: most of them were re-derived by other means as well."""

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path as File

import numpy as np
import pytest
from spherical_source import TABLE_3, TABLE_4, PlanarFiveBar, asymptote, peak

from mechwright.mechanics.planar import Turning
from mechwright_spherical.defaults import published_example
from mechwright_spherical.kinematics.drive import external, internal
from mechwright_spherical.kinematics.five_bar import on_circle, projected
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.jets import turning_about
from mechwright_spherical.kinematics.mobility import mobility
from mechwright_spherical.kinematics.projection import project, unproject
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.rules.links import clear_radius
from mechwright_spherical.synthesis.planar import CouplerPoses, arm_pins, crank_dyad, points, rocker_dyad
from mechwright_spherical.synthesis.refine import Fit, Freedom, Path, errors, refine
from mechwright_spherical.synthesis.structural import (
    PlanarDesign,
    best_centre,
    scaled_error,
    smallest_length,
)
from mechwright_spherical.synthesis.structural import errors as structural_errors

DATA = json.loads((File(__file__).parents[1] / "data" / "spherical.json").read_text(encoding="utf-8"))
FACTS = DATA["facts"]
NAMED = {fact["name"]: fact for fact in FACTS}

ANGLES, ANGLES_N = np.radians(published_example.ANGLES), np.radians(published_example.ANGLES_N)
TABLE_2 = np.array(published_example.TABLE_2)
PRINTED = PlanarDesign(published_example.PINS, published_example.RATIO, ANGLES, ANGLES_N, TABLE_2)


def planar_phases():
    pin = {name: complex(points(at)) for name, at in published_example.PINS.items()}
    p1 = complex(points(published_example.TABLE_2[0]))
    for a, c, angles in (("a1", "c1", ANGLES), ("a1n", "c1n", ANGLES_N)):
        five_bar = PlanarFiveBar(pin["a0"], pin[a], pin["b0"], pin["b1"], pin[c], p1, published_example.RATIO)
        yield five_bar.at(angles)


@cache
def planar():
    """Path points (7,) as complex numbers and coupler angles (7,)."""
    found = list(planar_phases())
    return np.concatenate([path for path, _ in found]), np.concatenate([turns for _, turns in found])


def poses():
    path, turns = planar()
    return CouplerPoses(path[:4], turns[:4], path[4:], turns[4:])


EXACT = replace(PRINTED, targets=planar()[0].view(float).reshape(-1, 2))
MECHANISM = projected(
    published_example.PINS, published_example.TABLE_2[0], published_example.LENGTH, published_example.RATIO
)
PATH = Path(ANGLES, ANGLES_N, project(TABLE_2, published_example.LENGTH).T)


@cache
def six():
    (fit,) = refine(MECHANISM, PATH, Freedom.SIX)
    return fit


def equalised_rocker():
    """R3 is the mean of both phases, R1 that of phase 1."""
    r1, r3 = MECHANISM.crank_arcs[0], (MECHANISM.rocker_arcs[0] + MECHANISM.rocker_arcs[1]) / 2
    return replace(
        MECHANISM,
        a1n=on_circle(MECHANISM.a0, MECHANISM.a1n, r1),
        c1=on_circle(MECHANISM.b1, MECHANISM.c1, r3),
        c1n=on_circle(MECHANISM.b1, MECHANISM.c1n, r3),
    )


def exact_member():
    pins = {
        name: np.array(NAMED[f"refine.V3.{name}"]["expected"])
        for name in ("a0", "b0", "b1", "a1", "a1n", "c1", "c1n")
    }
    return replace(MECHANISM, **pins)


def printed_matches():
    found = [
        project(TABLE_2, published_example.LENGTH),
        project(list(published_example.PINS.values()), published_example.LENGTH),
    ]
    wanted = [TABLE_3, [TABLE_4[name] for name in published_example.PINS]]
    return sum(int((np.round(f, 4) == np.array(w)).sum()) for f, w in zip(found, wanted, strict=True))


def printed_fit(radius_free):
    from scipy.optimize import least_squares

    flat = np.concatenate([TABLE_2, list(published_example.PINS.values())])
    wanted = np.concatenate([TABLE_3, [TABLE_4[name] for name in published_example.PINS]])

    def residuals(x):
        return (project(flat, x[0], x[1] if radius_free else 1.0) - wanted).ravel()

    return least_squares(
        residuals, [4.0, 1.1] if radius_free else [4.0], xtol=1e-15, ftol=1e-15, gtol=1e-15
    ).x


def length_between(one, two):
    return math.dist(published_example.PINS[one], published_example.PINS[two])


PLANAR_LENGTHS = {
    "R1_phase1": ("a0", "a1"),
    "R1_phase2": ("a0", "a1n"),
    "R3_phase1": ("b1", "c1"),
    "R3_phase2": ("b1", "c1n"),
    "R2_phase1": ("a1", "c1"),
    "R2_phase2": ("a1n", "c1n"),
}


def crank_angle(pin):
    x, y = np.subtract(published_example.PINS[pin], published_example.PINS["a0"])
    return math.degrees(math.atan2(y, x))


def planar_fact(name):
    kind, *rest = name.split(".")[1:]
    match kind:
        case "b1":
            return published_example.PINS["b1"]
        case "length":
            return length_between(*PLANAR_LENGTHS[rest[0]])
        case "theta1_deg" | "theta1n_deg":
            return crank_angle("a1" if kind == "theta1_deg" else "a1n")
        case "path":
            return planar()[0].view(float).reshape(-1, 2)[int(rest[0][-1]) - 1]
        case "coupler_rotation_deg":
            return math.degrees(planar()[1][int(rest[0][-1]) - 1])


def synthesis_fact(name):
    if "crank" in name:
        return crank_dyad(poses(), 0.0, 1.0, published_example.CRANK_GUESS, "five").unknowns
    b0, b1 = (complex(points(published_example.PINS[pin])) for pin in ("b0", "b1"))
    arms = [arm_pins(b0, b1, published_example.RATIO, angles) for angles in (ANGLES, ANGLES_N)]
    return rocker_dyad(poses(), *arms, published_example.DRIVEN_GUESS, "five").unknowns


def printed_fact(name):
    if "table2" in name:
        return planar()[0].view(float).reshape(-1, 2)[int(name[-1]) - 1]
    return synthesis_fact(name)


def project_fact(name, inputs):
    if name == "project.inverse":
        return unproject(inputs["sphere_point"], inputs["d"])
    return project(inputs["point"], inputs["d"], inputs["r"], side=inputs["sigma"])


def sph5_fact(name, inputs):
    kind, rest = name.split(".")[1:]
    if kind == "arc_deg":
        one, two = (getattr(MECHANISM, pin) for pin in rest.split("-"))
        return math.degrees(float(arc(one, two)))
    if kind == "maxSerrTimesD":
        return float(scaled_error(PRINTED, inputs["d"]))
    place = int(rest[-1]) - 1
    if kind == "path":
        return MECHANISM.path(ANGLES, ANGLES_N)[:, place]
    return float(structural_errors(PRINTED, inputs["d"])[place])


def refine_fact(name):
    kind = name.removeprefix("refine.")
    match kind.split("."):
        case "V0", "rms":
            mechanism = equalised_rocker()
            return Fit(mechanism, errors(mechanism, PATH)).rms
        case "V1", "rms":
            return six().rms
        case "V1", "max":
            return float(six().errors.max())
        case "V1", pin:
            return getattr(six().mechanism, pin)
        case "V3", "max_error":
            return float(errors(exact_member(), PATH).max())
        case "V3", pin:
            return getattr(exact_member(), pin)
        case "gain", "V1":
            return float(errors(MECHANISM, PATH).max()) / float(six().errors.max())


def length_fact(name, inputs):
    _, which, *_ = name.split(".")
    return smallest_length(PRINTED, inputs["SerrTimesD"], 7 if which == "pos7" else None)


def four_bar(inputs):
    arcs = inputs["arcs_deg"]
    return FourBar(
        *(math.radians(arcs[name]) for name in ("ground", "input", "coupler", "output")),
        inputs["sigma"],
        math.radians(inputs["kappa_deg"]),
        math.radians(inputs["eta_deg"]),
    )


def four_bar_fact(name, inputs):
    linkage = four_bar(inputs)
    if name.startswith("fourbar.mu_m"):
        limits = sorted(linkage.at(Turning.of(np.array([0.0, math.pi])), 0).transmission.tolist())
        return math.degrees(limits[name == "fourbar.mu_max_deg"])
    theta = np.radians([inputs.get("theta_deg", 0.0)])
    if name == "fourbar.psi_limits_deg":
        return psi_limits(linkage)
    state = linkage.at(Turning.of(theta, 1.0))
    psi, spin = turning_about(linkage.output_axis, state.c), state.coupler_spin
    found = {
        "psi_deg": math.degrees(math.remainder(linkage.output_angle(theta)[0], math.tau)),
        "mu_deg": math.degrees(state.transmission[0]),
        "a": state.a[0][:, 0],
        "b": state.c[0][:, 0],
        "p": state.p[0][:, 0],
        "dpsi": psi.omega[0],
        "d2psi": psi.alpha[0],
        # ω3 = θ' o + ζ a, with θ' = 1 about o = z.
        "zeta": (spin[0][:, 0] - [0, 0, 1]) @ state.a[0][:, 0],
        "omega3": spin[0][:, 0],
        "alpha3": spin[1][:, 0],
        "vp": state.p[1][:, 0],
        "ap": state.p[2][:, 0],
    }
    return found[name.rsplit(".", 1)[1]]


def psi_limits(linkage):
    """Where ψ' vanishes, from a fine grid and two zooms."""
    found = []
    for extreme in (np.argmin, np.argmax):
        theta = np.linspace(0, math.tau, 2001)
        for _ in range(3):
            psi = linkage.output_angle(theta)
            at = int(extreme(psi))
            theta = np.linspace(theta[max(at - 1, 0)], theta[min(at + 1, 2000)], 2001)
        found.append(math.degrees(psi[at]) - 360)
    return found


def grashof_fact(inputs):
    found = mobility(*(math.radians(inputs[name]) for name in ("ground", "input", "coupler", "output")))
    return {
        "T": np.degrees(found.t).tolist(),
        "input_full": bool(found.input_full),
        "output_full": bool(found.output_full),
        "grashof": bool(found.grashof),
    }


def cad_fact(name, inputs):
    from mechwright_spherical.parts import solids

    def between(angle):
        return np.array([0.0, 0.0, 1.0]), np.array([math.sin(angle), 0.0, math.cos(angle)])

    match name.removeprefix("cad."):
        case "arc_body_volume":
            ends = between(math.radians(inputs["alpha_deg"]))
            return solids.arc_body(*ends, (inputs["Ri"], inputs["Ro"]), inputs["w"]).Volume()
        case "shell_strip_volume":
            delta, angle = inputs["half_width_angle_rad"], math.radians(inputs["alpha_deg"])
            span = (inputs["Ri"], inputs["Ro"])
            return solids.shell_strip(*between(angle), span, sum(span) * math.sin(delta)).Volume()
        case "link_volume":
            ends = between(math.radians(inputs["alpha_deg"]))
            span = (
                inputs["Ri"] - inputs["boss_extra_each_side"],
                inputs["Ro"] + inputs["boss_extra_each_side"],
            )
            bodies = [solids.arc_body(*ends, (inputs["Ri"], inputs["Ro"]), inputs["w"])]
            bodies += [solids.cylinder(end, span, inputs["Db"]) for end in ends]
            holes = [solids.cylinder(end, (span[0] - 1, span[1] + 1), inputs["Dp"]) for end in ends]
            return solids.fused(bodies, holes).Volume()
        case "slot_wedge_volume":
            axis, start = between(math.radians(inputs["R1_deg"]))
            return solids.wedge(
                axis, start, math.radians(inputs["sweep_deg"]), (inputs["r0"], inputs["r1"]), inputs["Dp"]
            ).Volume()
        case "slot_volume":
            given = NAMED["cad.slot_wedge_volume"]["inputs"]
            axis, start = between(math.radians(given["R1_deg"]))
            from mechwright_spherical.kinematics.vectors import rotate

            slot = solids.Slot(axis, start, rotate(axis, math.radians(given["sweep_deg"]), start))
            return solids.fused(slot.swept((given["r0"], given["r1"]), given["Dp"])).Volume()
        case "shaft_clear_radius":
            return clear_radius(inputs["D"], math.radians(inputs["alpha_deg"]))


def other_fact(name, inputs):
    match name:
        case "fig12.peak_d":
            return peak(PRINTED, 7)[0]
        case "fig12.peak_value":
            return peak(PRINTED, 7)[1]
        case "centre.d5.best":
            return best_centre(PRINTED, 5.0)[0]
        case "centre.d5.maxSerrTimesD":
            return 5.0 * float(structural_errors(PRINTED, 5.0, inputs["centre"]).max())
        case "gear.bevel_internal_pitch_cones_deg":
            return np.degrees(internal(math.radians(inputs["shaft_angle_deg"]), 1 / inputs["ratio"]))
        case "gear.bevel_external_pitch_cones_deg":
            return np.degrees(external(math.radians(inputs["shaft_angle_deg"]), 1 / inputs["ratio"]))
        case "slot.sweep_about_a0_deg":
            return math.degrees(MECHANISM.crank_setting)
        case "slot.sweep_about_b1_deg":
            return math.degrees(MECHANISM.rocker_setting)
        case "print.match_count":
            return printed_matches()
        case "print.d_least_squares":
            return printed_fit(False)[0]
        case "print.d_r_least_squares":
            return printed_fit(True)
        case "interference.input_output_min_separation_deg":
            return separation(four_bar(inputs))


def separation(linkage):
    from mechwright_spherical.kinematics.clearances import arcs_apart

    theta = np.radians(np.arange(360.0))
    state = linkage.at(Turning.of(theta), 0)
    o = np.broadcast_to(np.array([[0.0], [0.0], [1.0]]), state.a[0].shape)
    return math.degrees(arcs_apart((o, state.a[0]), (state.b[0], state.c[0])).min())


def found(fact):
    name, inputs = fact["name"], fact["inputs"]
    match name.split(".")[0]:
        case "planar":
            return planar_fact(name)
        case "synthesis":
            return synthesis_fact(name)
        case "printed":
            return printed_fact(name)
        case "project":
            return project_fact(name, inputs)
        case "sph5":
            return sph5_fact(name, inputs)
        case "refine":
            return refine_fact(name)
        case "d_for_tolerance":
            return length_fact(name, inputs)
        case "asymptotic":
            return float(asymptote(EXACT)[int(name[-1]) - 1])
        case "fourbar":
            return four_bar_fact(name, inputs)
        case "grashof":
            return grashof_fact(inputs)
        case "cad":
            return cad_fact(name, inputs)
        case "fig12" if "SerrTimesD" in name:
            return float(scaled_error(PRINTED, inputs["d"], 7))
    return other_fact(name, inputs)


def test_the_inputs_are_the_printed_ones():
    common = DATA["common"]
    assert common["planar"].keys() == published_example.PINS.keys()
    for name, at in common["planar"].items():
        assert published_example.PINS[name] == pytest.approx(at, abs=1e-15)
    assert tuple(common["p1"]) == published_example.TABLE_2[0]
    assert common["gear_ratio"] == published_example.RATIO
    assert tuple(common["dtheta_deg"].values()) == (*published_example.ANGLES, *published_example.ANGLES_N)
    assert len(FACTS) == 295


@pytest.mark.parametrize("fact", FACTS, ids=lambda fact: fact["name"])
def test_fact(fact):
    value, wanted, tolerance = found(fact), fact["expected"], fact["tolerance"]
    assert value is not None, "this fact is not looked at"
    if isinstance(wanted, dict):
        assert value["T"] == pytest.approx(wanted["T"], abs=tolerance)
        assert {key: value[key] for key in wanted if key != "T"} == {
            k: v for k, v in wanted.items() if k != "T"
        }
        return
    np.testing.assert_allclose(value, wanted, rtol=0, atol=tolerance)

"""Strength of the joints: pins, the plates beside their bores, and bushings, from forces over a period."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Stage, kept, of_stage
from mechwright.contracts.finding import Change
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE
from mechwright.mechanics.strength.judging import SLOWEST, Stress, Way, judged
from mechwright.mechanics.strength.pressure import most_pressed, too_pressed
from mechwright.mechanics.strength.turning_pair import (
    TurningPair,
    bush_stresses,
    eye_stresses,
    pin_stresses,
)
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.masses import MICRO, MILLI, joint_forces, masses_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.plates import sides_of, stack_of, unloaded
from mechwright_four_bar.parts.sizes import turning_bore
from mechwright_four_bar.peaks import peaks_of, period_of


@of_stage(Stage.PARTS)
def strength_findings(params: FourBarParams) -> Iterator[Finding]:
    """Pins, plates, bushings, with the sizes that would bear the load."""
    yield from _joints(params, advise=True)


@of_stage(Stage.PARTS)
def strength_judged(params: FourBarParams) -> Iterator[Finding]:
    """The same without these sizes, whose search takes many times as long."""
    yield from _joints(params, advise=False)


def _joints(params: FourBarParams, *, advise: bool) -> Iterator[Finding]:
    most = max(pairs_of(params), key=lambda pair: pair.greatest)
    load = f"{most.greatest:.4g} N at {most.name}"
    pin = Way("pin_diameter", params.pin_diameter)
    wide, rim = Way("thickness", params.thickness), Way("rim", params.rim)
    less = [Way("load_torque", params.load_torque, up=False), Way("speed", params.speed, up=False)]
    yield from judged("four-bar.pin", params, pins, [pin, *less], load, advise=advise)
    yield from judged("four-bar.eye", params, eyes, [rim, wide, *less], load, advise=advise)
    yield from judged("four-bar.bushing", params, bushes, [wide, *less], load, advise=advise)


def pins(params: FourBarParams) -> list[Stress]:
    """Of the pins of all joints."""
    return pin_stresses(pairs_of(params))


def eyes(params: FourBarParams) -> list[Stress]:
    """Of the plates beside all joints."""
    return eye_stresses(pairs_of(params))


def bushes(params: FourBarParams) -> list[Stress]:
    """Of all plain bearings."""
    return bush_stresses(pairs_of(params))


@kept
def pairs_of(params: FourBarParams) -> tuple[TurningPair, ...]:
    """The four joints over a period."""
    found = period_of(params)
    layers, two, masses = stack_of(params), sides_of(params) == 2, masses_of(unloaded(params))
    carried = joint_forces(bar_of(params), found.loop, found.bodies, masses, params.load_torque / MICRO)
    speed = {name: body.turning.omega for name, body in found.bodies.items()}
    speed["ground"] = speed["ground-2"] = np.zeros_like(speed["crank"])
    thick = dict.fromkeys(("crank", "coupler", "follower"), params.thickness)
    thick |= dict.fromkeys(("ground", "ground-2"), params.ground_thickness)
    # Joint to the plate that holds the pin, and the one that turns on it.
    held = {"A0": ("crank", "ground"), "A": ("crank", "coupler"), "B": ("follower", "coupler")}
    held["B0"] = ("follower", "ground-2") if two else ("ground", "follower")

    def middle(plate: str) -> float:
        return layers.bottom(plate) + thick[plate] / 2

    return tuple(
        TurningPair(
            f"pin {joint}" if joint in {"A", "B"} else f"shaft {joint}",
            np.abs(carried.joints[joint]) * MILLI,
            speed[turns] - speed[holds],
            params.pin_diameter,
            abs(middle(turns) - middle(holds)) - thick[holds] / 2,
            thick[turns],
            turning_bore(params),
            params.rim,
            params.material,
            params.bushing_wall > 0,
        )
        for joint, (holds, turns) in held.items()
    )


def _stronger(params: FourBarParams, over: float) -> tuple[Change, ...]:
    """Larger bearings, or less of what they carry, which is so many times ``over`` its limit.

    Larger ones make heavier plates, so that more than the first may be needed.
    """
    pin, plate = params.pin_diameter, params.thickness
    found: list[Change] = []
    for share in (1.05, 1.2, 1.5):
        much = over * share
        found += [
            {"parameters.pin_diameter": _half(much * pin)},
            {"parameters.thickness": _half(much * plate)},
            {
                "parameters.pin_diameter": _half(math.sqrt(much) * pin),
                "parameters.thickness": _half(math.sqrt(much) * plate),
            },
        ]
    for share in (1.05, 1.2):
        if params.load_torque != 0:
            found.append({"parameters.load_torque": float(f"{params.load_torque / over / share:.2g}")})
        if (speed := params.speed / math.sqrt(over) / share) >= SLOWEST:
            found.append({"parameters.speed": float(f"{speed:.2g}")})
    return tuple(found)


def _half(size: float) -> float:
    """The next half millimetre."""
    return math.ceil(2 * size) / 2


@of_stage(Stage.PARTS)
def bearing_findings(params: FourBarParams) -> Iterator[Finding]:
    """Pressure on the bearings, and the forces of the joints."""
    peaks = peaks_of(params)
    widths = dict.fromkeys(("A", "B", "B0"), params.thickness) | {"A0": params.ground_thickness}
    if sides_of(params) == 2:
        widths["B0"] = params.ground_thickness
    joint, force, pressure = most_pressed(peaks, widths, params.pin_diameter)
    more = _stronger(params, pressure / SINTERED_PRESSURE)
    yield from too_pressed("four-bar.bearing-pressure", joint, force, pressure, more)
    yield Finding.note(
        "four-bar.forces",
        f"the drive needs up to {peaks['drive_torque'].value:.4g} N m; joint {joint} carries up to "
        f"{force:.4g} N, and the moving masses shake the ground with up to "
        f"{peaks['shaking_force'].value:.4g} N",
        peaks["drive_torque"].value,
        "N*m",
    )

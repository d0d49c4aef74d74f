"""Strength of the joints: pins, the plates beside their bores, and bushings, from forces over a period."""

from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Stage, kept, of_stage
from mechwright.mechanics.strength.judging import Stress, Way, judged
from mechwright.mechanics.strength.turning_pair import (
    TurningPair,
    bush_stresses,
    eye_stresses,
    pin_stresses,
)
from mechwright_slider_crank.course import period_of
from mechwright_slider_crank.forces import joint_forces
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.plates import TURN_SAMPLES, layout_of, masses_of, unloaded
from mechwright_slider_crank.sizes import sizes_of


@of_stage(Stage.PARTS)
def strength_findings(params: SliderCrankParams) -> Iterator[Finding]:
    """Pins, plates, bushings, with the sizes that would bear the load."""
    yield from _joints(params, advise=True)


@of_stage(Stage.PARTS)
def strength_judged(params: SliderCrankParams) -> Iterator[Finding]:
    """The same without these sizes, whose search takes many times as long."""
    yield from _joints(params, advise=False)


def _joints(params: SliderCrankParams, *, advise: bool) -> Iterator[Finding]:
    sizes = sizes_of(params)
    most = max(pairs_of(params), key=lambda pair: pair.greatest)
    load = f"{most.greatest:.4g} N at the {most.name.removeprefix('the ')}"
    pin, wall = Way("pin", sizes.pin), Way("wall", sizes.wall)
    wide = Way("thickness", params.thickness)
    less = [Way("load", params.load, up=False), Way("speed", params.speed, up=False)]
    yield from judged("slider-crank.pin", params, pins, [pin, *less], load, advise=advise)
    yield from judged("slider-crank.eye", params, eyes, [wall, wide, *less], load, advise=advise)
    yield from judged("slider-crank.bushing", params, bushes, [wide, *less], load, advise=advise)


def pins(params: SliderCrankParams) -> list[Stress]:
    """Of shaft, crank pin and wrist pin."""
    return pin_stresses(pairs_of(params))


def eyes(params: SliderCrankParams) -> list[Stress]:
    """Of the plates beside them."""
    return eye_stresses(pairs_of(params))


def bushes(params: SliderCrankParams) -> list[Stress]:
    """Of base and rod."""
    return bush_stresses(pairs_of(params))


@kept
def pairs_of(params: SliderCrankParams) -> tuple[TurningPair, ...]:
    """Shaft, crank pin and wrist pin over a period."""
    sizes, layers, t = sizes_of(params), layout_of(params).stack, params.thickness
    _, _, bodies = period_of(params, TURN_SAMPLES)
    carried = joint_forces(params.linkage, bodies, masses_of(unloaded(params)), params.load)
    crank, rod = bodies.crank.turning.omega, bodies.rod.turning.omega
    # Pin to the plate that holds it, the one that turns on it, its diameter and bore, and how fast it turns.
    held = {
        "shaft": ("crank", "base", sizes.shaft, sizes.base_bore, crank),
        "crank-pin": ("crank", "rod", sizes.pin, sizes.rod_bore, rod - crank),
        "wrist-pin": ("slider", "rod", sizes.pin, sizes.rod_bore, rod),
    }
    return tuple(
        TurningPair(
            f"the {name.replace('-', ' ')}",
            np.abs(carried.joints[name]),
            speed,
            pin,
            abs(layers.bottom(turns) - layers.bottom(holds)) - t / 2,
            t,
            bore,
            sizes.wall,
            params.material,
            params.bushing > 0,
        )
        for name, (holds, turns, pin, bore, speed) in held.items()
    )

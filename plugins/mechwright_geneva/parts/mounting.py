"""Where the shafts of wheel and driver stand, and what loads them."""

import math

import numpy as np

from mechwright import Hub, Mounting, MountingError, Spindle
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.motion import DRIVER, WHEEL, motion_of
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.parts import driver_keyway_angle, keyway_angle

SAMPLES = 721
"""Of a turn, for the greatest force and torque: every half degree."""


def mounting_of(params: GenevaParams) -> Mounting:
    """The camshaft and the wheel's shaft; raises DesignError where a bore is 0."""
    m = mechanism_of(params)
    sizes = m.params
    for key, bore in (("bore", sizes.bore), ("driver_bore", sizes.driver_bore)):
        if bore == 0:
            raise MountingError(
                f"parameters.{key}: a plate without a bore has no shaft; set {key} = 10",
                ({f"parameters.{key}": 10.0},),
            )
    force, wheel_torque = shares(m)
    disc = sizes.disc_thickness
    foot = sizes.thickness + sizes.axial_gap
    driver = Hub(
        foot - disc,
        foot + sizes.crank_thickness,
        sizes.driver_bore,
        sizes.driver_keyway_width,
        driver_keyway_angle(m),
        sizes.material,
        pieces=(disc, sizes.crank_thickness),
    )
    return Mounting(
        (
            Spindle(
                "driver",
                DRIVER,
                (m.axes, 0.0),
                driver,
                "parameters.driver_bore",
                drives=True,
                force=force,
            ),
            Spindle(
                "wheel", WHEEL, (0.0, 0.0), wheel_hub(m), "parameters.bore", torque=wheel_torque, force=force
            ),
        ),
        ("parameters.axial_gap", sizes.axial_gap),
    )


def wheel_hub(m: Mechanism) -> Hub:
    """The wheel on its shaft, with its hub plate; a counterbore takes its share of the bore's length."""
    sizes = m.params
    low = -sizes.hub_height if sizes.hub_diameter > 0 else 0.0
    high, recess = sizes.thickness, math.inf
    if sizes.counterbore_diameter > 0:
        recess = sizes.counterbore_diameter
        if sizes.counterbore_side == "top":
            high -= sizes.counterbore_depth
        else:
            low += sizes.counterbore_depth
    return Hub(low, high, sizes.bore, sizes.keyway_width, keyway_angle(m), sizes.material, recess)


def shares(m: Mechanism) -> tuple[float, float]:
    """Force of the roller, N, and torque of the wheel, N m, for each N m of the crank at its greatest."""
    motion = motion_of(m.params, SAMPLES)
    values = {name: np.abs(channel.values) for name, channel in motion.channels.items()}
    crank = float(values["crank_torque"].max())
    if crank == 0:  # nothing turns with the wheel: the roller's lever at the start of a stroke
        return 1000 / m.bottom, 1.0
    wheel = m.params.load_inertia * values["alpha_w"] + m.params.load_torque * (values["omega_w"] > 0)
    return float(values["contact_force"].max()) / crank, float(wheel.max()) / crank

"""Cams that books and other programs print, to their digits."""

import math

import numpy as np
import pytest

from mechwright_cam_follower.kinematics.cycle import cycle_of
from mechwright_cam_follower.kinematics.extremes import face_ends, pressure_peak
from mechwright_cam_follower.kinematics.mechanism import mechanism_of
from mechwright_cam_follower.kinematics.motion import contacts_at
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.requirements import SizeRequirement
from mechwright_cam_follower.synthesis.smallest_cam import smallest


def cam(**table) -> CamParams:
    return CamParams.model_validate(table)


@pytest.mark.parametrize(("law", "printed"), [("simple-harmonic", 1.8), ("cycloidal", 1.6)])
def test_radius_of_curvature_of_a_handbook(law, printed):
    """Machinery's Handbook, chapter Cams and Cam Design, example of the least radius of curvature of a pitch curve.

    A rise of 1 in over 60 degrees, least radius of the pitch curve 2.9 in: 1.8 in for simple harmonic motion, 1.6 in
    for cycloidal motion. In mm times ten here.
    """
    scale = 10.0
    params = cam(
        angles=(60, 120, 60, 120),
        lifts=(scale, scale, 0, 0),
        laws=[law],
        base_radius=2.4 * scale,
        roller_radius=0.5 * scale,
        bore=0,
    )
    theta = np.linspace(0.0, math.pi / 3, 20001)
    (contact,) = contacts_at(mechanism_of(params), cycle_of(params).at(theta))
    assert np.abs(contact.centre).min() / scale == pytest.approx(2.9, abs=1e-9)
    bent = contact.pitch_radius[contact.pitch_radius > 0]
    assert round(bent.min() / scale, 1) == printed


def test_sizes_that_another_program_prints():
    """The README of the Python package ``mechanism`` (G. Morris), section Cams, which follows Norton.

    Rise and fall of 1 in over 90 degrees each, dwells of 90 degrees, cycloidal, a flat face, ρ at least 0.25 in:
    it prints a base radius of 1.893 in and a face of 2.55 in. In mm times ten here.
    """
    scale = 10.0
    wanted = SizeRequirement(
        contact="flat",
        angles=(90, 90, 90, 90),
        lifts=(scale, scale, 0, 0),
        least_curvature_radius=0.25 * scale,
        bore=0,
    )
    (best,) = smallest(wanted, lambda done, what: None).candidates
    assert best.params.base_radius / scale == pytest.approx(1.893, abs=0.001)
    low, high = face_ends(mechanism_of(best.params))
    assert round((high - low) / scale, 2) == 2.55


def test_pressure_angle_that_another_program_prints():
    """The same README and cam with a roller of 0.5 in, in its plot of the pressure angle: R_b = 1.25091 in for 30°.

    The angle there is the greatest of its samples, so that the radius is good to five digits.
    """
    scale = 10.0
    table = {"angles": (90, 90, 90, 90), "lifts": (0, scale, scale, 0), "roller_radius": scale / 2, "bore": 0}
    printed = pressure_peak(mechanism_of(cam(base_radius=1.25091 * scale, **table)))
    assert round(math.degrees(printed.value), 2) == 30.0
    wanted = SizeRequirement(**table, greatest_pressure_angle=30, offset=0.0)
    (best,) = smallest(wanted, lambda done, what: None).candidates
    assert best.params.base_radius / scale == pytest.approx(1.2509, abs=1e-4)


PRINTED = (
    # lift in mm, rise, rest and return in degrees, rev/min, accelerations of rise and return in m/s²
    (40, (60, 45, 90), 300, (177.6, 78.9)),
    (50, (120, 30, 60), 100, (6.2, 24.7)),
)
"""Illustrations 2 and 3 of chapter 9, pages 247 and 249, of B. K. Sarkar, Theory of Machines.

The digits are those of the textbook companion of FOSSEE, which has them with π = 3.141.
"""


@pytest.mark.parametrize(("lift", "angles", "speed", "printed"), PRINTED)
def test_accelerations_that_a_textbook_prints(lift, angles, speed, printed):
    """Harmonic motion: the greatest accelerations of rise and return."""
    valve = cam(
        angles=(*angles, 360 - sum(angles)),
        lifts=(lift, lift, 0, 0),
        laws=["simple-harmonic"],
        base_radius=25,
        roller_radius=10,
        speed=speed,
        bore=0,
    )
    for segment, acceleration in zip((0, 2), printed, strict=True):
        rates = cycle_of(valve).segments[segment].at(np.linspace(0, 1, 1001))
        assert np.abs(rates.a).max() * valve.omega**2 / 1e3 == pytest.approx(acceleration, abs=0.06, rel=1e-3)

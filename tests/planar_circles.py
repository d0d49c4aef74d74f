"""Poles and circles of a moving body, to hold its rates and its acceleration pole against.

With the velocity pole P, its rate of change u along the centrodes, and z = r - P:

* u = v_A + i a_A/ω - i v_A α/ω²;
* the inflection circle goes through P and P + J, J = -i u/ω: there the acceleration has no normal part;
* the Bresse circle goes through P and P + T, T = u ω/α: there it has no tangential part;
* the acceleration pole is the foot of the perpendicular from P on the line from P + J to P + T;
* Euler and Savary: the path of r has its centre of curvature in r - |z|² z / (|z|² - Re(z* J)).

Places are those on the ground, x + i y, at each sample; infinite or not a number where there is none.
"""

import numpy as np


def in_body(body, place):
    return (place - body.origin.position) / body.turning.direction


def velocity_pole(body):
    with np.errstate(divide="ignore", invalid="ignore"):
        return body.origin.position + 1j * body.origin.velocity / body.turning.omega


def jerk_pole(body):
    return body.origin.position - body.origin.jerk / body.turning.jerk_factor


def pole_velocity(body):
    omega, alpha = body.turning.omega, body.turning.alpha
    return (
        body.origin.velocity + 1j * (body.origin.acceleration - body.origin.velocity * alpha / omega) / omega
    )


def inflection_pole(body):
    """The far end of the inflection circle's diameter through the velocity pole."""
    return velocity_pole(body) - 1j * pole_velocity(body) / body.turning.omega


def bresse_point(body):
    """The far end of the Bresse circle's diameter through the velocity pole."""
    return velocity_pole(body) + pole_velocity(body) * body.turning.omega / body.turning.alpha


def curvature(point):
    """Of the path of a point, 1/mm, positive to the left: Im(v* a) / |v|³."""
    return (np.conj(point.velocity) * point.acceleration).imag / np.abs(point.velocity) ** 3


def centre_of_curvature(point):
    return point.position + 1j * point.velocity / np.abs(point.velocity) / curvature(point)

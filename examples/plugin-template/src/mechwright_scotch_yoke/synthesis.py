"""A yoke with a wanted stroke and velocity: both are closed forms of x = r cos θ."""

import math

from mechwright import Candidate, Finding, Scalar, Severity, Synthesis
from mechwright.contracts.finding import errors
from mechwright_scotch_yoke.family import ScotchYoke, ScotchYokeParams, StrokeRequirement
from mechwright_scotch_yoke.kinematics import peak_force

FASTEST = 600.0
"""Crank speed, rev/min, above which a plain bearing of the default sizes runs hot."""


def from_stroke(wanted: StrokeRequirement) -> Synthesis[ScotchYokeParams]:
    """The one yoke with this stroke 2 r and peak velocity r ω; its other sizes are the defaults."""
    radius = wanted.stroke / 2
    speed = wanted.peak_velocity * 1000 / (math.tau * radius)
    if speed > FASTEST:
        limit = FASTEST * math.tau * radius / 1000
        fault = Finding(
            "scotch-yoke.peak-velocity",
            Severity.ERROR,
            "speed",
            f"a stroke of {wanted.stroke:g} mm would need {speed:.4g} rev/min, the limit is {FASTEST:g}",
            value=speed,
            limit=FASTEST,
            unit="rpm",
            remedy=f"ask for a peak_velocity of at most {limit:.4g} m/min, or for a longer stroke",
        )
        return Synthesis((), (fault,))
    params = ScotchYokeParams.model_validate({"crank_radius": radius, "speed": speed})
    findings = ScotchYoke().check(params)
    if errors(findings):
        return Synthesis((), tuple(findings))
    force = Scalar(peak_force(params), "N")
    return Synthesis((Candidate(params, Scalar(0.0, "mm"), {"peak_force": force}),))

"""Rigid bodies in the plane: motion from pose to jerk, poles, circles, path curvature, forces.

Glossary
--------
plane number
    A point or vector of the plane as a complex number x + i y; a turn by θ is the factor exp(i θ).
body
    A rigid body with coordinates of its own: the body point p stands at ``origin + p exp(i θ)``.
pole
    The point of a body that has no velocity (no acceleration, no jerk) just now.
centrode
    The path of the velocity pole: seen from the ground the fixed one, seen from the body the moving one.
inflection circle
    The body points whose path has no curvature just now; their acceleration has no normal part.
Bresse circle
    The body points whose acceleration has no tangential part. Both circles meet in the velocity pole and
    in the acceleration pole.

Everything takes and gives arrays of one shape (...), the samples of a motion; time is the parameter of
all rates, and where a crank turns with one radian per second they are rates per crank radian.
"""

from mechwright.mechanics.planar.circles import (
    Circle,
    Curvature,
    bresse_circle,
    curvature_of_path,
    inflection_circle,
    pole_velocity,
)
from mechwright.mechanics.planar.poles import Pole, PoleKind, acceleration_pole, jerk_pole, velocity_pole
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Turning

__all__ = [
    "BodyMotion",
    "Circle",
    "Curvature",
    "Plane",
    "PointMotion",
    "Pole",
    "PoleKind",
    "Turning",
    "acceleration_pole",
    "bresse_circle",
    "curvature_of_path",
    "inflection_circle",
    "jerk_pole",
    "pole_velocity",
    "velocity_pole",
]

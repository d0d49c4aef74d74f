"""Rigid bodies in the plane: motion from pose to jerk, the acceleration pole, forces.

Glossary
--------
plane number
    A point or vector of the plane as a complex number x + i y; a turn by θ is the factor exp(i θ).
body
    A rigid body with coordinates of its own: the body point p stands at ``origin + p exp(i θ)``.
acceleration pole
    The point of a body that has no acceleration just now.

Everything takes and gives arrays of one shape (...), the samples of a motion; time is the parameter of
all rates, and where a crank turns with one radian per second they are rates per crank radian.
"""

from mechwright.mechanics.planar.course import Course
from mechwright.mechanics.planar.poles import acceleration_pole
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Turning

__all__ = ["BodyMotion", "Course", "Plane", "PointMotion", "Turning", "acceleration_pole"]

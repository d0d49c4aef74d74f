"""The mechanism for simulators: MJCF for MuJoCo, URDF and SDF for robots.

Metres, kilograms, radians. Angles and ways are 0 in the pose that is written.
"""

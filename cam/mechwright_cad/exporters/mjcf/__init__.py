"""MJCF, what MuJoCo simulates: bodies with their masses, joints, closed loops, contacts and looks.

Metres, kilograms, radians; no gravity. Angles and ways are 0 in the pose that is written.
"""

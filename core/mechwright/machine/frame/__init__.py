"""Frames: plates, pillars, shafts and bearings around a mechanism, by rule from its planes and loads.

Glossary
--------
bearing plate
    A plate with the bearings of one end of all shafts; its inner face looks at the mechanism.
pillar
    A turned distance piece between two plates, threaded at both ends; two of them have spigots.
column
    A corner of the frame: the pillar there, and the leg under it.
bracket
    The plate that carries the motor, with its pillars.

Heights are those of the mechanism; the input's shaft goes down to the motor.
"""

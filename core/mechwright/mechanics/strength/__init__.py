"""Strength and life of machine parts as formulas: shafts, bearings, keys, pins, screws, teeth, motors.

Units: forces N, lengths mm, stresses and moduli MPa, **moments and torques N m**, speeds rev/min, inertias
kg m², angles rad, unless a name says other. Each formula has its source; limits stand in ``allowed``. None of
them knows a family.
"""

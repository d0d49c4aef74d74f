"""How far a slender cutter bends under its roughing cut: a cantilever with a force at its tip.

The tangential force of a tooth is k_c a_p h with Kienzle's k_c = k_c1.1 h^-m and the mean chip thickness
h = f_z sqrt(a_e / d) (common workshop formulas), times the teeth in the cut, at least one. Deflection is
F l³ / (3 E I) with I = π d_e⁴ / 64 of the equivalent diameter that the flutes leave.
"""

import math

from mechwright.contracts.materials import material
from mechwright.tolerances import TOLERANCES
from mechwright_cam.shop.tool import Tool

CORE = 0.75
"""Equivalent diameter of a fluted cutter in its diameter: flutes take a quarter to a third of the section."""
MODULUS = {"carbide": 6.0e5, "hss": 2.1e5}
"""Modulus of elasticity, N/mm²: cemented carbide with 10 % cobalt, and steel."""
NECK = 1.0
"""A cutter stands out of the holder this many diameters further than it cuts, if nothing is said of it."""
MOST = 0.02
"""Deflection from which on a cutter is worth a warning, mm: a tenth of the usual allowance for finishing."""


def deflection(tool: Tool, workpiece: str, depth: float) -> float:
    """Deflection, mm, of an end mill that roughs with its own cutting data for the workpiece's material.

    It goes to ``depth`` below the top of the stock, mm; a stick-out of the tool's own counts instead.
    """
    data, stuff = tool.cutting[workpiece], material(workpiece)
    wide = data.step_over
    chip = data.chip_load * math.sqrt(wide)
    teeth = max(1.0, tool.flutes * math.acos(1 - 2 * wide) / math.tau)
    passes = max(1, math.ceil(depth / (data.step_down * tool.diameter) - TOLERANCES.noise))
    force = stuff.force * chip ** (1 - stuff.force_exponent) * (depth / passes) * teeth
    length = depth + NECK * tool.diameter if tool.stick_out is None else tool.stick_out
    fluted = min(tool.flute_length, length)
    cut, shank = _inertia(CORE * tool.diameter), _inertia(tool.shank_diameter or tool.diameter)
    # Mohr's integral of the two parts: the flutes, and the shank behind them.
    bent = fluted**3 / cut + (length**3 - fluted**3) / shank
    return float(force * bent / (3 * MODULUS[tool.substrate]))


def _inertia(diameter: float) -> float:
    return math.pi * diameter**4 / 64

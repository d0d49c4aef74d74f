"""How far a slender cutter bends under its roughing cut, and how deep its passes are for that and for power.

It is a cantilever with a force at its tip.

The tangential force of a tooth is k_c a_p h with Kienzle's k_c = k_c1.1 h^-m and the mean chip thickness
h = f_z sqrt(a_e / d) (common workshop formulas), times the teeth in the cut, at least one. Deflection is
F l³ / (3 E I) with I = π d_e⁴ / 64 of the equivalent diameter that the flutes leave.
"""

import math

from mechwright.contracts.materials import material
from mechwright_cam.operations.rates import rates
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutting_force import HELIX
from mechwright_cam.shop.power import WATTS, available, milling_force
from mechwright_cam.shop.tool import Tool

SLENDER = 5.0
"""Beyond this many diameters of depth a mill bends noticeably: makers list such cutters as long-reach."""
THINNEST = 0.05
"""Passes of fewer diameters than this are not planned, however far the mill bends: time goes up and its edge
is worn in one place. No cutter that comes with the program asks for them."""

SHALLOWEST = 0.1
"""No pass is planned less deep for want of power, in diameters: from there on the feed gives way."""

CORE = 0.75
"""Equivalent diameter of a fluted cutter in its diameter: flutes take a quarter to a third of the section."""
MODULUS = {"carbide": 6.0e5, "hss": 2.1e5}
"""Modulus of elasticity, N/mm²: cemented carbide with 10 % cobalt, and steel."""
NECK = 1.0
"""A cutter stands out of the holder this many diameters further than it cuts, if nothing is said of it."""
NORMAL = 0.5
"""Force that pushes a mill off the wall in its tangential force: 0.3 in aluminium, up to 0.5 in steel."""
MOST_FED = 2.0
"""Walls are finished with so many times the feed of a full cut at most."""
MOST = 0.02
"""Greatest deflection, mm, of a cut to size, before it is cut in thinner passes: half of it stays after a
spring pass, at most."""
OF_FORCE = 1 / 3
"""Share of the force that a light machine bears which is left for walls: what gives way there is seen."""
OF_ALLOWANCE = 0.25
"""Greatest deflection of a roughing cut in what it leaves on walls. Finishing then takes a quarter more or
less than planned, and chips that get too thick for that are fed more slowly."""


def most_bent(job: Job, *, to_size: bool = False) -> float:
    """Greatest deflection, mm, of a roughing cut: a share of what it leaves for finishing.

    A cut ``to_size`` leaves nothing, and so does one of a job without an allowance: :data:`MOST` for these.
    """
    return MOST if to_size else max(MOST, OF_ALLOWANCE * job.settings.stock_to_leave)


def pass_depth(job: Job, tool: Tool, deep: float, *, to_size: bool = False) -> float:
    """Deepest pass, mm, of a mill that cuts with its whole width and ``deep`` mm below the top of the stock.

    It is the ``step_down`` of its cutting data, and no more than the spindle has the power for; of a slender
    mill no more than bends it by what :func:`most_bent` allows. Where the design itself says its
    ``step_down`` it is that, and the feed gives way.
    """
    planned = tool.cutting[job.part.material].step_down * tool.diameter
    if says_step_down(job, tool):
        return planned
    planned = min(planned, borne_depth(job, tool), max(powered_depth(job, tool), SHALLOWEST * tool.diameter))
    if deep <= SLENDER * tool.diameter:
        return planned
    bending = most_bent(job, to_size=to_size) / deflection(tool, job.part.material, deep, 1.0)
    return min(planned, max(bending, THINNEST * tool.diameter))


def borne_depth(job: Job, tool: Tool, share: float = 1.0) -> float:
    """Deepest slot, mm, in which a tooth takes no more than a share of the force that the machine bears."""
    force, stuff = job.settings.machine.bears, material(job.part.material)
    if math.isinf(force) or says_step_down(job, tool):
        return math.inf
    chip = tool.cutting[job.part.material].chip_load
    return float(share * force / (stuff.force * chip ** (1 - stuff.force_exponent)))


def borne_wall(job: Job, tool: Tool) -> float:
    """Deepest pass, mm, along a wall in which a tooth takes a third of that force off the allowance.

    Without a bound where no tooth in a helix has so long an edge in the allowance at once.
    """
    wide = min(job.settings.stock_to_leave, tool.radius) / tool.diameter
    if wide <= 0:
        return math.inf
    angle = math.acos(1 - 2 * wide)
    thinner = math.sin(min(angle, math.pi / 2)) ** (1 - material(job.part.material).force_exponent)
    most = borne_depth(job, tool, OF_FORCE) / thinner
    return math.inf if tool.radius * angle / HELIX <= most else most


def powered_depth(job: Job, tool: Tool) -> float:
    """Depth, mm, of a slot of the mill's width at its planned feed for which the spindle has the power.

    A deeper one at a lower feed takes more power for the same chips, for thin ones are harder to cut.
    """
    speed = rates(tool, job.part.material, job.settings.machine)
    force = milling_force(material(job.part.material), speed.chip, math.pi)
    per_mm = float(force) * tool.diameter * speed.full / 1000 * WATTS / 1000
    return float(available(job.settings.machine, speed.spindle)) / per_mm


def says_step_down(job: Job, tool: Tool) -> bool:
    """Whether the design says how deep the passes of a mill are."""
    said = job.settings.cutting.get(tool.name)
    return said is not None and said.step_down is not None


def deflection(tool: Tool, workpiece: str, deep: float, step: float) -> float:
    """Deflection, mm, of an end mill in passes of ``step`` mm, with its cutting data for a material.

    It goes to ``deep`` mm below the top of the stock; a stick-out of the tool's own counts instead.
    """
    data, stuff = tool.cutting[workpiece], material(workpiece)
    wide = data.step_over
    chip = data.chip_load * math.sqrt(wide)
    teeth = max(1.0, tool.flutes * math.acos(1 - 2 * wide) / math.tau)
    force = stuff.force * chip ** (1 - stuff.force_exponent) * step * teeth
    length = deep + NECK * tool.diameter if tool.stick_out is None else tool.stick_out
    shank = tool.shank_diameter or tool.diameter
    return bent(force, length, tool.flute_length, CORE * tool.diameter, shank, MODULUS[tool.substrate])


def wall_bending(job: Job, tool: Tool, deep: float, high: float) -> float:
    """How far, mm, a mill bends off a wall that it finishes in passes ``high`` mm deep, down to ``deep`` mm.

    Only what pushes it off the wall counts, :data:`NORMAL` of the tangential force, on those parts of its
    edges that are in the allowance at once: a tooth in a helix is at an engagement φ over the length
    r φ / tan β, and the teeth together over z φ / (2 π) of the depth. The load is spread over the pass.
    """
    data, stuff = tool.cutting[job.part.material], material(job.part.material)
    wide = min(job.settings.stock_to_leave, tool.radius) / tool.diameter
    angle = math.acos(1 - 2 * wide)
    if angle <= 0:
        return 0.0
    chip = data.chip_load * min(1 / math.sin(angle), MOST_FED) * math.sqrt(wide)
    engaged = max(min(high, tool.radius * angle / HELIX), high * tool.flutes * angle / math.tau)
    force = NORMAL * stuff.force * chip ** (1 - stuff.force_exponent) * engaged
    length = deep + NECK * tool.diameter if tool.stick_out is None else tool.stick_out
    shank = tool.shank_diameter or tool.diameter
    off = max(length - high, 0.0)
    spread = (0.75 * length**4 - length * off**3 + off**4 / 4) / (2 * (length - off) * length**3)
    core, modulus = CORE * tool.diameter, MODULUS[tool.substrate]
    return spread * bent(force, length, tool.flute_length, core, shank, modulus)


def bent(force: float, length: float, fluted: float, core: float, shank: float, modulus: float) -> float:
    """Deflection, mm, of the end of a cutter that stands out by a length, under a force, N, on its end.

    Its flutes, ``fluted`` mm long, bend as a rod of diameter ``core``, and the shank behind them as one
    of its own: F L³/(3 E I) where both are one, else Mohr's integral of the two.

    >>> round(bent(100, 20, 20, 4.8, 6, 6.0e5), 6)
    0.017056
    """
    fluted = min(fluted, length)
    along = fluted**3 / _inertia(core) + (length**3 - fluted**3) / _inertia(shank)
    return float(force * along / (3 * modulus))


def _inertia(diameter: float) -> float:
    return math.pi * diameter**4 / 64

"""Cutting data of mills and drills for which nobody has given any: from material, machine and diameter.

Chip loads of small machines are a fifth to a third of those that industry takes; they are read from
settings that makers of such machines publish, and interpolated. The depth of a slot follows from the force F
of a tooth that the machine bears: a chip h mm thick takes k_c1.1 h^(1-m) N per mm of depth (Kienzle), so

    a_p = F / (k_c1.1 f_z^(1-m)),

at most a share of the diameter by class, and less below 3 mm, where the cutter breaks before the machine
gives way. All of it is an estimate: the first cut is watched, and what works goes into the tool's table.
"""

import math
from collections.abc import Sequence

import numpy as np

from mechwright.contracts.materials import Kind, Material, material
from mechwright_cam.shop.machine import SIDE_FORCE, Machine, Rigidity
from mechwright_cam.shop.tool import MILLS, CuttingData, CuttingTable, Tool, ToolKind

DIAMETERS = (1.0, 2.0, 3.175, 6.0)
"""mm; beyond the last the chip does not grow."""

CHIPS: dict[Kind, dict[Rigidity, tuple[float, float, float, float]]] = {
    "wood": {
        "A": (0.010, 0.020, 0.030, 0.040),
        "B": (0.012, 0.022, 0.035, 0.050),
        "C": (0.015, 0.030, 0.050, 0.080),
        "D": (0.015, 0.030, 0.060, 0.120),
    },
    "plastic": {
        "A": (0.010, 0.020, 0.030, 0.040),
        "B": (0.012, 0.022, 0.035, 0.060),
        "C": (0.015, 0.030, 0.050, 0.080),
        "D": (0.015, 0.030, 0.060, 0.100),
    },
    "soft metal": {
        "A": (0.006, 0.012, 0.020, 0.025),
        "B": (0.008, 0.015, 0.025, 0.040),
        "C": (0.008, 0.016, 0.030, 0.045),
        "D": (0.008, 0.016, 0.030, 0.055),
    },
}
"""Feed per tooth, mm, at each of these diameters."""

DEEPEST: dict[Kind, dict[Rigidity, float]] = {
    "wood": {"A": 0.5, "B": 0.75, "C": 1.0, "D": 1.0},
    "plastic": {"A": 0.4, "B": 0.5, "C": 0.75, "D": 1.0},
    "soft metal": {"A": 0.1, "B": 0.25, "C": 0.5, "D": 1.0},
}
"""Deepest slot in diameters."""

SMALL: dict[Kind, tuple[float, float]] = {
    "wood": (0.25, 0.5),
    "plastic": (0.25, 0.5),
    "soft metal": (0.15, 0.15),
}
"""The same of cutters of 1 and 2 mm, whatever the machine; from 3 mm on it is a whole diameter."""

PLUNGE: dict[Rigidity, float] = {"A": 0.2, "B": 0.25, "C": 0.3, "D": 0.3}
"""Feed straight down in that of the chip load."""

STRONG: tuple[tuple[float, Rigidity], ...] = ((0.3, "A"), (1.0, "B"), (3.0, "C"))
"""Power in kW below which a machine whose class is not known is taken for one of a class; D from there on."""

DRILL_SPEED, DRILL_CHIP = 0.4, 0.008
"""Speed of a drill of high-speed steel in the least usual one of carbide; feed per lip in its diameter."""


def rigidity_of(machine: Machine) -> Rigidity:
    """The class of a machine; by the power of its spindle where it is not given."""
    if machine.rigidity is not None:
        return machine.rigidity
    for power, name in STRONG:
        if machine.spindle_power < power:
            return name
    return "D"


def estimate(tool: Tool, name: str, machine: Machine) -> CuttingData | None:
    """Cutting data of a tool for a material; None where there is no estimate, or the spindle is too fast.

    >>> from mechwright_cam.shop.tool import Tool
    >>> mill = Tool(name="mill", number=1, kind="end-mill", diameter=3.175, flutes=1, flute_length=12)
    >>> small = Machine(rigidity="A", spindle_min=1000, spindle_max=10000)
    >>> data = estimate(mill, "acrylic", small)
    >>> data.chip_load, round(data.step_down * 3.175, 2)
    (0.03, 0.66)
    """
    stuff = material(name)
    if stuff.kind not in CHIPS:
        return None
    slowest, fastest = (
        speed * math.pi * tool.diameter / 1000 for speed in (machine.speed(0.0), machine.speed(math.inf))
    )
    low, high = stuff.speed
    best = low if stuff.melts or stuff.kind == "soft metal" else math.sqrt(low * high)
    if tool.kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL}:
        best, high = DRILL_SPEED * low, low
    speed = min(max(best, slowest), max(fastest, slowest))
    if speed > high:
        return None
    if tool.kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL}:
        chip = min(DRILL_CHIP * tool.diameter, 0.1)
        return CuttingData(cutting_speed=speed, chip_load=round(chip, 4), step_down=0.5)
    if tool.kind not in MILLS:
        return None
    kind = rigidity_of(machine)
    chip = float(np.interp(tool.diameter, DIAMETERS, CHIPS[stuff.kind][kind])) * min(1.0, tool.diameter)
    deep = slot_depth(
        stuff, tool.diameter, chip, kind, machine.bears if math.isfinite(machine.bears) else 0.0
    )
    return CuttingData(
        cutting_speed=speed,
        chip_load=round(chip, 5),
        step_down=deep / tool.diameter,
        step_over=0.4,
        plunge=PLUNGE[kind],
    )


def no_estimate(mills: Sequence[Tool], name: str, machine: Machine) -> str:
    """In words, why mills have no estimate for a material; empty where one of them has.

    >>> fast = Machine(spindle_min=20000, spindle_max=30000)
    >>> mill = Tool(name="mill", number=1, kind="end-mill", diameter=6, flutes=1, flute_length=12)
    >>> no_estimate([mill], "acrylic", fast)
    ', as the spindle turns at 20000 rev/min at least: 377 m/min at 6 mm, and acrylic takes 300 at most'
    """
    stuff = material(name)
    if stuff.kind not in CHIPS:
        return f", and {name} is not estimated"
    if not mills or any(estimate(mill, name, machine) is not None for mill in mills):
        return ""
    least, slowest = min(mill.diameter for mill in mills), machine.speed(0.0)
    speed = math.pi * least * slowest / 1000
    return (
        f", as the spindle turns at {slowest:g} rev/min at least: {speed:.0f} m/min at {least:g} mm, and "
        f"{name} takes {stuff.speed[1]:g} at most"
    )


def slot_depth(stuff: Material, diameter: float, chip: float, kind: Rigidity, force: float = 0.0) -> float:
    """Deepest slot, mm, of a mill that is fed ``chip`` mm per tooth on a machine that bears ``force`` N.

    With no force it is that of the class.
    """
    by_force = (force or SIDE_FORCE[kind]) / (stuff.force * chip ** (1 - stuff.force_exponent))
    thin, thicker = SMALL[stuff.kind]
    slender = float(np.interp(diameter, (1.0, 2.0, 3.0), (thin, thicker, 1.0)))
    return float(min(by_force, min(DEEPEST[stuff.kind][kind], slender) * diameter))


def completed(tools: Sequence[Tool], names: Sequence[str], machine: Machine) -> tuple[Tool, ...]:
    """The tools with estimates where data are lacking.

    A tool without any data gets an estimate for each material; one with data does where no mill among them
    has any for the material.
    """
    lacking = [
        name for name in names if not any(tool.kind in MILLS and name in tool.cutting for tool in tools)
    ]
    return tuple(_with(tool, names if not tool.cutting else lacking, machine) for tool in tools)


def _with(tool: Tool, names: Sequence[str], machine: Machine) -> Tool:
    """A tool with estimates for some materials."""
    more = {name: data for name in names if (data := estimate(tool, name, machine)) is not None}
    if not more:
        return tool
    table = CuttingTable({**tool.cutting, **more})
    table.estimated = frozenset(more)
    return tool.model_copy(update={"cutting": table})

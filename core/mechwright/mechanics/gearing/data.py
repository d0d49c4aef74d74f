"""The data of teeth that a drawing of a gear has as a table."""

import math

from mechwright.mechanics.gearing.round import Round
from mechwright.mechanics.gearing.teeth import Teeth


def gear_data(teeth: Teeth) -> tuple[tuple[str, str], ...]:
    """Names and values: what a cutter is set to, and the thickness of a tooth along the pitch curve.

    The profile shift follows from the thickness, π m/2 + 2 x m tan α less half of the backlash: it is that of
    round gears. A gear that is not round says the length of its pitch curve.
    """
    rack, z = teeth.rack, teeth.count
    module, angle = rack.module, rack.pressure_angle
    thick = rack.pitch - 2 * teeth.half_space
    rows = [
        ("number of teeth", f"{z}"),
        ("module", f"{module:.4g}"),
        ("pressure angle", f"{math.degrees(angle):.4g}°"),
    ]
    if isinstance(teeth.curve, Round):
        shift = (thick + rack.backlash / 2 - rack.pitch / 2) / (2 * module * math.tan(angle))
        rows += [
            ("profile shift", f"{round(shift, 4) + 0.0:.4g}"),
            ("reference diameter", f"{2 * abs(teeth.curve.radius):.6g}"),
        ]
    else:
        rows.append(("length of the pitch curve", f"{z * rack.pitch:.6g}"))
    return (
        *rows,
        ("addendum, dedendum", f"{rack.addendum:.4g}, {rack.dedendum:.4g}"),
        ("tooth on the pitch curve", f"{thick:.4g}"),
        ("backlash of the pair", f"{rack.backlash:.3g}"),
    )

"""Grbl in laser mode: the beam is on in G1, G2 and G3 alone, and S is its power.

With M4 the power follows the speed and is off at rest. A pierce needs a beam that burns at rest: M3, a move
of no length that switches it on, and a dwell. The frame is that of Grbl's ``laser_mode.md``.
"""

from collections.abc import Sequence

from mechwright_cut.cuts import Contour
from mechwright_cut.jobs import CutJob
from mechwright_cut.programs.words import at, comment, moves, title
from mechwright_plane.text import number


def grbl_laser(job: CutJob, contours: Sequence[Contour]) -> str:
    """The program; X0 Y0 is the lower left corner of the sheet."""
    settings = job.settings
    lines = [
        *title(job),
        comment(f"needs $32=1 and $30={settings.full_power}"),
        "G21 G90 G17 G94 G54",
        "M5 S0",
    ]
    for contour in contours:
        mark = contour.role == "engrave"
        power, feed = settings.marking if mark else settings.cutting
        pierce = settings.pierce if contour.pierces else 0.0
        lines += [comment(contour.name), "M3 S0" if pierce else "M4 S0"]
        for _ in range(1 if mark else settings.passes):
            for stroke in contour.strokes:
                lines.append(f"G0 {at(stroke.start)}")
                if pierce:
                    lines += [f"G1 S{number(power)} F{number(feed)}", f"G4 P{number(pierce)}"]
                first, *rest = moves(stroke)
                lines += [f"{first} S{number(power)} F{number(feed)}", *rest]
        lines.append("M5 S0")
    return "\n".join([*lines, "G0 X0 Y0", "M2"]) + "\n"

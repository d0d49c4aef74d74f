"""LinuxCNC with a beam, a jet or an arc: M3 switches it on, M5 off, and S is its power.

Paths are net of the kerf. Of a plasma, S1 of spindle 0 starts the torch, as QtPlasmaC has it.
"""

from collections.abc import Sequence

from mechwright_cut.cuts import Contour
from mechwright_cut.jobs import CutJob
from mechwright_cut.programs.words import at, comment, moves, title
from mechwright_plane.text import number

BLEND = 0.002
"""Largest deviation from the path in corners, mm: P of G64."""


def linuxcnc_beam(job: CutJob, contours: Sequence[Contour]) -> str:
    """The program; X0 Y0 is the lower left corner of the sheet."""
    settings, plasma = job.settings, job.process.name == "plasma"
    off = "M5 $0" if plasma else "M5"
    lines = [*title(job), "G21 G17 G40 G49 G80 G90 G91.1 G94 G54", f"G64 P{BLEND}", off]
    for contour in contours:
        mark = contour.role == "engrave"
        power, feed = settings.marking if mark else settings.cutting
        on = "M3 $0 S1" if plasma else f"M3 S{number(power)}"
        lines.append(comment(contour.name))
        for _ in range(1 if mark else settings.passes):
            for stroke in contour.strokes:
                first, *rest = moves(stroke)
                lines += [f"G0 {at(stroke.start)}", on]
                lines += [f"G4 P{number(settings.pierce)}"] if settings.pierce and contour.pierces else []
                lines += [f"{first} F{number(feed)}", *rest, off]
    return "\n".join([*lines, "G0 X0 Y0", "M2"]) + "\n"

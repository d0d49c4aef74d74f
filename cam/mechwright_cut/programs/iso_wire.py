"""Wire erosion in ISO words: the net contour, G41 or G42 with D, start holes, passes, a stop before the tab.

D1, D2 ... are registers of the machine; the sheet lists them. G92 sets the zero at the first start hole. M60
threads the wire and M50 cuts it, as Fanuc and Makino have it; M1 stops to hold the slug or the part.
Generator conditions are no part of the program.
"""

from collections.abc import Sequence

from mechwright_cut.cuts import WireContour, WirePass
from mechwright_cut.jobs import CutJob
from mechwright_cut.programs.words import at, comment, moves, title
from mechwright_plane.text import number


def iso_wire(job: CutJob, contours: Sequence[WireContour]) -> str:
    """The program; X0 Y0 is the lower left corner of the sheet."""
    registers = job.settings.registers(job.kerf.width)
    lines = ["%", *title(job)]
    lines += [comment(f"D{n}={number(value)}") for n, value in enumerate(registers, start=1)]
    lines.append("G90 G21")
    for place, contour in enumerate(contours):
        lines.append(comment(contour.name))
        lines.append(f"{'G0' if place else 'G92'} {at(contour.hole)}")
        lines.append("M60")
        for one in contour.passes:
            lines += _pass(one)
        lines += ["M1", *_pass(contour.last), "M50"]
    return "\n".join([*lines, "M2", "%"]) + "\n"


def _pass(one: WirePass) -> list[str]:
    """The offset is put on and taken off on straight lines."""
    first, *between, last = moves(one.path)
    return [f"G{one.side} D{one.register} {first}", *between, f"G40 {last}"]

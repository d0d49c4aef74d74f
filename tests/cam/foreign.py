"""Drawings and programs as other people make them: a coupler as polyline chords, a gear as FreeCAD posts it."""

import math
from pathlib import Path

import ezdxf
import numpy as np
import shapely

LONG, ROUND, HOLE, THICK = 80.0, 10.0, 5.0, 6.0
"""A coupler: distance of its holes, radius of its ends, diameter of its holes, thickness, mm."""


def coupler_drawing(path: Path, *, unit: int = 4, scale: float = 1.0) -> Path:
    """Two lines, two arcs and two circles, X0 Y0 in the left hole."""
    document = ezdxf.new("R2010", units=unit)
    space = document.modelspace()
    long, radius = LONG / scale, ROUND / scale
    space.add_line((0, -radius), (long, -radius))
    space.add_arc((long, 0), radius, 270, 90)
    space.add_line((long, radius), (0, radius))
    space.add_arc((0, 0), radius, 90, 270)
    for x in (0, long):
        space.add_circle((x, 0), HOLE / 2 / scale)
    space.add_text("coupler")
    document.saveas(path)
    return path


def ring(offset: float, chord: float) -> np.ndarray:  # type: ignore[type-arg]
    """(n, 2) corners of the parallel of the coupler's outline, clockwise from the middle of its lower edge, mm."""
    radius = ROUND + offset
    steps = math.ceil(math.pi / (2 * math.acos(1 - chord / radius)))
    turn = np.linspace(-math.pi / 2, math.pi / 2, steps + 1)
    right = np.column_stack((LONG + radius * np.cos(turn), radius * np.sin(turn)))
    left = np.column_stack((-radius * np.cos(turn), -radius * np.sin(turn)))
    points = np.concatenate(([[LONG / 2, -radius]], right, left, [[LONG / 2, -radius]]))
    return points[::-1]


def coupler_program(*, chord: float = 0.002, hold: str = "vacuum", mill: float = 6.0) -> str:
    """The program of some other CAM for LinuxCNC: T1 the mill, T2 a drill of 5 mm; arcs are chords.

    On ``tabs`` the last pass rises over four of them, 5 mm wide and 1.2 mm high, where it pleases.
    """
    off = mill / 2 + chord + 0.001
    points = ring(off, chord)
    lines = [
        *("%", "(SOMECAM 3.1)", "(COUPLER)", "N10 G90 G94 G17 G91.1", "N15 G21", "N20 G40 G49 G80"),
        *("N22 G64 P0.002", "N25 G53 G0 Z0.", "(DRILL)", "N30 T2 M6", "N35 S6000 M3", "N40 G54"),
        *("N45 M8", "N50 G0 X0. Y0.", "N55 G43 Z15. H2", "N60 G0 Z5."),
        *("N65 G98 G83 X0. Y0. Z-8. R2. Q2. F200.", f"N70 X{LONG:.3f}", "N75 G80", "N80 G0 Z15."),
        *("N85 M9", "N90 M5", "N95 G53 G0 Z0.", "(CONTOUR)", "N100 T1 M6", "N105 S8000 M3", "N110 G54"),
        *("N115 M8", f"N120 G0 X{points[0, 0]:.4f} Y{points[0, 1]:.4f}", "N125 G43 Z15. H1", "N130 G0 Z2."),
        "N135 G1 Z0.05 F150.",
    ]
    depth = 0.0
    for bottom in (-1.4, -2.8, -4.2, -5.6, -6.2):
        # Down on a ramp along the lower edge and back; then once around.
        lines += [f"G1 X{LONG / 2 - 30:.4f} Z{(depth + bottom) / 2:.4f} F300."]
        lines += [f"X{LONG / 2:.4f} Z{bottom:.4f}", "F600."]
        lines += over_tabs(points, mill) if hold == "tabs" and bottom == -6.2 else plain(points)
        depth = bottom
    return "\n".join([*lines, "G0 Z15.", "M9", "M5", "G53 G0 Z0.", "M30", "%"]) + "\n"


def plain(points: np.ndarray) -> list[str]:  # type: ignore[type-arg]
    return [f"X{x:.4f} Y{y:.4f}" for x, y in points[1:].tolist()]


def over_tabs(points: np.ndarray, mill: float) -> list[str]:  # type: ignore[type-arg]
    """The last pass, lifted over tabs at a seventh, three, five and six sevenths of the way."""
    line = shapely.LineString(points)
    lifts = [(share * line.length - (5 + mill) / 2, share * line.length + (5 + mill) / 2) for share in SHARES]
    stations = sorted({*(line.project(shapely.Point(p)) for p in points[1:-1].tolist()), *sum(lifts, ())})
    found = []
    for station in [*stations, line.length]:
        at = line.interpolate(station)
        up = any(a < station <= b for a, b in lifts)
        found.append(f"X{at.x:.4f} Y{at.y:.4f}")
        if any(station == a for a, _ in lifts):
            found.append("Z-4.8 F300.")
        elif up and any(station == b for _, b in lifts):
            found.append("Z-6.2 F150.\nF600.")
    return found


SHARES = (0.15, 0.4, 0.62, 0.88)


def freecad_gear() -> str:
    """The gear-like profile of a job in FreeCAD, in the form of its linuxcnc post: what it does not say is told.

    The post begins without a retract, changes tools without one, uses no length offset that is stated before Z
    moves, has no path tolerance, no coolant, and plunges with a tool down in one go; nothing holds the part.
    """
    lines = [
        *(
            "(Exported by FreeCAD)",
            "(Post Processor: linuxcnc_post)",
            "(begin preamble)",
            "G17 G54 G40 G49 G80 G90",
        ),
        *("G21", "(begin operation: Fixture)", "G54", "(begin toolchange: TC: 6mm Endmill)", "M5", "M6 T1"),
        *("G43 H1", "M3 S8000", "(begin operation: Profile)", "G0 Z8.000", "G0 X0.000 Y-13.000", "G0 Z3.000"),
        *("G1 X0.000 Y-13.000 Z-6.200 F200.000",),
    ]
    lines += [f"G1 X{x:.3f} Y{y:.3f} Z-6.200 F600.000" for x, y in ring(3.0, 0.05).tolist()]
    return "\n".join([*lines, "G0 Z8.000", "(begin postamble)", "M5", "G17 G54 G90 G80 G40", "M2"]) + "\n"

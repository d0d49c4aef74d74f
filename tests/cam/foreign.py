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


def freecad_gear(rim: np.ndarray, within: float = 0.03) -> str:  # type: ignore[type-arg]
    """The program of a job in FreeCAD for a gear 10 mm thick, as its post for LinuxCNC writes it.

    Drilling, helix and profile with cutting data, depths per pass and coolant that are right: what is left are
    the habits of planner and post. ``rim`` (n, 2) is the outline, mm, which its way keeps to ``within`` so much. T10
    is a drill of 10 mm, T27 a mill of 3 mm.
    """
    drill = [
        "G0 X0.000 Y0.000",
        "G0 Z3.000",
        "G98",
        "G83 X0.000 Y0.000 Z-13.500 F245.000 Q5.000 R1.000",
        "G80",
    ]
    helix = ["G0 X4.500 Y0.000", "G0 Z3.000", "G1 X4.500 Y0.000 Z0.000 F150.000"]
    for half in range(1, 21):
        x = 4.5 if half % 2 == 0 else -4.5
        helix.append(
            f"G3 X{x:.3f} Y0.000 Z{-10.4 * half / 20:.3f} I{-4.5 if half % 2 else 4.5:.3f} J0.000 F300.000"
        )
    helix += ["G3 X-4.500 Y0.000 Z-10.400 I-4.500 J0.000 F300.000"]
    helix += ["G3 X4.500 Y0.000 Z-10.400 I4.500 J0.000 F300.000", "G1 X4.000 Y0.000 Z-10.400 F300.000"]
    # Chords of the cutter's way: into the tops of the teeth, and short of their roots.
    way = shapely.Polygon(rim).buffer(1.5, quad_segs=64).exterior.simplify(within)
    points = np.asarray(way.coords)[::-1]
    profile = ["G0 X{:.3f} Y{:.3f}".format(*points[0]), "G0 Z3.000"]
    for depth in (*np.arange(1.4, 10.4, 1.4).tolist(), 10.4):
        profile.append("G1 X{:.3f} Y{:.3f} Z{:.3f} F120.000".format(*points[0], -depth))
        profile += [f"G1 X{x:.3f} Y{y:.3f} Z{-depth:.3f} F300.000" for x, y in points[1:].tolist()]
    return "\n".join(
        [
            *("(Exported by FreeCAD)", "(Post Processor: linuxcnc_post)", "(begin preamble)"),
            *(
                "G17 G54 G40 G49 G80 G90",
                "G21",
                "(begin operation: Fixture)",
                "(machine units: mm/min)",
                "G54",
            ),
            *("(finish operation: Fixture)", *changed("TC: 10mm Drill", 10, 2228)),
            *operation("Drilling", drill),
            *changed("TC: 3mm Endmill", 27, 10000),
            *operation("Helix", helix),
            *operation("Profile", ["(Compensated Tool Path. Diameter: 3.0)", *profile]),
            *("(begin postamble)", "M05", "G17 G54 G90 G80 G40", "M2", ""),
        ]
    )


def changed(name: str, tool: int, rpm: int) -> list[str]:
    """A tool controller: no way up before M6, as the last operation has left the tool at its clearance height."""
    return [
        *(f"(begin operation: {name})", "(machine units: mm/min)", f"({name})", "(begin toolchange)", "M5"),
        *(f"M6 T{tool}", f"G43 H{tool}", f"M3 S{rpm}", f"(finish operation: {name})"),
    ]


def operation(name: str, moves: list[str]) -> list[str]:
    return [
        *(f"(begin operation: {name})", "(machine units: mm/min)", "(Coolant On:Flood)", "M8", f"({name})"),
        *("G0 Z5.000", *moves, "G0 Z5.000", f"(finish operation: {name})", "(Coolant Off:Flood)", "M9"),
    ]

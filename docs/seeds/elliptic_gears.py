"""Compares the published figure-eight trains with the code.

``python docs/seeds/elliptic_gears.py`` writes the page anew.
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechwright.designs.design import load
from mechwright.mechanics.peak import Peak
from mechwright.plugins.host import host
from mechwright_elliptic_gears.as_made.pairs import phase_sensitivity
from mechwright_elliptic_gears.kinematics.equations import phase_offset, ratio
from mechwright_elliptic_gears.kinematics.figures import point_peaks, point_window
from mechwright_elliptic_gears.kinematics.joint_load import greatest_torque
from mechwright_elliptic_gears.kinematics.peak import peak
from mechwright_elliptic_gears.kinematics.point import speed_of_q
from mechwright_elliptic_gears.kinematics.window import Window
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.clamp import clamp_of
from mechwright_elliptic_gears.parts.layout import dividing_of
from mechwright_elliptic_gears.rules.pins import pin_play, shifted_window

HERE = Path(__file__).parent
PRINTED = json.loads((HERE / "elliptic-gears.json").read_text(encoding="utf-8"))
PAGE = HERE / "elliptic-gears.md"

LISTED = 1.0
"""rad. The source lists windows of about this length and says none of shorter ones."""

MISPRINT = (0, 0.6)
"""Phase (degrees) and eccentricity of the cell whose acceleration is printed with a digit missing."""

VARIABLE = HERE.parents[1] / "examples" / "figure-eight-variable.toml"
"""One machine for all phases."""

BEST = (85.93, 0.3358)
"""Phase (degrees) and eccentricity that the synthesis finds."""


@dataclass(frozen=True)
class Cell:
    """One cell of both tables: what is printed, and what the code gives."""

    phase: int
    eccentricity: float
    printed: dict[str, Any]
    speed: Peak
    acceleration: Peak
    window: Window

    @property
    def is_misprint(self) -> bool:
        """Whether the printed acceleration lacks a digit."""
        return (self.phase, self.eccentricity) == MISPRINT

    @property
    def speed_error(self) -> float:
        """Printed over computed peak speed, less 1."""
        return self.printed["speed"] / self.speed.value - 1

    @property
    def acceleration_error(self) -> float:
        """Printed over computed peak acceleration, less 1."""
        return 1000 * self.printed["acceleration"] / self.acceleration.value - 1

    @property
    def end(self) -> float:
        """End of the window, rad."""
        return self.window.start + self.window.length


def design(phase: float, eccentricity: float) -> EllipticGearParams:
    """The published train with this phase angle, degrees, and eccentricity."""
    return EllipticGearParams(
        stages=2,
        phase=phase,
        eccentricity=eccentricity,
        semi_major=PRINTED["semi_major_mm"],
        speed=PRINTED["omega2_rad_per_s"] * 60 / math.tau,
        band=PRINTED["band_mm_per_s"],
        bore=12,
    )


def cells() -> list[Cell]:
    """All twenty cells."""
    found = []
    for printed in PRINTED["cells"]:
        params = design(printed["phase"], printed["eccentricity"])
        top = point_peaks(params, ("speed", "acceleration"))
        found.append(
            Cell(
                printed["phase"],
                printed["eccentricity"],
                printed,
                top["speed"],
                top["acceleration"],
                point_window(params),
            )
        )
    return found


def table3(rows: list[Cell]) -> list[str]:
    """Peak speeds and accelerations."""
    lines = [
        "| γ, e | speed printed | computed | at θ2 | error | acceleration printed | computed | at θ2 | "
        "error |",
        "| --- " * 9 + "|",
    ]
    for cell in rows:
        error = "**misprint**" if cell.is_misprint else f"{cell.acceleration_error:+.3%}"
        lines.append(
            f"| {cell.phase}°, {cell.eccentricity} | {cell.printed['speed']:g} | {cell.speed.value:.2f} "
            f"| {cell.speed.angle:.3f} | {cell.speed_error:+.3%} | {cell.printed['acceleration']:g} "
            f"| {cell.acceleration.value / 1000:.4f} | {cell.acceleration.angle:.3f} | {error} |"
        )
    return lines


def table2(rows: list[Cell]) -> list[str]:
    """Windows of near-constant speed."""
    lines = [
        "| γ, e | printed θ2 | computed θ2 | length printed | computed | speed printed | computed |",
        "| --- " * 7 + "|",
    ]
    for cell in rows:
        computed = f"{cell.window.start:.3f}–{cell.end:.3f}"
        speed = f"{cell.window.low:.2f}–{cell.window.low + PRINTED['band_mm_per_s']:.2f}"
        window = cell.printed["window"]
        start = f"| {cell.phase}°, {cell.eccentricity} "
        if window is None:
            lines.append(f"{start}| none | {computed} | <{LISTED:g} | {cell.window.length:.3f} | | {speed} |")
        else:
            one, two, low, high = window
            lines.append(
                f"{start}| {one:g}–{two:g} | {computed} | {two - one:.2f} | {cell.window.length:.3f} "
                f"| {low:g}–{high:g} | {speed} |"
            )
    return lines


def errata(rows: list[Cell]) -> list[str]:
    """What is wrong or missing in the source, with the figures that show it."""
    cell = {(row.phase, row.eccentricity): row for row in rows}
    naive = naive_peak()
    missing = cell[MISPRINT].acceleration.value / 1000
    best = point_window(design(*BEST))
    small = [cell[phase, 0.2].speed.value for phase in (0, 45)]
    split, listed, unlisted = cell[90, 0.4], cell[90, 0.6], cell[135, 0.6]
    return [
        "1. (3) holds as a vector product; read with magnitudes it loses the sign of (4).",
        "2. (5), (19), (22): the ratio is −(1 − e²)/D; the gears turn in opposite directions.",
        "3. (6), (20), (23): the first term is +2 e (1 − e²) sin θ / D² ω².",
        "4. (7), (21): the radicand −(1 − e²)² is negative. The logarithm has twice its right factor and "
        "jumps by 2π. The code has θ4 = 2π − 2 atan2((1 + e) sin(θ2/2), (1 − e) cos(θ2/2)), continued over "
        "any number of turns.",
        "5. (8) holds modulo 2π; (11) to (16) and the equations of θ6 and Q of the train are missing.",
        "6. (17) φ is never given. φ is not γ: with φ = γ the cell γ = 45°, e = 0.8 would have a peak speed "
        f"of {naive:.0f} mm/s, where {cell[45, 0.8].printed['speed']:g} is printed. φ = −θ3(γ) "
        f"({math.degrees(phase_offset(math.pi / 2, 0.4)):.3f}° for γ = 90°, e = 0.4) agrees with all cells "
        "but the misprint.",
        "7. (18) The principal arccos turns gear 3 the wrong way for 0 < θ2 < π.",
        "8. θ3 and ω3 mean both the coupler of a pair and gear 3 of the train; its coupler is link 6.",
        f"9. Table 3, γ = 0, e = 0.6: {cell[MISPRINT].printed['acceleration']:g} stands for {missing:.0f}. "
        "The misprint contradicts the text, which calls γ = 0 the largest: γ = 45° has "
        f"{cell[45, 0.6].printed['acceleration']:g}.",
        f"10. Table 2, γ = 90°, e = 0.4: the band 188 to 198 has to be {split.window.low:.2f} to "
        f"{split.window.low + 10:.2f}; with the printed band the window splits.",
        f"11. Table 2 lists γ = 90°, e = 0.6 with {listed.window.length:.3f} rad, but not γ = 135°, e = 0.6 "
        f"with {unlisted.window.length:.3f} rad.",
        '12. "At equal e, γ = 0 has the largest variation" is false for the speed at e = 0.2: the peak is '
        f"{small[0]:.1f} mm/s at γ = 0 and {small[1]:.1f} at 45°.",
        '13. The "1.4 rad" of a single pair is that of e = 0.8 only; table 1 is missing. A train with γ = '
        f"180° moves as a single pair does: {cell[180, 0.8].window.length:.3f} rad.",
        f'14. "The longest is 2.21 rad" holds on the grid of the table only: e = {BEST[1]}, γ = {BEST[0]}° '
        f"has {best.length:.3f} rad, from {best.start:.3f} to {best.start + best.length:.3f}.",
    ]


def naive_peak() -> float:
    """Peak speed, mm/s, of the cell γ = 45°, e = 0.8 if φ were γ: of the phase whose offset is 45°."""
    k = (1 + 0.8) / (1 - 0.8)
    phase = 2 * math.atan(math.tan(math.pi / 8) / k)
    return point_peaks(design(math.degrees(phase), 0.8), ("speed",))["speed"].value


def variable_table() -> list[str]:
    """What the machine of the example does at each phase of its joint."""
    machine = load(VARIABLE, host()).params
    lines = [
        "| γ | φ | dφ/dγ | speed of Q | acceleration | window | half a degree of the joint more, less | "
        "torque of the joint |",
        "| --- " * 8 + "|",
    ]
    for phase in machine.set_phases:
        one = machine.model_copy(update={"phase": phase})
        gamma, e, scale = math.radians(phase), one.eccentricity, one.semi_major * one.speed * math.tau / 60
        least = -peak(lambda t, gamma=gamma, e=e, scale=scale: -scale * speed_of_q(t, e, gamma)).value
        top = point_peaks(one, ("speed", "acceleration"))
        length = point_window(one).length
        more, less = (shifted_window(one, math.radians(turn)).length - length for turn in (0.5, -0.5))
        lines.append(
            f"| {phase:g}° | {math.degrees(phase_offset(gamma, e)):.3f}° | "
            f"{-float(ratio(math.cos(gamma), e)):.4f} "
            f"| {least:.2f} to {top['speed'].value:.2f} | {top['acceleration'].value / 1000:.3f} "
            f"| {length:.3f} | {_signed(more)}, {_signed(less)} "
            f"| {greatest_torque(one, phase).value:.3f} |"
        )
    return lines


def _signed(value: float) -> str:
    return "0" if abs(value) < 5e-4 else f"{value:+.3f}".replace("-", "−")


def variable() -> list[str]:
    """The section on the machine whose phase is set."""
    machine = load(VARIABLE, host()).params
    clamped = machine.model_copy(update={"phase_joint": "clamp"})
    holes = ", ".join(f"{hole.phase:g}" for hole in dividing_of(machine).holes)
    play = math.degrees(pin_play(machine) / 2)
    return [
        "The source turns the first pair by γ, then joins gears 3 and 4. How the machine does so, and how γ "
        "is changed, is not stated. Only the angle φ between the two gears changes: gears, axes, coupler and "
        "figure stay. [`figure-eight-variable.toml`](../../examples/figure-eight-variable.toml) is one "
        f"machine with a pin in one of five holes ({holes} degrees). Its rows of e = 0.4, speeds in mm/s, "
        "acceleration in 1000 mm/s², windows in rad, torque in N m:",
        "",
        *variable_table(),
        "",
        f"The play of the pin turns gear 4 by ±{play:.3f}°. The speed changes by at most "
        f"{phase_sensitivity(machine):.4f} of that angle, "
        f"±{100 * phase_sensitivity(machine) * math.radians(play):.2f} %, at every phase. The window of γ = "
        "90° ends at an edge: set the joint on the side of more. A clamp in place of the pin transmits "
        f"{clamp_of(clamped).torque(machine.material):.1f} N m.",
        "",
        "`mechwright solve` writes `figure-eight.html`, with sliders for phase and eccentricity and with "
        "both tables. [The family's page](../elliptic-gears.md) has parts, strength and limits.",
    ]


FIGURES = (
    ("3", "pitch curves of a pair", "the same, with teeth: [picture](../images/elliptic-pair.svg)"),
    (
        "7",
        "train from above and from the side, gear 4 at 0 while gear 2 is at γ",
        "the order of assembly: [setting the phase](../elliptic-gears.md)",
    ),
    (
        "8",
        "train at any angle, φ between gears 3 and 4",
        "[picture](../images/figure-eight.svg), `motion.html`",
    ),
    (
        "9",
        "coupler 6 on J and K of the second pair, Q in its middle",
        "the same picture; `figure-eight.html`",
    ),
    ("8 (a) to (e), second of that number", "speed of Q, five phases, four e", "charts below, left"),
    ("13 (a) to (e)", "acceleration of Q", "charts below, right"),
    ("14", "outline in CAM, 10 mm thick", "`thickness = 10`, DXF and STEP of each gear"),
    (
        "20 to 22",
        "setter for Z, G54, G43",
        "setup sheets: the order of touching off, work offset, tool table",
    ),
    ("23", "a milled gear", "programs of all plates, proven, and [as made](../as-made.md)"),
    (
        "24",
        "prototype, two photographs",
        "[figure-eight-machine](../../examples/figure-eight-machine.toml): 63 bodies on a base, with motor",
    ),
    ("Table 1", "lost: near-constant speed of a single pair", "erratum 13; a train with γ = 180° moves so"),
    ("Tables 2, 3", "windows and peaks", "the tables above, row by row"),
    ("1, 2, 4 to 6, 10 to 12, 15 to 19", "", "not in the text at hand"),
)
"""Figure of the source, what it shows, and where ours is."""


def page() -> str:
    """The whole page."""
    rows = cells()
    listed = [row for row in rows if row.printed["window"] is not None]
    ends = max(
        max(abs(row.printed["window"][0] - row.window.start), abs(row.printed["window"][1] - row.end))
        for row in listed
    )
    speed = max(abs(row.speed_error) for row in rows)
    acceleration = max(abs(row.acceleration_error) for row in rows if not row.is_misprint)
    lines = [
        "# The published figure-eight trains, and the code",
        "",
        "<!-- written by elliptic_gears.py in this folder; do not edit -->",
        "",
        "The source is the report NSC 94-2212-E-150-038 on elliptic gear trains that draw a figure of eight "
        "with a variable speed. Table 3 prints peak speeds and accelerations of point Q, table 2 the parts "
        "of a turn with near-constant speed. The dimensions are not printed. One set reproduces all cells: a "
        "= 50 mm, ω2 = 10 rad/s, counter-clockwise, Q in the middle of the coupler, φ = −θ3(γ). [The "
        "family's page](../elliptic-gears.md) has the equations.",
        "",
        "## Table 3: peaks of Q",
        "",
        "Speeds in mm/s, accelerations in 1000 mm/s², θ2 in rad (the first of two mirrored peaks). The error "
        "is printed − computed.",
        "",
        *table3(rows),
        "",
        f"20 of 20 speeds agree within {speed:.3%}, 19 of 20 accelerations within {acceleration:.3%}; the "
        "twentieth is a misprint. The differences come from rounding and a coarse grid: most printed peaks "
        "lie just below the true ones.",
        "",
        "## Table 2: near-constant speed",
        "",
        "The window is the longest part of a turn, taken cyclically, on which the speed of Q spreads by at "
        "most 10 mm/s. θ2 in rad, speeds in mm/s.",
        "",
        *table2(rows),
        "",
        f"The ends of the {len(listed)} printed windows are read off charts and agree within {ends:.3f} rad.",
        "",
        "## One machine, five phases",
        "",
        *variable(),
        "",
        "## Figures of the source",
        "",
        "| figure | shows | ours |",
        "| --- | --- | --- |",
        *(f"| {number} | {shows} | {ours} |" for number, shows, ours in FIGURES),
        "",
        "![Speed and acceleration of Q over a turn](../images/figure-eight-charts.svg)",
        "",
        "Lines end at 3,500 mm/s and 350,000 mm/s², as in the source; θ2 in rad. At γ = 0 and e = 0.8 the "
        "peaks are 28,800 and 26.6 million.",
        "",
        "## Errata of the source",
        "",
        "Roots, brackets and some signs are lost in the text at hand; printed equations are as read.",
        "",
        *errata(rows),
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")

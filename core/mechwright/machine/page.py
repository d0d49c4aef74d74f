"""``drive.html`` and ``drive.json``: torque over the turn, what it is made of, and the motor."""

import json
import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright.machine.drive import Drive
from mechwright.machine.electrics import supply_of
from mechwright.machine.made import drive_for, electrics_for, motion_for, motor_for, settings_of, wanted_of
from mechwright.machine.motor_findings import speed_said
from mechwright.machine.motors import Choice, curve_of
from mechwright.machine.plots import Line, key, plot, said
from mechwright.machine.settings import MachineSettings
from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.figures import Figure, Grid, figures_page
from mechwright.pipeline.page import FileName, Page
from mechwright.standards.motors import GearMotor
from mechwright.standards.supply import Supply

HTML, JSON = "drive.html", "drive.json"
"""The files."""

FIGURES: Mapping[str, tuple[str, str]] = {
    "peak_torque": ("greatest torque of the drive", "N*m"),
    "peak_angle": ("input angle there", "deg"),
    "rms_torque": ("torque, root mean square over time", "N*m"),
    "greatest_speed": ("greatest speed of the input", "rev/min"),
    "greatest_power": ("greatest power", "W"),
    "mean_power": ("mean power", "W"),
    "greatest_inertia": ("greatest inertia that the input feels", "kg*m^2"),
    "least_inertia": ("least", "kg*m^2"),
    "work_swing": ("swing of the work about its mean", "J"),
    "flywheel": ("inertia of a flywheel for the speed variation", "kg*m^2"),
    "motor_peak": ("peak torque at the motor, with the margin", "N*m"),
    "motor_rms": ("rms torque at the motor, with the margin", "N*m"),
    "motor_speed": ("greatest speed of the motor", "rev/min"),
    "motor_cover": ("times that the motor covers this", ""),
    "least_driven_speed": ("least speed of the input over the turn with this motor", "rev/min"),
    "mean_driven_speed": ("mean over time", "rev/min"),
    "greatest_driven_speed": ("greatest", "rev/min"),
    "motor_voltage": ("voltage of the motor, or of its driver, there", "V"),
    "supply_voltage": ("voltage of the power supply", "V"),
    "supply_current": ("its current at least", "A"),
    "current_limit": ("current limit of the driver, for the gearbox", "A"),
    "inertia_ratio": ("inertia that its rotor feels, over its own", ""),
}
"""Name in ``drive.json`` to words and unit."""


class DrivePage(Page):
    """Torque over the turn, what it is made of, inertia and power, and the motor."""

    name = "drive"
    commands = frozenset({"model", "build"})
    doing = "the drive"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Both files."""
        return [FileName(name, "the drive") for name in (HTML, JSON)] if wanted_of(build) else []

    def files(self, build: Build) -> Mapping[str, str]:
        """Nothing where the design says nothing of a machine."""
        if not wanted_of(build):
            return {}
        drive, choice, settings = build.made(drive_for), build.made(motor_for), settings_of(build)
        values = figures_of(drive, settings, choice)
        numbers = {name: {"value": value, "unit": FIGURES[name][1]} for name, value in values.items()}
        motor = {} if choice is None else {"motor": choice.motor.name}
        html = figures_page(
            build.design.name,
            f"{build.design.family.title}: drive",
            _notes(settings, choice),
            _figures(build.made(motion_for).input_name, drive, choice),
            [_table(values), *_to_buy(build.made(electrics_for))],
        )
        return {HTML: html, JSON: json.dumps({**motor, "figures": numbers}, indent=2) + "\n"}


def figures_of(drive: Drive, settings: MachineSettings, choice: Choice | None) -> dict[str, float]:
    """The figures that there are, by the names of :data:`FIGURES`."""
    peak, at, _ = drive.peak()
    power, mean = drive.power
    found: dict[str, float | None] = {
        "peak_torque": peak,
        "peak_angle": math.degrees(at),
        "rms_torque": drive.rms,
        "greatest_speed": drive.speed * 60 / math.tau,
        "greatest_power": power,
        "mean_power": mean,
        "greatest_inertia": float(drive.reflected.max()),
        "least_inertia": float(drive.reflected.min()),
        "work_swing": drive.swing,
        "flywheel": drive.flywheel(settings.variation),
    }
    if choice is not None:
        found |= {
            "motor_peak": choice.demand.peak,
            "motor_rms": choice.demand.rms,
            "motor_speed": choice.demand.speed,
            "motor_cover": choice.cover,
            **_speeds(choice),
            **_supply(choice),
            "inertia_ratio": choice.ratio,
        }
    return {
        name: float(f"{value:.{_DIGITS}g}")
        for name, value in found.items()
        if value is not None and math.isfinite(value)
    }


def _speeds(choice: Choice) -> dict[str, float | None]:
    seen = choice.speed
    if seen is None or seen.stalls:
        return {}
    least, mean, most = (one * 60 / math.tau for one in (seen.least, seen.requested, seen.greatest))
    return {
        "least_driven_speed": least,
        "mean_driven_speed": mean,
        "greatest_driven_speed": most,
        "motor_voltage": seen.voltage,
    }


def _supply(choice: Choice) -> dict[str, float | None]:
    """What feeds the motor; nothing for one that is not enough."""
    if not choice.enough:
        return {}
    volts, least = supply_of(choice)
    limit = choice.motor.current_limit if isinstance(choice.motor, GearMotor) else None
    return {"supply_voltage": volts, "supply_current": least, "current_limit": limit}


def _to_buy(supplies: Sequence[Supply]) -> list[Grid]:
    rows = [[one.name, one.order, one.note] for one in supplies]
    return [Grid("To buy for the motor", ["", "order as", "why"], rows)] if rows else []


_NOTHING = 1e-8
"""Share of the peak below which a part of the torque is rounding."""

_DIGITS = 9
"""Significant digits of a figure: differences of samples are right to them."""


def _notes(settings: MachineSettings, choice: Choice | None) -> list[str]:
    weights = "left out" if settings.up == "none" else f"taken with {settings.up} up"
    gear = "" if settings.gear == 1 else f" through a gear of {settings.gear:g}"
    motor = (
        "No motor is asked for."
        if choice is None
        else f"{choice.motor.name}{gear} covers {choice.cover:.3g} times what is asked, a margin of "
        f"{settings.margin:g} in it."
    )
    said = "" if choice is None else speed_said(choice)
    return [
        motor,
        *([f"{said[0].upper()}{said[1:]}."] if said else []),
        "Torque of accelerated masses as parts and materials have them, of loads, and of weights "
        f"({weights}); friction is in the margin alone. Positive torque drives, negative torque brakes.",
    ]


def _figures(name: str, drive: Drive, choice: Choice | None) -> list[Figure]:
    peak = drive.peak()
    angle, across = np.degrees(drive.course.angle), f"{name}, deg"
    place = math.degrees(peak[1])
    if drive.course.rocks:
        angle, across = drive.course.time, "time, s"
        run = next(run for run in drive.runs if run.name == peak[2])
        place = float(angle[np.argmax(np.abs(run.torque))])
    runs = [Line(run.name, angle, run.torque) for run in drive.runs]
    parts = [
        Line(words, angle, values)
        for words, values in (
            ("accelerated masses", drive.inertia),
            ("weights", drive.weight),
            ("given loads", drive.given),
            ("resistance", drive.resisting),
        )
        if np.abs(values).max() > _NOTHING * abs(peak[0])
    ]
    mark = (place, peak[0], f"{said(peak[0])} N·m")
    power = [Line(run.name, angle, run.power) for run in drive.runs]
    found = [
        Figure("Torque of the input", plot(runs, across, "N·m", [mark]), f"In its sense; {key(runs)}."),
        Figure("Power", plot(power, across, "W"), f"{key(power).capitalize()}."),
    ]
    if parts:
        words = f"About the angle of the motion, forwards; {key(parts)}."
        found.insert(1, Figure("What it is made of", plot(parts, across, "N·m"), words))
    felt = [Line("inertia", angle, 1e6 * drive.reflected)]
    found.append(
        Figure("Inertia that the input feels", plot(felt, across, "kg·mm²"), "All that moves, reduced to it.")
    )
    if choice is not None:
        found += [*_speed(name, choice), _motor(choice)]
    return found


def _speed(name: str, choice: Choice) -> list[Figure]:
    """The speed of the input over the turn with a gear motor; nothing of a stepper, which keeps its steps."""
    seen = choice.speed
    if seen is None or seen.stalls or choice.ratio is not None:
        return []
    angle, rate = np.degrees(seen.angle), seen.speed * 60 / math.tau
    mean = np.full(angle.size, seen.requested * 60 / math.tau)
    lines = [Line(seen.run, angle, rate), Line("requested", angle, mean, dashed=True)]
    words = (
        f"At a constant {seen.voltage:.3g} V the motor drives and brakes along its line. Inertia of the "
        "mechanism evens the speed out; that of the motor's own rotor is not counted. "
        f"{key(lines).capitalize()}; more than {100 * choice.variation:g} % off is refused."
    )
    return [Figure("Speed of the input", plot(lines, f"{name}, deg", "rev/min"), words)]


def _motor(choice: Choice) -> Figure:
    asked = choice.demand
    speeds, torques = curve_of(choice)
    lines = [Line("may be asked for a moment", speeds, torques)]
    mark = (asked.speed, asked.peak, "peak asked")
    return Figure(
        f"Motor {choice.motor.name}",
        plot(lines, "rev/min of its shaft", "N·m", [mark]),
        f"What it may be asked for over its speed; the peak that is asked is {asked.peak:.3g} N·m at "
        f"{asked.speed:.4g} rev/min.",
    )


def _table(values: Mapping[str, float]) -> Grid:
    units = {"N*m": "N·m", "kg*m^2": "kg·m²"}
    rows = [
        [FIGURES[name][0], said(value), units.get(FIGURES[name][1], FIGURES[name][1])]
        for name, value in values.items()
    ]
    return Grid("Figures of the drive, the greater of both senses", ["", "value", "unit"], rows)

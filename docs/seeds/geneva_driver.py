"""The part of the page on the Geneva mechanism about its driver: (6) to (9) in general, and the walls."""

import math
from collections.abc import Iterator
from pathlib import Path

import geneva_machine
import numpy as np

from mechwright.mechanics.planar import Turning
from mechwright.pipeline.figures.sheet import INK, LINKS, Window
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.contact_forces import contact
from mechwright_geneva.kinematics.figures import rate_peaks
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.wall_change import switches, torque
from mechwright_geneva.parameters import GenevaParams

IMAGES = Path(__file__).parents[1] / "images"
WORKED: dict[str, object] = {
    "crank_half_angle": 50,
    "offset_angle": 5,
    "entry_radius": 100,
    "roller_radius": 5,
}

INSTANTS = (
    (25, math.tau, 0, 0),
    (25, math.tau, 20, 0),
    (60, 5, -30, 100),
    (80, -4, 10, -50),
    (50, 3, 50, 0),
    (37.5, 10, -100, 2000),
)
"""θd, degrees, and the driver's speed, acceleration and jerk there."""

LAWS: tuple[tuple[str, dict[str, object]], ...] = (
    ("constant, 60 rev/min", {}),
    ("harmonic, v = 0.05", {"driver_law": "harmonic", "driver_variation": 0.05}),
    ("harmonic, v = 0.10", {"driver_law": "harmonic", "driver_variation": 0.1}),
    ("from rest, 10 rad/s²", {"driver_law": "from-rest", "driver_acceleration": 10}),
)

CARRIED: tuple[tuple[str, dict[str, object]], ...] = (
    ("inertia alone, constant speed", {}),
    ("load 0.1 N·m", {"load_torque": 0.1}),
    ("load 0.5 N·m", {"load_torque": 0.5}),
    ("load 1 N·m", {"load_torque": 1.0}),
    ("load 0.5 N·m, 120 rev/min", {"load_torque": 0.5, "speed": 120}),
    ("load 1.3 N·m", {"load_torque": 1.3}),
    ("from rest, 10 rad/s²", {"driver_law": "from-rest", "driver_acceleration": 10}),
    ("slowing down, -3 rad/s²", {"driver_law": "accelerating", "driver_acceleration": -3}),
)

SLOTS: tuple[tuple[str, str, dict[str, object]], ...] = (
    ("geneva-6-loop", "6: a loop, equation (33)",
     {"crank_half_angle": 60, "offset_angle": 0, "roller_radius": 4}),
    ("geneva-undercut", "undercut, and the walls cross",
     {"crank_half_angle": 60, "offset_angle": 0, "roller_radius": 8}),
    ("geneva-neither", "neither: the worked reference", WORKED),
    ("geneva-swallowtail", "undercut without a loop at the mouth", {**WORKED, "roller_radius": 8}),
)  # fmt: skip
"""Picture, what it shows, and the design on a wheel of 100 mm; the lost figures of undercut are ours."""


def worked(**table: object) -> Mechanism:
    return mechanism_of(GenevaParams.model_validate({**WORKED, **table}))


def instants() -> Iterator[list[str]]:
    """The wheel's rates by (6), (7) and the jerk."""
    m = worked()
    for degrees, omega, alpha, jerk in INSTANTS:
        theta = np.array([math.radians(degrees)])
        run = m.stroke(theta / (2 * m.crank_half))
        rates = Turning.of(theta, omega, alpha, jerk).carried(run.first, run.second, run.third)
        said = [f"{float(rate[0]) + 0.0:.10f}" for rate in rates]
        # The jerk in the middle of a quarter is 0 but for rounding.
        said = ["0.0000000000" if abs(float(one)) < 1e-9 else one for one in said]
        yield [f"{degrees:g}", f"{omega:.6g}", f"{alpha:g}", f"{jerk:g}", *said]


def peaks() -> Iterator[list[str]]:
    for name, table in LAWS:
        m = worked(**table)
        found = rate_peaks(m)
        time = np.diff(m.driver.time(np.array([0.0, 2 * m.crank_half])))
        yield [name, f"{float(time[0]):.6f}", f"{found.v:.6g}", f"{found.a:.6g}", f"{found.j:.6g}"]


def carried() -> Iterator[list[str]]:
    """Where the wall that carries changes, forwards and backwards."""
    for name, table in CARRIED:
        cells = []
        for direction in ("forwards", "backwards"):
            m = worked(**table, driver_direction=direction)
            changes = [
                f"{math.degrees(one.theta):.6f} {one.wall}"
                + (f" ({one.impact:.1f})" if one.impact is not None else "")
                for one in switches(m)
            ]
            cells.append(", ".join(changes) or "right only")
        yield [name, *cells]


def slot(table: dict[str, object]) -> str:
    """The walls of a slot on the wheel, the roller's way, and the roller at entry, middle and exit."""
    m = mechanism_of(GenevaParams.model_validate({"entry_radius": 100, **table}))
    run = m.stroke(np.linspace(0, 1, 721))
    turn = np.exp(1j * m.wheel_half)
    window = Window.about([0j, *(run.wall(m.roller, LEFT) * turn).tolist()], 0.06)
    rim = m.rim * np.exp(1j * np.linspace(-0.9, 0.9, 181))
    drawn = [window.line(rim, LINKS, 1.2), window.line(run.track * turn, LINKS, 1.0)]
    for side, colour in ((LEFT, "#1f5fa8"), (RIGHT, "#b3261e")):
        drawn.append(window.line(run.wall(m.roller, side) * turn, colour, 1.8))
    for share in (0, 360, 720):
        place = complex(run.track[share] * turn)
        drawn.append(window.circle(place, m.roller, INK, 0.9, stroke_dasharray=window.dashes()))
    drawn.append(window.dot(0j, INK, "O2"))
    key = [("wall α, left", "#1f5fa8"), ("wall α + π, right", "#b3261e"), (f"r = {m.roller:g} mm", INK)]
    return window.picture([*drawn, window.scale(), window.key(key)], "the walls of a slot") + "\n"


def walls() -> str:
    """Torque over the stroke for three cases, in the colour of the wall that carries."""
    cases = (("inertia", {}), ("with 0.5 N·m", {"load_torque": 0.5}), ("from rest", dict(LAWS[3][1])))
    window = Window(complex(-16, -44), complex(108, 49))
    drawn = [
        window.line(np.array([0j, 100 + 0j]), INK, 1.0),
        window.line(np.array([50 - 40j, 50 + 40j]), LINKS),
    ]
    for number, (name, table) in enumerate(cases):
        m = worked(**table)
        u = np.linspace(0, 1, 1001)[1:-1]
        run = m.stroke(u)
        found = contact(m, run)
        values = torque(m, u, 0)
        points = 100 * u + 1j * 24 * values
        for side, colour in ((LEFT, "#1f5fa8"), (RIGHT, "#b3261e")):
            shown = np.where(found.carrier == side, points, np.nan + 0j)
            drawn.append(window.line(shown, colour, (2.6, 1.6, 1.0)[number]))
        at = int(np.argmax(values))
        drawn.append(window.words(complex(points[at]) + complex(2, 1.5), name, INK, 0.8))
    for degrees in (0, 50, 100):
        drawn.append(window.words(complex(degrees - 2, -5), f"{degrees}°", INK, 0.8))
    key = [("left wall carries", "#1f5fa8"), ("right wall carries", "#b3261e")]
    return window.picture([*drawn, window.key(key)], "torque on the wheel over the stroke, by wall") + "\n"


def drawn() -> dict[str, str]:
    """Picture to its content."""
    found = {f"{name}.svg": slot(table) for name, _, table in SLOTS}
    return {**found, "geneva-walls.svg": walls(), **geneva_machine.drawn()}


def draw() -> None:
    """Write the pictures anew."""
    for name, content in drawn().items():
        (IMAGES / name).write_text(content, encoding="utf-8")

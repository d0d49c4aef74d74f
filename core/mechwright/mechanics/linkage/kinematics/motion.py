"""The motion of a design: channels, poses and figures over one period of the input."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mechwright.contracts.figure import scalars
from mechwright.contracts.joint import Joint
from mechwright.contracts.load import Load
from mechwright.contracts.motion import Channel, Motion, Poses, Scalar, Trace
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.linkage.kinematics.channels import PHI, STROKE, input_channels, solution_channels
from mechwright.mechanics.linkage.kinematics.figures import figures_of
from mechwright.mechanics.linkage.kinematics.forces import MILLI, force_channels, peaks_of
from mechwright.mechanics.linkage.kinematics.period import Period, drives_at, period_of
from mechwright.mechanics.linkage.mass import moving_figures
from mechwright.mechanics.linkage.parts.frames import frames_of, joints_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.planar.rigid import BodyMotion


def motion_of(table: AnyPlanarTable, samples: Samples) -> Motion:
    """Sample one period of the input, both ends included; the rules of the motion come first.

    Forces and masses are those of the real parts, and left out where there can be none.
    """
    return motion_over(table, period_of(table, samples))


def motion_over(table: AnyPlanarTable, period: Period) -> Motion:
    """The motion over samples of the input."""
    solution = period.solution
    channels = input_channels(table, period.drive, period.time) | solution_channels(table, solution)
    figures = scalars(figures_of(table))
    masses = table.masses_or_none
    if masses is not None:
        channels |= force_channels(table, solution, masses)
        figures |= {name: Scalar(value, unit) for name, (value, unit) in peaks_of(table).items()}
        figures |= moving_figures(masses, {})
    traces = {
        name: Trace(link, _place(table, link, point)) for name, (link, point) in table.linkage.traces.items()
    }
    return Motion(
        STROKE if table.driver_slides else PHI,
        channels,
        frames_over(table, solution.bodies),
        figures,
        traces,
        held_by(table),
        loads=_loads(table),
    )


def frames_over(table: AnyPlanarTable, bodies: Mapping[str, BodyMotion]) -> Mapping[str, Poses]:
    """Poses of all links, and of the frames on their axes where there are parts."""
    layout = table.layout_or_none
    if layout is not None:
        return frames_of(layout, bodies)
    return {name: body.poses() for name, body in bodies.items()}


def held_by(table: AnyPlanarTable) -> Mapping[str, Joint]:
    """What holds the bodies; of a linkage without parts nothing is known."""
    layout = table.layout_or_none
    return {} if layout is None else joints_of(layout)


def _loads(table: AnyPlanarTable) -> dict[str, Load]:
    found = {}
    for number, load in enumerate(table.loads, start=1):
        place, force = complex(load.place), complex(load.force)
        found[f"load-{number}"] = Load(
            load.link,
            force=(force.real, force.imag, 0.0),
            point=(place.real, place.imag, 0.0),
            torque=(0.0, 0.0, float(load.moment) * MILLI),
        )
    return found


def _place(table: AnyPlanarTable, link: str, point: str) -> tuple[float, float, float]:
    place = complex(table.linkage.points[link][point])
    return place.real, place.imag, 0.0


class _ChannelsOfTable(Mapping[str, Channel]):
    """The channels of a table: motion at once, forces design by design if they are asked for."""

    def __init__(self, table: AnyPlanarTable, samples: int) -> None:
        self._table, self._samples = table, samples
        phases = travelled(2 * np.pi, samples)
        time, drive = drives_at(table, phases)
        self._found = input_channels(table, drive, time)
        self._found |= solution_channels(table, table.solved(drive))

    def _forces(self) -> dict[str, Channel]:
        def compute() -> dict[str, Channel]:
            rows = [motion_of(self._table.row(place), self._samples) for place in range(len(self._table))]
            names = [name for name in rows[0].channels if name not in self._found] if rows else []
            return {
                name: Channel(np.stack([one[name] for one in rows]), rows[0].channels[name].unit)
                for name in names
                if all(name in one.channels for one in rows)
            }

        return self._table.once("force channels", compute)

    def __getitem__(self, name: str) -> Channel:
        return self._found[name] if name in self._found else self._forces()[name]

    def __contains__(self, name: object) -> bool:
        return name in self._found or name in self._forces()

    def __iter__(self) -> Iterator[str]:
        return iter({**self._found, **self._forces()})

    def __len__(self) -> int:
        return len({**self._found, **self._forces()})


def channels_over(table: AnyPlanarTable, samples: int) -> Mapping[str, Any]:
    """The channels (n, samples) of a table over one period of each design."""
    return _ChannelsOfTable(table, samples)

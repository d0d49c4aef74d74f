"""The motion of a design: channels, poses and figures over one period of the input."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from mechwright import Channel, Finding, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.arrays import Array
from mechwright.contracts.figure import scalars
from mechwright.contracts.finding import refuse
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.linkage.mass import moving_figures
from mechwright_linkage.kinematics.channels import PHI, STROKE, input_channels, solution_channels
from mechwright_linkage.kinematics.figures import figures_of
from mechwright_linkage.kinematics.forces import force_channels, peaks_of
from mechwright_linkage.kinematics.linkage_table import LinkageTable, table_of
from mechwright_linkage.kinematics.period import Period, drives_at, period_of
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.parts.design import frames_of, held_by, masses_or_none
from mechwright_linkage.rules.motion_rules import MOTION


def motion_of(params: LinkageParams, samples: Samples) -> Motion:
    """Sample one period of the input, both ends included.

    Forces and masses are those of the real parts, and left out where there can be none.

    Raises
    ------
    KinematicsError
        ``check`` finds an error of the motion; the message is that of the first one.
    """
    refuse_unmoved(params)
    table = table_of(params)
    return motion_over(table, period_of(table, samples))


def refuse_unmoved(params: LinkageParams) -> Sequence[Finding]:
    """What the rules of the motion find; raises KinematicsError where that is an error."""
    found = MOTION.findings(table_of(params))
    refuse(found, Stage.MOTION, KinematicsError)
    return found


def motion_over(table: LinkageTable, period: Period) -> Motion:
    """The motion over samples of the input."""
    params, solution = table.given, period.solution
    channels = input_channels(table, period.drive, period.time) | solution_channels(table, solution)
    figures = scalars(figures_of(table))
    masses = masses_or_none(params)
    if masses is not None:
        channels |= force_channels(table, solution, masses)
        figures |= {name: Scalar(value, unit) for name, (value, unit) in peaks_of(params).items()}
        figures |= moving_figures(masses, {})
    traces = {
        name: Trace(link, _place(table, link, point)) for name, (link, point) in table.linkage.traces.items()
    }
    return Motion(
        STROKE if table.driver_slides else PHI,
        channels,
        frames_of(params, solution.bodies),
        figures,
        traces,
        held_by(params),
        loads=_loads(table),
    )


def _loads(table: LinkageTable) -> dict[str, Load]:
    found = {}
    for number, load in enumerate(table.given.loads, start=1):
        points = table.linkage.points[load.link]
        place = _place(table, load.link, load.point or next(iter(points)))
        force, torque = (load.force_x, load.force_y, 0.0), (0.0, 0.0, load.torque)
        found[f"load-{number}"] = Load(load.link, force=force, point=place, torque=torque)
    return found


def _place(table: LinkageTable, link: str, point: str) -> tuple[float, float, float]:
    place = complex(table.linkage.points[link][point])
    return place.real, place.imag, 0.0


class _ChannelsOfTable(Mapping[str, Channel]):
    """The channels of a table: motion at once, forces design by design if they are asked for."""

    def __init__(self, table: LinkageTable, samples: int) -> None:
        self._table, self._samples = table, samples
        phases = travelled(2 * np.pi, samples)
        time, drive = drives_at(table, phases)
        self._found = input_channels(table, drive, time)
        self._found |= solution_channels(table, table.solved(drive))

    def _forces(self) -> dict[str, Channel]:
        def compute() -> dict[str, Channel]:
            rows = [
                motion_of(self._table.row(place).given, self._samples) for place in range(len(self._table))
            ]
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


def channels_over(table: LinkageTable, samples: int) -> Mapping[str, Any]:
    """The channels (n, samples) of a table over one period of each design."""
    return _ChannelsOfTable(table, samples)


__all__ = ["Array", "channels_over", "motion_of", "motion_over", "refuse_unmoved"]

"""How a mechanism moves: named channels over the input angle, and the pose of every body."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.joint import Joint, check_bodies
from mechwright.contracts.load import Load
from mechwright.contracts.shown import html_table
from mechwright.errors import KinematicsError
from mechwright.extras import optional

if TYPE_CHECKING:
    import pandas
    import plotly.graph_objects

TIME = "time"
"""Name of the channel of time, s, of a motion whose input goes there and back."""


_PARTS_COLUMNS = frozenset(",;\"'")
"""What a name cannot have that heads a column: tables of programs part their columns by it, or quote them."""

LONGEST_NAME = 100
"""Characters of a name: columns are read by people."""

_KEPT = 100_000
"""Poses of more samples than this are worked out when they are asked for: 100 bytes each, for every body."""

NOTHING = 1e-12
"""A single figure below this is the rounding of sums, in whatever unit: people are told 0."""


def name_fault(name: str, unit: str = "") -> str:
    """What keeps a name, with its unit, from heading a column of a table; nothing if it can.

    >>> name_fault("omega4", "rad/s"), name_fault("x, y")
    ('', "has ','")
    """
    if not name:
        return "is empty"
    if name[0] in "=+-@":
        return f"begins with {name[0]!r}, which makes it a formula of a spreadsheet"
    if not (name[0].isalnum() or name[0] == "_"):
        # A blank, or a wide sign that some spreadsheets take for a narrow one.
        return f"begins with {name[0]!r}"
    if name[-1].isspace():
        return "ends with a blank"
    if len(name) > LONGEST_NAME:
        return f"has {len(name)} characters, more than {LONGEST_NAME}"
    wrong = next((c for c in name + unit if c in _PARTS_COLUMNS or not c.isprintable()), "")
    return f"has {wrong!r}" if wrong else ""


@dataclass(frozen=True, slots=True)
class Channel:
    """A sampled quantity: ``values`` (n,) float in ``unit`` (SI with millimetres: mm, rad, rad/s, mm/s^2).

    ``label`` says to people what it is, in a few words: ``"angle of the crank"``.
    """

    values: Array
    unit: str
    label: str = ""


@dataclass(frozen=True, slots=True)
class Scalar:
    """A single figure and its unit."""

    value: float
    unit: str

    def __str__(self) -> str:
        return f"{0.0 if abs(self.value) < NOTHING else self.value:.6g} {self.unit}".rstrip()


@dataclass(frozen=True, slots=True)
class Rates:
    """How fast the frames [rotation | position] of a body change.

    Parameters
    ----------
    first, second
        (n, 3, 4) float: their derivatives over time, per s and s², mm.
    """

    first: Array
    second: Array


@dataclass(frozen=True, slots=True)
class Poses:
    """Where a body is at each sample: a body point p stands at ``rotation @ p + position``.

    Parameters
    ----------
    position
        (n, 3) float, mm.
    rotation
        (n, 3, 3) float, proper orthogonal.
    rates
        Where the family knows them; else whoever needs them takes differences, which are exact but where the
        acceleration jumps.
    """

    position: Array
    rotation: Array
    rates: Rates | None = None

    @property
    def frames(self) -> Array:
        """[rotation | position] (n, 3, 4)."""
        return np.concatenate([self.rotation, self.position[:, :, None]], axis=2)

    @classmethod
    def planar(cls, x: Array | float, y: Array | float, angle: Array, z: float = 0.0) -> "Poses":
        """Poses of a body that turns about z; ``angle`` (n,) rad, ``x`` and ``y`` (n,) or a constant, mm."""
        angle = np.asarray(angle, dtype=float)
        if angle.size > _KEPT:
            return _Planar(x, y, angle, z)
        return cls(_in_plane(x, y, angle.size, z), _about_z(angle))

    @property
    def shapes(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Those of positions and rotations."""
        return self.position.shape, self.rotation.shape

    @property
    def given(self) -> tuple[Array | float, ...]:
        """What the poses were made of: if that is finite, they are."""
        rates = () if self.rates is None else (self.rates.first, self.rates.second)
        return (self.position, self.rotation, *rates)

    def transform(self, points: Array) -> Array:
        """Move body points (k, 3), mm, to every pose: (n, k, 3), mm."""
        moved: Array = np.einsum("nij,kj->nki", self.rotation, points) + self.position[:, None, :]
        return moved


class _Planar(Poses):
    """Poses about z of so many samples that they are worked out each time they are asked for."""

    __slots__ = ("_angle", "_x", "_y", "_z")
    _x: Array | float
    _y: Array | float
    _angle: Array
    _z: float

    def __init__(self, x: Array | float, y: Array | float, angle: Array, z: float) -> None:
        for name, value in (("_x", x), ("_y", y), ("_angle", angle), ("_z", z), ("rates", None)):
            object.__setattr__(self, name, value)

    @property
    def position(self) -> Array:
        """As of any poses."""
        return _in_plane(self._x, self._y, self._angle.size, self._z)

    @property
    def rotation(self) -> Array:
        """As of any poses."""
        return _about_z(self._angle)

    @property
    def shapes(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Those of positions and rotations."""
        return (self._angle.size, 3), (self._angle.size, 3, 3)

    @property
    def given(self) -> tuple[Array | float, ...]:
        """As of any poses."""
        return self._x, self._y, self._angle, self._z

    def __reduce__(self) -> tuple[type[Poses], tuple[Array, Array]]:
        return Poses, (self.position, self.rotation)


def _in_plane(x: Array | float, y: Array | float, count: int, z: float) -> Array:
    position = np.empty((count, 3))
    position[:, 0], position[:, 1], position[:, 2] = x, y, z
    return position


def _about_z(angle: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    rotation = np.zeros((angle.size, 3, 3))
    rotation[:, 0, 0], rotation[:, 0, 1] = c, -s
    rotation[:, 1, 0], rotation[:, 1, 1] = s, c
    rotation[:, 2, 2] = 1.0
    return rotation


@dataclass(frozen=True, slots=True)
class Trace:
    """A point whose path is worth seeing: a ``body``, and a place in that body's coordinates, mm."""

    body: str
    point: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Curve:
    """A line that belongs to a ``body``, in its coordinates: the pitch curve of a gear, the wall of a slot.

    ``points`` are (n, 3) float, mm; a page shows it where there are no parts to show.
    """

    body: str
    points: Array

    @classmethod
    def planar(cls, body: str, points: NDArray[np.complex128]) -> "Curve":
        """A curve through points (n,) of the plane, x + i y, mm."""
        return cls(body, np.column_stack([points.real, points.imag, np.zeros(points.size)]))


@dataclass(frozen=True, slots=True)
class Motion:
    """The motion of a mechanism over one period of its input.

    A period is one turn of a crank, or as many turns as bring the mechanism back; the travel that a design
    asks for; or the way there and back of a lever, an input that cannot turn fully. Then there is a channel
    ``time`` [s], along which all else is drawn.

    Parameters
    ----------
    input_name
        Name of the channel that drives (``"theta2"``); it is one of ``channels``, and goes one way, or one
        way and back.
    channels
        Name to channel; all of one length n, in the order they are printed.
    poses
        Body name to its poses, n samples each, for every body that a part is an instance of.
    scalars
        Figures of the whole motion (maxima, ratios), name to value and unit.
    traces
        Points whose paths are drawn, by name: the coupler point of a linkage.
    joints
        How the bodies hold each other, by name; empty where the family does not say.
    curves
        Lines fixed to bodies, by name.
    loads
        What works on bodies from outside, by name.

    Raises
    ------
    KinematicsError
        The input is no channel, a channel's name cannot head a column of a table, a channel or body has
        another number of samples than the input, or a trace, joint, curve or load is that of no body.
    """

    input_name: str
    channels: Mapping[str, Channel]
    poses: Mapping[str, Poses] = field(default_factory=dict)
    scalars: Mapping[str, Scalar] = field(default_factory=dict)
    traces: Mapping[str, Trace] = field(default_factory=dict)
    joints: Mapping[str, Joint] = field(default_factory=dict)
    curves: Mapping[str, Curve] = field(default_factory=dict)
    loads: Mapping[str, Load] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.input_name not in self.channels:
            raise KinematicsError(f"the input {self.input_name!r} of the motion is none of its channels")
        for name, channel in self.channels.items():
            if fault := name_fault(name, channel.unit):
                raise KinematicsError(
                    f"the channel {name!r} [{channel.unit}] cannot head a column: it {fault}; name it by "
                    "printable characters without quotes, commas and semicolons, a letter or digit first"
                )
        n = self.samples
        shapes: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
            f"channel {name}": (channel.values.shape, (n,)) for name, channel in self.channels.items()
        }
        for body, poses in self.poses.items():
            position, rotation = poses.shapes
            shapes[f"positions of body {body}"] = (position, (n, 3))
            shapes[f"rotations of body {body}"] = (rotation, (n, 3, 3))
            for which in () if poses.rates is None else (poses.rates.first, poses.rates.second):
                shapes[f"rates of body {body}"] = (which.shape, (n, 3, 4))
        for what, (shape, wanted) in shapes.items():
            if shape != wanted:
                raise KinematicsError(f"{what}: shape {shape}; the input has {n} samples, so {wanted}")
        for name, trace in self.traces.items():
            if trace.body not in self.poses:
                raise KinematicsError(
                    f"the trace {name!r} is a point of body {trace.body!r}, which has no poses"
                )
        for name, curve in self.curves.items():
            if curve.body not in self.poses or curve.points.ndim != 2 or curve.points.shape[1] != 3:
                raise KinematicsError(
                    f"the curve {name!r} has points of shape {curve.points.shape} in body {curve.body!r}; it "
                    "needs (n, 3) in a body that has poses"
                )
        for name, load in self.loads.items():
            if load.body not in self.poses:
                raise KinematicsError(f"the load {name!r} is on body {load.body!r}, which has no poses")
            if load.share is not None and load.share.shape != (n,):
                raise KinematicsError(
                    f"the share of load {name!r} has the shape {load.share.shape}; the input has {n} samples"
                )
        check_bodies(self.joints, self.poses.keys())

    def __repr__(self) -> str:
        travel = self.channels[self.input_name]
        moved = (
            f"{self.input_name} {travel.values.min():.6g} to {travel.values.max():.6g} {travel.unit}".rstrip()
        )
        names = ", ".join(self.channels)
        return f"<Motion of {len(self.poses)} bodies, {self.samples} samples, {moved}; channels {names}>"

    def _repr_html_(self) -> str:
        columns = self.arrays.items()
        ranges = ((name, float(values.min()), float(values.max())) for name, values in columns)
        figures = ((name, str(one)) for name, one in self.scalars.items())
        return html_table(["channel", "least", "greatest"], ranges) + html_table(["figure", "value"], figures)

    def __getitem__(self, name: str) -> Array:
        """The values (n,) of a channel by its name; raises KinematicsError that lists the channels."""
        if name not in self.channels:
            raise KinematicsError(f"the motion has no channel {name!r}; it has {', '.join(self.channels)}")
        return self.channels[name].values

    @property
    def arrays(self) -> dict[str, Array]:
        """The channels (n,) by name and unit, ``"omega4 [rad/s]"``, as tables and plots head them."""
        return {
            f"{name} [{channel.unit}]" if channel.unit else name: channel.values
            for name, channel in self.channels.items()
        }

    @property
    def labels(self) -> dict[str, str]:
        """What each channel is, in words; of one that does not say it, its name without underscores."""
        return {name: channel.label or name.replace("_", " ") for name, channel in self.channels.items()}

    def to_dataframe(self) -> "pandas.DataFrame":
        """The channels as a table of pandas, a row for each sample, columns as :attr:`arrays` names them.

        Raises PluginError where pandas is not installed.
        """
        return optional("pandas").DataFrame(self.arrays)

    def plot(self, *names: str) -> "plotly.graph_objects.Figure":
        """Channels over the input as a figure of plotly, one below the other; by default all of them.

        Raises PluginError where plotly is not installed, KinematicsError for a channel that is not there.
        """
        from mechwright.contracts.plot import stacked

        for name in names:
            self[name]
        titles = dict(zip(self.channels, self.arrays, strict=True))
        chosen = names or [name for name in titles if name != self.over]
        return stacked(titles[self.over], self[self.over], {titles[name]: self[name] for name in chosen})

    def path(self, name: str) -> Array:
        """Path (n, 3), mm, of the trace ``name``."""
        trace = self.traces[name]
        path: Array = self.poses[trace.body].transform(np.array([trace.point]))[:, 0]
        return path

    @property
    def rocks(self) -> bool:
        """Whether the input goes there and back."""
        values = self.channels[self.input_name].values
        steps = np.sign(np.diff(values))
        return bool(steps.size > 1 and (steps > 0).any() and (steps < 0).any())

    @property
    def over(self) -> str:
        """The channel that goes one way all along: the input, or the time of one that goes there and back."""
        return TIME if self.rocks and TIME in self.channels else self.input_name

    @property
    def samples(self) -> int:
        """Number of samples n."""
        return int(self.channels[self.input_name].values.size)

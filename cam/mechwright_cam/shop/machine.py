"""The mill: its limits and its places; the table ``[cam.machine]`` of a design file, or a machine file."""

import math
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import ConfigDict, Field, model_validator
from pydantic.config import JsonDict

from mechwright.contracts.parameters import FIRST, GIVEN, Parameters
from mechwright.designs.files import beside, read_toml
from mechwright.designs.tables import read_table, unknown
from mechwright.errors import DesignError
from mechwright.units import (
    Kilowatts,
    Millimetres,
    MillimetresPerMin,
    NewtonMetres,
    Newtons,
    Ratio,
    RevPerMin,
)

MACHINES = Path(__file__).with_name("machines.toml")
"""The machines that come with the program, by name."""

Place = Annotated[Millimetres | None, Field(ge=-10000, le=10000)]
"""A machine coordinate of one axis; None where it is not known."""


Rigidity = Literal["A", "B", "C", "D"]
"""A: printed or thin, B: extrusions with a router, C: rails and ball screws or a small iron mill, D: iron."""

SIDE_FORCE: dict[Rigidity, float] = {"A": 8.0, "B": 25.0, "C": 60.0, "D": 200.0}
"""Greatest force on a tooth that machines of each class bear, N: estimates from published settings."""

_CHOSEN = ("model", "name", "retract_z", "change_x", "change_y", "home_x", "home_y")
"""Keys that one chooses for a job; the others are figures of the mill that stands in the shop."""


_MACHINE_ZERO = ("low_x", "low_y", "low_z", "change_x", "change_y", "home_x", "home_y")
"""Keys that are places in machine coordinates."""


def _figures(schema: JsonDict) -> None:
    """Mark the mill's figures as given: a design is changed to suit the mill, never the other way round."""
    keys = schema.get("properties")
    if isinstance(keys, dict):
        for name, key in keys.items():
            if name not in _CHOSEN and isinstance(key, dict):
                key.update(GIVEN)


class Machine(Parameters):
    """A three-axis mill."""

    model_config = ConfigDict(json_schema_extra=_figures)

    model: str = Field(
        "",
        max_length=200,
        description="A known machine, or a machine file (.toml) beside the design; its figures come first.",
        json_schema_extra=FIRST,
    )
    name: str = Field("three-axis mill", max_length=60, description="Its name on the setup sheet.")
    travel_x: Millimetres = Field(500.0, gt=0, le=10000, description="Travel of X.")
    travel_y: Millimetres = Field(400.0, gt=0, le=10000, description="Travel of Y.")
    travel_z: Millimetres = Field(400.0, gt=0, le=10000, description="Travel of Z.")
    nose_to_table: Millimetres | None = Field(
        None,
        gt=0,
        le=10000,
        description="From the table to the nose of the spindle at the upper end of Z, if measured.",
    )
    spoil_board: Millimetres = Field(
        0.0, ge=0, le=200, description="Thickness of a board that stays on the table, below the stock."
    )
    homing: Literal["switches", "marks", "none"] = Field(
        "switches",
        description="How it finds machine zero: by switches, by hand at marks, or not at all; then programs "
        "go by the work offset alone.",
    )
    rigidity: Rigidity | None = Field(
        None,
        description="A: printed or thin extrusions; B: extrusions with a router; C: rails and ball screws, "
        "or a small iron mill; D: an iron mill. Cutting data are estimated by it.",
    )
    side_force: Newtons | None = Field(
        None, gt=0, le=10000, description="Greatest force of a tooth; by default that of its rigidity."
    )
    collet: Millimetres | None = Field(
        None, gt=0, le=100, description="Diameter of the largest shank that it holds, if known."
    )
    rapid: MillimetresPerMin = Field(10000.0, gt=0, le=200000, description="Speed of a rapid move.")
    rapid_z: MillimetresPerMin | None = Field(
        None, gt=0, le=200000, description="Speed of a rapid move of Z, if it is slower."
    )
    max_feed: MillimetresPerMin = Field(5000.0, gt=0, le=100000, description="Fastest feed.")
    spindle_min: RevPerMin = Field(100.0, ge=0, le=100000, description="Slowest spindle speed.")
    spindle_max: RevPerMin = Field(12000.0, gt=0, le=200000, description="Fastest spindle speed.")
    speed_by_hand: bool = Field(
        False, description="Whether its speed is set by hand at a dial; S in a program then does nothing."
    )
    dial: tuple[Annotated[RevPerMin, Field(gt=0, le=200000)], ...] = Field(
        (), max_length=20, description="Speeds at the marks 1, 2, 3 ... of that dial."
    )
    spindle_power: Kilowatts = Field(
        2.2, gt=0, le=200, description="Power of the spindle motor above its base speed."
    )
    spindle_torque: NewtonMetres = Field(
        10.5, gt=0, le=5000, description="Torque of the spindle below its base speed."
    )
    spindle_efficiency: Ratio = Field(
        0.8, gt=0, le=1, description="Share of power and torque that reaches the cut."
    )
    acceleration: Ratio = Field(
        1.0, gt=0, le=50, description="Acceleration of each axis in m/s², for time estimates."
    )
    tool_change: Annotated[Ratio, Field(ge=0, le=3600)] = Field(
        12.0, description="Time of a tool change in s."
    )
    spindle_delay: Annotated[Ratio, Field(ge=0, le=10)] = Field(
        0.0, description="Wait in s for the spindle to come up to speed; 0 if the control waits by itself."
    )
    pockets: int = Field(0, ge=0, le=1000, description="Places of the tool changer; 0: no limit is known.")
    low_x: Place = Field(None, description="Machine X at the lower end of its travel, if known.")
    low_y: Place = Field(None, description="Machine Y at the lower end of its travel, if known.")
    low_z: Place = Field(None, description="Machine Z at the lower end of its travel, if known.")
    retract_z: Millimetres = Field(
        0.0,
        ge=-10000,
        le=10000,
        description="Machine Z of a full retract, the upper end of travel; on Grbl -2 by default.",
    )
    change_x: Place = Field(None, description="Machine X where tools are changed; by default it stays.")
    change_y: Place = Field(None, description="Machine Y where tools are changed; by default it stays.")
    home_x: Place = Field(None, description="Machine X at the program's end; by default it stays.")
    home_y: Place = Field(None, description="Machine Y at the program's end; by default it stays.")

    @model_validator(mode="after")
    def _spindle(self) -> Self:
        if self.spindle_min >= self.spindle_max:
            raise ValueError("spindle_min must be below spindle_max")
        if self.dial and not self.speed_by_hand:
            raise ValueError("dial is that of a speed that is set by hand; write speed_by_hand = true")
        if any(one >= other for one, other in pairwise(self.dial)):
            raise ValueError("dial: each mark is faster than the one before")
        return self

    @model_validator(mode="after")
    def _zero(self) -> Self:
        if self.homing == "none":
            for key in _MACHINE_ZERO:
                if getattr(self, key) is not None:
                    raise ValueError(
                        f'{key} is a machine coordinate, and homing = "none" has none; leave it out'
                    )
            if "retract_z" in self.model_fields_set:
                raise ValueError(
                    'retract_z is a machine coordinate, and homing = "none" has none; leave it out'
                )
        return self

    @model_validator(mode="after")
    def _places(self) -> Self:
        for axis, keys in (
            ("x", ("change_x", "home_x")),
            ("y", ("change_y", "home_y")),
            ("z", ("retract_z",)),
        ):
            low, high = self.ends(axis)
            for key in keys:
                place = getattr(self, key)
                if place is not None and not low <= place <= high:
                    raise ValueError(
                        f"{key} is {place:g}, and {axis.upper()} travels from {low:g} to {high:g}"
                    )
        return self

    @property
    def homed(self) -> bool:
        """Whether it has machine coordinates."""
        return self.homing != "none"

    @property
    def bears(self) -> float:
        """Greatest force of a tooth, N; infinite where nobody has said anything of it."""
        if self.side_force is not None:
            return self.side_force
        return math.inf if self.rigidity is None else SIDE_FORCE[self.rigidity]

    def speed(self, wanted: float) -> float:
        """The speed, rev/min, in place of a wanted one: within its limits, at a mark of the dial.

        >>> Machine(spindle_min=1e4, spindle_max=3e4, speed_by_hand=True, dial=(1e4, 1.7e4)).speed(16000)
        10000.0
        """
        if self.dial:
            return float(max((mark for mark in self.dial if mark <= wanted), default=self.dial[0]))
        return float(round(min(max(wanted, self.spindle_min), self.spindle_max)))

    def ends(self, axis: str) -> tuple[float, float]:
        """The least and the greatest machine coordinate of an axis, mm.

        Where the lower end is not known, Z travels up to machine Z0, or to ``retract_z`` if that is higher;
        the zero of X and Y is somewhere in their travel.

        >>> Machine(low_z=-100.0).ends("z"), Machine().ends("z"), Machine().ends("x")
        ((-100.0, 300.0), (-400.0, 0.0), (-500.0, 500.0))
        """
        low: float | None = getattr(self, f"low_{axis}")
        travel: float = getattr(self, f"travel_{axis}")
        if low is not None:
            return low, low + travel
        if axis == "z":
            high = max(self.retract_z, 0.0)
            return high - travel, high
        return -travel, travel

    @property
    def open_axes(self) -> tuple[str, ...]:
        """The axes whose ends are not known in machine coordinates.

        Z ends where programs retract to; the zero of X and Y may be anywhere.

        >>> Machine(low_y=0.0).open_axes, Machine(low_x=-500.0, low_y=0.0).open_axes
        (('x',), ())
        """
        return tuple(axis for axis in "xy" if getattr(self, f"low_{axis}") is None)


class Preset(Parameters):
    """What a shop file takes over with a known machine: the table ``[NAME.shop]``."""

    control: str = Field("", description="Control that comes with it; empty where none here writes for it.")
    reads: str = Field("", description="The language of that control, in the maker's words.")
    coolant: Literal["flood", "mist", "off"] = Field("flood", description="Coolant that it has.")
    unknown: tuple[str, ...] = Field((), description="Unpublished figures: estimates stand there.")
    doubtful: tuple[str, ...] = Field((), description="Figures of one owner, or from memory.")


@cache
def known_machines() -> dict[str, tuple[dict[str, Any], Preset]]:
    """The machines that come with the program: figures and preset by name, other names among them."""
    rows = read_toml(MACHINES)[0]
    others = rows.pop("names")
    found = {}
    for name, row in rows.items():
        preset = Preset.model_validate(row.pop("shop", {}))
        found[name] = (row, preset)
    return found | {name: found[one] for name, one in others.items()}


def machine_figures(model: str, path: Path) -> dict[str, Any]:
    """The figures of a built-in machine, or of a machine file beside ``path``."""
    if model.endswith(".toml"):
        file = beside(path, model, "cam.machine.model")
        figures = read_toml(file)[0]
        if "model" in figures:
            raise DesignError(f"{file}: model: a machine file stands for itself; write its figures")
        read_table(Machine, figures, str(file), "machine")  # mistakes are told with the file's name
        return figures
    machines = known_machines()
    if model not in machines:
        said = unknown(model, tuple(machines), "machine")
        raise DesignError(f"{path}: cam.machine.model: {said}; or name a machine file (.toml)")
    return dict(machines[model][0])

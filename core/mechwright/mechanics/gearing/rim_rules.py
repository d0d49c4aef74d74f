"""What stays around the teeth of a plate that is screwed on, a ring or a rack: at and between its holes."""

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Severity
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.mechanics.gearing.checks import FULL_RIM, LEAST_RIM
from mechwright.tolerances import falls_short

LEAST_WALL = 2.0
"""mm on each side of a hole where the design names no size: a mill and a screw's head have room."""

HOLE = 5.5
"""Diameter of the holes where the design names none, mm: M5 screws go through."""


class ScrewedPlate(Protocol):
    """What the rules ask of a plate, mm; numbers, or columns (n, 1)."""

    module: Any
    """Of the teeth."""
    holes: Any
    """Number of holes."""
    hole: Any
    """Their diameter."""

    @property
    def depth(self) -> Any:
        """Of the teeth, from tip to root."""

    @property
    def wall(self) -> Any:
        """What stays on both sides of a hole together; all of it where there are none."""

    @property
    def bridge(self) -> Any:
        """What stays between two holes."""

    @property
    def most_holes(self) -> int:
        """Holes of one plate between which a module stays."""

    def size_for(self, rim: float) -> int:
        """The size that the design states, in whole mm, of one plate whose rim is so wide."""


def full_wall(plate: ScrewedPlate) -> Any:
    """Wall that no longer weakens the teeth."""
    return FULL_RIM * plate.depth


def least_wall(plate: ScrewedPlate) -> Any:
    """Wall that the teeth need: a module, and one on each side of a hole."""
    return LEAST_RIM * plate.module * np.where(np.asarray(plate.holes) > 0, 2, 1)


def rim_for(hole: Any, depth: Any) -> Any:
    """Width, mm, of the rim of a plate whose design names no size."""
    return hole + np.maximum(FULL_RIM * depth, 2 * LEAST_WALL)


def rim_rules(kind: str, size: str, where: str, plate_of: Callable[[Any], ScrewedPlate]) -> Rules[Any]:
    """Rules of a ``kind`` of plate, whose keys begin with its name.

    Parameters
    ----------
    size
        The key of its size.
    where
        Where its rim is: ``"outside of"`` its roots.
    plate_of
        The plate of a table.
    """

    def needed(f: Failure[Any]) -> int:
        plate = plate_of(f.m)
        hole = float(plate.hole) if plate.holes > 0 else 0.0
        return plate.size_for(hole + max(float(full_wall(plate)), float(least_wall(plate))))

    def beside(f: Failure[Any]) -> str:
        plate = plate_of(f.m)
        return f" beside its holes of {float(plate.hole):g} mm" if plate.holes > 0 else ""

    thin = DesignRule[Any](
        f"{kind}.rim",
        size,
        lambda f: f"{f.value:.2f} mm of the {kind} stay {where} its roots{beside(f)}",
        value=lambda m: plate_of(m).wall,
        limit=lambda m: least_wall(plate_of(m)),
        unit="mm",
        remedy=lambda f: (
            f"make {size} at least {needed(f)}"
            + (f", or {kind}_hole smaller" if plate_of(f.m).holes > 0 else "")
        ),
        proposed=lambda f: ({f"parameters.{size}": needed(f)},),
    )
    weak = thin.but(
        severity=Severity.WARNING,
        limit=lambda m: full_wall(plate_of(m)),
        when=lambda m: ~np.asarray(falls_short(plate_of(m).wall, least_wall(plate_of(m)))),
    )
    bridge = DesignRule[Any](
        f"{kind}.holes",
        f"{kind}_holes",
        lambda f: f"{f.value:.2f} mm stay between two of the {int(plate_of(f.m).holes)} holes of the {kind}",
        value=lambda m: plate_of(m).bridge,
        limit=lambda m: plate_of(m).module,
        unit="mm",
        remedy=lambda f: f"make {kind}_holes at most {plate_of(f.m).most_holes}, or {kind}_hole smaller",
        proposed=lambda f: ({f"parameters.{kind}_holes": plate_of(f.m).most_holes},),
    )
    return in_turn(thin, all_of(weak, bridge))

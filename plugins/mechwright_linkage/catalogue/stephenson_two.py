"""The Stephenson II six-bar, which is no chain of dyads from its crank."""

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from pydantic import Field

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.machine import Pose
from mechwright_linkage.catalogue.entry import GROUND, Angle, Coordinate, Entry, Length, Points, bar
from mechwright_linkage.catalogue.three_bars import assemblies, place


class StephensonTwo(Entry):
    """Two rods from a crank with two pins, and a rocker on the ground, carry a coupler with three pins.

    With the crank standing the coupler is a plate on three bars, which can be put together in up to six ways;
    that one is drawn whose coupler is nearest to ``coupler_angle`` at the crank angle of 0°. From there the
    linkage is followed along the input.
    """

    title = "Stephenson II six-bar"
    source = "Crank pins (30, -8) and (19, 25), rods 72 and 66, rocker 98"
    output = "rocker"
    traces: ClassVar = {"F": ("coupler", "F")}
    pin_links: ClassVar = {
        "A0": (GROUND, "crank"),
        "P1": ("crank", "rod1"),
        "P2": ("crank", "rod2"),
        "R1": ("rod1", "coupler"),
        "R2": ("rod2", "coupler"),
        "F": ("coupler", "rocker"),
        "B0": (GROUND, "rocker"),
    }

    b0_x: Coordinate = Field(110.0, description="Pivot B0 of the rocker, to the right of the crank's A0.")
    b0_y: Coordinate = Field(-3.0, description="Pivot B0 of the rocker, over A0.")
    p1_x: Coordinate = Field(30.0, description="Pin P1 in the crank, X from A0.")
    p1_y: Coordinate = Field(-8.0, description="Pin P1 in the crank, Y from A0.")
    p2_x: Coordinate = Field(19.0, description="Pin P2 in the crank, X from A0.")
    p2_y: Coordinate = Field(25.0, description="Pin P2 in the crank, Y from A0.")
    rod1: Length = Field(72.0, description="First rod, from P1 to R1.")
    rod2: Length = Field(66.0, description="Second rod, from P2 to R2.")
    r2_x: Coordinate = Field(40.0, description="Pin R2 in the coupler, X from R1.")
    r2_y: Coordinate = Field(42.0, description="Pin R2 in the coupler, Y from R1.")
    f_x: Coordinate = Field(46.0, description="Pin F of the rocker in the coupler, X from R1.")
    f_y: Coordinate = Field(29.0, description="Pin F of the rocker in the coupler, Y from R1.")
    rocker: Length = Field(98.0, description="Rocker, from F to B0.")
    coupler_angle: Angle = Field(
        -36.0, description="Angle of the coupler's X at the crank angle of 0, about."
    )

    def points(self) -> Points:
        """Give the points of every link, mm; the crank's pivot A0 is the origin."""
        return {
            GROUND: {"A0": 0j, "B0": self.b0_x + 1j * self.b0_y},
            "crank": {"A0": 0j, "P1": self.p1_x + 1j * self.p1_y, "P2": self.p2_x + 1j * self.p2_y},
            "rod1": bar("P1", "R1", self.rod1),
            "rod2": bar("P2", "R2", self.rod2),
            "coupler": {"R1": 0j, "R2": self.r2_x + 1j * self.r2_y, "F": self.f_x + 1j * self.f_y},
            "rocker": bar("F", "B0", self.rocker),
        }

    def drawn(self) -> Mapping[str, Pose]:
        """Give the poses at ``start``; NaN in rows of columns that cannot be put together.

        Raises
        ------
        KinematicsError
            No pose of the coupler fits rods and rocker of a single design.
        """
        points = self.points()
        crank, coupler = points["crank"], points["coupler"]
        turn = np.exp(1j * np.radians(self.start))
        outer = crank["P1"] * turn, crank["P2"] * turn, points[GROUND]["B0"]
        plate, lengths = (coupler["R2"], coupler["F"]), (self.rod1, self.rod2, self.rocker)
        ways = assemblies(outer, plate, lengths)
        angle: Any = _nearest(ways, np.radians(np.ravel(self.coupler_angle)))
        if max(np.size(one) for one in (*outer, *plate, *lengths, self.coupler_angle)) > 1:
            angle = angle[:, None]
        elif np.isnan(angle := float(angle[0])):
            raise KinematicsError(
                f"stephenson-2: no coupler fits rod1 {self.rod1:g}, rod2 {self.rod2:g} and rocker "
                f"{self.rocker:g} mm at the crank angle of {self.start:g} degrees; change one of the three"
            )
        r1 = place(angle, outer, plate, lengths)
        e = np.exp(1j * angle)
        rods = {
            "rod1": (outer[0], r1),
            "rod2": (outer[1], r1 + plate[0] * e),
            "rocker": (r1 + plate[1] * e, outer[2]),
        }
        return {
            "coupler": Pose(r1, angle),
            **{name: Pose(one + 0 * e, np.angle(two - one)) for name, (one, two) in rods.items()},
        }


def _nearest(ways: Any, angle: Any) -> Any:
    """Of angles (n, 6) the one nearest to that of each row (n,) or (1,); NaN where a row has none."""
    off = np.abs(np.angle(np.exp(1j * (ways - angle[:, None]))))
    rows = np.arange(len(ways))
    return ways[rows, np.argmin(np.where(np.isnan(off), np.inf, off), axis=1)]

"""The pair as a stage of a chain."""

import math
from fractions import Fraction

import numpy as np

from mechwright import Array, DesignError, Motion, Port, Transmission, Turning
from mechwright.contracts.finding import Change
from mechwright_noncircular_gears.fields import LAW_FIELDS
from mechwright_noncircular_gears.kinematics.motion import driven, driven_by, swinging, turns_of
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.table import NAMES, GearTable


class PairStage(Transmission):
    """Driver in, driven gear out, the other way round; a ring has no shaft (DesignError).

    Sectors swing over their travel; where nothing stands before them they do so by their own drive, whose
    phase is then the angle of the input.
    """

    own_drive = ("speed",)
    travel_field = "sector"
    load_field = "load_torque"

    def __init__(self, m: GearTable) -> None:
        params = m.given
        if params.internal:
            raise DesignError(
                "internal: a ring is screwed to what turns with it and has no shaft for the next stage; set "
                "internal = false"
            )
        self.m = m
        driver, mate = NAMES
        self.input = Port(driver, (0.0, 0.0))
        self.output = Port(mate, (m.pair.distance, 0.0))
        if params.sector is None:
            self.period = Fraction(turns_of(m))
            self.advance = -self.period * params.lobes / params.mate_lobes
        else:
            self.travel = (0.0, math.radians(params.sector))
            self.whole = _closed(params)
        self.speed = m.omega

    def move(self, drive: Turning) -> Turning:
        """By the law and its derivatives."""
        return driven(self.m, drive)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """Both gears."""
        return driven_by(self.m, drive, time)

    def at(self, angle: Array) -> tuple[Array, Turning]:
        """At constant speed, and sectors by their swing."""
        if self.travel is None:
            return super().at(angle)
        return angle / self.speed, swinging(self.m, angle)

    def driven_fields(self, drive: Turning) -> dict[str, float]:
        """The greatest speed, and of sectors that of a swing that is as fast and speeds up as much."""
        if self.travel is None:
            return super().driven_fields(drive)
        half = self.travel[1] / 2
        fast, sudden = (float(np.abs(one).max()) / half for one in (drive.omega, drive.alpha))
        return {"speed": max(fast, math.sqrt(sudden)) * 60 / math.tau}

    def power(self, drive: Turning, motion: Motion) -> Array:  # noqa: ARG002 - the law has it
        """Of the torque against the driven gear."""
        return self.m.given.load_torque * np.abs(self.move(drive).omega)


def _closed(params: NoncircularParams) -> tuple[Change, ...]:
    """The law of sectors all the way round, where it closes, and the usual law."""
    given = [
        name for name in (*LAW_FIELDS[params.law], "sector_hub") if getattr(params, name, None) is not None
    ]
    whole: Change = {"parameters.sector": None}
    if "sector_hub" in given:
        whole = {**whole, "parameters.sector_hub": None}
    return whole, {**whole, **{f"parameters.{name}": None for name in given}, "parameters.law": None}

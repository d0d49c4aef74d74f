"""The pair as a stage of a chain."""

from fractions import Fraction

import numpy as np

from mechwright import Array, DesignError, Motion, MountingError, Port, Transmission, Turning
from mechwright.contracts.finding import Change
from mechwright_noncircular_gears.fields import LAW_FIELDS
from mechwright_noncircular_gears.gear import NAMES, pair_of
from mechwright_noncircular_gears.motion import driven, driven_by, turns_of
from mechwright_noncircular_gears.params import NoncircularParams


class PairStage(Transmission):
    """Driver in, driven gear out, the other way round; a ring has no shaft, sectors swing (DesignError)."""

    own_drive = ("speed",)
    load_field = "load_torque"

    def __init__(self, params: NoncircularParams) -> None:
        if params.internal:
            raise DesignError(
                "internal: a ring is screwed to what turns with it and has no shaft for the next stage; set "
                "internal = false"
            )
        if params.sector is not None:
            raise MountingError(
                "sector: sectors swing there and back, and the next stage turns on; leave sector out, with a "
                "law that goes all the way round",
                _closed(params),
            )
        self.params = params
        driver, mate = NAMES
        self.input = Port(driver, (0.0, 0.0))
        self.output = Port(mate, (pair_of(params).distance, 0.0))
        self.period = Fraction(turns_of(params))
        self.advance = -self.period * params.lobes / params.mate_lobes
        self.speed = params.omega

    def move(self, drive: Turning) -> Turning:
        """By the law and its derivatives."""
        return driven(self.params, drive)

    def motion(self, drive: Turning, time: Array) -> Motion:
        """Both gears."""
        return driven_by(self.params, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:  # noqa: ARG002 - the law has it
        """Of the torque against the driven gear."""
        return self.params.load_torque * np.abs(self.move(drive).omega)


def _closed(params: NoncircularParams) -> tuple[Change, ...]:
    """The law of sectors all the way round, where it closes, and the usual law."""
    given = [
        name for name in (*LAW_FIELDS[params.law], "sector_hub") if getattr(params, name, None) is not None
    ]
    whole: Change = {"parameters.sector": None}
    if "sector_hub" in given:
        whole = {**whole, "parameters.sector_hub": None}
    return whole, {**whole, **{f"parameters.{name}": None for name in given}, "parameters.law": None}

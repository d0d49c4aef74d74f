"""Cam and follower as a stage of a chain."""

from typing import ClassVar

import numpy as np

from mechwright import Array, KinematicsError, Motion, Port, Transmission, Turning
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.motion import CAM, FOLLOWER, driven_by, refuse_unclosed, turned_by
from mechwright_cam_follower.mounting import shafts_of
from mechwright_cam_follower.params import CamParams


class CamStage(Transmission):
    """Camshaft in; the axis of a lever out, by the angle that it has risen. Behind a slide stands nothing."""

    own_drive: ClassVar[tuple[str, ...]] = ("speed",)

    def __init__(self, params: CamParams) -> None:
        refuse_unclosed(params)
        self.params = params
        self.input = Port(CAM, (0.0, 0.0))
        if not params.translating:
            self.output = Port(FOLLOWER, (params.value("centre_distance"), 0.0), -1)
        self.speed = params.sense * params.omega
        self.mounting = shafts_of(params)

    def move(self, drive: Turning) -> Turning:
        """By the law of the segment that the cam stands in; raises KinematicsError for a slide."""
        if self.output is None:
            raise KinematicsError("a slide is no shaft; nothing can stand behind it")
        sense = self.params.sense
        rates = cycle_of(self.params).at(turned_by(self.params, drive))
        return Turning(rates.s, *drive.carried(sense * rates.v, rates.a, sense * rates.j))

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and the contact as this motion loads it."""
        return driven_by(self.params, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:
        """Of spring, load and what moves."""
        return np.asarray(motion["torque"] * drive.omega)

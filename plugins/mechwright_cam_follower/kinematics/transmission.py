"""Cam and follower as a stage of a chain."""

from typing import ClassVar

import numpy as np

from mechwright import Array, KinematicsError, Motion, MountingError, Port, Transmission, Turning
from mechwright_cam_follower.kinematics.mechanism import mechanism_of
from mechwright_cam_follower.kinematics.motion import CAM, FOLLOWER, driven_by, turned_by
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.mounting import shafts_of
from mechwright_cam_follower.rules.closure import refuse_unclosed


class CamStage(Transmission):
    """Camshaft in; the axis of a lever out, by the angle that it has risen. Behind a slide stands nothing."""

    own_drive: ClassVar[tuple[str, ...]] = ("speed",)

    def __init__(self, params: CamParams) -> None:
        if params.spring is not None:
            raise MountingError(
                "spring: in a chain no spring is chosen, since no frame has its pin; leave it out and state "
                "spring_torque and spring_stiffness",
                ({"parameters.spring": None},),
            )
        self.m = m = mechanism_of(params)
        refuse_unclosed(m)
        self.input = Port(CAM, (0.0, 0.0))
        if not m.slides:
            self.output = Port(FOLLOWER, (m.axis, 0.0), -1)
        self.speed = m.sense * m.omega
        self.mounting = shafts_of(m)

    def move(self, drive: Turning) -> Turning:
        """By the law of the segment that the cam stands in; raises KinematicsError for a slide."""
        if self.output is None:
            raise KinematicsError("a slide is no shaft; nothing can stand behind it")
        sense = self.m.sense
        rates = self.m.cycle.at(turned_by(self.m, drive))
        return Turning(rates.s, *drive.carried(sense * rates.v, rates.a, sense * rates.j))

    def motion(self, drive: Turning, time: Array) -> Motion:
        """All bodies, and the contact as this motion loads it."""
        return driven_by(self.m, drive, time)

    def power(self, drive: Turning, motion: Motion) -> Array:
        """Of spring, load and what moves."""
        return np.asarray(motion["torque"] * drive.omega)

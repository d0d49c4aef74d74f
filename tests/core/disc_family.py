"""The smallest honest family: a disc with a hole that turns. The tests of the kit break it in every way."""

import math
from typing import ClassVar, Literal

import numpy as np
from procedural import Procedural
from pydantic import Field, model_validator

from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.motion import Channel, Motion, Poses, Scalar
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.synthesis import Candidate, Synthesis
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.units import Millimetres, Ratio, RevPerMin


class DiscParams(Parameters):
    diameter: Millimetres = Field(40.0, ge=5, le=500, description="Outside.")
    bore: Millimetres | None = Field(None, ge=1, le=400, description="Hole; half the diameter if not given.")
    thickness: Millimetres = Field(5.0, ge=1, le=50, description="Thickness.")
    speed: RevPerMin = Field(60.0, gt=0, le=1000, description="Speed.")
    holes: int = Field(2, ge=0, le=12, description="Number of holes on the pitch circle.")
    material: Literal["steel", "brass"] = Field("steel", description="Material.")

    @model_validator(mode="after")
    def _speed(self):
        if self.speed * self.diameter > 200_000:
            raise ValueError("speed and diameter together burst the disc")
        return self

    @property
    def hole(self) -> float:
        return self.diameter / 2 if self.bore is None else self.bore


class RimRequirement(Parameters):
    rim_speed: Ratio = Field(125.0, gt=0, le=1e5, description="Wanted speed of the rim in mm/s.")
    count: int = Field(2, ge=1, le=20, description="How many discs to choose from.")


class Disc(Procedural[DiscParams]):
    name = "disc"
    title = "Disc"
    summary = "A disc that turns."
    Params = DiscParams
    requirements: ClassVar = {"rim": RimRequirement}

    def found(self, params):
        wall = (params.diameter - params.hole) / 2
        found = [Finding("disc.wall", Severity.NOTE, "", f"the wall is {wall:.3g} mm", value=wall, unit="mm")]
        if wall < 2 or (params.holes and wall < 8):
            found.append(
                Finding(
                    "disc.wall",
                    Severity.ERROR,
                    "bore",
                    f"the wall is only {wall:.3g} mm",
                    value=wall,
                    limit=8.0 if params.holes else 2.0,
                    unit="mm",
                    remedy="make the bore smaller",
                )
            )
        pitch = params.diameter / 2 - 3.5
        if params.holes > 1 and 2 * pitch * math.sin(math.pi / params.holes) < 5:
            found.append(Finding("disc.holes", Severity.ERROR, "holes", "no room", remedy="use fewer holes"))
        return found

    def solve(self, params, samples):
        theta = np.linspace(0, math.tau, samples)
        w = params.speed * math.tau / 60
        return Motion(
            "theta",
            {
                "theta": Channel(theta, "rad"),
                "omega": Channel(np.full(samples, w), "rad/s"),
                "y": Channel(params.diameter / 2 * np.sin(theta), "mm"),
                "speed_y": Channel(params.diameter / 2 * w * np.cos(theta), "mm/s"),
            },
            {"disc": Poses.planar(0, 0, theta)},
            {"rim_speed": Scalar(params.diameter / 2 * w, "mm/s")},
        )

    def synthesise(self, kind, requirement, progress):
        found = []
        for i in range(requirement.count):
            progress(i / requirement.count, f"disc {i + 1}")
            diameter = 40.0 + 10 * i
            rate = 2 * requirement.rim_speed / diameter * 60 / math.tau
            if rate <= 1000:
                params = DiscParams(diameter=diameter, speed=rate)
                rim = self.solve(params, 2).scalars["rim_speed"]
                missed = Scalar(abs(rim.value - requirement.rim_speed), "mm/s")
                found.append(Candidate(params, missed, {"rim": rim}))
        if not found:
            limit = 1000 * math.tau / 60 * (40 + 10 * requirement.count) / 2
            message = f"no disc up to 1000 rev/min has a rim that fast; the limit is {limit:.0f} mm/s"
            fault = Finding("disc.rim", Severity.ERROR, "rim_speed", message, remedy="ask for less")
            return Synthesis((), (fault,))
        return Synthesis(tuple(found))

    def parts(self, params):
        pitch = params.diameter / 2 - 3.5
        if params.hole >= params.diameter:
            raise GeometryError("the bore is larger than the disc")
        places = [math.tau * i / params.holes for i in range(params.holes)]
        outline = Outline(
            Loop((circle((0, 0), params.diameter / 2),)),
            (
                Loop((circle((0, 0), params.hole / 2, clockwise=True),)),
                *(
                    Loop((circle((pitch * math.cos(a), pitch * math.sin(a)), 1.5, clockwise=True),))
                    for a in places
                ),
            ),
        )
        return [Part("disc", outline, params.thickness, params.material, (Instance("disc"),))]

"""A family in closed form, and studies of it: whose front is known, so that what is found can be judged."""

import math
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
from pydantic import Field

from mechwright import Channel, DesignRule, Family, Motion, Parameters, Scalar, in_turn
from mechwright.plugins.host import host
from mechwright.studies.study import study_of
from mechwright.units import Degrees, Millimetres


class Inner(Parameters):
    """A table in the table."""

    width: Millimetres = Field(1.0, ge=0, le=50, description="A width.")


class BowlParams(Parameters):
    """A bowl: x² and (x - 2)² are to be small at once, which x in [0, 2] is best at."""

    x: float = Field(1.0, ge=-10, le=10, description="A number.")
    teeth: int = Field(10, ge=5, le=20, description="A whole number.")
    tilt: Degrees = Field(0.0, ge=-90, le=90, description="An angle.")
    shape: str = Field("round", description="A name.")
    inner: Inner = Field(Inner(), description="A table.")


class Bowl(Family[BowlParams]):
    name, title, summary = "bowl", "Bowl", "A closed form."
    Params = BowlParams
    batch: ClassVar[int] = 64

    def rules(self):
        return in_turn(
            DesignRule("bowl.deep", "x", "is too deep", lambda t: t.params.x, 3, must_be="at most")
        )

    def solve(self, params, samples):
        angle = np.linspace(0, math.tau, samples)
        turning = Channel(params.x * np.sin(angle), "rad")
        return Motion(
            "angle",
            {"angle": Channel(angle, "rad"), "swing": turning},
            scalars={"left": Scalar(params.x**2, "mm"), "right": Scalar((params.x - 2) ** 2, "mm"),
                     "lean": Scalar(math.radians(params.tilt), "rad")},
        )  # fmt: skip

    def parts(self, params):
        return []


BOWL = Bowl()


@dataclass
class OneFamily:
    """The host, with one family more."""

    own: Family

    def of(self, contract):
        return {**host().of(contract), "bowl": None} if contract is Family else host().of(contract)

    def all(self, contract):
        return host().all(contract)

    def family(self, name):
        return self.own


def study(**changed):
    table = {
        "count": 300,
        "ranges": {"x": {"least": -4, "greatest": 6}},
        "objectives": {"left": "least", "right": "least"},
        **changed,
    }
    content = {"family": "bowl", "study": {key: value for key, value in table.items() if value is not None}}
    return study_of(content, Path("bowl.toml"), OneFamily(BOWL))

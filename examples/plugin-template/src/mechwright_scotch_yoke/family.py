"""The family: parameters in, findings, motion and parts out."""

from collections.abc import Mapping, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from mechwright import (
    Channel,
    DesignTable,
    Family,
    Figure,
    Motion,
    Parameters,
    Part,
    Poses,
    Progress,
    Rules,
    Synthesis,
    ToleranceModel,
    Tolerances,
    scalars,
)
from mechwright.units import MetresPerMin, Millimetres, Newtons, RevPerMin

Material = Literal["aluminium", "brass", "pom", "steel"]


class ScotchYokeParams(Parameters):
    """The table ``[parameters]`` of a Scotch yoke."""

    crank_radius: Millimetres = Field(20.0, ge=1, le=500, description="Shaft to pin; half the stroke.")
    speed: RevPerMin = Field(120.0, ge=0.1, le=3000, description="Speed of the crank, constant.")
    shaft_diameter: Millimetres = Field(10.0, ge=2, le=200, description="Bore of the crank.")
    pin_diameter: Millimetres = Field(8.0, ge=2, le=100, description="Dowel pin in the crank.")
    clearance: Millimetres = Field(0.05, ge=0.005, le=1, description="Width of the slot beyond the pin.")
    rim: Millimetres = Field(8.0, ge=1, le=200, description="Material around bores and slot.")
    crank_thickness: Millimetres = Field(8.0, ge=1, le=100, description="Thickness of the crank.")
    yoke_thickness: Millimetres = Field(6.0, ge=1, le=100, description="Thickness of the yoke.")
    stem_width: Millimetres = Field(14.0, ge=2, le=500, description="Width of the yoke's stem.")
    stem_length: Millimetres = Field(80.0, ge=5, le=2000, description="Length of the stem from the head.")
    load: Newtons = Field(100.0, ge=0, le=1e6, description="Largest force that the stem pushes with.")
    crank_material: Material = Field("steel", description="Material of the crank.")
    yoke_material: Material = Field("brass", description="Material of the yoke.")


class StrokeRequirement(Parameters):
    """The table ``[requirement]`` of the kind ``stroke``."""

    stroke: Millimetres = Field(40.0, ge=2, le=1000, description="Between the dead centres.")
    peak_velocity: MetresPerMin = Field(15.0, ge=0.001, le=1e4, description="Of the yoke, in mid-stroke.")


class ScotchYoke(Family[ScotchYokeParams]):
    """A pin on a turning crank drives a slotted yoke to and fro."""

    name = "scotch-yoke"
    title = "Scotch yoke"
    summary = "A crank pin in a straight slot turns rotation into a pure sine stroke."
    Params = ScotchYokeParams
    requirements: ClassVar = {"stroke": StrokeRequirement}

    def rules(self) -> Rules[DesignTable[ScotchYokeParams]]:
        """Strength, room for the bores and the stem, lost motion."""
        from mechwright_scotch_yoke.rules import RULES

        return RULES

    def figures(self, table: DesignTable[ScotchYokeParams]) -> Mapping[str, Figure]:
        """Stroke, velocity, mass and force."""
        from mechwright_scotch_yoke import kinematics

        return kinematics.figures(table.params)

    def channels(self, table: DesignTable[ScotchYokeParams], samples: int) -> Mapping[str, Channel]:
        """One turn of the crank from the outer dead centre, at constant speed."""
        from mechwright_scotch_yoke import kinematics

        return kinematics.channels(table.params, samples)

    def solve(self, params: ScotchYokeParams, samples: int) -> Motion:
        """The same of one design, with the poses of crank and yoke."""
        table = self.table(params)
        found = self.channels(table, samples)
        theta, x = found["theta"].values, found["x"].values
        poses = {"crank": Poses.planar(0.0, 0.0, theta), "yoke": Poses.planar(x, 0.0, 0 * x)}
        return Motion("theta", found, poses, scalars(self.figures(table)))

    def parts(self, params: ScotchYokeParams) -> Sequence[Part]:
        """The crank and the yoke."""
        from mechwright_scotch_yoke import plates

        return plates.crank(params), plates.yoke(params)

    def tolerances(self, params: ScotchYokeParams, tolerances: Tolerances) -> ToleranceModel:
        """Errors of the stroke, from crank and slot."""
        from mechwright_scotch_yoke.tolerances import ScotchYokeTolerances

        return ScotchYokeTolerances(params, tolerances)

    def synthesise(
        self,
        kind: str,  # noqa: ARG002 - there is one kind
        requirement: Parameters,
        progress: Progress,  # noqa: ARG002 - a closed form takes no time
    ) -> Synthesis[ScotchYokeParams]:
        """The yoke of a wanted stroke and velocity."""
        from mechwright_scotch_yoke import synthesis

        return synthesis.from_stroke(StrokeRequirement.model_validate(requirement))

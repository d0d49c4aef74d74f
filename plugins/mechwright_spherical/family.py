"""The family ``spherical``."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import DesignError, Family, Parameters, Progress, Synthesis, refuse
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.requirements import (
    AdjustablePathRequirement,
    FiveBarPathRequirement,
    FourBarPathRequirement,
    PosesRequirement,
)

if TYPE_CHECKING:
    from mechwright import (
        Array,
        AsMade,
        AxialStack,
        Flange,
        MadePart,
        Motion,
        Part,
        Target,
        ToleranceModel,
        Tolerances,
        Transmission,
    )
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure
    from mechwright.contracts.rule_list import Rules
    from mechwright_spherical.table import SphericalTable


class Spherical(Family[SphericalParams]):
    """Spherical linkages: all axes meet in one point."""

    name = "spherical"
    title = "Spherical linkages"
    summary = "Spherical four-bars, and geared five-bars, set to another path on the sphere in each phase."
    Params = CompleteParams
    batch = 1 << 16
    requirements: ClassVar = {
        "adjustable-path": AdjustablePathRequirement,
        "four-bar-path": FourBarPathRequirement,
        "five-bar-path": FiveBarPathRequirement,
        "poses": PosesRequirement,
    }

    def rules(self) -> "Rules[SphericalTable]":
        """Pins, setting, assembly, transmission angle, path, room for links, drive, stand and strips."""
        from mechwright_spherical.rules.rule_table import RULES

        return RULES

    def table(self, params: SphericalParams, size: int | None = None) -> "SphericalTable":
        """A linkage; a table holds four-bars of one phase that go as far as they can."""
        from mechwright_spherical.defaults.complete_parameters import complete
        from mechwright_spherical.table import SphericalTable

        return SphericalTable.of(params) if size is None else SphericalTable(params, size, complete)

    def solve(self, params: SphericalParams, samples: int) -> "Motion":
        """The travel of the phase that is shown, at constant speed."""
        from mechwright_spherical.kinematics.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: SphericalParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_spherical.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def parts(self, params: SphericalParams) -> "Sequence[Part]":
        """Links, pins, drive, base plate and flat strips."""
        from mechwright_spherical.parts.parts import parts_of

        refuse(self.check(params))
        return parts_of(params)

    def stacks(self, params: SphericalParams) -> "Sequence[AxialStack]":
        """The floats of both shafts of a ground with a motor's flange."""
        from mechwright_spherical.parts.stacks import stacks_of

        return tuple(stacks_of(params))

    def mounting(self, params: SphericalParams) -> "Flange":
        """The flange of the ground link about the input axis, and the base."""
        from mechwright_spherical.parts.mount import mounting_of

        return mounting_of(params)

    def transmission(self, params: SphericalParams) -> "Transmission":
        """None: raises DesignError."""
        angle = "" if params.kind == "five-bar" else f" of {params.four_bar.ground:g} degrees"
        raise DesignError(
            f"its shafts stand at an angle{angle} to each other, and all shafts of a chain are parallel; "
            "take a mechanism of the plane there"
        )

    def settings(self, params: SphericalParams) -> Mapping[str, SphericalParams]:
        """The other phases."""
        table = "five_bar" if params.kind == "five-bar" else "four_bar"
        shown = params.five_bar if params.kind == "five-bar" else params.four_bar
        count = len(shown.phases) + (2 if params.kind == "five-bar" else 1)
        return {
            f"{table}.phase = {phase}": params.model_copy(
                update={table: shown.model_copy(update={"phase": phase})}
            )
            for phase in range(1, count + 1)
            if phase != shown.phase
        }

    def as_made(self, params: SphericalParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """Error of the output, in angles, from the bores of flat strips."""
        from mechwright_spherical.as_made.bores import as_made

        return as_made(params, made)

    def tolerances(self, params: SphericalParams, tolerances: "Tolerances") -> "ToleranceModel":
        """Errors of the output angle and of the path point, from arcs and pins."""
        from mechwright_spherical.as_made.tolerances import SphericalTolerances

        return SphericalTolerances(params, tolerances)

    def figures(self, table: "DesignTable[SphericalParams]") -> "Mapping[str, Figure]":
        """Transmission angles and sums of arcs."""
        from mechwright_spherical.kinematics.figures import figures_of

        return figures_of(cast("SphericalTable", table))

    def extremes(
        self, table: "DesignTable[SphericalParams]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Input, output and transmission angle; the path point and the coupler one by one."""
        from mechwright_spherical.kinematics.figures import extremes_of

        return extremes_of(cast("SphericalTable", table), names)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: Progress
    ) -> Synthesis[SphericalParams]:
        """An adjustable linkage for poses in the plane or paths, or a four-bar for points or poses."""
        if kind == "adjustable-path":
            wanted = AdjustablePathRequirement.model_validate(requirement)
            if wanted.phases:
                from mechwright_spherical.synthesis.phased import from_phases

                return from_phases(wanted, progress)
            from mechwright_spherical.synthesis.adjustable import from_poses

            return from_poses(wanted, progress)
        if kind == "poses":
            from mechwright_spherical.synthesis.poses import from_five

            return from_five(PosesRequirement.model_validate(requirement), progress)
        if kind == "five-bar-path":
            from mechwright_spherical.synthesis.five_bar_path import from_points as five_bars

            return five_bars(FiveBarPathRequirement.model_validate(requirement), progress)
        from mechwright_spherical.synthesis.four_bar_path import from_points

        return from_points(FourBarPathRequirement.model_validate(requirement), progress)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":
        """The points of the path, or of each phase's, on the sphere."""
        from mechwright_spherical.synthesis.targets import targets_of

        if not isinstance(requirement, (AdjustablePathRequirement, FourBarPathRequirement)):
            return super().targets(kind, requirement)
        return targets_of(requirement)

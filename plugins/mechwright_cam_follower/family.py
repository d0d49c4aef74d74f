"""The family ``cam-follower``."""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, ClassVar, cast

from mechwright import Family, Finding, Parameters, Stage, refuse
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.requirements import SizeRequirement

if TYPE_CHECKING:
    from mechwright import (
        AsMade,
        Channel,
        MadePart,
        Motion,
        Mounting,
        Part,
        Progress,
        Synthesis,
        Transmission,
    )
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.rule_list import Rules
    from mechwright_cam_follower.kinematics.mechanism import Mechanism


class CamFollower(Family[CamParams]):
    """A disc cam, alone or with its conjugate, and a slide or lever with a roller or a flat face."""

    name = "cam-follower"
    title = "Cam and follower"
    summary = "A disc cam gives a slide or a lever any motion of rises, dwells and returns."
    size_keys: ClassVar[Mapping[str, float]] = {"base_radius": 40.0}
    Params = CamParams
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {"size": SizeRequirement}
    batch = 1 << 16
    structure: ClassVar[frozenset[str]] = frozenset({"keyway_width"})
    counts: ClassVar[frozenset[str]] = frozenset({"screws"})
    block: ClassVar[int] = 1024

    def rules(self) -> "Rules[Mechanism]":
        """Closure, undercut, openings, walls and room, pressure angle, spring, contact pressure."""
        from mechwright_cam_follower.rules.rule_table import RULES

        return RULES

    def table(self, params: CamParams, size: int | None = None) -> "Mechanism":
        """The mechanism with the dimensions that a design leaves open."""
        from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of

        return mechanism_of(params) if size is None else Mechanism(params, size)

    def remedy(self, params: CamParams, finding: Finding) -> Finding:
        """Gentler motions for a lever that does not close."""
        from mechwright_cam_follower.rules.remedies import with_remedy

        return with_remedy(params, finding)

    def figures(self, table: "DesignTable[CamParams]") -> "Mapping[str, Figure]":
        """Peaks of the motion, sizes of the cams, loads."""
        from mechwright_cam_follower.kinematics.figures import figures_of

        return figures_of(cast("Mechanism", table))

    def channels(self, table: "DesignTable[CamParams]", samples: int) -> "Mapping[str, Channel]":
        """Lift and its rates, pressure angles, curvatures, loads."""
        from mechwright_cam_follower.kinematics.motion import channels_of_turn

        return channels_of_turn(cast("Mechanism", table), samples)

    def masses(self, table: "DesignTable[CamParams]") -> "Mapping[str, PartMass]":
        """Cams, follower, rollers, rails."""
        from mechwright_cam_follower.parts.masses import masses_of

        return masses_of(cast("Mechanism", table))

    def solve(self, params: CamParams, samples: int) -> "Motion":
        """One turn of the cam at constant speed."""
        from mechwright_cam_follower.kinematics.motion import motion_of

        return motion_of(params, samples)

    def stretches(self, params: CamParams, samples: int) -> "Iterator[Motion]":
        """The same, a stretch after the other."""
        from mechwright.contracts.stretch import in_stretches
        from mechwright_cam_follower.kinematics.motion import motion_of

        return in_stretches(partial(motion_of, params), samples)

    def breaks(self, params: CamParams) -> Sequence[float]:
        """Where segments meet, and where their laws are put together."""
        from mechwright_cam_follower.kinematics.mechanism import mechanism_of

        return tuple(params.sense * angle for angle in mechanism_of(params).cycle.breaks)

    def parts(self, params: CamParams) -> "Sequence[Part]":
        """Cams, follower, rollers, rails."""
        from mechwright_cam_follower.parts.parts import parts_of

        refuse(self.check(params), Stage.PARTS)
        return parts_of(params)

    def mounting(self, params: CamParams) -> "Mounting":
        """The shafts of cam and lever."""
        from mechwright_cam_follower.kinematics.mechanism import mechanism_of
        from mechwright_cam_follower.parts.mounting import mounting_of

        return mounting_of(mechanism_of(params))

    def transmission(self, params: CamParams) -> "Transmission":
        """Camshaft in, a lever's axis out; behind a slide stands nothing."""
        from mechwright_cam_follower.kinematics.transmission import CamStage

        return CamStage(params)

    def as_made(self, params: CamParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """How far the follower is from its law with the cam as its program leaves it."""
        from mechwright_cam_follower.as_made.lift_error import as_made

        return as_made(params, made)

    def synthesise(self, kind: str, requirement: Parameters, progress: "Progress") -> "Synthesis[CamParams]":
        """The smallest cam within limits of pressure angle and curvature."""
        if not isinstance(requirement, SizeRequirement):
            return super().synthesise(kind, requirement, progress)
        from mechwright_cam_follower.synthesis.smallest_cam import smallest

        return smallest(requirement, progress)

"""The contract of a family without a motion: things to make that stand still, such as a plate."""

from typing import TYPE_CHECKING, ClassVar

from mechwright.contracts.family import Family, P

if TYPE_CHECKING:
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.transmission import Transmission

SECONDS = 1.0
"""How long its bodies are said to stand."""


class Standing(Family[P]):
    """A family without a motion: parameters in, findings and parts out.

    It is checked, drawn, built and machined as any other. Commands that are about motion say in one line that
    there is none: ``solve`` writes nothing, and ``build`` neither tables nor a page of the motion.
    """

    moves = False
    bodies: ClassVar[tuple[str, ...]]
    """The bodies that its parts are instances of."""

    def transmission(self, params: P) -> "Transmission":  # noqa: ARG002 - of none
        """None: raises DesignError."""
        from mechwright.errors import DesignError

        raise DesignError("nothing turns in it; take a mechanism there")

    def solve(self, params: P, samples: int) -> "Motion":  # noqa: ARG002 - what stands needs no parameters
        """A second in which every body stands where it is: what assemblies and pictures ask for."""
        from mechwright.contracts.motion import TIME, Channel, Motion, Poses
        from mechwright.contracts.stretch import travelled

        time = travelled(SECONDS, samples)
        poses = {body: Poses.planar(0.0, 0.0, 0.0 * time) for body in self.bodies}
        return Motion(TIME, {TIME: Channel(time, "s", "time")}, poses)

"""What the proofs of a build and its sheets both show of the programs, measured once."""

from functools import cached_property
from typing import Any

from mechwright.pipeline import Build
from mechwright_cam.machining import Machined, Machining
from mechwright_cam.proof.simulation import Simulation
from mechwright_cam.proof.walls import Walls, wall_deviation


class Seen:
    """The programs of a build as they cut."""

    def __init__(self, build: Build) -> None:
        self.machining = build.made(Machining)

    @cached_property
    def measured(self) -> list[tuple[Machined, Simulation, Walls]]:
        """Each program with its simulated stock and the deviation along its walls."""
        return [
            (item, item.scene.simulation, wall_deviation(item.scene.sweeps, item.job))
            for item in self.machining.proven_programs
        ]

    @cached_property
    def proofs(self) -> dict[str, dict[str, Any]]:
        """Program name to its part of ``proof.json``."""
        return {
            item.program.name: {
                **item.proof.as_dict(),
                "simulation": simulation.as_dict(),
                "walls": walls.as_dict(),
            }
            for item, simulation, walls in self.measured
        }

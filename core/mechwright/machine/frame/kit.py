"""The parts of a frame while it is put together."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.bought import Bought
from mechwright.contracts.part import Colour, Feature, Instance, Part, Profile
from mechwright.contracts.surroundings import Place
from mechwright.contracts.turned import Turned
from mechwright.geometry import Outline

BRIGHT: Colour = (0.78, 0.79, 0.81)
BLACK: Colour = (0.25, 0.26, 0.28)
PLATE: Colour = (0.70, 0.74, 0.78)
"""Turned steel, bought parts, plates."""

STEEL = "steel"


@dataclass
class Kit:
    """Parts by name, each with its copies, the places where they stand, and the stacks they make."""

    parts: dict[str, Part] = field(default_factory=dict)
    places: dict[str, Place] = field(default_factory=dict)
    stacks: list[AxialStack] = field(default_factory=list)

    def put(self, part: Part, body: str, z: float) -> None:
        """A copy of a part in a body, its underside at the height z, mm."""
        known = self.parts.get(part.name, part)
        self.parts[part.name] = replace(known, instances=(*known.instances, Instance(body, z)))

    def turned(self, name: str, form: Turned, body: str, z: float, *, play: float = 0.0) -> None:
        """A copy of a turned part of steel; ``play`` as :attr:`Part.play`."""
        self.put(Part(name, None, 0.0, STEEL, colour=BRIGHT, turned=form, play=play), body, z)

    def bought(self, name: str, what: Bought, body: str, z: float, *, play: float = 0.0) -> None:
        """A copy of a part that is bought; ``play`` as :attr:`Part.play`."""
        self.put(Part(name, None, 0.0, STEEL, colour=BLACK, bought=what, play=play), body, z)

    def plate(
        self,
        name: str,
        outline: Outline,
        thickness: float,
        material: str,
        holes: Sequence[Feature],
        body: str,
        z: float,
    ) -> None:
        """A plate whose outline has its through holes, ``holes`` all of them as features."""
        rim = Profile("outside", outline.outer, "outside", 0, thickness)
        self.put(Part(name, outline, thickness, material, colour=PLATE, machined=(*holes, rim)), body, z)

"""The bodies of a mechanism: every instance of every part, with its name in the assembly and its poses."""

from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.bodies import Placed, placed
from mechwright.contracts.file_names import free_name
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError


@dataclass(frozen=True)
class Body(Placed):
    """One copy of a part where it stands, with its name in the assembly."""

    name: str

    @property
    def is_plate(self) -> bool:
        """Whether it is a prism, or several on each other."""
        return self.part.outline is not None


def is_spring(part: Part) -> bool:
    """Whether it is a spring that is stretched between two pins."""
    return part.bought is not None and part.bought.stretched


def is_coupling(part: Part) -> bool:
    """Whether it is clamped on the ends of two shafts."""
    return part.bought is not None and part.bought.designation.startswith("flexible coupling")


def is_carriage(part: Part) -> bool:
    """Whether it is the carriage of a linear guide, which stays on its rail."""
    return part.bought is not None and part.bought.designation.startswith("carriage of a ")


def is_motor(part: Part) -> bool:
    """Whether it is a motor of the standard tables, whose shaft needs a coupling."""
    return part.bought is not None and part.bought.designation.startswith(("stepper ", "gear motor "))


def label_of(body: Body) -> str:
    """What a picture calls it: the part, and of a part with several copies the body as well.

    Copies in one body share their label.
    """
    part = body.part
    return part.name if len(part.instances) == 1 else f"{part.name} ({body.instance.body})"


def bodies_of(parts: Sequence[Part], motion: Motion, sample: int = 0) -> list[Body]:
    """All instances, named as the assembly names them: by the body, and by the part where a body has several.

    Raises GeometryError for an instance of a body, or a sample, that the motion does not have.
    """
    if not 0 <= sample < motion.samples:
        raise GeometryError(f"the motion has {motion.samples} samples; there is no sample {sample}")
    names = [instance.body for part in parts for instance in part.instances]
    taken = {name for name in names if names.count(name) == 1}
    found = []
    for one in placed(parts, motion):
        name = one.instance.body
        if names.count(name) > 1:  # names of children of an assembly are unique
            name = free_name(f"{name}-{one.part.name}", taken)
            taken.add(name)
        found.append(Body(one.part, one.instance, one.poses, name))
    return found


def assembly_name(name: str, bodies: Sequence[Body]) -> str:
    """The name of the whole: that of the design, or NAME-assembly where a body has that one.

    An assembly and what stands in it are asked for by name, so that all their names differ.
    """
    taken = [body.name for body in bodies]
    return name if name not in taken else free_name(f"{name}-assembly", taken)

"""One assembly of all stages: where they stand, their parts by new names, and the shafts that join them."""

from dataclasses import dataclass, replace

from mechwright.contracts.motion import Motion
from mechwright.contracts.mounting import GroundPlate, Mounting, MountingError
from mechwright.contracts.parameters import kept
from mechwright.contracts.part import Part
from mechwright.errors import DesignError, MechwrightError
from mechwright.mechanics.chain.links import Link, key_of, links_of
from mechwright.mechanics.chain.motion import motion_of
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.placing import Placed, in_plan
from mechwright.mechanics.chain.planes import Plane, levels_of, plane_of
from mechwright.mechanics.chain.shafts import reaching, shafts_of


@dataclass(frozen=True, eq=False)
class Assembly:
    """Stages in space: their places, planes and parts, by their own names."""

    places: tuple[Placed, ...]
    planes: tuple[Plane, ...]
    parts: tuple[tuple[Part, ...], ...]

    @property
    def shafts(self) -> tuple[Part, ...]:
        """Shafts and spacers that join the stages."""
        return shafts_of(self.places, self.planes)


@kept
def assembly_of(params: ChainParams, families: Families) -> Assembly:
    """The assembly; raises MechwrightError where the parts of a stage cannot be made."""
    links = links_of(params, families)
    parts = tuple(tuple(link.family.parts(link.params)) for link in links)
    planes = tuple(_plane(link, own) for link, own in zip(links, parts, strict=True))
    levels = levels_of(links, planes)
    stand = zip(in_plan(links), levels, strict=True)
    places = tuple(replace(place, level=level) for place, level in stand)
    return Assembly(places, *reaching(places, planes, parts))


def _plane(link: Link, parts: tuple[Part, ...]) -> Plane:
    motion = link.family.solve(link.params, 2)
    levels = {name: float(poses.position[0, 2]) for name, poses in motion.poses.items()}
    mounting = link.transmission.mounting or stage_mounting(link)
    if not isinstance(mounting, Mounting | GroundPlate):
        raise DesignError(
            f"stage.{link.number}.family: the family {link.family.name} does not say where its shafts stand, "
            "so that none can be joined to it; take another family there"
        )
    return plane_of(parts, levels, mounting)


def stage_mounting(link: Link) -> object:
    """How a frame holds a stage, as its family says; raises MountingError with the stage's own keys."""
    try:
        return link.family.mounting(link.params)
    except MountingError as error:
        key, _, said = str(error).partition(": ")
        changes = tuple(
            {key_of(link.number, name): value for name, value in change.items()} for change in error.proposed
        )
        message = f"{key_of(link.number, key)}: stage {link.number}, {link.family.name}: {said}"
        raise MountingError(message, changes) from None


def parts_of(params: ChainParams, families: Families) -> tuple[Part, ...]:
    """Parts of all stages by the chain's names, then shafts and spacers."""
    whole = assembly_of(params, families)
    found: list[Part] = []
    for place, own in zip(whole.places, whole.parts, strict=True):
        link = place.link
        for part in own:
            instances = tuple(replace(one, body=link.named(one.body)) for one in part.instances)
            found.append(replace(part, name=link.named(part.name), instances=instances))
    return (*found, *whole.shafts)


def assembled(params: ChainParams, families: Families, samples: int) -> Motion:
    """The motion in space; where no parts can be made, all stages stand in one plane."""
    try:
        places = assembly_of(params, families).places
    except MechwrightError:
        places = in_plan(links_of(params, families))
    return motion_of(params, families, places, samples)

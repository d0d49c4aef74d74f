"""Where the shafts of a chain stand, so that one frame carries all stages."""

from collections.abc import Iterator
from dataclasses import replace

from mechwright.contracts.mounting import Hub, Mounting, MountingError, Spindle
from mechwright.mechanics.chain.assembly import Assembly, assembly_of, stage_mounting
from mechwright.mechanics.chain.links import Link, key_of
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.placing import Placed
from mechwright.mechanics.chain.planes import Plane
from mechwright.mechanics.chain.shafts import is_shaft, same_size


def mounting_of(params: ChainParams, families: Families) -> Mounting:
    """One spindle for each shaft; those that join two stages carry both hubs, and the spacer between them.

    Torques and forces are shares of the torque at the chain's input: those of a stage times the torque that
    comes into it.

    Raises
    ------
    MountingError
        No frame holds a stage, such as a slide or a stage with a ground plate of its own; or two hubs on one
        shaft have other bores, or keyways.
    """
    whole = assembly_of(params, families)
    shafts = tuple(part.name for part in whole.shafts if is_shaft(part.name))
    turns = tuple(f"stage.{place.link.number}.turned" for place in whole.places[1:])
    return Mounting(tuple(_spindles(whole)), own_shafts=shafts, turning_keys=turns)


def _spindles(whole: Assembly) -> Iterator[Spindle]:
    joined: Spindle | None = None
    entering = 1.0
    for place, plane in zip(whole.places, whole.planes, strict=True):
        link, mounting = place.link, _of_stage(place.link)
        turning, out = link.transmission.input.body, link.transmission.output
        for own in mounting.spindles:
            here = _raised(own, place, plane, entering)
            if own.body == turning and joined is not None:
                yield _together(joined, here, link.number)
            elif out is None or own.body != out.body or place is whole.places[-1]:
                yield here
        leaving = (
            None if out is None else next((one for one in mounting.spindles if one.body == out.body), None)
        )
        if leaving is not None:
            joined = _raised(leaving, place, plane, entering)
            entering = joined.torque


def _of_stage(link: Link) -> Mounting:
    found = stage_mounting(link)
    if isinstance(found, Mounting):
        if found.posts or found.slideways:
            raise MountingError(
                f"stage.{link.number}.family: stage {link.number}, {link.family.name}, has a guide or the "
                "pin of a spring on the bearing plates, and no frame of a chain has them; leave [machine] out"
            )
        return found
    raise MountingError(
        f"stage.{link.number}.family: stage {link.number}, {link.family.name}, has a ground plate of its "
        "own, and no frame holds that with the bearings of other stages; leave [machine] out"
    )


def _raised(own: Spindle, place: Placed, plane: Plane, entering: float) -> Spindle:
    """The spindle of a stage in the chain."""
    link, hub = place.link, own.hub
    return replace(
        own,
        name=link.named(own.name),
        body=link.named(own.body),
        point=place.at(own.point),
        hub=replace(hub, low=hub.low + place.level, high=hub.high + place.level),
        bore_key=key_of(link.number, own.bore_key),
        torque=own.torque * entering,
        force=own.force * entering,
        drives=own.drives and link.number == 1,
        origin=plane.origins[own.body] + place.level,
    )


def _together(lower: Spindle, upper: Spindle, number: int) -> Spindle:
    """One shaft through the hub that turns a stage, and the one that it turns."""
    low, high = lower.hub, upper.hub
    if not same_size(low.bore, high.bore):
        raise MountingError(
            f"{upper.bore_key}: the shaft into stage {number} carries hubs with bores of {low.bore:g} and "
            f"{high.bore:g} mm, and that of a frame has one; set {upper.bore_key} = {low.bore:g}",
            ({upper.bore_key: low.bore}, {lower.bore_key: high.bore}),
        )
    keyed = next((one for one in (lower, upper) if one.hub.key), None)
    if keyed is not None:
        key = f"{keyed.bore_key.rpartition('.')[0]}.keyway_width"
        raise MountingError(
            f"{key}: the shaft into stage {number} carries two hubs, and a key holds one; both are bonded to "
            f"it: set {key} = 0",
            ({key: 0},),
        )
    grip = min(low.grip, high.grip)
    pieces = (*low.stacked, high.low - low.high, *high.stacked)
    hub = Hub(
        low.low, high.high, low.bore, material=low.material, recess=high.recess, bonded=grip, pieces=pieces
    )
    return replace(lower, hub=hub, force=lower.force + upper.force)

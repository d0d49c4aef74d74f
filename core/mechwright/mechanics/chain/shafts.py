"""The shafts of a chain: into the first stage, between two stages, and out of the last one.

A shaft fills the bores of the hubs that it carries. Between the planes of two stages it has a spacer where
both bores are alike, else a collar of its own. The first shaft stands out below, the last one above; those
between stand out below the first stage alone, where nothing else turns.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.mounting import GroundPlate, Hub
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.turned import Step, Turned, tube
from mechwright.mechanics.chain.links import key_of
from mechwright.mechanics.chain.placing import Placed
from mechwright.mechanics.chain.planes import Plane

OUT = 2.0
"""How far a shaft stands out, in its diameters: a bearing, and room for a coupling."""

COLLAR = 1.5
"""Outside of a spacer or collar over the shaft: a wall of a quarter of it."""

MATERIAL, SPACER_MATERIAL = "steel", "steel"

_SAME = 1e-6
"""mm. Bores and heights that differ by less are the same."""


_SHAFT = "shaft-"
"""How the names of shafts begin."""


def is_shaft(name: str) -> bool:
    """Whether a part of :func:`shafts_of` is a shaft, and no spacer."""
    return name.startswith(_SHAFT)


def same_size(one: float, two: float) -> bool:
    """Whether two bores, mm, are the same."""
    return abs(one - two) <= _SAME


@dataclass(frozen=True)
class Seat:
    """What sits on a shaft: a hub between two heights of the chain, mm, and the key that sets its bore.

    ``body`` is the chain's name of the hub's body, whose origin stands at the height ``origin``, mm.
    """

    hub: Hub
    key: str
    body: str
    origin: float

    @property
    def low(self) -> float:
        """Its lower end, mm."""
        return self.hub.low

    @property
    def high(self) -> float:
        """Its upper end, mm."""
        return self.hub.high

    def carries(self, name: str, low: float, form: Turned, material: str = MATERIAL) -> Part:
        """A turned part that turns with the hub and whose lower end stands at a height of the chain, mm."""
        at = Instance(self.body, low - self.origin)
        return Part(name, None, 0.0, material, (at,), turned=form)


def seat_of(place: Placed, plane: Plane, body: str) -> Seat | None:
    """The seat of a stage's body, at the heights of the chain; None without a hub."""
    hub = plane.hub(body)
    if hub is None:
        return None
    raised = replace(hub, low=hub.low + place.level, high=hub.high + place.level)
    keys = {one.body: one.bore_key for one in plane.mounting.spindles} if plane.mounting else {}  # type: ignore[union-attr]
    key = key_of(place.link.number, keys.get(body, ""))
    return Seat(raised, key, place.link.named(body), plane.origins[body] + place.level)


def shafts_of(places: tuple[Placed, ...], planes: tuple[Plane, ...]) -> tuple[Part, ...]:
    """All shafts and spacers; of a stage with a shaft of its own there is none to make."""
    parts: list[Part] = []
    first, last = places[0], places[-1]
    begin = seat_of(first, planes[0], first.link.transmission.input.body)
    if begin is not None:
        size = begin.hub.bore
        whole = Turned((Step(size, OUT * size + begin.hub.length),))
        parts.append(begin.carries(f"{_SHAFT}in", begin.low - OUT * size, whole))
    for place, plane, after, above in zip(places, planes, places[1:], planes[1:], strict=False):
        parts += _between(place, plane, after, above)
    out = last.link.transmission.output
    end = None if out is None else seat_of(last, planes[-1], out.body)
    if end is not None:
        size = end.hub.bore
        whole = Turned((Step(size, end.hub.length + OUT * size),))
        parts.append(end.carries(f"{_SHAFT}out", end.low, whole))
    return tuple(parts)


def _between(place: Placed, plane: Plane, after: Placed, above: Plane) -> Iterator[Part]:
    out = place.link.transmission.output
    if out is None:
        return
    lower = seat_of(place, plane, out.body)
    upper = seat_of(after, above, after.link.transmission.input.body)
    if lower is None:
        return
    number, low = place.link.number, lower.low
    if isinstance(above.mounting, GroundPlate):
        room = above.mounting.bare + after.level - lower.high
        if room > _SAME:  # the shaft is that of the stage's own ground plate
            bore = above.mounting.diameter
            ring = tube(bore, COLLAR * bore, room)
            part = lower.carries(f"spacer-{number}", lower.high, ring, SPACER_MATERIAL)
            # It ends below the neck, whose circlip may stand higher than the neck's lower end.
            yield replace(part, play=above.mounting.neck)
        return
    if upper is None:
        return
    one, two, room = lower.hub.bore, upper.hub.bore, upper.low - lower.high
    tail = OUT * one if number == 1 else 0.0
    outside = COLLAR * max(one, two)
    if same_size(one, two):
        whole = Turned((Step(one, tail + upper.high - low),))
        yield lower.carries(f"{_SHAFT}{number}", low - tail, whole)
        yield lower.carries(f"spacer-{number}", lower.high, tube(one, outside, room), SPACER_MATERIAL)
        return
    steps = (Step(one, tail + lower.hub.length), Step(outside, room), Step(two, upper.hub.length))
    yield lower.carries(f"{_SHAFT}{number}", low - tail, Turned(steps))


def shaft_findings(places: tuple[Placed, ...], planes: tuple[Plane, ...]) -> Iterator[Finding]:
    """Hubs that no shaft joins, and shafts of ground plates that fit no hub."""
    for place, plane, after, above in zip(places, planes, places[1:], planes[1:], strict=False):
        out = place.link.transmission.output
        if out is None:
            continue
        number = after.link.number
        lower = seat_of(place, plane, out.body)
        if lower is None:
            yield Finding.error(
                "chain.shaft",
                f"stage.{place.link.number}",
                f"stage {place.link.number}, {place.link.family.name}: its output turns on a plate of its "
                f"own, so that no shaft goes on to stage {number}",
                remedy="make it the last stage",
                stage=Stage.PARTS,
            )
        elif isinstance(above.mounting, GroundPlate):
            yield from _on_stub(lower, after, above.mounting)


def reaching(
    places: tuple[Placed, ...], planes: tuple[Plane, ...], parts: tuple[tuple[Part, ...], ...]
) -> tuple[tuple[Plane, ...], tuple[tuple[Part, ...], ...]]:
    """Planes and parts with the shafts of ground plates as long as the hubs that turn them want."""
    found, own = list(planes), list(parts)
    for number, (place, after) in enumerate(pairwise(places), 1):
        out, plate = place.link.transmission.output, planes[number].mounting
        lower = None if out is None else seat_of(place, planes[number - 1], out.body)
        if lower is None or not isinstance(plate, GroundPlate):
            continue
        more = plate.end + after.level - lower.low
        longer = _lengthened(parts[number], plate, more) if more > _SAME else None
        if longer is not None:
            own[number] = longer
            found[number] = replace(planes[number], mounting=replace(plate, end=plate.end - more))
    return tuple(found), tuple(own)


def _lengthened(parts: tuple[Part, ...], plate: GroundPlate, more: float) -> tuple[Part, ...] | None:
    """Parts of a stage with the lower end of its shaft longer; None where no turned part is that shaft."""
    ends = [
        (part.instances[0].z, part)
        for part in parts
        if part.turned is not None
        and len(part.instances) == 1
        and part.instances[0].body == plate.shaft
        and abs(part.turned.steps[0].foot - plate.diameter) <= _SAME
    ]
    if not ends:
        return None
    low, shaft = min(ends, key=lambda one: one[0])
    deeper = (replace(shaft.instances[0], z=low - more),)
    turned = None if shaft.turned is None else shaft.turned.lengthened(more)
    longer = replace(shaft, turned=turned, build=None, instances=deeper)
    return tuple(longer if part is shaft else part for part in parts)


def _alike(lower: Seat, after: Placed, plate: GroundPlate) -> list[tuple[str, float]]:
    """Keys of a hub and of the shaft in it, each with the diameter of the other."""
    key = plate.diameter_key.removeprefix("parameters.")
    return [(lower.key, plate.diameter), (key_of(after.link.number, key), lower.hub.bore)]


def _on_stub(lower: Seat, after: Placed, plate: GroundPlate) -> Iterator[Finding]:
    """The hub on the shaft's end below a ground plate."""
    number, end = after.link.number, plate.end + after.level
    if not same_size(lower.hub.bore, plate.diameter):
        alike = _alike(lower, after, plate)
        yield Finding.error(
            "chain.bore",
            lower.key,
            f"the shaft of stage {number} has {plate.diameter:g} mm at its end, and the hub that turns it a "
            f"bore of {lower.hub.bore:g} mm",
            lower.hub.bore,
            plate.diameter,
            "mm",
            f"make both alike: {' or '.join(f'{key} = {size:g}' for key, size in alike)}",
            Stage.PARTS,
            tuple({key: size} for key, size in alike),
        )
    if end > lower.low + _SAME:
        yield Finding.error(
            "chain.stub",
            f"stage.{number}.gap",
            f"the shaft of stage {number} ends {end - lower.low:.4g} mm above the lower end of the hub that "
            "turns it",
            end - lower.low,
            0.0,
            "mm",
            "make the hub thinner, or the shaft a turned part, which is made as long as the hub wants",
            Stage.PARTS,
        )

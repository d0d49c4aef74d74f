"""What is used up in fitting, and small parts that the assembly does not show.

Glossary
--------
loose dowel
    One whose holes stand in parts that are put together, and that is no body of the assembly.
bonded
    Held by a retaining compound.
"""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from mechwright.contracts.bought import Bought
from mechwright.contracts.part import Bore, Part
from mechwright.errors import DesignError
from mechwright.mechanics.mating.rounds import NEAR, rounds_of
from mechwright.standards.dowels import dowel_for
from mechwright.standards.ordering import order_of
from mechwright.standards.screws import needs_washer, washer
from mechwright.standards.supply import Supply
from mechwright_cad.bodies import Body
from mechwright_cad.contacts.screw_joints import ScrewJoint, screw_of

GREASE = "grease for plain bearings"

DOWELS = frozenset({"ISO 8734", "ISO 2338"})
BUSHES = "ISO 2795"
RINGS = frozenset({"DIN 471", "DIN 472"})
SHIMS = "DIN 988"


def supplies_of(
    bodies: Sequence[Body],
    joints: Collection[ScrewJoint],
    numbers: Mapping[str, int],
    *,
    bonded: bool = False,
    sample: int = 0,
) -> list[Supply]:
    """Loose dowels and washers, then compounds, grease, oil and spare parts, as far as something needs them.

    Parameters
    ----------
    bodies
        Of the assembly.
    joints
        Its screwed joints.
    numbers
        Name of a part to the number of its item.
    bonded
        Whether a pin or shaft of the assembly is bonded into its hole.
    sample
        Of the poses of the bodies at which dowels are looked for.
    """
    parts = {body.part.name: body.part for body in bodies}
    dowels = list(_loose_dowels(bodies, numbers, sample))
    return [
        *dowels,
        *_washers(bodies, joints, numbers),
        *_compounds(parts, numbers, bonded=bonded or bool(dowels)),
        *_grease(parts.values()),
        *_oil(parts, joints, numbers),
        *_spares(parts, numbers),
    ]


def _loose_dowels(bodies: Sequence[Body], numbers: Mapping[str, int], sample: int) -> Iterator[Supply]:
    """Of each size: through all parts that have its hole in one line, where no pin stands."""
    lines: dict[tuple[int, int, float], list[tuple[float, float, str]]] = {}
    for body in bodies:
        turn, place = body.poses.rotation[sample], body.poses.position[sample]
        for bore in body.part.features:
            if isinstance(bore, Bore) and bore.name.startswith("dowel"):
                top = body.part.thickness - bore.top
                ends = [
                    turn @ np.array((*bore.centre, z + body.instance.z)) + place
                    for z in (top - bore.depth, top)
                ]
                low, high = sorted(float(one[2]) for one in ends)
                key = (round(float(ends[0][0]) / NEAR), round(float(ends[0][1]) / NEAR), bore.diameter)
                lines.setdefault(key, []).append((low, high, body.part.name))
    sizes: dict[tuple[float, float], list[tuple[str, ...]]] = {}
    for (x, y, diameter), spans in lines.items():
        at = (x * NEAR, y * NEAR)
        if len(spans) > 1 and not _occupied(bodies, at, diameter, sample):
            long = max(high for _, high, _ in spans) - min(low for low, _, _ in spans)
            sizes.setdefault((diameter, round(long, 3)), []).append(tuple(name for *_, name in spans))
    for (diameter, long), places in sizes.items():
        items = _items(numbers, (name for those in places for name in those))
        yield _dowel(diameter, long, len(places), f"joins {items}; not drawn")


def _occupied(bodies: Sequence[Body], at: tuple[float, float], diameter: float, sample: int) -> bool:
    """Whether a pin of about this diameter stands at a place, mm."""
    return any(
        not one.inside
        and abs(one.diameter - diameter) < 0.1 * diameter
        and math.dist(at, (float(one.at[0]), float(one.at[1]))) < 2 * NEAR
        for body in bodies
        if body.part.outline is None
        for one in rounds_of(body, sample)
    )


def _dowel(diameter: float, room: float, count: int, note: str) -> Supply:
    try:
        return _sold("dowel", dowel_for(diameter, room).bought, note, count)
    except DesignError:
        order = f"round bar {diameter:g} h6, sawn {room:g} mm"
        return Supply("dowel", order, f"{note}; no standard pin has this size", count)


def _sold(name: str, what: Bought, note: str, count: int = 1) -> Supply:
    found = order_of(what)
    return Supply(name, found.text, note, count, "pcs", what.designation, what.standard, found.inch)


def _washers(
    bodies: Sequence[Body], joints: Collection[ScrewJoint], numbers: Mapping[str, int]
) -> Iterator[Supply]:
    """Under heads that lie over coarse holes or on plastics, where the assembly has none."""
    under: dict[float, dict[int, tuple[str, str]]] = {}
    for joint in joints:
        if joint.clamped and joint.what.standard == "4762":
            k, seat = joint.clamped[0]
            part, size = bodies[k].part, joint.what.of
            if size.washer and part.outline is not None and needs_washer(size.size, seat.hole, part.material):
                under.setdefault(size.size, {})[joint.screw] = (bodies[joint.screw].part.name, part.name)
    for thread, screws in under.items():
        ring = washer(thread)
        items = _items(numbers, (screw for screw, _ in screws.values()))
        where = _items(numbers, (plate for _, plate in screws.values()))
        note = f"under {items} on {where}, a coarse hole or plastic; not drawn, {ring.height:g} mm high"
        yield _sold("washer", ring.bought, note, len(screws))


def _compounds(parts: Mapping[str, Part], numbers: Mapping[str, int], *, bonded: bool) -> Iterator[Supply]:
    screws = [name for name, part in parts.items() if screw_of(part) is not None]
    if screws:
        note = f"a drop on the thread of {_items(numbers, screws)}; not on threads in plastics"
        yield Supply("thread locker", "thread locker, medium strength, 10 ml", note, 1, "bottle")
    fast = [name for name, part in parts.items() if _standard(part) in DOWELS | {BUSHES}]
    if bonded or fast:
        where = f"{_items(numbers, fast)}: " if fast else ""
        note = f"{where}in the holes of pins and bushes that are not tight, and under hubs without a key"
        yield Supply("retaining compound", "retaining compound, high strength, 10 ml", note, 1, "bottle")
    if screws or bonded or fast:
        yield Supply(
            "cleaner",
            "isopropanol or brake cleaner, lint-free cloth",
            "degreases what is locked or bonded",
            1,
            "as needed",
        )


def _grease(parts: Collection[Part]) -> Iterator[Supply]:
    if any(part.turned is not None or part.bought is not None for part in parts):
        note = "on every pin, shaft and bush that turns; not on parts of POM"
        yield Supply(GREASE, "lithium grease NLGI 2", note, 1, "as needed")


def _oil(
    parts: Mapping[str, Part], joints: Collection[ScrewJoint], numbers: Mapping[str, int]
) -> Iterator[Supply]:
    bushes = [name for name, part in parts.items() if _standard(part) == BUSHES]
    if bushes or any(joint.tightening is not None for joint in joints):
        of = f", and for {_items(numbers, bushes)}" if bushes else ""
        note = f"under the heads of screws, whose torques are for oiled ones{of}"
        yield Supply("oil", "machine oil ISO VG 100", note, 1, "as needed")


def _spares(parts: Mapping[str, Part], numbers: Mapping[str, int]) -> Iterator[Supply]:
    for name, part in parts.items():
        if part.bought is not None and _standard(part) in RINGS:
            note = f"spare for item {numbers[name]}: a ring that was opened too far is scrap"
            yield _sold("spare ring", part.bought, note)
    shims = [name for name, part in parts.items() if _standard(part) == SHIMS]
    if shims:
        note = f"the play that is measured is filled in place of {_items(numbers, shims)}"
        yield Supply("shims", "shim rings DIN 988, 0.1 0.15 0.2 0.3 0.5 1 mm, of each size", note, 1, "set")


def _standard(part: Part) -> str:
    return "" if part.bought is None else part.bought.standard


def _items(numbers: Mapping[str, int], names: "Iterator[str] | Sequence[str]") -> str:
    """Items by their numbers.

    >>> _items({"a": 3, "b": 1, "c": 1}, ["a", "b", "c"]), _items({"a": 3}, ["a"])
    ('items 1, 3', 'item 3')
    """
    found = sorted({numbers[name] for name in names})
    return f"item{'s' if len(found) > 1 else ''} {', '.join(map(str, found))}"

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
from mechwright.standards import bushes, circlips, shims
from mechwright.standards.dowels import dowel_for
from mechwright.standards.ordering import order_of
from mechwright.standards.screws import needs_washer, washer
from mechwright.standards.supply import Supply
from mechwright_cad.bodies import Body
from mechwright_cad.contacts.screw_joints import ScrewJoint

GREASE = "grease for plain bearings"


def supplies_of(
    bodies: Sequence[Body],
    joints: Collection[ScrewJoint],
    numbers: Mapping[str, int],
    *,
    bonded: Sequence[str] = (),
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
        Names of the parts that retaining compound holds in their holes.
    sample
        Of the poses of the bodies at which dowels are looked for.
    """
    parts = {body.part.name: body.part for body in bodies}
    loose = list(_loose_dowels(bodies, numbers, sample))
    return [
        *loose,
        *_washers(bodies, joints, numbers),
        *_compounds([bodies[one.screw].part.name for one in joints if one.is_locked], bonded, loose, numbers),
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


def _compounds(
    locked: Sequence[str], bonded: Sequence[str], loose: Collection[Supply], numbers: Mapping[str, int]
) -> Iterator[Supply]:
    if locked:
        note = f"a drop on the thread of {_items(numbers, locked)}; not on threads in plastics"
        yield Supply("thread locker", "thread locker, medium strength, 10 ml", note, 1, "bottle")
    if bonded or loose:
        own = [_items(numbers, bonded)] if bonded else []
        note = " and ".join([*own, *(["the dowels that are not drawn"] if loose else [])])
        yield Supply(
            "retaining compound", "retaining compound, high strength, 10 ml", f"holds {note}", 1, "bottle"
        )
    if locked or bonded or loose:
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
    pressed = [name for name, part in parts.items() if _standard(part) == bushes.STANDARD]
    if pressed or any(joint.tightening is not None for joint in joints):
        of = f", and for {_items(numbers, pressed)}" if pressed else ""
        note = f"under the heads of screws, whose torques are for oiled ones{of}"
        yield Supply("oil", "machine oil ISO VG 100", note, 1, "as needed")


def _spares(parts: Mapping[str, Part], numbers: Mapping[str, int]) -> Iterator[Supply]:
    for name, part in parts.items():
        if part.bought is not None and _standard(part) in circlips.STANDARDS:
            note = f"spare for item {numbers[name]}: a ring that was opened too far is scrap"
            yield _sold("spare ring", part.bought, note)
    rings = [name for name, part in parts.items() if _standard(part) == shims.STANDARD]
    if rings:
        note = f"the play that is measured is filled in place of {_items(numbers, rings)}"
        sizes = " ".join(f"{one:g}" for one in shims.THICKNESSES)
        yield Supply("shims", f"shim rings {shims.STANDARD}, {sizes} mm, of each size", note, 1, "set")


def _standard(part: Part) -> str:
    return "" if part.bought is None else part.bought.standard


def _items(numbers: Mapping[str, int], names: "Iterator[str] | Sequence[str]") -> str:
    """Items by their numbers.

    >>> _items({"a": 3, "b": 1, "c": 1}, ["a", "b", "c"]), _items({"a": 3}, ["a"])
    ('items 1, 3', 'item 3')
    """
    found = sorted({numbers[name] for name in names})
    return f"item{'s' if len(found) > 1 else ''} {', '.join(map(str, found))}"

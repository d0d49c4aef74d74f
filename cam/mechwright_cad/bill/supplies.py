"""What is used up in fitting, and small parts that the assembly does not show.

Glossary
--------
loose dowel
    One whose holes stand in parts that are put together, and that is no body of the assembly.
bonded
    Held by a retaining compound.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence

from mechwright.contracts.bought import Bought
from mechwright.contracts.part import Part
from mechwright.errors import DesignError
from mechwright.mechanics.mating.undrawn_dowels import UndrawnDowel, undrawn_dowels
from mechwright.standards import bushes, circlips, shims
from mechwright.standards.dowels import dowel_for
from mechwright.standards.ordering import order_of
from mechwright.standards.screws import needs_washer, washer
from mechwright.standards.supply import Supply
from mechwright_cad.bill.items import FIRST
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
    loose = list(_undrawn_dowels(bodies, numbers, sample))
    return [
        *loose,
        *_washers(bodies, joints, numbers),
        *_compounds(_locked(bodies, joints, numbers), bonded, loose, numbers),
        *_grease(parts.values()),
        *_oil(parts, joints, numbers),
        *_spares(parts, numbers),
        *_reamers(parts, numbers),
        *_tools(parts, joints),
    ]


def dowel_items(bodies: Sequence[Body], sample: int) -> dict[int, list[UndrawnDowel]]:
    """Number of an item to the dowels of one size that are no bodies: the first supplies of a list."""
    sizes: dict[tuple[float, float], list[UndrawnDowel]] = {}
    for one in undrawn_dowels(bodies, sample):
        sizes.setdefault((one.diameter, one.room), []).append(one)
    return dict(enumerate(sizes.values(), FIRST["supply"]))


def _undrawn_dowels(bodies: Sequence[Body], numbers: Mapping[str, int], sample: int) -> Iterator[Supply]:
    """Of each size: through all parts that have its hole in one line, where no pin stands."""
    for those in dowel_items(bodies, sample).values():
        items = _items(numbers, (bodies[seat.body].part.name for one in those for seat in one.seats))
        yield _dowel(those[0].diameter, those[0].room, len(those), f"joins {items}; not drawn")


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


def _locked(bodies: Sequence[Body], joints: Collection[ScrewJoint], numbers: Mapping[str, int]) -> list[str]:
    """Which screws are locked in which items: the same screw may stand elsewhere, where it is not."""
    where: dict[int, set[int]] = {}
    for one in joints:
        if one.is_locked:
            screw, holder = (numbers[bodies[k].part.name] for k in (one.screw, one.holder))
            where.setdefault(screw, set()).add(holder)
    return [
        f"item {screw} in {' and '.join(map(str, sorted(holders)))}"
        for screw, holders in sorted(where.items())
    ]


def _compounds(
    locked: Sequence[str], bonded: Sequence[str], loose: Collection[Supply], numbers: Mapping[str, int]
) -> Iterator[Supply]:
    if locked:
        note = f"a drop on the thread of {', '.join(locked)}; not on threads in plastics"
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
    sold = {
        numbers[name]: part.bought
        for name, part in parts.items()
        if part.bought is not None and _standard(part) in circlips.STANDARDS
    }
    for number, ring in sold.items():
        yield _sold("spare ring", ring, f"spare for item {number}: a ring that was opened too far is scrap")
    rings = [name for name, part in parts.items() if _standard(part) == shims.STANDARD]
    if rings:
        note = f"the play that is measured is filled in place of {_items(numbers, rings)}"
        sizes = " ".join(f"{one:g}" for one in shims.THICKNESSES)
        yield Supply("shims", f"shim rings {shims.STANDARD}, {sizes} mm, of each size", note, 1, "set")


def _reamers(parts: Mapping[str, Part], numbers: Mapping[str, int]) -> Iterator[Supply]:
    """For bores of bushes that the press narrows: an adjustable one where the class is not H7."""
    wanted: dict[str, list[str]] = {}
    for name, part in parts.items():
        form = part.turned
        if form is not None and form.bore_fit is not None and any(step.fit for step in form.steps):
            wanted.setdefault(form.bore_fit.text, []).append(name)
    for text, names in wanted.items():
        size, _, name = text.partition(" ")
        kind = "hand reamer" if name.startswith("H7") else "adjustable hand reamer"
        note = f"reams {_items(numbers, names)} to {text} after pressing"
        yield Supply("reamer", f"{kind} for {size} mm", note, 1, "tool")


def _tools(parts: Mapping[str, Part], joints: Collection[ScrewJoint]) -> Iterator[Supply]:
    """What a fitter has in hand."""
    keys = sorted({one.what.key for one in joints})
    flats = sorted({one.across for part in parts.values() if part.turned for one in part.turned.flats})
    standards = {_standard(part) for part in parts.values()}
    words = [f"hexagon keys {_widths(keys)} mm"] if keys else []
    words += [f"two open spanners {_widths(flats)} mm"] if flats else []
    words += ["torque screwdriver or wrench"] if any(one.tightening is not None for one in joints) else []
    words += ["pliers for outer circlips"] if circlips.ON_SHAFTS in standards else []
    words += ["dial gauge with stand"] if shims.STANDARD in standards else []
    words += ["feeler gauges"] if any(part.turned for part in parts.values()) else []
    words += ["soft hammer", "vice or arbor press"] if words else []
    if words:
        yield Supply("hand tools", ", ".join(words), "for the steps of the assembly guide", 1, "set")


def _widths(sizes: Sequence[float]) -> str:
    return ", ".join(f"{one:g}" for one in sizes)


def _standard(part: Part) -> str:
    return "" if part.bought is None else part.bought.standard


def _items(numbers: Mapping[str, int], names: "Iterator[str] | Sequence[str]") -> str:
    """Items by their numbers.

    >>> _items({"a": 3, "b": 1, "c": 1}, ["a", "b", "c"]), _items({"a": 3}, ["a"])
    ('items 1, 3', 'item 3')
    """
    found = sorted({numbers[name] for name in names})
    return f"item{'s' if len(found) > 1 else ''} {', '.join(map(str, found))}"

"""How deep a pin goes, and into which of several holes."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.holes import hole
from mechwright.contracts.part import Bore
from mechwright.mechanics.mating.rounds import Match, Round, rounds_of
from mechwright_cad.assembly_order.groups import is_bearing
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.bodies import is_coupling

FLUSH = 0.05
"""Ends nearer to a face than this, mm, are flush with it."""

TURNS = 0.1
"""What is left between the shoulder of a pin and a part that turns under it, mm."""

WIDER = 0.5
"""By how much a shoulder is wider than the hole that it bears beside, mm."""


def depths(order: Order, step: Step, found: Sequence[Match], name: Callable[[int], str]) -> Iterator[str]:
    """How far pins go into the holes that hold them: by the end that can be measured.

    Of a pin that comes this is the end whence it comes, over the part that it passes first; of a part that is
    put onto a pin the end that comes out of it.
    """
    if step.way is None:
        return
    for match in found:
        moved = match.pin in step.moved
        if moved == (match.hole in step.moved) or not _fixed(order, match):
            continue
        way = np.array(step.way) * (1.0 if moved else -1.0)
        if abs(way @ match.outside.axis) < 1 - FLUSH:
            continue
        verb = "Press" if order.seats.kind(match) == "pressed" else "Set"
        if moved:
            each = "it" if len(step.moved) == 1 else "each"
            said = _comes(order, [one for one in found if one.pin == match.pin], match, way, name)
        else:
            each = f"{name(match.hole)} on"
            said = _put_on(order, step, match, way, name)
        if said:
            yield said if said.startswith("Its") else f"{verb} {each} until {said}"


def _fixed(order: Order, match: Match) -> bool:
    """Whether only its fit, or a bond, says how deep a pin is."""
    both = (order.bodies[match.pin], order.bodies[match.hole])
    fixed = order.seats.kind(match) in {"pressed", "bonded"}
    return fixed and not any(is_bearing(one) or is_coupling(one.part) for one in both)


def _comes(
    order: Order, through: Sequence[Match], match: Match, way: Array, name: Callable[[int], str]
) -> str:
    """Of a pin that comes along a way, through the holes of all matches."""
    pin = order.bodies[match.pin]
    rounds = [one for one in rounds_of(pin, order.sample) if not one.inside]
    start = min(_span(one, way)[0] for one in rounds)
    first = min(through, key=lambda one: _faces(order, one, way)[0])
    mouth = _faces(order, first, way)[0]
    shoulders = [one for one in rounds if one.diameter > first.inside.diameter + WIDER]
    if any(abs(_span(one, way)[1] - mouth) < FLUSH for one in shoulders):
        if order.seats.is_fast(first):
            return f"Its shoulder rests on {name(first.hole)}."
        return (
            f"a feeler gauge of {TURNS} mm just passes between its shoulder and {name(first.hole)}, "
            "which has to turn."
        )
    return _measured(name(match.pin), name(first.hole), mouth - start)


def _put_on(order: Order, step: Step, match: Match, way: Array, name: Callable[[int], str]) -> str:
    """Of a part that is put onto a pin, which goes into it along a way; nothing where a part stops it."""
    barred = order.table.barred(-way)
    if any(barred[match.hole, k] and order.standing.touch(match.hole, k) for k in step.onto):
        return ""
    rounds = [one for one in rounds_of(order.bodies[match.pin], order.sample) if not one.inside]
    end = max(_span(one, way)[1] for one in rounds)
    return _measured(name(match.pin), name(match.hole), end - _faces(order, match, way)[1])


def _measured(pin: str, plate: str, out: float) -> str:
    """The end of a pin over a part, mm, below it where it is negative."""
    if abs(out) < FLUSH:
        return f"the end of {pin} is flush with {plate}."
    if out > 0:
        return f"{pin} stands {out:.1f} mm out of {plate}."
    return f"the end of {pin} lies {-out:.1f} mm below the face of {plate}."


def _span(one: Round, way: Array) -> tuple[float, float]:
    """Where a round face begins and ends along a way, mm."""
    ends = sorted(float((one.at + height * one.axis) @ way) for height in (one.low, one.high))
    return ends[0], ends[1]


def _faces(order: Order, match: Match, way: Array) -> tuple[float, float]:
    """Where the part with a hole begins and ends along a way, mm: a plate by its faces, else by the hole."""
    body = order.bodies[match.hole]
    if body.part.outline is None:
        return _span(match.inside, way)
    axis = body.poses.rotation[order.sample][:, 2]
    low = float((body.poses.position[order.sample] + body.instance.z * axis) @ way)
    high = low + body.part.thickness * float(axis @ way)
    return min(low, high), max(low, high)


def chosen_hole(order: Order, match: Match, name: Callable[[int], str]) -> str:
    """Into which of several alike holes a pin goes, where the others stay empty; else nothing.

    A hole may be that of a plate, or the bore of a bush in a hole of a plate.
    """
    alike = [(match.hole, match.inside.face)]
    if order.seats.is_bush(match.hole):
        plates = _bushed(order, match.hole)
        if plates is None:
            return ""
        plate, face = plates
        others = [
            found
            for k, body in enumerate(order.bodies)
            if body.part.name == order.bodies[match.hole].part.name
            and k != match.hole
            and _empty(order, k, match.inside.face)
            and (found := _bushed(order, k)) is not None
            and found[0] == plate
        ]
        alike = [(plate, face), *others]
    else:
        part = order.bodies[match.hole].part
        alike += [
            (match.hole, bore.name)
            for bore in part.features
            if isinstance(bore, Bore)
            and bore.fit is not None
            and abs(bore.diameter - match.inside.diameter) < FLUSH
            and bore.name != match.inside.face
            and _empty(order, match.hole, bore.name)
        ]
    if len(alike) < 2:
        return ""
    plate, face = alike[0]
    x, y = hole(order.bodies[plate].part, face).centre
    names = [other for _, other in alike[1:]]
    listed = names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
    stay = "stays" if len(names) == 1 else "stay"
    return (
        f"{name(match.pin)} goes into the hole {face} of {name(plate)}, at x {x:.1f}, y {y:.1f} mm in its "
        f"drawing; {listed} {stay} empty in this setting."
    )


def _empty(order: Order, k: int, face: str) -> bool:
    return not any(one.hole == k and one.inside.face == face for one in order.seats.matches)


def _bushed(order: Order, bush: int) -> tuple[int, str] | None:
    """The plate that a bush sits in, and the name of its hole there."""
    return next(
        (
            (one.hole, one.inside.face)
            for one in order.seats.matches
            if one.pin == bush and order.bodies[one.hole].part.outline is not None
        ),
        None,
    )

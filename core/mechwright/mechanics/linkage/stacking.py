"""The layers in which plates stand so that nothing collides over a turn.

Plates of one layer share a height, so no two of them may come closer than a clearance while the mechanism
turns. A spindle takes up every layer from its lowest plate to its highest, so no other plate there may come
close to it. Of all ways to deal plates to layers the flattest is taken, and among those the one whose
spindles are shortest.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.mechanics.linkage.closeness import Closeness, Plate, Spindle
from mechwright.mechanics.linkage.layer_search import Problem, flattest

STACK_SAMPLES = 361
"""Positions of a crank per turn, both ends included, at which plates are kept apart."""

_SAID = 6
"""Conflicts that a message names; a list of all helps nobody."""


@dataclass(frozen=True)
class Layer:
    """A layer: the height of its underside and how thick it is, mm."""

    bottom: float
    thickness: float


@dataclass(frozen=True)
class Stack:
    """Plates in their layers.

    Parameters
    ----------
    layer
        Plate to the number of its layer.
    layers
        All layers, the ground's first.
    spans
        Spindle to the heights of its ends, mm: underside of its lowest plate, top of its highest.
    """

    layer: Mapping[str, int]
    layers: tuple[Layer, ...]
    spans: Mapping[str, tuple[float, float]]

    def bottom(self, plate: str) -> float:
        """Height of a plate's underside, mm."""
        return self.layers[self.layer[plate]].bottom


def stack(
    plates: Sequence[Plate],
    spindles: Sequence[Spindle],
    poses: Mapping[str, Poses] | Sequence[Mapping[str, Poses]],
    clearance: float,
    gap: float,
    neighbours: Sequence[tuple[str, str]] = (),
    together: Sequence[tuple[str, ...]] = (),
    measured: Sequence[Closeness] = (),
) -> Stack:
    """Deal plates to layers.

    Parameters
    ----------
    plates
        At least one; those of the ground name layer 0.
    spindles
        What joins them.
    poses
        Body to its poses over one turn, both ends included; or one such for each phase of a machine.
    clearance
        Least distance in plan, mm, of what shares a height and does not touch by design.
    gap
        Air between layers, mm.
    neighbours
        Pairs of plates that slide along each other by design and may share a layer.
    together
        Groups of plates that have to share one.
    measured
        How near the same plates and spindles come in each phase, where other layers were tried before.

    Raises
    ------
    GeometryError
        There is no way; the message names the pairs that no layers keep apart.
    """
    choices = [plate.layers or tuple(range(1, max(2, len(plates)))) for plate in plates]
    phases = [poses] if isinstance(poses, Mapping) else poses
    pairs = {frozenset(pair) for pair in neighbours}
    conflicts = _Conflicts(set(), {}, {})
    for close in measured or [Closeness(plates, spindles, one, clearance) for one in phases]:
        conflicts = conflicts.joined(_conflicts(plates, spindles, choices, close, pairs))
    chosen = flattest(_problem(plates, spindles, choices, conflicts, together))
    if chosen is None:
        raise GeometryError(_reason(plates, spindles, conflicts))
    layer = {plate.name: number for plate, number in zip(plates, chosen, strict=True)}
    return _heights(plates, spindles, layer, gap)


@dataclass(frozen=True)
class _Conflicts:
    """What may not stand together.

    Parameters
    ----------
    clashes
        Pairs of plates that share no layer.
    blocked
        Spindle to the plates that it may not pass through.
    covered
        Spindle with a head to the plates that may not stand above it.
    """

    clashes: set[frozenset[str]]
    blocked: dict[str, set[str]]
    covered: dict[str, set[str]]

    def joined(self, other: "_Conflicts") -> "_Conflicts":
        """What may not stand together in either of two motions."""

        def both(one: dict[str, set[str]], two: dict[str, set[str]]) -> dict[str, set[str]]:
            return {name: one.get(name, set()) | two.get(name, set()) for name in (*one, *two)}

        return _Conflicts(
            self.clashes | other.clashes,
            both(self.blocked, other.blocked),
            both(self.covered, other.covered),
        )


def _conflicts(
    plates: Sequence[Plate],
    spindles: Sequence[Spindle],
    choices: Sequence[tuple[int, ...]],
    close: Closeness,
    neighbours: set[frozenset[str]],
) -> _Conflicts:
    """Measure what can come to share a height in some dealing of plates to layers."""
    allowed = {plate.name: set(choice) for plate, choice in zip(plates, choices, strict=True)}
    clashes = {
        frozenset((a.name, b.name))
        for number, a in enumerate(plates)
        for b in plates[:number]
        if allowed[a.name] & allowed[b.name]
        and frozenset((a.name, b.name)) not in neighbours
        and close.plates(a, b)
    }
    blocked, covered = {}, {}
    for spindle in spindles:
        # What lies below all its plates in every layering, as the ground does, need not be measured.
        lowest = min(min(allowed[name]) for name in spindle.plates)
        reached = [
            plate
            for plate in plates
            if plate.name not in spindle.plates and max(allowed[plate.name]) >= lowest
        ]
        blocked[spindle.name] = {p.name for p in reached if close.spindle(spindle, p, spindle.radius)}
        if spindle.head > 0:
            covered[spindle.name] = {p.name for p in reached if close.spindle(spindle, p, spindle.head)}
    return _Conflicts(clashes, blocked, covered)


def _problem(
    plates: Sequence[Plate],
    spindles: Sequence[Spindle],
    choices: Sequence[tuple[int, ...]],
    conflicts: _Conflicts,
    together: Sequence[tuple[str, ...]],
) -> Problem:
    """The same with plates by their number."""
    place = {plate.name: number for number, plate in enumerate(plates)}

    def numbers(names: Iterable[str]) -> frozenset[int]:
        return frozenset(place[name] for name in names)

    return Problem(
        tuple(frozenset(choice) for choice in choices),
        tuple(numbers(spindle.plates) for spindle in spindles),
        tuple(numbers(pair) for pair in conflicts.clashes),
        tuple(numbers(conflicts.blocked.get(spindle.name, ())) for spindle in spindles),
        tuple(numbers(conflicts.covered.get(spindle.name, ())) for spindle in spindles),
        tuple(numbers(group) for group in together),
    )


def _heights(
    plates: Sequence[Plate], spindles: Sequence[Spindle], layer: dict[str, int], gap: float
) -> Stack:
    layers: list[Layer] = []
    bottom = 0.0
    for number in range(max(layer.values()) + 1):
        thickness = max(plate.thickness for plate in plates if layer[plate.name] == number)
        layers.append(Layer(bottom, thickness))
        bottom += thickness + gap
    thick = {plate.name: plate.thickness for plate in plates}
    spans = {
        spindle.name: (
            min(layers[layer[name]].bottom for name in spindle.plates),
            max(layers[layer[name]].bottom + thick[name] for name in spindle.plates),
        )
        for spindle in spindles
    }
    return Stack(layer, tuple(layers), spans)


def _reason(plates: Sequence[Plate], spindles: Sequence[Spindle], conflicts: _Conflicts) -> str:
    """What stands in the way; not what is joined, which meets by design, nor the ground plate below all."""
    below = {plate.name for plate in plates if plate.layers == (0,)}
    joined = {frozenset(pair) for spindle in spindles for pair in combinations(spindle.plates, 2)}
    said = [
        " and ".join(sorted(pair)) + " meet in plan"
        for pair in sorted(conflicts.clashes - joined, key=sorted)
        if not pair & below
    ]
    said += [
        f"the {name} hits {plate}" for name, hit in conflicts.blocked.items() for plate in sorted(hit - below)
    ]
    more = f" and {len(said) - _SAID} more" if len(said) > _SAID else ""
    return f"no order of layers keeps the plates apart over a turn: {', '.join(said[:_SAID])}{more}"

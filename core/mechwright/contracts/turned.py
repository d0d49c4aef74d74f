"""A part that is turned: one description from which its solid and its drawing both come.

Glossary
--------
step
    A length of one diameter, or a cone. Steps follow each other upwards from z = 0.
groove
    A ring cut into a step, such as a circlip's.
key seat
    A slot along the axis with a flat floor, on the side of +x. It is milled by a cutter of its own width, so
    its ends are half circles; where it reaches the end of the part it is open there.
flats
    Two parallel faces on the outside, on the sides of +x and -x, which a spanner holds.
length
    From one edge of the part to another, with limits of its own. It decides a stack, so it is measured from
    the face that bears: the loaded wall of a circlip's groove, the shoulder of a bearing.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

from mechwright.contracts.fits import Fit, signed
from mechwright.contracts.shape import Prism, Revolve, Shape, Slot, ring, slot
from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

SMALLEST = 0.001
"""Below this diameter, mm, a cone ends in a point."""


@dataclass(frozen=True)
class Step:
    """A length of one diameter, mm; the drawing notes the ``fit`` in place of the diameter.

    A cone has the diameter ``start`` at its lower end, which may be 0, and ``diameter`` at its upper one.
    """

    diameter: float
    length: float
    fit: Fit | None = None
    start: float | None = None

    @property
    def foot(self) -> float:
        """Diameter at the lower end, mm."""
        return self.diameter if self.start is None else self.start

    @property
    def least(self) -> float:
        """Smaller of the diameters at both ends, mm."""
        return min(self.foot, self.diameter)


@dataclass(frozen=True)
class Groove:
    """A ring from ``at`` upwards, ``width`` wide, down to ``diameter``, mm, which has 0/-``under``."""

    at: float
    width: float
    diameter: float
    under: float = 0.0


@dataclass(frozen=True)
class KeySeat:
    """A seat from ``at`` upwards, mm: its length over all, width, and the x of its ``floor``.

    ``limits`` is the tolerance class of its width.
    """

    at: float
    length: float
    width: float
    floor: float
    limits: str = "N9"

    def piece(self, x: float, part: float) -> Slot:
        """What the cutter takes, out to x, of a part of that length, mm: half circles but at an open end."""
        ends = (self.at, self.at + self.length)
        return slot((self.floor, x), self.width, ends, self.round_ends(part))

    def round_ends(self, part: float) -> tuple[bool, bool]:
        """Whether its lower and its upper end are half circles, in a part of that length, mm."""
        return self.at > TOLERANCES.closure, self.at + self.length < part - TOLERANCES.closure


@dataclass(frozen=True)
class Length:
    """A length from ``low`` to ``high``, both edges of the part, mm, with its limit deviations.

    ``name`` says what it is in the stack that it decides.
    """

    name: str
    low: float
    high: float
    lower: float
    upper: float

    @property
    def nominal(self) -> float:
        """Mm."""
        return round(self.high - self.low, 6)

    @property
    def text(self) -> str:
        """With its limit deviations, as a drawing notes it."""
        return limited(self.nominal, self.lower, self.upper)


def limited(nominal: float, lower: float, upper: float) -> str:
    """A size with its limit deviations, as a drawing notes it.

    >>> limited(22.8, -0.05, 0.0), limited(20, -0.02, 0.02)
    ('22.8 (0/-0.05)', '20 ±0.02')
    """
    shown = f"{round(nominal, 3):g}"
    if math.isclose(upper, -lower):
        return f"{shown} ±{upper:g}"
    return f"{shown} ({signed(upper)}/{signed(lower)})"


@dataclass(frozen=True)
class Flats:
    """Two parallel flats for a spanner from ``at`` upwards, mm: their length, and the width across them."""

    at: float
    length: float
    across: float

    def pieces(self, wide: float) -> tuple[Prism, ...]:
        """What the cutter takes on either side of a part of that diameter, mm."""
        half, low, high = self.across / 2, self.at, self.at + self.length
        sides = ((half, wide), (-wide, -half))
        return tuple(Prism(((a, -wide), (b, -wide), (b, wide), (a, wide)), low, high) for a, b in sides)


TAP_RUN = 3.0
"""A drilled hole goes on so many pitches below its last full turn of thread: the tap's own lead."""


@dataclass(frozen=True)
class EndThread:
    """A threaded blind hole in an end, along the axis: nominal diameter, pitch and full depth, mm."""

    end: Literal["lower", "upper"]
    diameter: float
    pitch: float
    depth: float

    @property
    def core(self) -> float:
        """Diameter of the hole to be threaded, mm."""
        return round(self.diameter - 1.0825 * self.pitch, 6)

    @property
    def drilled(self) -> float:
        """Depth of that hole, mm."""
        return self.depth + TAP_RUN * self.pitch

    def hole(self, length: float, *, screwed: bool) -> Revolve:
        """The hole in a part of this length; ``screwed``: as wide as the screw that stands in it."""
        low = 0.0 if self.end == "lower" else length - self.drilled
        return ring(0.0, self.diameter if screwed else self.core, self.drilled, low)


@dataclass(frozen=True)
class Turned:
    """A turned part that stands on z = 0 with its axis upright.

    Parameters
    ----------
    steps
        From below.
    bore
        Diameter of the hole all through, mm; 0 for none.
    bore_fit
        Of that hole.
    tapped
        Whether that hole is a thread of its diameter, all through.
    chamfer
        At 45° on the outer edges of both ends, mm.
    grooves, seats
        What is cut into the steps.
    note
        A line more on its drawing.
    threads
        In its ends; of a part without a bore.
    lengths
        Lengths with limits of their own, each from edge to edge; all others have the general tolerance.
    flats
        For spanners, each across one step.

    Raises
    ------
    GeometryError
        A size is not above 0, threads meet or leave no wall, a groove or seat lies outside of the part or
        cuts nothing, the bore or the chamfer is as large as a step, or a length ends at no edge.

    Examples
    --------
    >>> stud = Turned((Step(10.0, 8.0), Step(6.0, 12.0)))
    >>> stud.length, stud.greatest, round(stud.shape.solid().Volume(), 3)
    (20.0, 10.0, 967.611)
    """

    steps: tuple[Step, ...]
    bore: float = 0.0
    bore_fit: Fit | None = None
    chamfer: float = 0.0
    grooves: tuple[Groove, ...] = ()
    seats: tuple[KeySeat, ...] = ()
    note: str = ""
    threads: tuple[EndThread, ...] = ()
    tapped: bool = False
    lengths: tuple[Length, ...] = ()
    flats: tuple[Flats, ...] = ()

    def __post_init__(self) -> None:
        if not self.steps or not all(step.diameter > 0 and step.length > 0 for step in self.steps):
            raise GeometryError("a turned part has steps, each with a diameter and a length above 0 mm")
        least = min(step.least for step in self.steps)
        if not 0 <= self.bore < max(least, SMALLEST):
            raise GeometryError(f"a bore of {self.bore:g} mm leaves nothing of a step of {least:g} mm")
        first, last = self.steps[0], self.steps[-1]
        share = 2 if first is last else 1
        room = min(
            (first.foot - self.bore) / 2,
            (last.diameter - self.bore) / 2,
            first.length / share,
            last.length / share,
        )
        if self.chamfer and not 0 < self.chamfer < room:
            raise GeometryError(
                f"a chamfer of {self.chamfer:g} mm does not fit on both ends; one below {room:g} mm does"
            )
        self._check_threads()
        for groove in self.grooves:
            step = self._step_of(groove)
            if not self.bore < groove.diameter < step.least:
                raise GeometryError(
                    f"a groove of {groove.diameter:g} mm diameter at {groove.at:g} mm; it has to be between "
                    f"the bore, {self.bore:g} mm, and its step, {step.least:g} mm"
                )
        for seat in self.seats:
            end = seat.at + seat.length
            if not 0 <= seat.at < end <= self.length + TOLERANCES.closure:
                raise GeometryError(
                    f"a key seat from {seat.at:g} to {end:g} mm; the part is {self.length:g} mm long"
                )
            if not (self.bore / 2 < seat.floor < self.greatest / 2 and 0 < seat.width < self.greatest):
                raise GeometryError(
                    f"a key seat {seat.width:g} mm wide with its floor at {seat.floor:g} mm cuts nothing, or "
                    f"the bore; the part has a radius of {self.greatest / 2:g} mm"
                )
        for flat in self.flats:
            step = self._step_of(flat)
            if not self.bore < flat.across < step.least:
                raise GeometryError(
                    f"flats {flat.across:g} mm across are no cut between {self.bore:g} and {step.least:g} mm"
                )
        self._check_lengths()

    def _check_lengths(self) -> None:
        edges = self.edges
        for one in self.lengths:
            for end in (one.low, one.high):
                if not any(math.isclose(end, edge, abs_tol=TOLERANCES.closure) for edge in edges):
                    raise GeometryError(
                        f"the length {one.name!r} ends at {end:g} mm, where the part has no edge; edges: "
                        f"{', '.join(f'{edge:g}' for edge in edges)}"
                    )
            if not (one.low < one.high and one.lower <= one.upper):
                raise GeometryError(
                    f"the length {one.name!r} from {one.low:g} to {one.high:g} mm with limits {one.lower:g} "
                    f"to {one.upper:g} mm; the lower one comes first"
                )

    def _check_threads(self) -> None:
        deep = sum(thread.drilled for thread in self.threads)
        if self.threads and (self.bore or deep >= self.length):
            raise GeometryError(
                f"threads need {deep:g} mm of a part without a bore; it is {self.length:g} mm long"
            )
        for thread in self.threads:
            step = self.steps[0 if thread.end == "lower" else -1]
            if not 0 < thread.diameter + 2 * thread.pitch <= step.least:
                raise GeometryError(
                    f"M{thread.diameter:g} leaves less than one pitch of wall in an end of {step.least:g} mm"
                )

    def _step_of(self, cut: Groove | Flats) -> Step:
        name, wide = ("a groove", cut.width) if isinstance(cut, Groove) else ("flats", cut.length)
        end = cut.at + wide
        for low, step in zip(self.starts, self.steps, strict=True):
            if low <= cut.at < end <= low + step.length + TOLERANCES.closure:
                return step
        raise GeometryError(f"{name} from {cut.at:g} to {end:g} mm lies in no one step")

    @cached_property
    def starts(self) -> tuple[float, ...]:
        """Where each step begins, mm."""
        return tuple(sum(step.length for step in self.steps[:k]) for k in range(len(self.steps)))

    @property
    def edges(self) -> tuple[float, ...]:
        """Heights of all faces across the axis: ends, steps, walls of grooves, ends of key seats; mm."""
        found = {*self.starts, self.length}
        found |= {end for one in self.grooves for end in (one.at, one.at + one.width)}
        found |= {end for one in self.seats for end in (one.at, one.at + one.length)}
        return tuple(sorted({round(one, 6): one for one in found}.values()))

    def length_of(self, name: str) -> Length:
        """The length of that name; raises GeometryError where there is none."""
        for one in self.lengths:
            if one.name == name:
                return one
        known = ", ".join(one.name for one in self.lengths) or "none"
        raise GeometryError(f"a turned part has no length {name!r}; it has: {known}")

    @property
    def length(self) -> float:
        """Mm."""
        return sum(step.length for step in self.steps)

    def lengthened(self, more: float) -> "Turned":
        """The part with its lower end longer, mm; what is cut into it stays where it is.

        >>> Turned((Step(6.0, 20.0),), grooves=(Groove(12.0, 0.8, 5.0),)).lengthened(3.0).grooves[0].at
        15.0
        """
        first, *rest = self.steps
        return replace(
            self,
            steps=(replace(first, length=first.length + more), *rest),
            grooves=tuple(replace(one, at=one.at + more) for one in self.grooves),
            seats=tuple(replace(one, at=one.at + more) for one in self.seats),
            lengths=tuple(replace(one, low=one.low + more, high=one.high + more) for one in self.lengths),
            flats=tuple(replace(one, at=one.at + more) for one in self.flats),
        )

    @property
    def greatest(self) -> float:
        """Largest diameter, mm."""
        return max(max(step.diameter, step.foot) for step in self.steps)

    @cached_property
    def profile(self) -> tuple[Point, ...]:
        """Corners (r, z) of the outside from below, chamfers and grooves included; mm."""
        corners: list[Point] = []
        for low, step in zip(self.starts, self.steps, strict=True):
            r, end = step.diameter / 2, low + step.length
            corners.append((step.foot / 2, low))
            for groove in sorted(self.grooves, key=lambda one: one.at):
                if low <= groove.at < end:
                    deep = groove.diameter / 2
                    top = groove.at + groove.width
                    corners += [(r, groove.at), (deep, groove.at), (deep, top), (r, top)]
            corners.append((r, end))
        c = self.chamfer
        if c > 0:
            (first, low), (last, high) = corners[0], corners[-1]
            corners = [(first - c, low), (first, low + c), *corners[1:-1], (last, high - c), (last - c, high)]
        kept: list[Point] = []
        for corner in corners:
            if not kept or corner != kept[-1]:
                kept.append(corner)
        return tuple(kept)

    @property
    def shape(self) -> Shape:
        """The profile turned, less its key seats and threaded holes."""
        return self._shape(screwed=False)

    @property
    def screwed(self) -> Shape:
        """The same with threaded holes as wide as the screws that stand in them."""
        return self._shape(screwed=True)

    def _shape(self, *, screwed: bool) -> Shape:
        r = self.bore / 2
        ends = [(r, 0.0), *self.profile, (r, self.length)]
        body = Revolve(tuple(one for k, one in enumerate(ends) if one != ends[k - 1]))
        wide = self.greatest
        return Shape(
            (body,),
            (
                *(one.piece(wide, self.length) for one in self.seats),
                *(thread.hole(self.length, screwed=screwed) for thread in self.threads),
                *(piece for one in self.flats for piece in one.pieces(wide)),
            ),
        )


def tube(inner: float, outer: float, length: float, fit: Fit | None = None) -> Turned:
    """A plain ring: a spacer, a bush; mm. The ``fit`` is its bore's."""
    return Turned((Step(outer, length),), inner, fit)

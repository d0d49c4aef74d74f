"""Round parts of a train, which are turned or bought: shafts, pins, spacers, dowels; and the keys.

They get no milling program.
"""

from collections.abc import Sequence
from dataclasses import replace

from mechwright import Colour, Groove, Instance, KeySeat, Part, Step, Turned
from mechwright.contracts.fits import Fit, shaft_fit
from mechwright.contracts.turned import Length, limited, tube
from mechwright.geometry.keyway import Opening
from mechwright.standards.parts import dowel_part, key_part
from mechwright_elliptic_gears.parts.keeper import PLATE, Keeper
from mechwright_elliptic_gears.parts.layout import (
    AXIAL_PLAY,
    DOWELS,
    HEAD,
    HEAD_HEIGHT,
    PHASE_PIN,
    PIN_HEAD,
    PIN_KEEPER,
    SPACER,
    Layout,
)
from mechwright_elliptic_gears.parts.retainers import LENGTH, LOADED, PLAY, WALL, Disc, Keep, spacer

MATERIAL = "steel"
"""Of all round parts."""

_STEEL, _BRASS, _DARK = (0.78, 0.79, 0.81), (0.80, 0.66, 0.36), (0.36, 0.38, 0.42)


def round_parts(
    layout: Layout,
    opening: Opening,
    *,
    keyed: bool,
    dowelled: bool,
    phase_pin: Fit | None = None,
    discs: Sequence[Disc] = (),
    keep: Keep | None = None,
) -> tuple[Part, ...]:
    """Everything that is no plate.

    ``discs`` and ``keep`` are what holds gears on their shafts, and the input's shaft in the base plate.
    ``keyed`` and ``dowelled`` say whether keys or dowels join gears 3 and 4, ``phase_pin`` has the limits
    of the pin that joins them by a dividing circle; where nothing does, a clamp has its own spacer there.
    """
    joined = keyed or dowelled or phase_pin is not None
    low, high, t = layout.lower, layout.upper, layout.thickness
    foot = layout.base + layout.stub
    # Seats are open at the upper end of the shaft, so that gears and keys can be put on from there.
    seat = opening if opening.has_keyway else None
    joints, on = ("joint-j", "joint-k"), {disc.shaft: disc for disc in discs}
    parts = [
        _part("shaft-2", input_shaft(layout, seat, keep), (Instance("gear-2", -foot),), _STEEL),
        _part(
            "shaft-4",
            _shaft(layout.bore, layout.base + high + t, high - low + t, seat)
            if keyed
            else _standing(layout, high + t, on.get("shaft-4")),
            (Instance("gear-3" if keyed else "base", -layout.base),),
            _STEEL,
            PLAY if "shaft-4" in on else 0.0,
        ),
        _part(
            "shaft-5",
            _standing(layout, high + t, on.get("shaft-5")),
            (Instance("axis-5", -layout.base),),
            _STEEL,
            PLAY if "shaft-5" in on else 0.0,
        ),
        _part(
            "hub-spacer",
            spacer(layout.bore, layout.spacer, layout.gap),
            (
                Instance("axis-2"),
                Instance("base"),
                *((Instance("base", low + layout.thickness),) if joined else ()),
            ),
            _BRASS,
        ),
        _part("hub-spacer-5", spacer(layout.bore, layout.spacer, high), (Instance("axis-5"),), _BRASS),
        _part(
            "joint-spacer",
            tube(layout.pin, SPACER * layout.pin, layout.crown),
            tuple(Instance(body, high + layout.thickness) for body in joints),
            _BRASS,
        ),
        _part(
            "joint-pin",
            _pin(layout.pin, layout.thickness, layout.crown + layout.coupler + AXIAL_PLAY),
            tuple(Instance(body, high) for body in joints),
            _DARK,
        ),
    ]
    if opening.has_keyway:
        keys = [Instance("gear-2", low)]
        if keyed:
            keys += [Instance("gear-3", low), Instance("gear-3", high)]
        parts.append(key_part("key", opening, t, tuple(keys), _DARK))
    if phase_pin is not None:
        shank = Step(phase_pin.middle, high - low + t, phase_pin)
        pin = Turned((shank, Step(HEAD * layout.dowel, PIN_HEAD * layout.gap)))
        parts.append(_part(PHASE_PIN, pin, (Instance(PHASE_PIN, low),), _DARK))
    elif dowelled:
        at = tuple(Instance(body, low) for body in DOWELS)
        parts.append(dowel_part("dowel", layout.dowel, high - low + t, at, _DARK))
    return tuple(parts)


def keeper_parts(keeper: Keeper, layout: Layout) -> tuple[Part, ...]:
    """What keeps the pin of a dividing circle down, and its screw."""
    top = layout.upper + layout.thickness
    under = Instance(PIN_KEEPER, top + keeper.low + PLATE)
    return (
        _part(PIN_KEEPER, keeper.turned, (Instance(PIN_KEEPER, top),), _BRASS),
        Part("keeper-screw", None, 0.0, MATERIAL, (under,), _DARK, bought=keeper.screw.bought),
    )


def _part(
    name: str, turned: Turned, instances: tuple[Instance, ...], colour: Colour, play: float = 0.0
) -> Part:
    return Part(name, None, 0.0, MATERIAL, instances, colour, turned=turned, play=play)


def _running(diameter: float, length: float) -> Step:
    """A length that turns in a hole of that diameter: in the middle of f7."""
    fit = shaft_fit(diameter, "f7")
    return Step(fit.middle, length, fit)


def _shaft(diameter: float, length: float, seat_length: float, opening: Opening | None) -> Turned:
    """A cylinder; with a key seat whose straight sides are the upper ``seat_length``.

    The seat is open at the top and ends below in the half circle of its mill.
    """
    seats: tuple[KeySeat, ...] = ()
    if opening is not None:
        floor, over_all = opening.bore / 2 - opening.seat_depth, seat_length + opening.width / 2
        seats = (KeySeat(length - over_all, over_all, opening.width, floor),)
    return Turned((_running(diameter, length),), seats=seats)


def _standing(layout: Layout, over: float, disc: Disc | None) -> Turned:
    """A shaft that is pressed into the base plate, and on which gears turn, with the thread of its disc."""
    pressed = Step(layout.bore, layout.base, shaft_fit(layout.bore, "r6"))
    if disc is None:
        return Turned((pressed, _running(layout.bore, over)))
    note = f"pressed in until it stands {limited(over + disc.over, -LENGTH, LENGTH)} over the base plate"
    return Turned((pressed, _running(layout.bore, over + disc.over)), note=note, threads=(disc.thread,))


def input_shaft(layout: Layout, seat: Opening | None, keep: Keep | None) -> Turned:
    """The shaft of gear 2, with the groove of its circlip where it has one."""
    form = _input(layout, layout.lower + layout.thickness, seat)
    if keep is None:
        return form
    ring, at = keep.circlip, layout.stub - keep.wall
    groove = Groove(at, ring.width, ring.groove, ring.tolerance)
    loaded = Length(LOADED, at, form.length, *WALL)
    note = "gear 2 is bonded to it with retaining compound, flush with its upper end"
    return replace(form, grooves=(groove,), lengths=(loaded,), note=note)


def _input(layout: Layout, over: float, seat: Opening | None) -> Turned:
    """The shaft of gear 2, so much over the base plate, with a thinner stub below if one is asked for."""
    if layout.stub_diameter == layout.bore:
        return _shaft(layout.bore, layout.base + layout.stub + over, layout.thickness, seat)
    whole = _shaft(layout.bore, layout.base + over, layout.thickness, seat)
    fit = shaft_fit(layout.stub_diameter, "h6")
    stub = Step(fit.middle, layout.stub, fit)
    return replace(
        whole,
        steps=(stub, *whole.steps),
        seats=tuple(replace(one, at=one.at + layout.stub) for one in whole.seats),
    )


def _pin(diameter: float, seat: float, running: float) -> Turned:
    """Seat, then the thinner part that turns, then the head, from below."""
    pressed = Step(diameter, seat, shaft_fit(diameter, "h6"))  # it goes through the coupler's hole first
    head = Step(HEAD * diameter, HEAD_HEIGHT * diameter)
    return Turned((pressed, _running(diameter, running), head))

"""The parts of an assembly with the fits of all round faces that go into each other."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from mechwright.contracts.bodies import placed
from mechwright.contracts.fit_settings import Fits
from mechwright.contracts.fits import Fit, hole_fit
from mechwright.contracts.holes import exchanged, hole
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.contracts.turned import Turned
from mechwright.errors import DesignError, did_you_mean
from mechwright.mechanics.mating.choice import Assembled, hole_fit_of, pin_fit
from mechwright.mechanics.mating.key_seats import with_key_seats
from mechwright.mechanics.mating.rounds import Match, Round
from mechwright.mechanics.mating.undrawn_dowels import undrawn_dowels

Limits = dict[tuple[str, str], Fit]
"""Names of a part and of a face of it to the limits that it gets."""


def with_fits(parts: Sequence[Part], motion: Motion, fits: Fits, reverses: bool = False) -> list[Part]:
    """The parts, each round face that another one touches with its limits, and key seats with theirs.

    ``reverses``: the torque of the drive changes its sense within a turn, see :mod:`.key_seats`.

    Pins come first: the limits of a hole follow from those that its pin has in the end. What a part says of
    itself stays, but for the pairs that the settings name. Of two pairs that share a face the looser one
    decides, so that both go together.
    """
    parts = with_key_seats(parts, fits.settings, reverses=reverses)
    whole = Assembled(placed(parts, motion), motion)
    _check_pairs(whole, fits)
    pins = _loosest(_pins(whole, fits))
    matches = [_with_pin(whole, match, pins) for match in whole.matches]
    holes = _loosest([*_holes(whole, matches, fits), *_hubs(whole, fits), *_dowel_holes(whole, fits)])
    chosen = pins | holes | _loosest(_own(whole, matches, fits))
    return [
        _part(part, {face: fit for (name, face), fit in chosen.items() if name == part.name})
        for part in parts
    ]


def _loosest(found: Iterable[tuple[str, str, Fit]]) -> Limits:
    """The limits of each face: those that leave most play."""
    limits: Limits = {}
    for name, face, fit in found:
        known = limits.get((name, face))
        if known is None or _looser(fit, known):
            limits[name, face] = fit
    return limits


def _check_pairs(whole: Assembled, fits: Fits) -> None:
    """Raise DesignError for a pair of the settings that is none of the assembly."""
    known = {whole.pair(match): whole.bodies[match.hole].part for match in whole.matches}
    for pair in fits.own:
        if pair not in known:
            pin, _, body = pair.partition(" in ")
            hint = did_you_mean(pair, known) or f"the pairs are: {', '.join(known) or 'none'}"
            raise DesignError(f'fits.of."{pair}": no part {pin} goes into a part {body}; {hint}')
        if known[pair].bought is not None:
            raise DesignError(
                f'fits.of."{pair}": the hole of {known[pair].name} is its maker\'s; leave the pair out'
            )


def _looser(one: Fit, two: Fit) -> bool:
    """Whether one of two limits of a face leaves more play: of a hole the wider, of a shaft the thinner."""
    if one.name[:1].islower():
        return one.upper < two.upper
    return one.lower > two.lower


def _pins(whole: Assembled, fits: Fits) -> Iterator[tuple[str, str, Fit]]:
    for match in whole.matches:
        pin = whole.bodies[match.pin].part
        if match.outside.fit is None and pin.bought is None:
            yield pin.name, match.outside.face, pin_fit(whole, match, fits)


def _with_pin(whole: Assembled, match: Match, pins: Limits) -> Match:
    """The pair with the limits that its pin has in the end."""
    fit = pins.get((whole.bodies[match.pin].part.name, match.outside.face), match.outside.fit)
    return replace(match, outside=replace(match.outside, fit=fit))


def _holes(whole: Assembled, matches: Sequence[Match], fits: Fits) -> Iterator[tuple[str, str, Fit]]:
    for match in matches:
        body = whole.bodies[match.hole].part
        if match.inside.fit is None and body.bought is None:
            found = hole_fit_of(whole, match, fits)
            if found is not None:
                yield body.name, match.inside.face, found


def _own(whole: Assembled, matches: Sequence[Match], fits: Fits) -> Iterator[tuple[str, str, Fit]]:
    """Holes of the pairs that the settings name, whatever their parts say."""
    for match in matches:
        body, pair = whole.bodies[match.hole].part, whole.pair(match)
        if pair in fits.own:
            size = match.outside.diameter if match.outside.fit is None else match.outside.fit.size
            yield body.name, match.inside.face, hole_fit(size, fits.own[pair])


def _hubs(whole: Assembled, fits: Fits) -> Iterator[tuple[str, str, Fit]]:
    """Holes about whose axis a plate turns, and in which no shaft is drawn."""
    filled = {(match.hole, match.inside.face) for match in whole.matches}
    for k, faces in enumerate(whole.rounds):
        body = whole.bodies[k].part
        if body.outline is None or whole.heads[k] == GROUND:
            continue
        for one in faces:
            if _is_open(one) and (k, one.face) not in filled and whole.turns_on(k, one):
                yield body.name, one.face, hole_fit(one.diameter, fits.settings.hub)


def _dowel_holes(whole: Assembled, fits: Fits) -> Iterator[tuple[str, str, Fit]]:
    """Holes of dowels that no body shows: tight in the part that holds them, loose in those that come off."""
    for one in undrawn_dowels(whole.bodies, 0):
        for number, seat in enumerate(one.seats):
            part = whole.bodies[seat.body].part
            name = fits.settings.dowel if number else fits.settings.housing
            if hole(part, seat.hole).fit is None:
                yield part.name, seat.hole, hole_fit(one.diameter, name)


def _is_open(one: Round) -> bool:
    return one.inside and not one.threaded and one.fit is None


def _part(part: Part, fits: dict[str, Fit]) -> Part:
    if not fits:
        return part
    if part.turned is not None:
        return replace(part, turned=_turned(part.turned, fits), build=None)
    if part.free_form is not None:
        return replace(part, free_form=part.free_form.with_fits(fits))
    for name, fit in fits.items():
        old = hole(part, name)
        part = exchanged(part, old, replace(old, diameter=fit.middle, fit=fit))
    return part


def _turned(turned: Turned, fits: dict[str, Fit]) -> Turned:
    steps = tuple(
        replace(step, fit=fits.get(f"step-{number}", step.fit))
        for number, step in enumerate(turned.steps, start=1)
    )
    bore = fits.get("bore")
    if bore is None:
        return replace(turned, steps=steps)
    return replace(turned, steps=steps, bore=bore.middle, bore_fit=bore)

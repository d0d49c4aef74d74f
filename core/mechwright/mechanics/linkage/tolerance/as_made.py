"""What a linkage of plates as made does: errors of output and traced points, play of pins and rollers."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from mechwright.contracts.as_made import AsMade, MadeCurve, MadeFigure
from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.made_part import MadePart
from mechwright.mechanics.linkage.made import STEP, Joint, MadeLink, joint, stuck
from mechwright.mechanics.linkage.made_error import EXACT, MadeError, made_errors, room_figure
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.tolerance.contributors import (
    bore_names,
    gap_fits,
    gap_names,
    length_name,
    line_name,
    pin_name,
)
from mechwright.mechanics.linkage.tolerance.made_features import MadeFeature, MadePlates, MissingFeatureError
from mechwright.mechanics.linkage.tolerance.model import LinkageTolerances
from mechwright.mechanics.linkage.tolerance.plates import Plates

RULE = "Σ |∂/∂v| ρ + |Σ (∂/∂l) Δl|, every pin standing off in the worst direction; least: pins centred"


def as_made(table: AnyPlanarTable, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made; it says nothing without a plate, or one of its bores."""
    plates, code = Plates.of(table, drawn=True), f"{table.code}.as-made"
    if plates.layout is None:
        return AsMade()
    found = MadePlates(plates, plates.layout, made)
    try:
        links, pins, rollers = links_as_made(found), pins_as_made(found), _rollers(found)
    except (MissingFeatureError, KeyError):
        return AsMade()
    fit, bushed = plates.sizes.running_fit, plates.sizes.bushing_wall > 0
    drawn = dict.fromkeys(pins, fit / 2) | dict.fromkeys(rollers, gap_fits(plates) * fit / 2)
    model = LinkageTolerances(table, EXACT)
    errors = [one for one in made_errors(model, links, pins | rollers, drawn) if np.isfinite(one.most).any()]
    figures = [one.figure(name, RULE) for one, name in zip(errors, _names(model, errors), strict=True)]
    figures.append(room_figure([*pins.values()], fit, "; that of the bushings" if bushed else ""))
    jammed = [*stuck(code, [*pins.values()], "running_fit", fit)]
    slots = _slots(found)
    if slots:
        figures.append(_slot_figure(slots, fit))
        jammed += _jammed(code, slots, fit)
    return AsMade(tuple(figures), tuple(_curve(one, table, model) for one in errors), tuple(jammed))


def links_as_made(found: MadePlates) -> dict[str, MadeLink]:
    """What is off in the sizes of all links."""
    links: dict[str, MadeLink] = {}
    for link in found.plates.links:
        links |= dict(_sizes(found, link))
    return links


def _sizes(found: MadePlates, link: str) -> Iterator[tuple[str, MadeLink]]:
    plates = found.plates
    axes, along = plates.bores(link), plates.along(link)
    bores = [found.bore(link, axis) for axis in axes]
    turn = 1 + 0j
    if len(bores) > 1:
        made, drawn = bores[1].made - bores[0].made, bores[1].drawn - bores[0].drawn
        turn = made / drawn * abs(drawn / made)
        yield length_name(link), MadeLink(abs(made) - abs(drawn), _spread(found, bores[0], bores[1]))
    slides = plates.own_slides(link)
    datum = bores[0] if bores else found.line(link, slides[0]) if slides else None
    if datum is None:
        return
    for axis, bore in zip(axes[2:], bores[2:], strict=True):
        off = _moved(datum, bore, turn) / along
        for name, value in zip(bore_names(link, axis.point), (off.real, off.imag), strict=True):
            yield name, MadeLink(value, _spread(found, datum, bore))
    for slide in plates.measured(link):
        line = found.line(link, slide)
        across = (_moved(datum, line, turn) * np.exp(-1j * np.asarray(slide.direction(link)))).imag
        yield line_name(slide, link), MadeLink(float(across), _spread(found, datum, line))


def _moved(datum: MadeFeature, feature: MadeFeature, turn: complex) -> complex:
    """How far a feature is off as seen from the datum, in a frame that the link's bores turn."""
    return (feature.made - datum.made) / turn - (feature.drawn - datum.drawn)


def _spread(found: MadePlates, one: MadeFeature, two: MadeFeature) -> float:
    """Both features may be off by the corridor; in two plates so may what brings them in line."""
    spread = 2 * found.part(one.plate).corridor
    return spread if one.plate == two.plate else spread + 2 * found.part(two.plate).corridor


def pins_as_made(found: MadePlates) -> dict[str, Joint]:
    """The room of every pin in every link that turns on it, the least of its plates."""
    plates, sizes = found.plates, found.plates.sizes
    bushed = sizes.running_fit if sizes.bushing_wall > 0 else None
    joints: dict[str, Joint] = {}
    for axis in plates.axes:
        pin = next(one for one in found.layout.pins if one.eye == axis.point and not one.number)
        for plate, link in pin.turning:
            name = pin_name(plates, axis, link)
            hole = found.hole(plate, axis, link)
            shown = axis.point if len(plates.turning(axis)) == 1 else f"{axis.point} in {link}"
            own = joint(shown, found.part(plate), hole, sizes.pin_diameter, bushed)
            if own is None:
                raise MissingFeatureError(plate)
            if name not in joints or own.room < joints[name].room:
                joints[name] = own
    return joints


def _slots(found: MadePlates) -> list[Joint]:
    """The room of rollers in their slots."""
    roller = found.layout.sizes.roller
    return [
        Joint(name, (made.least - roller) / 2, part.corridor)
        for name, (_, made, part) in found.slots().items()
    ]


def _rollers(found: MadePlates) -> dict[str, Joint]:
    """The room of pins across their slots: that of the roller, and its own on the pin."""
    more = (gap_fits(found.plates) - 1) * found.plates.sizes.running_fit / 2
    room = {one.name: one for one in _slots(found)}
    return {
        name: Joint(name, room[slide.name].room + more, room[slide.name].spread)
        for slide in found.plates.slides
        for name in gap_names(found.plates, slide)
    }


def _names(model: LinkageTolerances, errors: Sequence[MadeError]) -> Iterator[str]:
    """Of figures: the output's, and those of points, which have their own names if there are several."""
    output, *points = model.outputs
    for one in errors:
        if one.output == output:
            yield "output.error"
        else:
            own = one.output.name.replace(" ", "-").lower()
            yield "point.error" if len(points) == 1 else f"{own}.error"


def _curve(error: MadeError, table: AnyPlanarTable, model: LinkageTolerances) -> MadeCurve:
    driver = table.driver[0]
    curve = error.curve(driver)
    if model.input_unit == "rad":
        return curve
    return MadeCurve(curve.title, f"way of the {driver}, mm", curve.unit, error.at, curve.lines)


def _slot_figure(slots: Sequence[Joint], fit: float) -> MadeFigure:
    least = min(slots, key=lambda one: one.room - one.spread)
    low, high = (2 * (least.room + sign * least.spread) for sign in (-1, 1))
    title = f"least play of a roller, in slot {least.name}"
    return MadeFigure(
        "slot.room", title, "mm", 0.0, fit, 2 * least.room, low, high, "between the slot's walls"
    )


def _jammed(code: str, slots: Sequence[Joint], fit: float) -> list[Finding]:
    """An error for rollers that do not go through their slots, with the running fit that lets all through."""
    worst = min(slots, key=lambda one: one.room - one.spread)
    left = worst.room - worst.spread
    if left > 0:
        return []
    better = math.ceil((fit - 2 * left) / STEP + 1) * STEP
    return [
        Finding(
            code,
            Severity.ERROR,
            "running_fit",
            f"as made the roller of {worst.name} jams in its slot, which is {-2 * left:.4f} mm too narrow",
            2 * left,
            0.0,
            "mm",
            f"make running_fit {better:g}: on these walls that leaves {2 * left + better - fit:.4f} mm",
            Stage.MACHINING,
        )
    ]

"""The whole drawing of a turned part: which sheet and scale, where the views stand, and the title block."""

from dataclasses import dataclass

from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.contracts.turned import KeySeat, Length, Turned
from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point
from mechwright_cad.sheet.dimensions import (
    FREE,
    ROW,
    Label,
    labels,
    labels_height,
    length,
    rows_height,
    upright,
)
from mechwright_cad.sheet.frame import EDGE, MARGIN, SHEETS, TITLE, frame
from mechwright_cad.sheet.scales import LEAST, SCALES
from mechwright_cad.sheet.sheet import Sheet, Text, width_of
from mechwright_cad.sheet.title import TitleBlock, projection_sign
from mechwright_cad.sheet.words import number
from mechwright_cad.turned_drawing import words
from mechwright_cad.turned_drawing.view import OVERHANG, across, side


@dataclass(frozen=True)
class _Plan:
    """What a sheet has to hold: names of labels, lengths from the base line, cuts through seats."""

    labels: tuple[tuple[float, float, str], ...]
    lengths: tuple[tuple[float, float, str], ...]
    seats: tuple[KeySeat, ...]

    @classmethod
    def of(cls, turned: Turned) -> "_Plan":
        found = []
        for at, step in zip(turned.starts, turned.steps, strict=True):
            share = _AT_A_CONE if step.start is not None else _free(turned, at, step.length)
            height = step.foot + share * (step.diameter - step.foot)
            found.append((at + share * step.length, height, words.of_step(step)))
        found += [(g.at + g.width / 2, g.diameter, words.of_groove(g)) for g in turned.grooves]
        if turned.bore:
            at, last = turned.starts[-1], turned.steps[-1]
            found.append((at + 0.8 * last.length, turned.bore, words.of_bore(turned)))
        for thread in turned.threads:
            at = 0.0 if thread.end == "lower" else turned.length
            found.append((at, thread.core, words.of_thread(thread)))
        return cls(tuple(found), tuple(_lengths(turned)), _different(turned.seats))

    def size(self, turned: Turned, scale: float) -> tuple[float, float]:
        """Width and height of all views with their dimensions, mm of the sheet."""
        texts = max(width_of(text) + scale * at for at, _, text in self.labels)
        # The text of a short length stands to the right of it.
        texts = max(texts, *(scale * high + 2 * ROW + width_of(text) for _, high, text in self.lengths))
        long = max(scale * turned.length, texts) + 2 * ROW + OVERHANG
        cut = _beside(turned, scale) if self.seats else 0.0
        high = labels_height(len(self.labels)) + scale * turned.greatest + rows_height(len(self.lengths))
        return long + len(self.seats) * cut, high


def _lengths(turned: Turned) -> list[tuple[float, float, str]]:
    """Both ends of every length and its text: those from the foot, then those with limits, shortest first.

    A length with limits of its own goes from edge to edge, and places one of both. Every edge that no such
    length places is measured from the foot.
    """
    ends = {turned.length, *turned.starts[1:], *(groove.at for groove in turned.grooves)}
    limited = []
    for seat in turned.seats:
        low, high = seat.at, seat.at + seat.length
        if seat.round_ends(turned.length) == (True, True):
            limited.append((low, high, words.of_seat_length(seat, turned.length)))
            high = low
        ends |= {low, high}
    from_foot = {round(end, 6) for end in ends if end > 0}
    for one in turned.lengths:
        limited.append((one.low, one.high, one.text))
        from_foot.discard(_placed_by(one, turned, from_foot))
    found = [(0.0, end, number(end)) for end in sorted(from_foot)]
    return [*found, *sorted(limited, key=lambda one: (round(one[1] - one[0], 6), one))]


def _placed_by(one: Length, turned: Turned, from_foot: set[float]) -> float:
    """The edge, of those measured from the foot, that a length with limits places instead."""
    walls = {round(g.at + g.width, 6): round(g.at, 6) for g in turned.grooves}
    for end in (one.high, one.low):
        edge = walls.get(round(end, 6), round(end, 6))
        if edge in from_foot:
            return edge
    return 0.0


_AT_A_CONE = 0.9
"""Where on a cone the label of its larger end stands, in its length."""

_PLACES = (0.5, 0.35, 0.65, 0.2, 0.8)
"""Where on a step its label may stand, in its length: the first that is on no groove or seat."""


def _free(turned: Turned, at: float, length: float) -> float:
    taken = [(one.at, one.at + one.width) for one in turned.grooves]
    taken += [(one.at, one.at + one.length) for one in turned.seats]
    near = length / 10
    for share in _PLACES:
        if not any(low - near <= at + share * length <= high + near for low, high in taken):
            return share
    return _PLACES[0]


def _different(seats: tuple[KeySeat, ...]) -> tuple[KeySeat, ...]:
    """One of all seats with the same section."""
    return tuple({(seat.width, seat.floor): seat for seat in reversed(seats)}.values())[::-1]


def _beside(turned: Turned, scale: float) -> float:
    """Width of a cut with its dimensions, mm."""
    return _to_middle(turned, scale) + scale * turned.greatest / 2 + 3 * ROW + width_of("100.5 (0/-0.1)")


def _to_middle(turned: Turned, scale: float) -> float:
    """From the left of a cut to its middle, mm: half of it, or of its title."""
    return ROW + max(scale * turned.greatest / 2 + OVERHANG, width_of(_CUT) / 2)


_CUT = "Key seat"
"""Title of a cut."""


def turned_sheet(part: Part, title: TitleBlock) -> Sheet:
    """The drawing of a turned part; raises GeometryError for another."""
    turned = part.turned
    if turned is None:
        raise GeometryError(f"part {part.name} is not turned: it has no drawing of this kind")
    plan = _Plan.of(turned)
    (wide, high), scale = _fitting(turned, plan)
    sheet = Sheet(wide, high, scale)
    used, needed = plan.size(turned, scale)
    low = MARGIN + TITLE[1]
    bottom = low + max((high - MARGIN - low - needed) / 2, 0.0) + rows_height(len(plan.lengths))
    beside = max((wide - 2 * (MARGIN + EDGE) - used) / 2, 0.0)
    left, axis = MARGIN + EDGE + ROW + beside, bottom + scale * turned.greatest / 2
    side(sheet, turned, left, axis)
    labels(
        sheet,
        [Label(left + scale * at, scale * size, text) for at, size, text in plan.labels],
        axis,
        axis + scale * turned.greatest / 2,
    )
    radius = {0.0: turned.steps[0].foot / 2} | {
        round(at + step.length, 6): step.diameter / 2
        for at, step in zip(turned.starts, turned.steps, strict=True)
    }
    for row, (low, high, text) in enumerate(plan.lengths):
        foot, at = (
            (left + scale * end, axis - scale * radius.get(round(end, 6), _radius(turned, end)))
            for end in (low, high)
        )
        y = axis - scale * turned.greatest / 2 - FREE - ROW * row
        length(sheet, foot, at, y, text)
    x = wide - MARGIN - EDGE - beside - len(plan.seats) * _beside(turned, scale)
    for seat in plan.seats:
        _cut(sheet, turned, seat, (x + _to_middle(turned, scale), axis))
        x += _beside(turned, scale)
    _frame(sheet, part, turned, title)
    return sheet


def _radius(turned: Turned, z: float) -> float:
    """Of the step at a height, mm."""
    for at, step in zip(turned.starts, turned.steps, strict=True):
        if at <= z <= at + step.length:
            return step.diameter / 2
    return turned.greatest / 2


def _fitting(turned: Turned, plan: _Plan) -> tuple[tuple[float, float], float]:
    """The smallest sheet and the largest scale that hold all; the last of both where none does."""
    for paper in SHEETS:
        for scale in SCALES:
            wide, high = plan.size(turned, scale)
            room = paper[0] - 2 * (MARGIN + EDGE), paper[1] - 2 * MARGIN - TITLE[1] - EDGE
            if wide <= room[0] and high <= room[1] and (scale >= LEAST or paper is SHEETS[-1]):
                return paper, scale
    return SHEETS[-1], SCALES[-1]


def _cut(sheet: Sheet, turned: Turned, seat: KeySeat, centre: Point) -> None:
    """The cut through a seat, with its width and what is left below it: d - t1, as it is measured."""
    step = 2 * _radius(turned, seat.at + seat.length / 2)
    left, right, floor, opposite = across(sheet, seat, step, centre)
    top = centre[1] + sheet.scale * step / 2
    y = top + ROW
    sheet.add(Text((centre[0], y + 2 * ROW), _CUT, "TEXT", align="middle"))
    length(sheet, (left[0], left[1] + 2.0), (right[0], right[1] + 2.0), y, words.of_seat_width(seat))
    deep = words.of_seat_depth(seat, step)
    upright(sheet, (floor[0], floor[1]), opposite, centre[0] + sheet.scale * step / 2 + ROW, deep)


def _frame(sheet: Sheet, part: Part, turned: Turned, title: TitleBlock) -> None:
    """Frame, title block, the sign of the projection, and the notes beside them."""
    frame(sheet, title.of_part(part, material(part.material).grades.bar, sheet.scale), words.notes(turned))
    projection_sign(sheet, third_angle=title.third_angle)

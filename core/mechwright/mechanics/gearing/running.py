"""Whether gears as their programs leave them go together and turn: play, contact and transmission error.

Two ways that share nothing but the outlines tell the play: the gaps at the points of contact, in closed form,
and the two polygons run against each other. Of the first the figures are; the second has to agree.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.as_made import MadeCurve, MadeFigure
from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.made_part import MadeHole, MadePart
from mechwright.mechanics.gearing.backlash import LEFT
from mechwright.mechanics.gearing.cut import hole_of
from mechwright.mechanics.gearing.made import Contacts, Gaps, error_of
from mechwright.mechanics.gearing.mesh import Mesh, mesh
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.rack import Rack
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.tolerances import OFF_CENTRE

AGREEMENT = 0.01
"""Share of the greatest play by which both ways may differ."""
RIDGE = 5e-4
"""Half a step of a control that reads three decimals, mm: polygons touch on ridges, flanks between them."""
FINE = 5e-5
"""Chord error of the polygons that run against each other, mm."""
DEEP = 0.05
"""Depth of interference up to which the polygons tell a play, mm: more is no matter of tolerances."""
MICRO = 1e6


class MadeMesh(ABC):
    """Two toothed bodies as made, the first of which drives the second.

    ``names`` are both bodies, ``corridor`` is that of both outlines together, mm. ``least`` is the backlash,
    mm, that the design asks for, and the rule by which it is found. ``free`` says whether the driven body
    finds its own place; else keys or links fix both.
    """

    names: tuple[str, str]
    outlines: tuple[Array, Array]
    corridor: float
    least: tuple[float, str]
    free: bool
    span: str = "a turn"
    """What the bodies are looked at over, in words."""
    play_rule: str = "2 (g cos δ + v sin α) cos α / (s4 cos(α + δ) cos(α - δ))"
    """How play follows from the gaps g and from v, by which an axis is off."""

    @property
    @abstractmethod
    def rack(self) -> Rack:
        """The cutter of the driver, with the backlash of the design."""

    @property
    @abstractmethod
    def contacts(self) -> Contacts:
        """Where the exact flanks touch."""

    @property
    @abstractmethod
    def mesh(self) -> Mesh:
        """The two polygons run against each other, at the exact centre distance."""

    def apart(self, off: float) -> tuple[float, float]:
        """By how much the driven body is off, mm, if it stands farther away by so much."""
        return off, 0.0

    @property
    def places(self) -> tuple[str, Array]:
        """What tells the positions, and its values (n,)."""
        return f"{self.names[0]}, degrees", np.degrees(self.gaps.theta) % 360.0

    def place(self, position: int) -> str:
        """A position in words."""
        return f"{self.places[1][position]:.1f} degrees of {self.names[0]}"

    @cached_property
    def gaps(self) -> Gaps:
        """What stands between the flanks."""
        return self.contacts.between(*self.outlines)

    @cached_property
    def disagreement(self) -> float:
        """By how much both ways differ at most, besides ridges of the path, as a share of the greatest play.

        Where that is less than what walls within tolerance make of it, of that. Polygons may touch sooner by
        the corridor, which every worst case has: the edge of a tip that the path leaves proud touches where
        the exact flanks have left each other.
        """
        closed, polygons = np.stack(self.gaps.play()), np.stack((self.mesh.ahead, self.mesh.behind))
        ahead, behind = closed
        lever = float(np.abs(self.gaps.lever).min())
        sooner = float((closed - polygons).max()) - max(RIDGE, self.corridor) / lever
        off = max(sooner, float((polygons - closed).max()) - RIDGE / lever, 0.0)
        return float(off / max(np.abs(np.concatenate((ahead, behind))).max(), LEFT / lever))

    def spare(self, off_centre: float, more: float = 0.0) -> Array:
        """What is left of the play (n,), rad, in the worst of the corridor and with the axes off, mm.

        A single pair finds its own angle, and only what brings the axes together takes play away. In a train
        keys and the coupler fix the angles: each flank needs its own play, whichever way an axis is off.
        """
        if self.free:
            ahead, behind = self.gaps.play(self.apart(-off_centre), more - self.corridor)
            return ahead + behind
        ahead, behind = self.gaps.play((0.0, 0.0), more - self.corridor - off_centre)
        least: Array = np.minimum(ahead, behind)
        return least

    @property
    def title(self) -> str:
        """What the pair is called."""
        return " and ".join(name.replace("-", " ") for name in self.names)


@dataclass(frozen=True)
class MadePair(MadeMesh):
    """A driver and the gear that it drives, as made.

    Parameters
    ----------
    pair, teeth
        How they turn, and the teeth of the driver, as designed.
    names
        Bodies of driver and driven gear.
    outlines
        Their toothed walls as made, material on the left, each about its axis: (n, 2) and (m, 2), mm.
    corridor
        mm, of both outlines together.
    least
        Backlash, mm, that the design asks for, and the rule by which it is found.
    free
        Whether the driven gear finds its own angle; else keys or links fix the angles of both.
    mate
        Teeth of the driven gear, where they differ from those of the driver.
    """

    pair: Pair
    teeth: Teeth
    names: tuple[str, str]
    outlines: tuple[Array, Array]
    corridor: float
    least: tuple[float, str]
    free: bool = True
    mate: Teeth | None = None

    @property
    def rack(self) -> Rack:
        """That of the teeth."""
        return self.teeth.rack

    @cached_property
    def contacts(self) -> Contacts:
        """Where the exact flanks touch."""
        return Contacts.of(self.pair, self.teeth, mate=self.mate)

    @cached_property
    def mesh(self) -> Mesh:
        """The two polygons run against each other, at the exact centre distance."""
        driver, driven = map(plain, self.outlines)
        return mesh(driver, driven, self.pair, self.teeth.wheel, allowance=DEEP)


def plain(outline: Array) -> Array:
    """An outline (n, 2), mm, without corners that hardly bend it."""
    import shapely

    return np.asarray(shapely.get_coordinates(shapely.simplify(shapely.Polygon(outline), FINE))[:-1])


def about_bore(part: MadePart, diameter: float) -> Array:
    """The outside of a gear as made (n, 2), mm, counter-clockwise, about the middle of its bore as made."""
    import shapely

    outside = part.outline.polygon().exterior
    points = shapely.get_coordinates(outside)[:-1]
    about: Array = (points if shapely.is_ccw(outside) else points[::-1]) - part.bore_middle(diameter)
    return about


def about_rim(part: MadePart) -> Array:
    """The teeth of a ring as made (n, 2), mm, clockwise, about the middle of its round outside as made."""
    import shapely

    shape = part.outline.polygon()
    points = shapely.get_coordinates(shape.exterior)[:-1]
    # Where tabs were, the rim stands proud by what they were filed to.
    away = np.hypot(*points.T)
    rim = MadeHole.of(points[np.abs(away - np.median(away)) < 2 * LEFT])
    return hole_of(shape) - (rim.x, rim.y)


def running_figures(pair: MadeMesh) -> list[MadeFigure]:
    """Play, gap and transmission error: as drawn, as made, and over corridor and centre distance."""
    c, (least, least_rule) = OFF_CENTRE, pair.least
    drawn = pair.contacts.gaps(0.0).play()
    made = pair.gaps.play()
    tight = pair.gaps.play(pair.apart(-c), -pair.corridor)
    loose = pair.gaps.play(pair.apart(c), pair.corridor)
    name = ".".join(pair.names)
    cos = math.cos(pair.rack.pressure_angle)
    room, gap = pair.contacts.room, pair.gaps.gap
    taken = room - gap[np.abs(gap - room) < LEFT]  # others lie beyond a tip
    what = pair.title

    def figure(key: str, title: str, asked: float | None, values: list[float], rule: str = "") -> MadeFigure:
        design, as_made, *both = values
        low, high = min(as_made, *both), max(as_made, *both)
        return MadeFigure(
            f"{name}.{key}", f"{what}: {title}", "µrad", asked, design, as_made, low, high, rule
        )

    def total(play: tuple[Array, Array]) -> Array:
        both: Array = (play[0] + play[1]) * MICRO
        return both

    rule = f"{pair.play_rule}, centre distance ± {c:g} mm"
    return [
        figure(
            "play.least",
            f"least play over {pair.span}",
            0.0,
            [float(total(one).min()) for one in (drawn, made, tight, loose)],
            rule,
        ),
        figure(
            "play.greatest",
            f"greatest play over {pair.span}",
            None,
            [float(total(one).max()) for one in (drawn, made, tight, loose)],
        ),
        figure(
            "transmission-error",
            "transmission error of one flank",
            None,
            [error_of(one) * MICRO for one in (drawn, made, tight, loose)],
            "max - min of the play of one flank; the backlash alone makes most of it",
        ),
        MadeFigure(
            f"{name}.left",
            f"{what}: left on two flanks that meet, mean",
            "mm",
            None,
            0.0,
            float(taken.mean()),
            float(taken.min()) - pair.corridor,
            float(taken.max()) + pair.corridor,
            "d2 + d4, normal to the flanks, and what the path may be off",
        ),
        MadeFigure(
            f"{name}.backlash",
            f"{what}: circumferential backlash",
            "mm",
            least,
            pair.rack.backlash,
            float(2 * (room - taken.mean()) / cos),
            float(2 * (room - taken.max() - pair.corridor) / cos),
            float(2 * (room - taken.min() + pair.corridor) / cos),
            least_rule,
        ),
    ]


def play_curve(pair: MadeMesh) -> MadeCurve:
    """Play over the driver's angle: as drawn, as made, and in the worst case."""
    name, turn = pair.places
    ahead, behind = pair.gaps.play()
    drawn = pair.contacts.gaps(0.0).play()
    order = np.argsort(turn, kind="stable")
    return MadeCurve(
        f"{pair.title}: play",
        name,
        "µrad",
        turn[order],
        {
            "as drawn": ((drawn[0] + drawn[1]) * MICRO)[order],
            "as made": ((ahead + behind) * MICRO)[order],
            "in the worst case": (pair.spare(OFF_CENTRE) * MICRO)[order],
        },
    )


def running_findings(pair: MadeMesh) -> list[Finding]:
    """Whether the pair turns, at the exact centre distance and over its tolerance, and both ways agree."""
    return [*_running(pair), *_agreeing(pair)]


def _running(pair: MadeMesh) -> list[Finding]:
    for off_centre, severity in ((0.0, Severity.ERROR), (OFF_CENTRE, Severity.WARNING)):
        spare = pair.spare(off_centre)
        worst = int(np.argmin(spare))
        if spare[worst] > 0:
            continue
        what = "jam" if severity is Severity.ERROR else f"jam with axes {off_centre:g} mm off"
        better, works = _tried(pair)
        return [
            Finding(
                "gear.as-made",
                severity,
                "backlash",
                f"as made {pair.title} {what}: {spare[worst] * MICRO:.0f} µrad of play at "
                f"{pair.place(worst)}",
                float(spare[worst]) * MICRO,
                0.0,
                "µrad",
                f"make backlash {better:g}: on these walls that leaves at least {works * MICRO:.0f} µrad",
                Stage.MACHINING,
                proposed=({"parameters.backlash": better},),
            )
        ]
    return []


def _tried(pair: MadeMesh) -> tuple[float, float]:
    """A backlash, mm, with which the pair turns over all tolerances, and the play that it leaves, rad."""
    backlash = pair.least[0]
    cos = math.cos(pair.rack.pressure_angle)
    while True:
        more = backlash * cos / 2 - pair.contacts.room
        spare = float(pair.spare(OFF_CENTRE, more).min())
        if spare > 0:
            return backlash, spare
        backlash = round(1.25 * backlash, 3)


def _agreeing(pair: MadeMesh) -> list[Finding]:
    if pair.disagreement <= AGREEMENT:
        return []
    return [
        Finding(
            "gear.as-made-routes",
            Severity.WARNING,
            "",
            f"the play of {pair.title} in closed form and that of the polygons differ by "
            f"{100 * pair.disagreement:.1f} % of the greatest",
            100 * pair.disagreement,
            100 * AGREEMENT,
            "%",
            "trust the smaller one",
            Stage.MACHINING,
        )
    ]

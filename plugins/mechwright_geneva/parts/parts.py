"""The parts of a design, and the heights at which they stand.

From below: the hub plate under the wheel; the wheel, from z = 0, with its floor or backing plate at the
bottom; beside it the locking disc; over both, one axial gap above the wheel, the crank plate; from the crank
the rollers hang into the slots.

The wheel's outline: rim, concave arcs, and, where they are cut through, slots and islands.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

from mechwright import (
    Arc,
    Bore,
    Colour,
    Feature,
    FittingMark,
    Instance,
    Loop,
    Outline,
    Part,
    Pocket,
    Point,
    Profile,
    Segment,
    Step,
    Turned,
    circle,
    kept,
)
from mechwright.contracts.fits import ROLLING, shaft_fit
from mechwright.contracts.measure import between_walls
from mechwright.geometry.keyway import Opening
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.motion import DRIVER, WHEEL, island_body, roller_body
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.counterbore import counterbore
from mechwright_geneva.parts.crank_outline import crank_loop, pin_bore, pin_fit, pins, stud_diameter
from mechwright_geneva.parts.dowels import driver_dowels, hub_dowels, island_places, web_place
from mechwright_geneva.parts.locking_disc import lock_loop
from mechwright_geneva.parts.openings import driver_opening, wheel_opening
from mechwright_geneva.parts.slot_outline import Slot, backwards
from mechwright_geneva.parts.tab_positions import tab_sites


@dataclass(frozen=True)
class Wheel:
    """The wheel of a mechanism, in its own frame: concave arc 0 on +x, slot 0 at -θw0."""

    mechanism: Mechanism

    @cached_property
    def slot(self) -> Slot:
        """Slot 0 as it is cut, clearance included."""
        return Slot(self.mechanism)

    def _bite(self) -> Segment:
        """Concave arc 0, from its lower horn to its upper one."""
        m = self.mechanism
        return Arc((m.axes, 0.0), m.arc, math.pi + m.arc_half, -2 * m.arc_half, "lock")

    def _rim(self, start: float, end: float) -> Segment:
        return Arc((0.0, 0.0), self.mechanism.rim, start, end - start, "rim")

    def disc(self) -> Loop:
        """The outside without slots: rim and concave arcs, counter-clockwise."""
        step, psi = 2 * self.mechanism.wheel_half, self.mechanism.horn_angle
        pieces: list[Segment] = []
        for k in range(self.mechanism.slots):
            pieces += [self._bite().moved(0, 0, k * step), self._rim(k * step + psi, (k + 1) * step - psi)]
        return Loop(tuple(pieces))

    def _wall(self, side: int) -> tuple[list[Segment], float]:
        """A wall from its mouth at the smaller polar angle inwards and out again, and its deviation."""
        if self.mechanism.straight:
            left, right = (self.slot.wall(one, trimmed=True) for one in (LEFT, RIGHT))
            return [*left.segments, *backwards(right.segments)], 0.0
        wall = self.slot.wall(side, trimmed=True)
        forwards = self.mechanism.side < 0
        return list(wall.segments) if forwards else backwards(wall.segments), wall.deviation

    def slotted(self) -> tuple[Loop, float]:
        """The outside with the slots cut through and the islands gone, and its deviation."""
        step, psi = 2 * self.mechanism.wheel_half, self.mechanism.horn_angle
        wall, deviation = self._wall(-self.mechanism.side)
        low, high = _angle(wall[0].start), _angle(wall[-1].end)
        sector = [self._bite().moved(0, 0, -step), self._rim(psi - step, low), *wall, self._rim(high, -psi)]
        return Loop(
            tuple(s.moved(0, 0, k * step) for k in range(self.mechanism.slots) for s in sector)
        ), deviation

    def island(self) -> tuple[Loop, float]:
        """Island 0, counter-clockwise, and its deviation."""
        wall, deviation = self._wall(self.mechanism.side)
        rim = self._rim(_angle(wall[0].start), _angle(wall[-1].end))
        return Loop((rim, *backwards(wall))), deviation


def _angle(point: Point) -> float:
    return math.atan2(point[1], point[0])


STEEL, BRONZE, BLUE, GREY = (0.68, 0.70, 0.74), (0.80, 0.62, 0.35), (0.42, 0.55, 0.72), (0.55, 0.56, 0.58)


_RELIEVED = 0.1
"""Share of its depth from which on a relief takes tabs."""


@kept
def parts_of(params: GenevaParams) -> tuple[Part, ...]:
    """All parts of a design without error findings."""
    m = mechanism_of(params)
    return (*_wheel(m), *_driver(m), _roller(m))


ARMS = FittingMark(
    "Turn the crank on the locking disc until each roller's hole stands over the middle of a hollow of it.",
    joins=True,
)
"""How the crank stands to the locking disc."""

FACING = FittingMark(
    "As the driver goes on, a slot of the wheel faces the roller. Which slot is no matter: they are alike."
)
"""How the crank stands to the wheel."""


def _wheel(m: Mechanism) -> list[Part]:
    params, wheel = m.params, Wheel(m)
    opening = _turned(wheel_opening(params), keyway_angle(m))
    dowels = [*hub_dowels(m)]
    depth = params.thickness
    made: list[Part] = []
    if m.params.slots_made == "blind":
        loop, deviation = wheel.slot.loop()
        grooves = [
            Pocket(f"groove-{k + 1}", loop.moved(0, 0, 2 * k * m.wheel_half), (), 0, m.params.groove_depth)
            for k in range(m.slots)
        ]
        grooves += counterbore(m, depth)
        made.append(
            _measured(
                m,
                _plate(
                    m, "wheel", wheel.disc(), deviation, opening, dowels, depth, WHEEL, 0, BRONZE, grooves
                ),
            )
        )
    elif m.params.slots_made == "through":
        loop, deviation = wheel.slotted()
        recess = counterbore(m, depth)
        plate = _plate(m, "wheel", loop, deviation, opening, dowels, depth, WHEEL, 0, BRONZE, recess)
        made.append(_measured(m, plate))
    else:
        made += _backed(m, wheel, opening, dowels)
    if params.hub_diameter > 0:
        hub = Loop((circle((0, 0), params.hub_diameter / 2, tag="hub"),))
        made.append(
            _plate(m, "hub", hub, 0.0, opening, dowels, params.hub_height, WHEEL, -params.hub_height, GREY)
        )
    return made


def _measured(m: Mechanism, wheel: Part) -> Part:
    """A wheel with the sizes that make it run and lock."""
    own = (
        between_walls("width of a slot", 2 * m.groove, -2),
        between_walls("axis to the bottom of a locking arc", m.axes - m.arc, 1),
    )
    return replace(wheel, measures=(*wheel.measures, *own))


def _backed(m: Mechanism, wheel: Wheel, opening: Loop | None, dowels: list[Point]) -> list[Part]:
    params, step = m.params, 2 * m.wheel_half
    depth = m.params.groove_depth
    webs: list[Point] = []
    own: list[Point] = []
    if params.fixing > 0:
        place, _ = web_place(m)
        webs = [_turn(place, k * step) for k in range(m.slots)]
        own = island_places(m, params.fixing)
    behind = [*dowels, *webs, *(_turn(place, k * step) for k in range(m.slots) for place in own)]
    body, one = wheel.slotted()
    island, two = wheel.island()
    holes = tuple(_hole(place, params.fixing) for place in own)
    pinned, recess = [*dowels, *webs], counterbore(m, depth)
    return [
        _plate(m, "wheel", body, one, opening, pinned, depth, WHEEL, params.floor, BRONZE, recess),
        _plate(m, "backing", wheel.disc(), 0.0, opening, behind, params.floor, WHEEL, 0, GREY),
        Part(
            "island",
            Outline(island, holes, two),
            depth,
            params.material,
            tuple(Instance(island_body(k), params.floor) for k in range(m.slots)),
            BRONZE,
            (
                *(Bore(f"dowel-{k}", place, params.fixing, 0, depth) for k, place in enumerate(own, start=1)),
                Profile("outside", island, "outside", 0, depth, tab_sites(island)),
            ),
        ),
    ]


def _driver(m: Mechanism) -> list[Part]:
    params = m.params
    opening = _turned(driver_opening(params), driver_keyway_angle(m))
    dowels = driver_dowels(m)
    loop, deviation = lock_loop(m)
    top = params.thickness + params.axial_gap
    # A relief leaves the disc's radius so gently that its ends still lock: tabs stand where it is deep.
    deep = m.lock - _RELIEVED * (m.lock - m.driver_radius)
    thick = params.disc_thickness
    disc = _plate(
        m, "locking-disc", loop, deviation, opening, dowels, thick, DRIVER, top - thick, STEEL, within=deep
    )
    disc = replace(disc, measures=(*disc.measures, between_walls("axis to the locking edge", m.lock, 1)))
    fit, thickness = pin_fit(m, params.pin_diameter), params.crank_thickness
    bores = [
        Bore(f"pin-{k}", (pin.real, pin.imag), pin_bore(m), 0, thickness, fit)
        for k, pin in enumerate(pins(m), start=1)
    ]
    crank = _plate(m, "crank", crank_loop(m), 0.0, opening, dowels, thickness, DRIVER, top, BLUE, bores)
    return [disc, replace(crank, marks=(ARMS, FACING))]


def _roller(m: Mechanism) -> Part:
    """The roller with its stud, which is turned."""
    params = m.params
    foot = params.thickness - params.roller_length
    stud = params.axial_gap + params.crank_thickness
    pressed = None if params.pin_fit == "none" else shaft_fit(params.pin_diameter, "h6")
    wide = 2 * m.roller
    running = Step(wide, params.roller_length, shaft_fit(wide, ROLLING))
    steps = (running, Step(stud_diameter(m), stud, pressed))
    instances = tuple(Instance(roller_body(k), foot) for k in range(params.rollers))
    return Part("roller", None, 0, params.roller_material, instances, STEEL, turned=Turned(steps))


def _plate(
    m: Mechanism,
    name: str,
    outer: Loop,
    deviation: float,
    opening: Loop | None,
    dowels: list[Point],
    thickness: float,
    body: str,
    z: float,
    colour: Colour,
    more: "list[Pocket] | list[Bore] | None" = None,
    within: float = math.inf,
) -> Part:
    """A plate with its opening, its dowel holes, and what else is cut into it, the outside last."""
    features: list[Feature] = []
    inner: list[Loop] = []
    if opening is not None:
        inner.append(opening)
        bore = m.params.bore if body == WHEEL else m.params.driver_bore
        features.append(Bore("bore", (0.0, 0.0), bore, 0, thickness))
        if not opening.is_circle:
            features.append(Profile("keyway", opening, "inside", 0, thickness))
    for number, place in enumerate(dowels, start=1):
        inner.append(_hole(place, m.params.fixing))
        features.append(Bore(f"dowel-{number}", place, m.params.fixing, 0, thickness))
    for feature in more or []:
        features.append(feature)
        if isinstance(feature, Bore):
            inner.append(_hole(feature.centre, feature.diameter))
    features.append(Profile("outside", outer, "outside", 0, thickness, tab_sites(outer, within)))
    return Part(
        name,
        Outline(outer, tuple(inner), deviation),
        thickness,
        m.params.material,
        (Instance(body, z),),
        colour,
        tuple(features),
    )


def driver_keyway_angle(m: Mechanism) -> float:
    """Direction of the driver's keyway: away from the rollers."""
    return math.pi if m.params.rollers == 1 else m.pitch / 2


def keyway_angle(m: Mechanism) -> float:
    """Direction of the wheel's keyway: towards the more of material, a concave arc or a slot's bottom."""
    return 0.0 if m.axes - m.arc > m.bottom - m.groove else -m.wheel_half


def _turned(opening: Opening | None, angle: float) -> Loop | None:
    if opening is None:
        return None
    loop = opening.loop()
    return loop.moved(0, 0, angle) if opening.has_keyway else loop


def _hole(place: Point, diameter: float) -> Loop:
    return Loop((circle(place, diameter / 2, clockwise=True, tag="dowel"),))


def _turn(place: Point, angle: float) -> Point:
    z = complex(*place) * complex(math.cos(angle), math.sin(angle))
    return z.real, z.imag

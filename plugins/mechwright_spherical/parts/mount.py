"""What a motor's flange brings with it: bushes in both fixed axes, shafts with rings, threads in the base.

The ground link gets a square flange about the input axis, beyond the heads of the screws that hold a motor's
pillars on it. Its hubs reach out to there, so that each shaft has long bearings. Where the ground is on both
sides, the flange is at the far end of the axis; of a five-bar it is on an arc of its own over the bevel
gears.
"""

import math
from dataclasses import dataclass

from mechwright import DesignError, Flange, Foot, MountingError, kept
from mechwright.contracts.finding import Change
from mechwright.contracts.turned import Groove, Length, Step, Turned, tube
from mechwright.standards.bushes import Bush, bush_for, bushes
from mechwright.standards.circlips import Circlip, shaft_circlip, shaft_circlips
from mechwright.standards.couplings import BORES, couplings
from mechwright.standards.screws import screw_sizes
from mechwright_spherical.kinematics.drive import Train, train_of
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import motor_opposite, shells_of
from mechwright_spherical.parts.hardware import StandTable
from mechwright_spherical.parts.places import carried_by, gear_cones, gear_span
from mechwright_spherical.parts.shells import FLANGE, RISE, Shells, Span
from mechwright_spherical.parts.stand import FLANGE_SCREWS, MOUNTING_SCREWS

EDGE = 9.0
"""From the axes of the flange's holes to its rim, mm."""

HOLE = 5.5
"""Diameter of these holes, mm: clearance of M5, medium."""

WALL = 2.0
"""Material around a bush, mm."""

AIR = 0.3
"""Between a hub and the ring on its shaft, and about a spacer, mm."""

LEAST_SCREW = 5.0
"""Of screws into the base, mm: thinner ones are for holes that no usual drill makes through a thick plate."""

HEAD = 1.25
"""Least diameter of a screw's head over that of its hole."""

FACE = 0.1
"""Deviation of the end faces of hubs and bosses from their places, plus and minus, mm."""

LOADED = "end of the shaft to the loaded wall of the groove"
"""The length of a shaft that decides its float."""

WALL_LIMITS = (0.0, 0.1)
"""Limits of that length, mm."""

FAR = {"ground": "far-ground", "crank": "far-crank"}
"""Frames of both, turned half a turn so that x is the far end of the input's axis."""

SIDE = "parameters.stand.motor_flange"

ADVISED = {SIDE: 56.0}
"""What is tried first where there is no flange: it takes motors NEMA 17 and of 37 mm."""


@dataclass(frozen=True)
class Hub:
    """The bearing of one fixed axis.

    Parameters
    ----------
    span
        Of the hub, radially, mm.
    bushes
        Each with the radius at which it begins, mm.
    ring
        On the shaft outside of the hub; None where a gear is there.
    """

    span: Span
    bushes: tuple[tuple[Bush, float], ...]
    ring: Circlip | None

    @property
    def outside(self) -> float:
        """Of the bushes, mm."""
        return self.bushes[0][0].outside

    @property
    def diameter(self) -> float:
        """Of the hub, mm, at least."""
        return self.outside + 2 * WALL

    def free_bore(self, params: SphericalParams) -> float:
        """How much of the longest bore that its bushes share they leave free, mm."""
        low, high = self.span
        inside = [bush.length for bush, at in self.bushes if low <= at < high]
        others = [one for one in self.bushes if not low <= one[1] < high]
        shells = shells_of(params)
        beside = shells.links["ground-2" if motor_opposite(params) else "ground"]
        rooms = [beside[1] - beside[0] - bush.length for bush, _ in others]
        return max(high - low - sum(inside), *rooms, 0.0)

    @property
    def seat(self) -> float:
        """Radius at which the ring begins, mm."""
        return self.span[1] + AIR


def bracket_of(params: SphericalParams) -> Span | None:
    """The span of the arc that carries a motor's flange over the bevel gears, mm; None without them."""
    if params.stand.motor_flange is None:
        return None
    shells, hardware, train = shells_of(params), params.hardware, train_of(linkage_of(params), params.drive)
    if train is None:
        return None
    low = max(gear_span(params, shells, train)[1], shells.pins["b0"][1]) + hardware.gap
    return low, low + hardware.link_thickness + 2 * hardware.boss_height


def flange_level(params: SphericalParams) -> float:
    """From the centre to the motor's flange, mm."""
    return (bracket_of(params) or shells_of(params).links["ground"])[1] + RISE


def least_height(params: SphericalParams) -> float:
    """Of the post, mm, so that the arc over the gears and heads of screws are below its flange; else 0."""
    over = bracket_of(params)
    if over is None:
        return 0.0
    return math.ceil(over[1] + RISE + params.hardware.link_thickness - shells_of(params).outside)


def shaft_start(params: SphericalParams, shells: Shells, name: str) -> float:
    """The radius at which the shaft of a hub begins, mm; below 0 beyond the centre."""
    low, high = shells.pins[name]
    return -high if name == "a0" and motor_opposite(params) else low


def spacer_room(params: SphericalParams, name: str) -> Span:
    """Between which radii the spacer beside a hub is, mm; below 0 beyond the centre.

    Of a five-bar only ``b0`` has one: at the input the pinion reaches to its hub.
    """
    shells, over = shells_of(params), bracket_of(params)
    if name == "a0" and motor_opposite(params):
        return -shells.links["crank"][0], -shells.links["ground-2"][1]
    if over is None:
        link = shells.links["crank" if name == "a0" else "rocker"]
        return link[1], link[1] + params.hardware.gap
    return shells.links["arm"][1], shells.links["ground"][0]


def gear_ends(params: SphericalParams, shells: Shells, train: Train, name: str) -> Span:
    """Between which distances from the centre a gear is along its axis, mm, with its hub.

    With a motor's flange the hub of the pinion reaches to the arc over the gears, those of wheel and idler to
    the ground, so that no spacers are between them.
    """
    half = gear_cones(train)[name][1]
    low, high = (end * math.cos(half) for end in gear_span(params, shells, train))
    over = bracket_of(params)
    if over is None:
        return low, high
    return (low, over[0] - AIR) if name == "pinion" else (shells.links["ground"][1] + AIR, high)


def idler_ring(params: SphericalParams, shells: Shells, train: Train) -> tuple[Circlip, float] | None:
    """The ring on the idler's stud and the distance at which it begins, mm; None without a motor's flange."""
    if bracket_of(params) is None:
        return None
    ring = shaft_circlip(params.hardware.pin_diameter)
    return ring, gear_ends(params, shells, train, "idler")[1] + AIR


def stud_form(params: SphericalParams, shells: Shells, train: Train) -> Turned:
    """The idler's stud from the ground outwards, with the groove of its ring where it has one."""
    low, high = shells.pins["idler"]
    held, diameter = idler_ring(params, shells, train), params.hardware.pin_diameter
    if held is None:
        return Turned((Step(diameter, high - low),))
    ring, seat = held
    groove = Groove(seat - low, ring.width, ring.groove, ring.tolerance)
    return Turned((Step(diameter, seat + ring.width + ring.edge - low),), grooves=(groove,))


def sizes() -> list[float]:
    """Diameters of pins for which there are bushes, rings and couplings, mm."""
    rings = {ring.size for ring in shaft_circlips()}
    return sorted({bush.bore for bush in bushes()} & rings & set(BORES))


@kept
def hubs_of(params: SphericalParams) -> dict[str, Hub]:
    """The hubs ``a0`` and ``b0`` of a ground link with a flange; none without one.

    Raises DesignError for pins without bush or ring.
    """
    if params.stand.motor_flange is None:
        return {}
    shells, diameter = shells_of(params), params.hardware.pin_diameter
    low, high = shells.links["ground"]
    ring = shaft_circlip(diameter)
    over = bracket_of(params)
    if over is not None:
        # Of a five-bar the gears are between both bushes of the input, and over the output's.
        end, one = flange_level(params) + FLANGE, bush_for(diameter, high - low)
        far = bush_for(diameter, end - over[0])
        return {
            "a0": Hub((over[0], end), ((one, low), (far, end - far.length)), ring),
            "b0": Hub((low, high), ((one, low),), None),
        }
    found = {}
    for name, end in (("a0", high + RISE + FLANGE), ("b0", high + RISE)):
        if name == "b0":
            found[name] = Hub((low, end), ((bush_for(diameter, end - low), low),), ring)
            continue
        if motor_opposite(params):
            # One beside the crank, beyond the centre, and one where the motor is.
            inner, outer = shells.links["ground-2"]
            near, far = bush_for(diameter, outer - inner), bush_for(diameter, end - low)
            found[name] = Hub((low, end), ((near, -outer), (far, end - far.length)), ring)
            continue
        # One at each end, for the crank hangs over the inner one.
        one = bush_for(diameter, (end - low) / 2)
        found[name] = Hub((low, end), ((one, low), (one, end - one.length)), ring)
    return found


def shaft_end(params: SphericalParams, name: str) -> float:
    """The radius at which the shaft of a hub ends, mm."""
    hub = hubs_of(params)[name]
    if hub.ring is None:
        return shells_of(params).pins[name][1]
    ring = hub.seat + hub.ring.width + hub.ring.edge
    return ring + 1.5 + max(one.length for one in couplings()) / 2 if name == "a0" else ring


def shaft_form(params: SphericalParams, shells: Shells, name: str) -> Turned:
    """A shaft from inside outwards, with the groove of its ring."""
    hub, low = hubs_of(params)[name], shaft_start(params, shells, name)
    step, ring = Step(params.hardware.pin_diameter, shaft_end(params, name) - low), hub.ring
    if ring is None:
        return Turned((step,))
    groove = Groove(hub.seat - low, ring.width, ring.groove, ring.tolerance)
    if bracket_of(params) is not None:
        return Turned((step,), grooves=(groove,))
    wall = Length(LOADED, 0.0, groove.at + groove.width, *WALL_LIMITS)
    link = carried_by(params, name)
    note = f"Bond {link} flush with the end from which the groove is measured"
    return Turned((step,), grooves=(groove,), lengths=(wall,), note=note)


def spacer_form(params: SphericalParams, name: str) -> Turned | None:
    """The spacer between a link and its hub; None where the gap is too narrow for one, or a gear is there."""
    if name == "a0" and bracket_of(params) is not None:
        return None
    low, high = spacer_room(params, name)
    length, bore = high - low - AIR, params.hardware.pin_diameter + 0.1
    return tube(bore, hubs_of(params)["a0"].outside, length) if length >= 0.5 else None


def thread_of(stand: StandTable) -> float:
    """The thinnest screw whose shank goes through the stand's holes and whose head does not, mm.

    DesignError where there is none from M5 upwards.
    """
    able = [
        one.size
        for one in screw_sizes()
        if one.size >= LEAST_SCREW and one.clearance("fine") <= stand.screw and one.head >= HEAD * stand.screw
    ]
    if not able:
        raise DesignError(f"parameters.stand.screw: no screw fits holes of {stand.screw:g} mm; make them 5.5")
    return min(able)


def mounting_of(params: SphericalParams) -> Flange:
    """The flange and the base; raises DesignError where there is none."""
    stand, hardware = params.stand, params.hardware
    if params.kind == "five-bar" and not params.drive.gears:
        raise MountingError(
            "parameters.drive.gears: without its bevel drive a five-bar has two inputs, and one motor drives "
            "one; set it to true",
            ({"parameters.drive.gears": True, **ADVISED}, {"machine.frame": "none"}),
        )
    if stand.motor_flange is None:
        wanted = params.model_copy(update={"stand": stand.model_copy(update={"motor_flange": ADVISED[SIDE]})})
        height: Change = {}
        if stand.height < least_height(wanted):
            height = {"parameters.stand.height": float(least_height(wanted))}
        arcs: tuple[Change, ...] = ({}, {"parameters.stand.arc": 75.0}, {"parameters.stand.arc": 90.0})
        raise MountingError(
            "parameters.stand.motor_flange: the ground link has no flange for a motor; make it 56",
            tuple({**ADVISED, **height, **arc} for arc in arcs),
        )
    hubs = hubs_of(params)
    plate, far = stand.plate, motor_opposite(params)
    return Flange(
        FAR["ground"] if far else "ground",
        flange_level(params),
        flange_level(params) + FLANGE,
        stand.motor_flange / 2,
        FAR["crank"] if far else "crank",
        hardware.pin_diameter,
        shaft_end(params, "a0"),
        max(shaft_end(params, "b0"), hubs["b0"].span[1], (bracket_of(params) or (0.0, 0.0))[1]),
        Foot(
            "base",
            stand.plate_thickness,
            tuple((plate * x, plate * y) for x, y in MOUNTING_SCREWS),
            tuple((plate * x, plate * y) for x, y in FLANGE_SCREWS),
            thread_of(stand),
            hardware.link_thickness,
            "parameters.stand.plate_thickness",
        ),
        "parameters.stand.motor_flange",
        "parameters.stand.arc",
        (hardware.link_thickness + 2 * hardware.boss_height, "parameters.hardware.pin_diameter"),
        opposite=far,
    )

"""What a motor's flange brings with it: bushes in both fixed axes, shafts with rings, threads in the base.

The ground link gets a square flange about the input axis, beyond the heads of the screws that hold a motor's
pillars on it. Its hubs reach out to there, so that each shaft has long bearings.
"""

from dataclasses import dataclass

from mechwright import DesignError, Flange, Foot, MountingError, kept
from mechwright.contracts.finding import Change
from mechwright.contracts.turned import Groove, Step, Turned, tube
from mechwright.standards.bushes import Bush, bush_for, bushes
from mechwright.standards.circlips import Circlip, shaft_circlip, shaft_circlips
from mechwright.standards.couplings import BORES, couplings
from mechwright.standards.screws import screw_sizes
from mechwright_spherical.frame import frame_of, shells_of
from mechwright_spherical.params import SphericalParams, StandTable
from mechwright_spherical.shells import FLANGE, RISE, Shells, Span
from mechwright_spherical.stand import FLANGE_SCREWS, MOUNTING_SCREWS

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

ADVISED = {"parameters.stand.motor_flange": 56.0}
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
        On the shaft outside of the hub.
    """

    span: Span
    bushes: tuple[tuple[Bush, float], ...]
    ring: Circlip

    @property
    def outside(self) -> float:
        """Of the bushes, mm."""
        return self.bushes[0][0].outside

    @property
    def diameter(self) -> float:
        """Of the hub, mm, at least."""
        return self.outside + 2 * WALL

    @property
    def seat(self) -> float:
        """Radius at which the ring begins, mm."""
        return self.span[1] + AIR


def sizes() -> list[float]:
    """Diameters of pins for which there are bushes, rings and couplings, mm."""
    rings = {ring.size for ring in shaft_circlips()}
    return sorted({bush.bore for bush in bushes()} & rings & set(BORES))


@kept
def hubs_of(params: SphericalParams) -> dict[str, Hub]:
    """The hubs ``a0`` and ``b0`` of a ground link with a flange; none without one.

    Raises DesignError for pins without bush or ring.
    """
    if params.stand.motor_flange is None or frame_of(params).bridge is not None:
        return {}
    (low, high), diameter = shells_of(params).links["ground"], params.hardware.pin_diameter
    ring = shaft_circlip(diameter)
    found = {}
    for name, end in (("a0", high + RISE + FLANGE), ("b0", high + RISE)):
        if name == "b0":
            found[name] = Hub((low, end), ((bush_for(diameter, end - low), low),), ring)
            continue
        # One at each end, for the crank hangs over the inner one.
        one = bush_for(diameter, (end - low) / 2)
        found[name] = Hub((low, end), ((one, low), (one, end - one.length)), ring)
    return found


def shaft_end(params: SphericalParams, name: str) -> float:
    """The radius at which the shaft of a hub ends, mm."""
    hub = hubs_of(params)[name]
    ring = hub.seat + hub.ring.width + hub.ring.edge
    return ring + 1.5 + max(one.length for one in couplings()) / 2 if name == "a0" else ring


def shaft_form(params: SphericalParams, shells: Shells, name: str) -> Turned:
    """A shaft from inside outwards, with the groove of its ring."""
    hub, (low, _) = hubs_of(params)[name], shells.pins[name]
    groove = Groove(hub.seat - low, hub.ring.width, hub.ring.groove, hub.ring.tolerance)
    return Turned((Step(params.hardware.pin_diameter, shaft_end(params, name) - low),), grooves=(groove,))


def spacer_form(params: SphericalParams) -> Turned | None:
    """The spacer between a link and its hub; None where the gap is too narrow for one."""
    length, bore = params.hardware.gap - AIR, params.hardware.pin_diameter + 0.1
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
    if params.kind != "four-bar":
        raise MountingError(
            "machine.frame: the bevel drive of a five-bar stands where a motor's bracket would; leave frame "
            'out, or set frame = "none"',
            ({"machine.frame": "none"},),
        )
    if frame_of(params).bridge is not None:
        raise MountingError(
            "parameters.hardware.frame: the input's shaft ends inside the links, where no motor goes; with "
            'other arcs, set it to "one"',
            ({"parameters.hardware.frame": "one", **ADVISED}, {"machine.frame": "none"}),
        )
    if stand.motor_flange is None:
        arcs: tuple[Change, ...] = ({}, {"parameters.stand.arc": 75.0}, {"parameters.stand.arc": 90.0})
        raise MountingError(
            "parameters.stand.motor_flange: the ground link has no flange for a motor; make it 56",
            tuple({**ADVISED, **arc} for arc in arcs),
        )
    shells, hubs = shells_of(params), hubs_of(params)
    plate = stand.plate
    return Flange(
        "ground",
        shells.outside + RISE,
        shells.outside + RISE + FLANGE,
        stand.motor_flange / 2,
        "crank",
        hardware.pin_diameter,
        shaft_end(params, "a0"),
        max(shaft_end(params, "b0"), hubs["b0"].span[1]),
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
    )

"""What keeps the gears of a train on their shafts, and the input's shaft in the base plate.

A disc with a screw in the upper end of a shaft that stands still keeps down what turns on it. A circlip with
a ring under the base plate keeps the input's shaft down; gear 2 is bonded to it. Shim rings under the discs
take up what the tolerances of the gears leave. A train whose coupler passes close over its gears has none.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from mechwright import Instance, Part
from mechwright.contracts.axial_stack import AxialStack, Shimming, StackLength
from mechwright.contracts.bought import Bought
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.turned import EndThread, Length, Turned, tube
from mechwright.errors import DesignError
from mechwright.standards.circlips import Circlip, shaft_circlip
from mechwright.standards.screws import Screw, least_engaged, lengths, screw, screw_size
from mechwright.standards.shims import THICKNESSES, Shim, shim_on
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.layout import Layout

DISC, OVER = 1.5, 2.0
"""Thickness of a disc, and by how much it is larger than the spacers on the shaft, mm."""

HEAD_GAP, SPARE = 0.5, 0.5
"""Between a screw's head and the coupler, and by how much a thread is deeper than its screw goes, mm."""

SIZES = (5.0, 4.0, 3.0)
"""Threads that are tried, mm, the largest first."""

PLAY = 0.1
"""Nominal play under a disc beside its shim ring, mm: the tolerances of the stack are in the ring."""

LEFT, MOST = 0.08, 0.3
"""What shim rings leave of a measured gap at least, and the greatest play with them, mm."""

LENGTH = 0.05
"""Limit deviations of spacers and of how far a shaft stands out of the base plate, plus and minus, mm."""

STANDS_OUT = "shaft over the base plate, set as it is pressed in"
"""Name of that length."""

UNDER, BELOW = 0.6, 1.0
"""Nominal play of the input's shaft under the base plate, and thickness of the ring on its circlip, mm."""

WALL, LOADED = (0.0, 0.1), "upper end of the shaft to the loaded wall of the groove"
"""Limits of the length that decides the float of the input's shaft, mm, and its name."""

FLOAT = (0.05, 1.3)
"""Float of the input's shaft that is meant, mm."""

STEEL = (0.78, 0.79, 0.81)


@dataclass(frozen=True)
class Disc:
    """The disc on one shaft: its body, gears and spacers under it, the ring on them, and the screw; mm."""

    shaft: str
    body: str
    lengths: tuple[tuple[str, float, float], ...]
    ring: float
    shim: Shim
    screw: Screw

    @property
    def over(self) -> float:
        """By how much the shaft stands over the gears, mm."""
        return self.ring + PLAY

    @property
    def thread(self) -> EndThread:
        """In the shaft's upper end."""
        of = self.screw.of
        return EndThread("upper", of.size, of.pitch, self.screw.length - DISC + SPARE)

    def stack(self) -> AxialStack:
        """The play of what turns on the shaft."""
        under = sum(length for _, length, _ in self.lengths)
        where = "between the upper gear and the disc on the shaft"
        rings = Shimming(self.shim.designation, THICKNESSES, where, LEFT, part=self.part_name)
        return AxialStack(
            f"play of the gears on {self.shaft}",
            (
                StackLength(STANDS_OUT, 1, under + self.over, -LENGTH, LENGTH, part=self.shaft),
                *(
                    StackLength(f"thickness of {name}", -1, length, -off, off, part=name)
                    for name, length, off in self.lengths
                ),
            ),
            LEFT - rings.reading,
            MOST,
            rings,
            STANDS_OUT,
        )

    @property
    def part_name(self) -> str:
        """Of the part that stands for its shim rings."""
        return self.shim.part_name(self.ring)


def discs_of(params: EllipticGearParams, layout: Layout) -> tuple[Disc, ...]:
    """The discs of a train; none where the coupler leaves no room, or nobody sells a ring for the shaft."""
    shim = shim_on(layout.bore, layout.spacer)
    if shim is None or params.screw_hole is None:
        return ()
    gear = (layout.thickness, general_length(layout.thickness, "medium"))
    found: dict[str, tuple[str, tuple[tuple[str, float, float], ...]]] = {}
    found["shaft-5"] = ("axis-5", (("hub-spacer-5", layout.upper, LENGTH), ("gear-5", *gear)))
    if params.phase_joint == "pins":
        between = ("hub-spacer", layout.gap, LENGTH)
        found["shaft-4"] = ("base", (between, ("gear-3", *gear), between, ("gear-4", *gear)))
    discs = []
    for shaft, (body, under) in found.items():
        needed = LENGTH + sum(off for _, _, off in under)
        # The thinnest ring that is sold and that all tolerances together leave room for.
        ring = next(one for one in THICKNESSES if one >= needed - 1e-9)
        room = layout.crown - ring - PLAY - DISC - HEAD_GAP
        chosen = _screw(layout.bore, room)
        if chosen is not None:
            discs.append(Disc(shaft, body, under, ring, shim, chosen))
    return tuple(discs)


def _screw(bore: float, room: float) -> Screw | None:
    """The largest that has its head in the room, and whose thread leaves a shaft its strength."""
    for size in SIZES:
        if size <= bore / 2 and screw_size(size).head_height <= room:
            return screw(
                size, next(one for one in lengths(size) if one >= DISC + least_engaged("steel") * size)
            )
    return None


def disc_parts(discs: tuple[Disc, ...], layout: Layout) -> Iterator[Part]:
    """Discs, their screws and shim rings."""
    top, wide = layout.upper + layout.thickness, layout.spacer + OVER
    for disc in discs:
        name = disc.shaft.removeprefix("shaft-")
        end = top + disc.over
        form = tube(disc.screw.of.clearance(), wide, DISC)
        yield Part(f"disc-{name}", None, 0.0, "steel", (Instance(disc.body, end),), STEEL, turned=form)
        at = (Instance(disc.body, end + DISC),)
        yield Part(f"disc-screw-{name}", None, 0.0, "steel", at, STEEL, bought=disc.screw.bought)
        ring = disc.shim.bought(disc.ring, "one of a set, chosen after measuring: see stacks.html")
        yield Part(disc.part_name, None, 0.0, "steel", (Instance(disc.body, top),), STEEL, bought=ring)


@dataclass(frozen=True)
class Keep:
    """The circlip of the input's shaft under the base plate, and the ring on it."""

    circlip: Circlip
    shim: Shim

    @property
    def wall(self) -> float:
        """From the base plate's lower face down to the loaded wall of the groove, mm."""
        return UNDER + BELOW + self.circlip.thickness

    @property
    def neck(self) -> float:
        """How far down the shaft carries something, mm."""
        return self.wall + self.circlip.edge

    def parts(self, layout: Layout) -> Iterator[Part]:
        """The circlip and the ring."""
        low = -layout.base - self.wall
        rings: tuple[tuple[str, float, Bought], ...] = (
            (self.circlip.part_name, low, self.circlip.bought),
            ("ring-2", low + self.circlip.thickness, self.shim.bought(BELOW)),
        )
        for name, z, bought in rings:
            yield Part(name, None, 0.0, "steel", (Instance("gear-2", z),), STEEL, bought=bought)

    def stack(self, layout: Layout, shaft: Turned) -> AxialStack:
        """The float of the input's shaft."""
        plates = (("gear-2", layout.thickness), ("base", layout.base))
        return AxialStack(
            "float of shaft-2",
            (
                StackLength.of(shaft.length_of(LOADED), 1, "shaft-2"),
                *(
                    StackLength(f"{name}, ISO 2768-m", -1, size, -off, off, part=name)
                    for name, size in plates
                    for off in (general_length(size, "medium"),)
                ),
                StackLength("hub-spacer", -1, layout.gap, -LENGTH, LENGTH, part="hub-spacer"),
                StackLength("ring on the circlip", -1, BELOW, -0.05, 0.0, True, "ring-2"),
                StackLength(
                    "circlip",
                    -1,
                    self.circlip.thickness,
                    -self.circlip.thinner,
                    0.0,
                    True,
                    self.circlip.part_name,
                ),
            ),
            *FLOAT,
            adjustable=LOADED,
        )


def keep_of(params: EllipticGearParams, layout: Layout) -> Keep | None:
    """What keeps the input's shaft down; None of a train without a frame, and where none is sold."""
    if params.screw_hole is None:
        return None
    try:
        circlip = shaft_circlip(layout.stub_diameter)
    except DesignError:
        return None
    # It bears on what is around the shaft in the base plate.
    shim = shim_on(layout.stub_diameter, 2 * layout.bore, layout.bore + OVER)
    keep = None if shim is None else Keep(circlip, shim)
    return keep if keep is not None and keep.neck < layout.stub else None


def spacer(bore: float, outside: float, height: float) -> Turned:
    """A spacer on a shaft, its height in the limits that the stacks have, mm."""
    form = tube(bore, outside, height)
    length = Length("height of the spacer", 0.0, height, -LENGTH, LENGTH)
    return Turned(form.steps, form.bore, lengths=(length,))

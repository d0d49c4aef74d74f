"""What cuts push with, and what holds against it: the heaviest cut against clamps, screws, tabs, bed, vice.

The heaviest cut is the widest slot that is planned for a mill of the job, with a worn edge. A hold is enough
if it bears twice of that. Friction between plate, table and clamp does it, not shear; coolant takes a third
of it. Figures are handbook's: a torque wrench is 15 % off, and chips under the plate take more than that.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import shapely

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.materials import material
from mechwright.contracts.threads import COARSE
from mechwright.geometry.segments import Point
from mechwright.mechanics.strength.bolts import preload, stress_area
from mechwright_cam.operations.bending import pass_depth
from mechwright_cam.operations.rates import rates
from mechwright_cam.setup.clamping import SCREW, Strap, least_margin, screw_places, straps, widest_channel
from mechwright_cam.setup.depths import bores
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutting_force import design_force
from mechwright_cam.shop.tool import Tool

SAFETY = 2.0
"""What a hold bears in the force of the heaviest cut, at least, in cuts that are not interrupted."""
FRICTION, WET = 0.15, 0.7
"""Of machined metal on metal, dry, and its share with coolant."""
MAT_FRICTION = 0.25
"""Of a plate on the rubber of a vacuum table."""
STRAP_SCREW = 7500.0
"""Force of a screw M8 of a strap at 12 N m, N: torque over 0.2 d."""
LEVER = 0.5
"""Share of that which a strap with equal arms brings to the plate."""
VICE = 10000.0
"""Force of the jaws of a small vice, N."""
VACUUM, TAPE = 0.08, 0.10
"""Pressure of a vacuum table, and shear of double-sided tape, N/mm²."""
GLUE, GLUE_SAFETY = 0.5, 2.5
"""Shear of superglue on masking tape, N/mm², and what it has to bear in the force of a cut: it is not known
as well as friction."""
SHEAR = 0.4
"""Shear strength of tabs in the yield strength of their material: 100 N/mm² in aluminium."""
CLAMP_SCREWS = (12, 10, 8, 6, 5, 4, 3)
"""Screws through a bore, from the largest: the bore is 0.5 mm wider."""


@dataclass(frozen=True)
class Push:
    """The heaviest cut: its mill, how deep it is, mm, and what it pushes with, N."""

    tool: Tool
    depth: float
    force: float


@dataclass(frozen=True)
class Way:
    """Something that holds, against a force in N: ``name`` says what, ``places`` where."""

    name: str
    holds: float
    straps: tuple[Strap, ...] = ()
    screws: tuple[Point, ...] = ()


@dataclass(frozen=True)
class Holding:
    """What holds a job, and against what; no way where there is room for none."""

    push: Push | None
    way: Way | None
    tabs: Way | None = None
    low: Push | None = None
    """The heaviest cut below the top of the tabs, which these bear."""

    @property
    def safety(self) -> float:
        """What the hold bears in the force of the heaviest cut."""
        if self.push is None:
            return math.inf
        return 0.0 if self.way is None else self.way.holds / self.push.force

    @property
    def tab_safety(self) -> float:
        """The same of the tabs and the cuts beside them."""
        return math.inf if self.tabs is None or self.low is None else self.tabs.holds / self.low.force


def strap_hold(count: int, friction: float = FRICTION, screw: float = STRAP_SCREW) -> float:
    """What straps bear, N: friction under the plate and under each strap.

    >>> strap_hold(4, screw=8000.0)
    4800.0
    """
    return count * screw * LEVER * 2 * friction


def screw_hold(count: int, size: float = SCREW, friction: float = FRICTION) -> float:
    """What screws 8.8 through the waste bear, N: by friction under the plate, at 0.7 of their proof stress.

    >>> round(screw_hold(4))
    3812
    """
    return count * preload(stress_area(size, COARSE[size])) * friction


def bed_hold(bed: str, area: float) -> float:
    """What a vacuum or tape under an area, mm², bears, N.

    >>> bed_hold("vacuum", 5000.0), bed_hold("tape", 1600.0)
    (100.0, 160.0)
    """
    return area * (VACUUM * MAT_FRICTION if bed == "vacuum" else TAPE)


def glue_hold(job: Job) -> float:
    """What superglue on masking tape under the parts of a job bears, N."""
    return GLUE * float(shapely.area(job.target))


def heaviest(job: Job, most: float = math.inf) -> Push | None:
    """The heaviest cut of the job, none deeper than ``most`` mm; None without a mill."""
    found = []
    name, deep = job.part.material, -job.floor
    for mill in job.mills:
        if name not in mill.cutting:
            continue
        tooth = rates(mill, name, job.settings.machine).chip
        depth = min(pass_depth(job, mill, deep), deep, most)
        force = design_force(material(name), mill.diameter, mill.flutes, tooth, depth, mill.diameter)
        found.append(Push(mill, depth, force))
        if job.settings.adaptive:
            depth = min(job.settings.adaptive_depth * mill.diameter, mill.flute_length, deep, most)
            wide = mill.radius * (1 - math.cos(math.radians(job.settings.engagement)))
            force = design_force(material(name), mill.diameter, mill.flutes, tooth, depth, wide)
            found.append(Push(mill, depth, force))
    return max(found, key=lambda push: push.force, default=None)


def holding(job: Job) -> Holding:
    """What holds a job against its heaviest cut: on the rim, else by screws, or as the design says."""
    push = heaviest(job)
    if push is None:
        return Holding(None, None)
    return Holding(push, _way(job, push), *_tabs(job))


def _way(job: Job, push: Push) -> Way | None:
    friction = FRICTION * (1.0 if job.settings.coolant == "off" else WET)
    if job.jaws:
        return Way("the vice with 10 kN", 2 * VICE * friction)
    if job.settings.hold.method == "none":
        if job.toes:
            count = len(job.toes)
            return Way(f"{count} toe clamps M8", strap_hold(count, friction))
        bed = job.settings.hold.bed or "tape"
        return Way(bed, bed_hold(bed, float(shapely.area(job.target))))
    on_rim, through = straps(job), screw_places(job)
    rim = Way(f"{len(on_rim)} toe clamps M8", strap_hold(len(on_rim), friction), straps=on_rim)
    screws = Way(
        f"{len(through)} screws M{SCREW:g} through the waste",
        screw_hold(len(through), SCREW, friction),
        screws=through,
    )
    ways = [way for way in (rim, screws) if way.holds > 0]
    enough = [way for way in ways if way.holds >= SAFETY * push.force]
    return enough[0] if enough else max(ways, key=lambda way: way.holds, default=None)


def _tabs(job: Job) -> tuple[Way | None, Push | None]:
    """The tabs, and the heaviest cut beside them."""
    if not job.tabs:
        return None, None
    height = job.thickness + job.tabs[0].top
    section = sum(tab.width * height for tab in job.tabs) / _pieces(job)
    strong = SHEAR * material(job.part.material).strength * section
    return Way("tabs", strong), heaviest(job, height + job.settings.breakthrough)


def _pieces(job: Job) -> int:
    """How many parts the tabs hold: each has its share of them."""
    return max(1, len(job.part.outlines))


def clamp_hold(job: Job) -> tuple[str, float] | None:
    """Screw of a clamp through the bore, and what it bears at the rim of the part, N; None without one.

    A part turns about its clamp: friction acts at the clamp's radius and, under the plate, at that radius and
    the thickness, and the cut at the part's. That is a share of what a clamp bears that pushes straight.
    """
    if job.clamp is None:
        return None
    wide = max((bore.diameter for bore in bores(job)), default=0.0)
    size = next((one for one in CLAMP_SCREWS if one + 0.5 <= wide), CLAMP_SCREWS[-1])
    friction = FRICTION * (1.0 if job.settings.coolant == "off" else WET)
    radius = job.clamp.diameter / 2
    arm = 2 / 3 * (radius + radius + job.thickness)
    middle = shapely.Point(job.clamp.centre)
    far = float(shapely.hausdorff_distance(middle, job.target.exterior))
    return f"M{size}", friction * preload(stress_area(size, COARSE[size])) * arm / max(far, radius)


def holding_findings(job: Job) -> Iterator[Finding]:
    """A warning where nothing holds the plate against its heaviest cut, with what would."""
    found = holding(job)
    if found.push is None or found.safety >= SAFETY:
        return
    push, way = found.push, found.way
    asked = SAFETY * push.force
    what = f"{push.tool.name}, {push.depth:.2g} mm deep, pushes {job.part.name} with {push.force:.0f} N"
    if way is None:
        margin = least_margin(widest_channel(job))
        message = f"{what}; the plate has no rim for clamps, and no waste for screws"
        key, cure = _cure(job, margin)
        remedy = f"{cure}: straps M8 hold {strap_hold(2, FRICTION * WET):.0f} N then"
        yield Finding.warning(
            "cam.hold-room", key, message, 0.0, asked, "N", remedy, proposed=_proposed(job, margin)
        )
        return
    message = f"{what}; {way.name} hold{'' if way.name[0].isdigit() else 's'} {way.holds:.0f} N"
    remedy = "take a smaller mill, or less of step_down in [cam.cutting.NAME]"
    if job.settings.hold.bed is not None and not job.toes:
        remedy += ", or hold it by toe_clamps"
    yield Finding.warning("cam.hold-force", "cam.hold", message, way.holds, asked, "N", remedy)


def _cure(job: Job, margin: float) -> tuple[str, str]:
    """The key of the stock, and what makes room for straps."""
    x0, y0, x1, y1 = job.target.bounds
    if job.settings.stock.length is None:
        return "cam.stock.margin", f"set margin = {margin:g}"
    longer = x1 - x0 >= y1 - y0
    size = (y1 - y0 if longer else x1 - x0) + 2 * margin
    key = "width" if longer else "length"
    return f"cam.stock.{key}", f"set {key} = {math.ceil(size)}"


def _proposed(job: Job, margin: float) -> tuple[Change, ...]:
    if job.settings.stock.length is not None or job.settings.stock.finished:
        return ()
    return ({"cam.stock.margin": margin},)

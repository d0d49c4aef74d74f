"""Which parts go together on one plate, and where they lie on it.

Rectangles around the parts are packed, largest first: see :mod:`mechwright.geometry.packing`.
"""

import math
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import shapely

from mechwright.contracts.file_names import free_name
from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.part import Part, check_name
from mechwright.errors import DesignError, MechwrightError
from mechwright.geometry.packing import on_plate, open_layout
from mechwright_cam.operations.channel import channel_width
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.in_hand import blanks
from mechwright_cam.planning.selection import choose_tools
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.sides import sides
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.holding import Nesting, Stock
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.packing import WEB
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import JobSettings
from mechwright_cam.shop.tool import MILLS, widest_mill
from mechwright_cam.shop.workshop_file import Shop
from mechwright_plane.nest import Nest, Placed, make_nest

NEST_NAME = "cam.nest.name"
"""The key of the design file that names a nest, and with it its files."""


MOST = 200
"""No more copies on one plate: their number comes from a file, and each costs time."""


class NestNameError(DesignError):
    """A nest has the name of a part, and both have files of it; ``finding`` proposes another one."""

    def __init__(self, path: Path, name: str, other: str) -> None:
        message, remedy = f"{name!r} is a part", f'set {NEST_NAME} = "{other}"'
        super().__init__(f"{path}: {NEST_NAME}: {message}; {remedy}")
        proposed: tuple[Change, ...] = ({NEST_NAME: other},)
        self.finding = Finding.error("files.names", NEST_NAME, message, remedy=remedy, proposed=proposed)


@dataclass(frozen=True)
class _Item:
    """A copy of a part with the box around all that is cut on it, in the part's coordinates."""

    part: Part
    label: str
    box: tuple[float, float, float, float]

    @property
    def size(self) -> tuple[float, float]:
        x0, y0, x1, y1 = self.box
        return x1 - x0, y1 - y0


def arranged(
    path: Path,
    settings: JobSettings,
    parts: Sequence[Part],
    library: Library,
    assignments: Assignments | None = None,
    shop: Shop | None = None,
) -> list[Part]:
    """The plate parts as they are cut: those that go together are one nest, at the place of the first.

    A nest is laid on a blank that the ``shop`` has in hand, if one is large enough.

    Raises DesignError where a part of ``[cam.nest]`` is not known or does not go with the others, or the
    plate is too small.
    """
    wanted = settings.cam.nest
    if wanted is None:
        return list(parts)
    groups = _groups(path, settings, wanted, parts)
    made: dict[str, Nest] = {}
    for number, group in enumerate(groups, start=1):
        name = wanted.name if number == 1 else f"{wanted.name}-{number}"
        try:
            check_name(name)
        except DesignError as error:
            raise DesignError(f"{path}: {NEST_NAME}: {error}") from error
        if name in (others := {part.name for part in parts}):
            other = free_name(f"{wanted.name}-nest", others)
            raise NestNameError(path, name, other)
        cam = settings.of(name)
        sheets = [] if shop is None else blanks(shop, group[0].material, group[0].thickness, cam)
        nest = _nested(path, cam, wanted, name, group, library, assignments, sheets)
        made |= {part.name: nest for part in group}
    return list({nest.name: nest for nest in (made.get(part.name, part) for part in parts)}.values())


def _groups(path: Path, settings: JobSettings, wanted: Nesting, parts: Sequence[Part]) -> list[list[Part]]:
    """The parts of each nest: those named, or all that are alike in material and thickness."""
    names = wanted.parts
    known = {part.name: part for part in parts}
    where = f"{path}: cam.nest.parts"
    if not names:
        alike: dict[tuple[str, float], list[Part]] = {}
        for part in parts:
            if part.name not in settings.parts and not sides(part)[1]:
                alike.setdefault((part.material, part.thickness), []).append(part)
        groups = [group for group in alike.values() if sum(map(copies, group)) > 1]
        if not groups:
            raise DesignError(
                f"{where}: no two plates are alike in material and thickness; remove [cam.nest]"
            )
        return groups
    for place, name in enumerate(names):
        if name not in known:
            listed = ", ".join(sorted(known)) or "none"
            raise DesignError(f"{where}: no plate part is named {name!r}; there is: {listed}")
        if name in names[:place]:
            raise DesignError(f"{where}: {name!r} is listed twice; copies come from the mechanism")
        part, first = known[name], known[names[0]]
        if (part.material, part.thickness) != (first.material, first.thickness):
            raise DesignError(
                f"{where}: {name} is {part.thickness:g} mm {part.material}, {first.name} is "
                f"{first.thickness:g} mm {first.material}; one plate has one thickness and one material"
            )
        if name in settings.parts:
            raise DesignError(
                f"{path}: cam.part.{name}: the part is cut in the nest; set it in "
                f"[cam.part.{wanted.name}], or take the part out of cam.nest.parts"
            )
        if sides(part)[1]:
            raise DesignError(f"{where}: {name} is cut from both sides; it cannot be nested, leave it out")
    return [[known[name] for name in names]]


def copies(part: Part) -> int:
    """How many of the part the mechanism needs."""
    return max(1, len(part.instances))


def _nested(
    path: Path,
    settings: CamSettings,
    wanted: Nesting,
    name: str,
    group: Sequence[Part],
    library: Library,
    assignments: Assignments | None,
    sheets: Sequence[tuple[float, float]],
) -> Nest:
    total = sum(map(copies, group))
    if total > MOST:
        raise DesignError(f"{path}: cam.nest: {total} copies on one plate, at most {MOST}; name fewer parts")
    if settings.stock.finished:
        raise DesignError(
            f"{path}: cam.stock.finished: the parts of {name} hang by tabs in a frame, and there is "
            "none at a finished edge; leave finished out, or cam.nest"
        )
    gap = wanted.gap or 2 * channel_of(group, settings, library, assignments) + WEB
    for length, width in sheets:
        on_sheet = settings.model_copy(update={"stock": Stock(length=length, width=width)})
        with suppress(DesignError):
            return nest_of(name, group, on_sheet, gap, turn=wanted.turn)
    try:
        return nest_of(name, group, settings, gap, turn=wanted.turn)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from error


def channel_of(
    group: Iterable[Part], settings: CamSettings, library: Library, assignments: Assignments | None = None
) -> float:
    """Width of the widest channel around the parts, mm.

    The part with the narrowest one decides: its mills rough all outsides of the plate.
    """
    found = []
    for part in group:
        try:
            tools = choose_tools(part, settings, library, assignments)
        except MechwrightError:
            continue  # laying out the nest says what is missing
        job = Job(part, settings, tools, (0.0, 0.0), (0.0, 0.0, 0.0, 0.0))
        mills = [channel_width(job, tool) for tool in tools if tool.kind in MILLS]
        found.append(max(mills, default=0.0))
    # With room for any cutter, laying out the nest comes to what is missing, and not to the gap.
    widest = widest_mill(library)
    return min(found, default=widest)


def nest_of(
    name: str, group: Sequence[Part], settings: CamSettings, gap: float, *, turn: bool = True
) -> Nest:
    """Lay all copies of some parts on one plate, ``gap`` mm apart at least.

    The first placed part, the largest, keeps its axis at the nest's origin. Raises DesignError where they do
    not fit on a plate of the given size.
    """
    items = [_Item(part, label, _box(part)) for part in group for label in _labels(part)]
    items.sort(key=lambda item: (-max(item.size), -min(item.size)))
    sizes = [item.size for item in items]
    stock, room = settings.stock, (settings.machine.travel_x, settings.machine.travel_y)
    if stock.length is not None and stock.width is not None:
        beside = gap + WEB  # a channel and a frame on either side
        inside = stock.length - beside, stock.width - beside
        within = min(inside[0], room[0] - gap), min(inside[1], room[1] - gap)
        layout = on_plate(sizes, *within, gap, turn) or on_plate(sizes, *inside, gap, turn)
        if layout is None:
            least = open_layout(sizes, gap, turn, room)
            raise DesignError(
                f"cam.stock: the {len(items)} parts of {name} do not fit on {stock.length:g} x "
                f"{stock.width:g} mm with {gap:.1f} mm between them; they do on "
                f"{math.ceil(least.width + beside)} x {math.ceil(least.height + beside)} mm; "
                "take a larger plate, or fewer parts"
            )
    else:
        layout = open_layout(sizes, gap, turn, room)
    placed = []
    for item, (x, y, turned) in zip(items, layout.spots, strict=True):
        x0, y0, _, y1 = item.box
        # Turned by +90 degrees, (x, y) goes to (-y, x): the box begins at (-y1, x0).
        (left, low), angle = ((-y1, x0), math.pi / 2) if turned else ((x0, y0), 0.0)
        placed.append(Placed(item.part, item.label, x - left, y - low, angle))
    dx, dy = placed[0].x, placed[0].y
    shifted = tuple(Placed(p.part, p.label, p.x - dx, p.y - dy, p.angle) for p in placed)
    return make_nest(name, shifted, gap)


def _labels(part: Part) -> list[str]:
    count = copies(part)
    return [part.name] if count == 1 else [f"{part.name} no {number}" for number in range(1, count + 1)]


def _box(part: Part) -> tuple[float, float, float, float]:
    """Around the plate and all features: a recess may be drawn, and run out, beyond the edge."""
    assert part.outline is not None  # noqa: S101 - only plates are nested
    shapes = [part.outline.polygon(), *(inside_of(feature) for feature in part.features)]
    x0, y0, x1, y1 = shapely.total_bounds(shapes).tolist()
    return x0, y0, x1, y1

"""Random plates for each operation: polygons with arcs, holes and islands, of many sizes, for any cutters and controls.

``benchmarks/random_parts.py`` runs hundreds of them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from planning_parts import LIBRARY, rounded_box
from random_shapes import Rng, polygon, ring, slot

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.part import Bore, Feature, OpenProfile, Part, Pocket, Profile
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright.geometry.lettering import lettering
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.tool import Tool, ToolKind

MATERIALS = ("aluminium", "steel", "brass", "pom")
SHAPES = {
    "bull-3-r0.3": (3, 0.3),
    "bull-4-r1.5": (4, 1.5),
    "bull-10-r2": (10, 2),
    "ball-2": (2, 1),
    "ball-4": (4, 2),
}
"""More round mills than the library has: diameter and corner radius, mm."""


def _more_mills() -> Library:
    """The library, and mills of more shapes in numbers that are free."""
    mills = []
    for number, (name, (diameter, nose)) in enumerate(SHAPES.items(), 150):
        like = LIBRARY.get("ball-6" if 2 * nose == diameter else "bull-6-r1")
        radius = {} if like.kind is ToolKind.BALL else {"corner_radius": nose}
        wanted = {
            "name": name,
            "number": number,
            "diameter": diameter,
            "flute_length": 4 * diameter,
            **radius,
        }
        mills.append(Tool.model_validate({**like.model_dump(exclude_unset=True), **wanted}))
    return Library((*LIBRARY, *mills))


CUTTERS = _more_mills()
THREADS = {"m3": (3.0, 0.5), "m4": (4.0, 0.7), "m5": (5.0, 0.8), "m6": (6.0, 1.0), "m8": (8.0, 1.25)}


@dataclass(frozen=True)
class Drawn:
    """A random part and what goes with it; features that stand apart from each other."""

    part: Part
    settings: dict[str, object]
    mills: tuple[str, ...] = ()
    """Mills that it cannot be made without."""
    kinds: frozenset[ToolKind] = frozenset()
    """Kinds of cutter that the operation needs beside end mills."""


def plate(
    rng: Rng,
    features: list[Feature],
    rim: Loop,
    thickness: float,
    details: tuple[Chamfer | Thread | Engraving, ...] = (),
) -> Part:
    """The plate with what goes through it in its outline."""
    inner = []
    for f in features:
        if f.top == 0 and f.depth == thickness:
            if isinstance(f, Bore):
                inner.append(Loop((circle(f.centre, f.diameter / 2, clockwise=True),)))
            elif isinstance(f, Profile) and f.side == "inside":
                inner.append(f.loop.reversed())
    outside = Profile("outside", rim, "outside", 0.0, thickness)
    machined = (*features, outside)
    material = str(rng.choice(MATERIALS))
    return Part("plate", Outline(rim, tuple(inner)), thickness, material, machined=machined, details=details)


def _size(rng: Rng) -> tuple[float, float]:
    """Size of a plate and its thickness, mm."""
    return float(rng.uniform(22, 45)), round(float(rng.uniform(2, 9)), 1)


def outside(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    return Drawn(plate(rng, [], polygon(rng, size), thick), {})


def inside(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    window = Profile("window", polygon(rng, rng.uniform(4, 0.5 * size)), "inside", 0.0, thick)
    return Drawn(plate(rng, [window], rounded_box(2 * size, 1.6 * size, 5), thick), {})


def pocket(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    wide = rng.uniform(5, 0.75 * size)
    depth = round(float(rng.uniform(0.3, 0.8)) * thick, 2)
    islands = ()
    if wide > 14 and rng.random() < 0.5:
        islands = (polygon(rng, rng.uniform(1.5, 0.25 * wide)),)
    recess = Pocket("recess", polygon(rng, wide), islands, 0.0, depth)
    features: list[Feature] = [recess]
    if rng.random() < 0.3 and not islands:  # a step lower
        features.append(
            Pocket("lower", Loop((circle((0.0, 0.0), 0.3 * wide),)), (), depth, 0.5 * (thick - depth))
        )
    return Drawn(plate(rng, features, rounded_box(2 * size, 1.8 * size, 4), thick), {})


def adaptive(rng: Rng) -> Drawn:
    drawn = pocket(rng)
    how = {"clearing": "adaptive", "engagement": float(rng.uniform(40, 110)), "adaptive_depth": 1.0}
    return replace(drawn, settings=how)


def slots(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    width = rng.uniform(1.2, 9)
    depth = round(min(float(rng.uniform(0.2, 0.9)) * thick, 3 * width), 2)
    loop = slot(
        rng, width + rng.uniform(2, size), width, rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(0, 3)
    )
    how = {"clearing": str(rng.choice(["contour", "adaptive"]))}
    return Drawn(
        plate(rng, [Pocket("slot", loop, (), 0.0, depth)], rounded_box(2 * size, 1.9 * size, 5), thick), how
    )


def groove(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    depth = round(float(rng.uniform(0.2, 0.7)) * thick, 2)
    width = rng.uniform(2, 10)
    if rng.random() < 0.4:
        inner = rng.uniform(0.5, 0.9) * size
        loop = ring(rng, inner, inner + width)
    else:
        loop = rounded_box(6 * size, width, 0.2).moved(0.0, rng.uniform(-0.3, 0.3) * size, rng.uniform(0, 3))
    rim = rounded_box(2 * size, 1.7 * size, 4)
    return Drawn(plate(rng, [Pocket("groove", loop, (), 0.0, depth)], rim, thick), {})


def rim(rng: Rng) -> Drawn:
    """A recess over a straight edge of a plate at any angle, and often another one of another kind."""
    size, thick = _size(rng)
    angle = float(rng.uniform(0, math.tau))
    plate_rim = Loop.polygon([(-size, -size), (size, -size), (size, 0.8 * size), (-size, 0.8 * size)])
    depth = round(float(rng.uniform(0.05, 0.8)) * thick, 2)
    wide = float(rng.uniform(5, 0.4 * size))
    over = polygon(rng, wide, float(rng.uniform(-0.3, 0.3)) * size, -size + float(rng.uniform(0, 0.6)) * wide)
    drawn = [Pocket("over", over, (), 0.0, depth)]
    maker: tuple[str, ...] = ()
    if rng.random() < 0.5:
        low = round(float(rng.uniform(0.3, 0.8)) * thick, 2)
        radius = 0.0
        if rng.random() < 0.4:
            tool = CUTTERS.get(
                str(rng.choice([t.name for t in CUTTERS if 0 < t.nose < low] or ["bull-3-r0.3"]))
            )
            radius, maker = min(tool.nose, low), (tool.name,)
        drawn.append(Pocket("inner", polygon(rng, 0.35 * size, 0.0, 0.35 * size), (), 0.0, low, radius))
    turned: list[Feature] = [replace(f, boundary=f.boundary.moved(0.0, 0.0, angle)) for f in drawn]
    return Drawn(plate(rng, turned, plate_rim.moved(0.0, 0.0, angle), thick), {}, maker)


def _bent(rng: Rng, reach: float, bend: float, turn: float) -> tuple[Line | Arc, ...]:
    """A straight piece, an arc to either side, and another straight piece."""
    turn *= rng.choice([-1.0, 1.0])
    arc = Arc((0.0, math.copysign(bend, turn)), bend, -math.copysign(math.pi / 2, turn), turn)
    end = (arc.end[0] + reach * math.cos(turn), arc.end[1] + reach * math.sin(turn))
    return Line((-reach, 0.0), (0.0, 0.0)), arc, Line(arc.end, end)


def open_profile(rng: Rng) -> Drawn:
    """A groove on an open path, or a step beside it."""
    size, thick = _size(rng)
    depth = round(float(rng.uniform(0.05, 0.8)) * thick, 2)
    width = float(rng.choice([2.0, 3.0, 4.0, 6.0, 10.0, rng.uniform(2, 12)]))
    reach, bend = float(rng.choice([0.5, 1.5])) * size, float(rng.uniform(13, 0.9 * size))
    bent = _bent(rng, reach, bend, float(rng.uniform(0.3, 2.0)))
    up, angle = float(rng.uniform(-0.3, 0.3)) * size, float(rng.uniform(0, 6))
    path = tuple(piece.moved(0.0, up, angle) for piece in bent)
    side = str(rng.choice(["on", "left", "right"]))
    cut = OpenProfile("strip", 0.0, depth, path=path, side=side, width=width)
    how = {"clearing": str(rng.choice(["contour", "adaptive"]))}
    return Drawn(plate(rng, [cut], rounded_box(2 * size, 1.8 * size, 4), thick), how)


def fillet(rng: Rng) -> Drawn:
    """A recess whose floor has a fillet."""
    size, thick = _size(rng)
    maker = rng.choice([tool.name for tool in CUTTERS if 0 < tool.nose < 0.8 * thick])
    radius = CUTTERS.get(str(maker)).nose
    depth = round(float(rng.uniform(radius, 0.85 * thick)) + 0.005, 2)
    recess = Pocket("recess", polygon(rng, rng.uniform(6, 0.75 * size)), (), 0.0, depth, radius)
    features: list[Feature] = [recess]
    if rng.random() < 0.3:
        features.append(Bore("hole", (0.0, 0.0), 3.0, 0.0, thick))
    rim = rounded_box(2 * size, 1.8 * size, 4)
    return Drawn(plate(rng, features, rim, thick), {}, (str(maker),), frozenset({ToolKind.DRILL}))


def snug(rng: Rng) -> Drawn:
    """A recess with a fillet, just as wide as the round mill that makes it, often over a slanted edge."""
    size, thick = _size(rng)
    maker = CUTTERS.get(str(rng.choice([tool.name for tool in CUTTERS if 0 < tool.nose < 0.7 * thick])))
    depth = round(float(rng.uniform(maker.nose, 0.85 * thick)) + 0.005, 2)
    side = str(rng.choice(["pocket", "on", "left", "right"]))
    place = (
        float(rng.uniform(-1, 1)) * size,
        float(rng.uniform(-0.8, 0.8)) * size,
        float(rng.uniform(0, math.tau)),
    )
    strip: Feature
    if side == "pocket":
        long, half = float(rng.uniform(1, size)) + maker.radius, maker.radius
        loop = Loop.polygon([(-long, -half), (long, -half), (long, half), (-long, half)])
        strip = Pocket("strip", loop.moved(*place), (), 0.0, depth, maker.nose)
    else:
        bend = float(rng.uniform(maker.diameter + 1, 0.9 * size))
        path = _bent(rng, float(rng.uniform(0.2, 1.5)) * size, bend, float(rng.uniform(0.2, 1.5)))
        path = tuple(piece.moved(*place) for piece in path)
        strip = OpenProfile(
            "strip", 0.0, depth, path=path, side=side, width=maker.diameter, floor_radius=maker.nose
        )
    rim = rounded_box(2 * size, 1.6 * size, float(rng.choice([0.5, 4.0, 10.0])))
    return Drawn(plate(rng, [strip], rim, thick), {}, (maker.name,))


def face(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    depth = round(float(rng.uniform(0.1, 0.3)) * thick, 2)
    over = rounded_box(5 * size, 5 * size, 1)
    features: list[Feature] = [Pocket("face", over, (), 0.0, depth)]
    if rng.random() < 0.5:
        below = polygon(rng, rng.uniform(5, 0.5 * size))
        features.append(Pocket("recess", below, (), depth, round(0.5 * (thick - depth), 2)))
    return Drawn(plate(rng, features, polygon(rng, size), thick), {})


def holes(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    thick = round(thick * rng.choice([1.0, 2.0]), 1)
    features: list[Feature] = []
    for number in range(int(rng.integers(1, 5))):
        diameter = float(rng.choice([2.0, 3.0, 3.3, 4.0, 5.0, 6.0, 8.0, rng.uniform(2, 14)]))
        x = -0.75 * size + number * 0.45 * size
        blind = rng.random() < 0.3 and diameter > 3
        depth = round(float(rng.uniform(0.3, 0.8)) * thick, 2) if blind else thick
        features.append(Bore(f"hole-{number}", (x, float(rng.uniform(-5, 5))), diameter, 0.0, depth))
    rim = rounded_box(2 * size + 16, 1.2 * size, 5)
    return Drawn(plate(rng, features, rim, thick), {}, (), frozenset({ToolKind.DRILL, ToolKind.SPOT_DRILL}))


def thread(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    name = str(rng.choice(list(THREADS)))
    diameter, pitch = THREADS[name]
    at = (float(rng.uniform(-5, 5)), float(rng.uniform(-5, 5)))
    cut = Thread(name, at, diameter, pitch, round(float(rng.uniform(0.4, 1.0)) * thick, 2))
    core = Bore("core", at, cut.core, 0.0, thick)
    part = plate(rng, [core], rounded_box(2 * size, 1.2 * size, 5), thick, (cut,))
    return Drawn(part, {}, (), frozenset({ToolKind.THREAD_MILL, ToolKind.DRILL}))


def chamfer(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    rim, width = polygon(rng, size), round(float(rng.uniform(0.2, 1.2)), 2)
    if rng.random() < 0.5:
        part = plate(rng, [], rim, thick, (Chamfer("edge", rim, "outside", width),))
    else:
        window = polygon(rng, rng.uniform(5, 0.5 * size))
        features: list[Feature] = [Profile("window", window, "inside", 0.0, thick)]
        edge = Chamfer("edge", window, "inside", width)
        part = plate(rng, features, rounded_box(2 * size, 1.6 * size, 5), thick, (edge,))
    return Drawn(part, {}, (), frozenset({ToolKind.CHAMFER}))


def engrave(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    letters = "".join(
        rng.choice(list("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-/ "), int(rng.integers(1, 7)))
    ).strip()
    strokes = lettering(letters or "A", rng.uniform(2.5, 6), (0.0, 0.0), rng.uniform(0, 3))
    mark = Engraving("mark", strokes, round(float(rng.uniform(0.1, 0.3)), 2), 0.6)
    part = plate(rng, [], rounded_box(2 * size + 10, 2 * size, 6), thick, (mark,))
    return Drawn(part, {}, (), frozenset({ToolKind.CHAMFER}))


def second_side(rng: Rng) -> Drawn:
    size, thick = _size(rng)
    bore = Bore("bore", (0.0, 0.0), float(rng.uniform(6, 10)), 0.0, thick)
    depth = round(float(rng.uniform(0.2, 0.5)) * thick, 2)
    if rng.random() < 0.5:
        under: Feature = Bore("counterbore", (0.0, 0.0), bore.diameter + 4, thick - depth, depth)
    else:
        loop = polygon(rng, 0.3 * size, 0.0, 0.6 * size)
        under = Pocket("mark", loop, (), thick - depth, depth)
    how = {"second_side": {"flip": str(rng.choice(["x", "y"])), "locate": str(rng.choice(["bore", "edges"]))}}
    rim = rounded_box(2 * size, 2.2 * size, 5)
    return Drawn(plate(rng, [bore, under], rim, thick), how)


def underside_rim(rng: Rng) -> Drawn:
    """A recess, step or groove of the underside, most of them over the rim, in a plate larger than the part."""
    drawn = (rim if rng.random() < 0.5 else open_profile)(rng)
    thick = drawn.part.thickness
    below: list[Feature] = []
    for f in drawn.part.machined:
        if isinstance(f, OpenProfile):  # not just as wide as a mill: what those do stands in ``open-profile``
            f = replace(f, width=f.width + 0.37)
        below.append(replace(f, top=thick - f.depth, floor_radius=0.0) if isinstance(f, Pocket) else f)
    side = {"flip": str(rng.choice(["x", "y"])), "locate": str(rng.choice(["dowels", "edges"]))}
    return Drawn(replace(drawn.part, machined=tuple(below)), {**drawn.settings, "second_side": side})


OPERATIONS: dict[str, Callable[[Rng], Drawn]] = {
    "outside": outside,
    "inside": inside,
    "pocket": pocket,
    "adaptive": adaptive,
    "slot": slots,
    "groove": groove,
    "rim": rim,
    "open-profile": open_profile,
    "fillet": fillet,
    "snug": snug,
    "face": face,
    "holes": holes,
    "thread": thread,
    "chamfer": chamfer,
    "engrave": engrave,
    "second-side": second_side,
    "underside-rim": underside_rim,
}


def cutters(rng: Rng, drawn: Drawn) -> list[str]:
    """Names of random mills and of all cutters of the other kinds; none: let them be chosen."""
    if rng.random() < 0.5:
        return []
    mills = [tool.name for tool in CUTTERS if tool.kind is ToolKind.END_MILL]
    rounds = [tool.name for tool in CUTTERS if tool.kind in (ToolKind.BULL_NOSE, ToolKind.BALL)]
    others = [tool.name for tool in CUTTERS if tool.kind in drawn.kinds]
    flat = rng.choice(mills, int(rng.integers(0, 4)), replace=False).tolist()
    more = rng.choice(rounds, int(rng.integers(not flat, 3)), replace=False).tolist()
    return [*flat, *dict.fromkeys([*more, *drawn.mills]), *others]

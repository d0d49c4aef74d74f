"""Draws the rooms of the project and who imports whom: ``python docs/architecture.py`` writes the picture.

Which rooms stand in one layer is read from the contracts of import-linter in ``pyproject.toml``, arrows from
the sources. The same sources give the same bytes.
"""

import tomllib
from dataclasses import dataclass
from html import escape
from textwrap import wrap

from imported import FACADE, ROOT, Graph, imports, reduced

IMAGE = ROOT / "docs" / "images" / "architecture.svg"

WIDTH = 400
"""Of the picture, in its own units: as wide as a telephone, so that its words can be read there."""
MARGIN = 6.0
ROW, BOX = 46.0, 24.0
"""Height of a layer, and of a box in it."""
CHAR = 6.7
"""Advance of a character of 11 units in any usual fixed-width font."""
PAD = 10.0
"""Beside the name of a room, both sides together."""
GAP = 18.0
"""Between boxes where there is room; an arrow that passes by takes as much."""
STEP = 26.0
"""Between blocks."""
HEAD = 20.0
"""Height of the title of a block."""

STYLE = (
    "text{font:11px ui-monospace,SFMono-Regular,Menlo,Consolas,'DejaVu Sans Mono',monospace;fill:#1c2733}"
    ".block{fill:#f4f6f8;stroke:#9fb0c0}.box{fill:#fff;stroke:#4a6076}"
    ".title{font-weight:bold}.arrow{fill:none;stroke:#4a6076;marker-end:url(#tip)}"
    ".wide{stroke:#a4561c;stroke-width:2;marker-end:url(#wide)}"
)


CORE, CAD, CAM, CHECKER = FACADE, "mechwright_cad", "mechwright_cam", "mechwright_check"
PLANE = "mechwright_plane"
PROCESSES = ("mechwright_cut", "mechwright_print")
"""Packages of processes besides milling: one block has them all."""

Spot = tuple[str, int]
"""A room, or an arrow as ``tail>tip``, and the number of the layer in which it stands or passes."""


@dataclass(frozen=True)
class Box:
    """A box and its place; one without width is where an arrow passes."""

    name: str
    x: float
    y: float
    width: float

    @property
    def middle(self) -> float:
        """Its middle across."""
        return self.x + self.width / 2


def rooms(graph: Graph, package: str) -> dict[str, frozenset[str]]:
    """Room of a package to the rooms of the same package that it imports."""
    found: dict[str, set[str]] = {}
    for module, wanted in graph.items():
        if module.startswith(f"{package}."):
            room = module.split(".")[1]
            found.setdefault(room, set()).update(
                one.split(".")[1] for one in wanted if one.startswith(f"{package}.")
            )
    return {room: frozenset(wanted - {room}) for room, wanted in sorted(found.items())}


def packages(graph: Graph) -> dict[str, frozenset[str]]:
    """Package to the packages that it imports."""
    found: dict[str, set[str]] = {}
    for module, wanted in graph.items():
        package = module.split(".")[0]
        found.setdefault(package, set()).update(one.split(".")[0] for one in wanted)
    return {package: frozenset(wanted - {package}) for package, wanted in sorted(found.items())}


def layers(package: str) -> list[list[str]]:
    """The layers of a package from the top down, as import-linter holds them."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (held,) = (
        one["layers"]
        for one in settings["tool"]["importlinter"]["contracts"]
        if one.get("containers") == [package]
    )
    return [[room.strip() for room in layer.split("|")] for layer in held]


def chains(rows: list[list[str]], arrows: Graph) -> list[list[Spot]]:
    """Each arrow as the spots that it goes through, one for each layer from its tail to its tip."""
    level = {room: number for number, row in enumerate(rows) for room in row}
    return [
        [
            (room, level[room]),
            *((f"{room}>{one}", number) for number in range(level[room] + 1, level[one])),
            (one, level[one]),
        ]
        for room, wanted in sorted(arrows.items())
        for one in sorted(wanted)
    ]


def placed(rows: list[list[str]], ways: list[list[Spot]], top: float) -> dict[Spot, Box]:
    """A place for each room and for each arrow that passes a layer, below those that lead there."""
    found: dict[Spot, Box] = {}
    for number, row in enumerate(rows):
        spots = [(room, number) for room in row]
        spots += [way[place] for way in ways for place in range(1, len(way) - 1) if way[place][1] == number]

        def wish(spot: Spot) -> float:
            above = [found[way[way.index(spot) - 1]].middle for way in ways if spot in way[1:]]
            return sum(above) / len(above) if above else WIDTH / 2

        widths = {
            spot: 0.0 if ">" in spot[0] else len(spot[0]) * CHAR + PAD for spot in sorted(spots, key=wish)
        }
        gap = min(GAP, (WIDTH - 4 * MARGIN - sum(widths.values())) / max(len(widths) - 1, 1))
        x = (WIDTH - sum(widths.values()) - gap * (len(widths) - 1)) / 2
        for spot, width in widths.items():
            found[spot] = Box(spot[0], x, top + number * ROW, width)
            x += width + gap
    return found


def block(package: str, title: str, graph: Graph, top: float) -> tuple[list[str], float]:
    """The drawing of a package with its rooms, and its lower edge."""
    rows = layers(package)
    ways = chains(rows, reduced(rooms(graph, package)))
    places = placed(rows, ways, top + HEAD + 6)
    bottom = top + HEAD + (len(rows) - 1) * ROW + BOX + 14
    drawn = [frame(MARGIN, top, WIDTH - 2 * MARGIN, bottom - top, title)]
    drawn += [arrow([places[spot] for spot in way]) for way in ways]
    drawn += [room(box) for spot, box in places.items() if ">" not in spot[0]]
    return drawn, bottom


def frame(x: float, y: float, width: float, height: float, title: str) -> str:
    """A block with its title."""
    return (
        f'<rect class="block" x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="6"/>'
        f'<text class="title" x="{x + 8:g}" y="{y + 14:g}">{escape(title)}</text>'
    )


def _near(value: float) -> str:
    """A length in tenths, the same whichever way its sums were rounded."""
    return f"{round(value, 6):.1f}"


def room(box: Box) -> str:
    """A room with its name."""
    x, width, middle = map(_near, (box.x, box.width, box.middle))
    return (
        f'<rect class="box" x="{x}" y="{box.y:g}" width="{width}" height="{BOX:g}" rx="3"/>'
        f'<text class="room" x="{middle}" y="{box.y + 16:g}" text-anchor="middle">{box.name}</text>'
    )


def arrow(boxes: list[Box]) -> str:
    """From the lower edge of the first box, by those between, to the upper edge of the last."""
    x, y = boxes[0].middle, boxes[0].y + BOX
    path = f"M{_near(x)} {y:g}"
    for box in boxes[1:]:
        half = (y + box.y) / 2
        path += f"C{_near(x)} {half:g} {_near(box.middle)} {half:g} {_near(box.middle)} {box.y:g}"
        x, y = box.middle, box.y
        if box.width == 0:
            y += BOX
            path += f"V{y:g}"
    return f'<path class="arrow" d="{path}"/>'


def wide(x: float, y: float, to_x: float, to_y: float) -> str:
    """The arrow from one block to another."""
    return f'<path class="arrow wide" d="M{x:g} {y:g}L{to_x:g} {to_y:g}"/>'


def draw() -> str:
    """The picture."""
    graph = imports()
    between = packages(graph)
    ours = {CORE, CAD, CAM, CHECKER, PLANE, *PROCESSES}
    families = [one for one in between if one not in ours]  # the checker stands by itself
    cam, cam_end = block(CAM, "cam/mechwright_cam: from parts to proven programs", graph, MARGIN)
    column = (WIDTH - 4 * MARGIN) / 3
    left = [MARGIN + n * (column + MARGIN) for n in range(3)]
    drawn, top = [], cam_end + STEP
    names = [one.removeprefix("mechwright_") for one in PROCESSES]
    height = small(drawn, (left[2], top, column), "other processes", [names])
    bottom = top + height
    top = bottom + STEP
    words = {
        CAD: ("mechwright_cad", list(rooms(graph, CAD))),
        PLANE: ("mechwright_plane", list(rooms(graph, PLANE))),
        "plugins": ("plugins", [one.removeprefix("mechwright_") for one in families]),
    }
    every = [names for _, names in words.values()]
    for x, (title, names) in zip(left, words.values(), strict=True):
        height = small(drawn, (x, top, column), title, [names, *every])
    core_top = top + height + STEP
    core, end = block(CORE, "core/mechwright: what every plugin may use", graph, core_top)
    middle = dict(zip(words, (x + column / 2 for x in left), strict=True))
    arrows = {(name, CORE): wide(x, top + height, x, core_top) for name, x in middle.items()}
    arrows |= {(CAM, name): wide(middle[name], cam_end, middle[name], top) for name in (CAD, PLANE)}
    arrows |= {
        ("processes", name): wide(left[2] + at, bottom, middle[name] + at, top)
        for name, at in ((CAD, 10.0), (PLANE, 30.0))
    }
    blocks = dict.fromkeys(families, "plugins") | dict.fromkeys(PROCESSES, "processes")
    there = {
        (blocks.get(one, one), blocks.get(other, other))
        for one, wanted in reduced(between).items()
        for other in wanted
    }
    assert there == arrows.keys(), f"an arrow between packages that has no place: {there ^ arrows.keys()}"  # noqa: S101
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {end + MARGIN:g}" '
            f'width="{WIDTH * 1.4:g}">',
            "<title>The rooms of Mechwright, and who imports whom</title>",
            f"<defs>{tip('tip', '#4a6076')}{tip('wide', '#a4561c')}</defs>",
            f"<style>{STYLE}</style>",
            *cam,
            *drawn,
            *core,
            *arrows.values(),
            "</svg>\n",
        ]
    )


LETTERS = 15
"""Characters of a line in a small block."""


def small(drawn: list[str], place: tuple[float, float, float], title: str, lists: list[list[str]]) -> float:
    """Draw a small block at x, y of a width with the first of some lists; gives its height."""
    x, y, width = place
    texts = [wrap(", ".join(names), LETTERS) for names in lists]
    height = HEAD + 12 + 15 * max(len(lines) for lines in texts)
    drawn.append(frame(x, y, width, height, title))
    drawn += [f'<text x="{x + 8:g}" y="{y + 32 + 15 * n:g}">{line}</text>' for n, line in enumerate(texts[0])]
    return height


def tip(name: str, colour: str) -> str:
    """The tip of an arrow."""
    return (
        f'<marker id="{name}" viewBox="0 0 8 8" refX="7.5" refY="4" markerWidth="7" markerHeight="7" '
        f'markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0L8 4L0 8Z" fill="{colour}"/></marker>'
    )


if __name__ == "__main__":
    IMAGE.write_text(draw(), encoding="utf-8")

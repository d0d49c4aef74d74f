"""One bracket as ten programs write it: versions, headers, units, kinds of entities and bad habits of each.

The bracket is 80 x 50 mm with rounded corners of 5 mm, a window of 30 x 16 mm, and four holes of 5 mm. All is
written anew here; of the programs only the habits are theirs, as public files of them show.
"""

import io
import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import ezdxf
from ezdxf import units
from ezdxf.document import Drawing

WIDE, HIGH, ROUND, HOLE = 80.0, 50.0, 5.0, 5.0
WINDOW = (25.0, 17.0, 55.0, 33.0)
HOLES = ((8.0, 8.0), (72.0, 8.0), (72.0, 42.0), (8.0, 42.0))
AREA = WIDE * HIGH - (4 - math.pi) * ROUND**2 - 30 * 16 - math.pi * HOLE**2
QUARTER = math.tan(math.pi / 8)

Row = tuple[int, object]


def rows(*entities: Sequence[Row], header: Sequence[Row] = ()) -> bytes:
    """A file of header and entities alone, as small programs write it."""
    found: list[Row] = []
    if header:
        found += [(0, "SECTION"), (2, "HEADER"), *header, (0, "ENDSEC")]
    found += [(0, "SECTION"), (2, "ENTITIES"), *(row for entity in entities for row in entity)]
    found += [(0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code}\n{value}\n" for code, value in found).encode()


def line(a: Sequence[float], b: Sequence[float], layer: str = "0") -> list[Row]:
    return [(0, "LINE"), (8, layer), (10, a[0]), (20, a[1]), (30, 0.0), (11, b[0]), (21, b[1]), (31, 0.0)]


def arc(centre: Sequence[float], radius: float, start: float, end: float, layer: str = "0") -> list[Row]:
    place: list[Row] = [(10, centre[0]), (20, centre[1]), (30, 0.0)]
    return [(0, "ARC"), (8, layer), *place, (40, radius), (50, start), (51, end)]


def ring(centre: Sequence[float], radius: float, layer: str = "0") -> list[Row]:
    return [(0, "CIRCLE"), (8, layer), (10, centre[0]), (20, centre[1]), (30, 0.0), (40, radius)]


def sides(
    x0: float, y0: float, x1: float, y1: float
) -> Iterator[tuple[tuple[float, float], tuple[float, float]]]:
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return zip(corners, [*corners[1:], corners[0]], strict=True)


def rim(digits: int = 9, scale: float = 1.0) -> list[tuple[str, tuple[float, ...]]]:
    """The outline as lines and arcs, in order, rounded."""
    w, h, r = WIDE, HIGH, ROUND

    def cut(*values: float) -> tuple[float, ...]:
        return tuple(round(value / scale, digits) for value in values)

    return [
        ("line", cut(r, 0, w - r, 0)),
        ("arc", (*cut(w - r, r, r), 270, 0)),
        ("line", cut(w, r, w, h - r)),
        ("arc", (*cut(w - r, h - r, r), 0, 90)),
        ("line", cut(w - r, h, r, h)),
        ("arc", (*cut(r, h - r, r), 90, 180)),
        ("line", cut(0, h - r, 0, r)),
        ("arc", (*cut(r, r, r), 180, 270)),
    ]


def edges(digits: int = 9, scale: float = 1.0, layer: str = "0") -> list[list[Row]]:
    found = []
    for kind, v in rim(digits, scale):
        found.append(line(v[:2], v[2:], layer) if kind == "line" else arc(v[:2], v[2], v[3], v[4], layer))
    return found


def bulged() -> list[tuple[float, float, float]]:
    w, h, r, q = WIDE, HIGH, ROUND, QUARTER
    return [
        (r, 0, 0),
        (w - r, 0, q),
        (w, r, 0),
        (w, h - r, q),
        (w - r, h, 0),
        (r, h, q),
        (0, h - r, 0),
        (0, r, q),
    ]


def window(scale: float = 1.0, layer: str = "0") -> list[list[Row]]:
    return [line([v / scale for v in a], [v / scale for v in b], layer) for a, b in sides(*WINDOW)]


def saved(document: Drawing) -> bytes:
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue().encode(document.output_encoding)


def freecad() -> bytes:
    """R12, no units in the header, blocks of its own layers, lines and arcs out of order, six decimals."""
    some = edges(6, layer="Sketch")
    holes = [ring(place, HOLE / 2, "Sketch") for place in HOLES]
    order = [*some[::2], *holes, *some[1::2], *window(layer="Sketch")]
    return rows(*order, header=[(9, "$ACADVER"), (1, "AC1009")])


def librecad() -> bytes:
    """R2000 in mm, dimensions, centre lines and a hatch beside the plate; polylines with bulges."""
    document = ezdxf.new("R2000", units=units.MM)
    space = document.modelspace()
    document.linetypes.add("CENTER2", [1.1, 0.8, -0.1, 0.1, -0.1])
    space.add_lwpolyline(bulged(), format="xyb", close=True)
    for a, b in sides(*WINDOW):
        space.add_line(a, b)
    for x, y in HOLES:
        space.add_circle((x, y), HOLE / 2)
        space.add_line((x - 4, y), (x + 4, y), dxfattribs={"linetype": "CENTER2"})
    space.add_linear_dim((0, -10), (0, 0), (80, 0)).render()
    space.add_hatch(color=2).paths.add_polyline_path([(0, 0), (5, 0), (5, 5)])
    return saved(document)


def qcad() -> bytes:
    """R15 in mm: every edge twice, once the other way, and a hidden layer with construction lines."""
    document = ezdxf.new("R2000", units=units.MM)
    document.layers.add("construction").off()
    space = document.modelspace()
    for kind, v in rim():
        if kind == "line":
            space.add_line(v[:2], v[2:])
            space.add_line(v[2:], v[:2])
        else:
            space.add_arc(v[:2], v[2], v[3], v[4])
            space.add_arc(v[:2], v[2], v[3], v[4])
    for a, b in sides(*WINDOW):
        space.add_line(a, b)
    space.add_line((25, 17), (40, 17))  # over a part of an edge
    for place in HOLES:
        space.add_circle(place, HOLE / 2)
        space.add_circle(place, HOLE / 2)
    space.add_line((-99, 25), (99, 25), dxfattribs={"layer": "construction"})
    return saved(document)


def inkscape() -> bytes:
    """R14, no units, all curves cubic splines, corners and circles too, and lines as LWPOLYLINE; layer names."""
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 0
    space = document.modelspace()
    layer = {"layer": "Layer 1"}
    k = 4 / 3 * math.tan(math.pi / 8)

    def quarter(x: float, y: float, r: float, start: float) -> None:
        a, b = math.radians(start), math.radians(start + 90)
        p, q = (x + r * math.cos(a), y + r * math.sin(a)), (x + r * math.cos(b), y + r * math.sin(b))
        one = p[0] - k * r * math.sin(a), p[1] + k * r * math.cos(a)
        two = q[0] + k * r * math.sin(b), q[1] - k * r * math.cos(b)
        points = [(*one_, 0.0) for one_ in (p, one, two, q)]
        space.add_open_spline(points, 3, [0, 0, 0, 0, 1, 1, 1, 1], dxfattribs=layer)

    for kind, v in rim():
        if kind == "line":
            space.add_lwpolyline([v[:2], v[2:]], dxfattribs=layer)
        else:
            quarter(v[0], v[1], v[2], v[3])
    space.add_lwpolyline([a for a, _ in sides(*WINDOW)], close=True, dxfattribs=layer)
    for x, y in HOLES:
        for start in (0, 90, 180, 270):
            quarter(x, y, HOLE / 2, start)
    return saved(document)


def autocad() -> bytes:
    """R2018 in inches: holes as blocks in an array, mirrored once; text, a frame in paper space, frozen layers."""
    document = ezdxf.new("R2018", units=units.IN)
    document.header["$MEASUREMENT"] = 0
    space = document.modelspace()
    inch = 25.4
    block = document.blocks.new("HOLE5")
    block.add_circle((0, 0), HOLE / 2 / inch)
    outer = document.blocks.new("PAIR")
    outer.add_blockref("HOLE5", (0, 0))
    outer.add_blockref("HOLE5", (64 / inch, 0))
    space.add_blockref("PAIR", (8 / inch, 8 / inch))
    space.add_blockref("PAIR", (72 / inch, 42 / inch), dxfattribs={"xscale": -1})
    space.add_lwpolyline([(x / inch, y / inch, b) for x, y, b in bulged()], format="xyb", close=True)
    document.layers.add("FROZEN").freeze()
    space.add_circle((1, 1), 0.7, dxfattribs={"layer": "FROZEN"})
    space.add_polyline2d([(x / inch, y / inch) for (x, y), _ in sides(*WINDOW)], close=True)
    space.add_mtext("BRACKET 3/16 PLATE")
    document.layout("Layout1").add_lwpolyline([(0, 0), (11, 0), (11, 8.5), (0, 8.5)], close=True)
    return saved(document)


def fusion() -> bytes:
    """R2000 in cm, five decimals: ends of arcs are a tenth of a micrometre off."""
    some = edges(5, 10.0)
    found = [*some, *window(10.0), *(ring([v / 10 for v in place], HOLE / 20) for place in HOLES)]
    return rows(*found, header=[(9, "$ACADVER"), (1, "AC1015"), (9, "$INSUNITS"), (70, 5)])


def solidworks() -> bytes:
    """R2000 in mm: everything on layer 0, the view from below (extrusion 0 0 -1), and bend lines on SLD-0."""
    document = ezdxf.new("R2000", units=units.MM)
    space = document.modelspace()
    below = {"extrusion": (0, 0, -1)}
    for kind, v in rim():
        if kind == "line":
            space.add_line(v[:2], v[2:])
        else:
            # Seen from below, X runs the other way, and so do angles.
            space.add_arc((-v[0], v[1]), v[2], 180 - v[4], 180 - v[3], dxfattribs=below)
    for a, b in sides(*WINDOW):
        space.add_line(a, b)
    for x, y in HOLES:
        space.add_circle((-x, y), HOLE / 2, dxfattribs=below)
    space.add_line((40, 0), (40, 50), dxfattribs={"layer": "SLD-0"})
    return saved(document)


def onshape() -> bytes:
    """R14 in inches, layers PERIMETER and CUTOUTS, every arc a polyline of one bulge."""
    document = ezdxf.new("R2000", units=units.IN)
    space = document.modelspace()
    for layer in ("PERIMETER", "CUTOUTS"):
        document.layers.add(layer)
    inch = 25.4
    for (x, y, b), (u, v, _) in zip(bulged(), [*bulged()[1:], bulged()[0]], strict=True):
        points = [(x / inch, y / inch, b), (u / inch, v / inch, 0)]
        space.add_lwpolyline(points, format="xyb", dxfattribs={"layer": "PERIMETER"})
    for a, b in sides(*WINDOW):
        space.add_line([v / inch for v in a], [v / inch for v in b], dxfattribs={"layer": "CUTOUTS"})
    for x, y in HOLES:
        halves = [((x + HOLE / 2) / inch, y / inch, 1), ((x - HOLE / 2) / inch, y / inch, 1)]
        space.add_lwpolyline(halves, format="xyb", close=True, dxfattribs={"layer": "CUTOUTS"})
    return saved(document)


def rhino() -> bytes:
    """R2004 in mm: circles and corners as rational splines, on a layer with a blank in its name."""
    document = ezdxf.new("R2004", units=units.MM)
    space = document.modelspace()
    layer = {"layer": "Layer 01"}
    w = math.sqrt(0.5)

    def corner(x: float, y: float, r: float, start: float) -> None:
        a, b, m = (math.radians(start + turn) for turn in (0, 90, 45))
        points = [
            (x + r * math.cos(a), y + r * math.sin(a), 0),
            (x + r / w * math.cos(m), y + r / w * math.sin(m), 0),
            (x + r * math.cos(b), y + r * math.sin(b), 0),
        ]
        space.add_rational_spline(points, [1, w, 1], 2, [0, 0, 0, 1, 1, 1], dxfattribs=layer)

    for kind, v in rim():
        if kind == "line":
            space.add_line(v[:2], v[2:], dxfattribs=layer)
        else:
            corner(v[0], v[1], v[2], v[3])
    space.add_lwpolyline([a for a, _ in sides(*WINDOW)], close=True, dxfattribs=layer)
    for x, y in HOLES:
        r = HOLE / 2
        turn = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
        knots = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]
        points = [(x + r * u, y + r * v, 0) for u, v in turn]
        space.add_rational_spline(points, [1, w, 1, w, 1, w, 1, w, 1], 2, knots, dxfattribs=layer)
    return saved(document)


def openscad() -> bytes:
    """No header at all: lines alone, circles as 40 chords, corners as 10."""
    found = []
    for kind, v in rim():
        if kind == "line":
            found.append(line(v[:2], v[2:]))
            continue
        turn = [math.radians(v[3] + 9 * k) for k in range(11)]
        points = [(v[0] + v[2] * math.cos(t), v[1] + v[2] * math.sin(t)) for t in turn]
        found += [line(a, b) for a, b in pairwise(points)]
    found += window()
    for x, y in HOLES:
        turn = [math.tau * k / 40 for k in range(40)]
        points = [(x + HOLE / 2 * math.cos(t), y + HOLE / 2 * math.sin(t)) for t in turn]
        found += [line(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    return rows(*found)


def kicad() -> bytes:
    """R2007 in mm, layer Edge.Cuts, wide polylines, circles as two arcs, Y below the axis."""
    document = ezdxf.new("R2007", units=units.MM)
    space = document.modelspace()
    layer = {"layer": "Edge.Cuts"}
    document.layers.add("Edge.Cuts")
    for kind, v in rim():
        if kind == "line":
            space.add_lwpolyline(
                [(v[0], v[1] - 60), (v[2], v[3] - 60)], dxfattribs={**layer, "const_width": 0.1}
            )
        else:
            space.add_arc((v[0], v[1] - 60), v[2], v[3], v[4], dxfattribs=layer)
    for a, b in sides(*WINDOW):
        space.add_line((a[0], a[1] - 60), (b[0], b[1] - 60), dxfattribs=layer)
    for x, y in HOLES:
        space.add_arc((x, y - 60), HOLE / 2, 0, 180, dxfattribs=layer)
        space.add_arc((x, y - 60), HOLE / 2, 180, 360, dxfattribs=layer)
    return saved(document)


def coreldraw() -> bytes:
    """R13 without units, ellipses for circles, and a gap of half a millimetre in the outline."""
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 0
    space = document.modelspace()
    for number, (kind, v) in enumerate(rim()):
        if kind == "line":
            space.add_line((v[0] + (0.5 if number == 0 else 0), v[1]), v[2:])
        else:
            space.add_arc(v[:2], v[2], v[3], v[4])
    for a, b in sides(*WINDOW):
        space.add_line(a, b)
    for x, y in HOLES:
        space.add_ellipse((x, y), (HOLE / 2, 0), 1.0)
    return saved(document)


HABITS: dict[str, Callable[[], bytes]] = {
    "FreeCAD": freecad,
    "LibreCAD": librecad,
    "QCAD": qcad,
    "Inkscape": inkscape,
    "AutoCAD": autocad,
    "Fusion": fusion,
    "SolidWorks": solidworks,
    "Onshape": onshape,
    "Rhino": rhino,
    "OpenSCAD": openscad,
    "KiCad": kicad,
    "CorelDRAW": coreldraw,
}

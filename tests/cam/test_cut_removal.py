"""What is left of a sheet, by a second count that shares nothing with the proof: areas by Steiner's formula.

A program is read by patterns alone. A beam of width k that runs around a part of area A and length L takes a
band of area k (L + π k / 2) beside it, less what leads add; the piece has the area of its outline. Pieces are
found as polygons of the way of the beam's middle, moved by half a kerf.
"""

import math
import re

import numpy as np
import pytest
import shapely
from cut_sheets import beam, copies, plate, sheet_of, toothed
from planning_parts import bore, lobes, rounded_box

from mechwright.contracts.part import Part
from mechwright.geometry import Outline

NUMBER = r"([-+]?\d*\.?\d+)"


def ways(text):
    """The points of each stretch of the way with the beam on, one every 2 µm of sagitta."""
    here, found, on = np.zeros(2), [], False
    for raw in text.splitlines():
        line = re.sub(r"\(.*?\)", "", raw)
        at = {letter: float(value) for letter, value in re.findall(rf"([XYIJ]){NUMBER}", line)}
        code = re.match(r"G([0123])\b", line)
        if code is None or not at:
            continue
        end = np.array((at.get("X", here[0]), at.get("Y", here[1])))
        if code[1] == "0":
            on = False
        else:
            if not on:
                found.append([here])
            found[-1].append(_path(here, end, at, code[1]))
            on = True
        here = end
    return [np.vstack(parts) for parts in found]


def _path(start, end, at, code):
    if code == "1":
        return end[None]
    centre = start + np.array((at.get("I", 0.0), at.get("J", 0.0)))
    one, two = (complex(*(point - centre)) for point in (start, end))
    sweep = np.angle(two / one)
    if code == "3" and sweep <= 0:
        sweep += math.tau
    if code == "2" and sweep >= 0:
        sweep -= math.tau
    count = max(2, int(abs(sweep) / (2 * math.acos(max(1 - 0.002 / abs(one), 0.0)))) + 1)
    turned = one * np.exp(1j * sweep * np.arange(1, count + 1) / count)
    return centre + np.column_stack((turned.real, turned.imag))


def enclosed(way):
    """What the way of the middle goes around, without its lead: the largest ring of its crossings."""
    lines = shapely.node(shapely.LineString(way))
    return max(shapely.get_parts(shapely.polygonize([lines])), key=lambda one: one.area)


PARTS = {
    "disc": Part("disc", Outline(bore(40).reversed(), (bore(10),)), 3, "acrylic"),
    "box": Part("box", Outline(rounded_box(50, 30, 5)), 3, "acrylic"),
    "lobes": Part("lobes", Outline(lobes(5, 20, 4), (bore(6),)), 3, "acrylic"),
    "wheel": toothed(),
    "plate": plate("plate", bore(5), bore(3, (8, 0))),
}


@pytest.mark.parametrize("name", PARTS)
@pytest.mark.parametrize("kerf", [0.1, 0.3])
def test_what_the_beam_goes_round_is_the_outline_moved_by_half_a_kerf(name, kerf):
    job = sheet_of(PARTS[name], kerf=kerf)
    text, asked = beam(job)
    (piece,) = asked.pieces
    found = sorted((enclosed(way).area for way in ways(text)), reverse=True)
    outer, *inner = piece.outline.loops
    ring = shapely.Polygon(outer.flatten())
    # Steiner: moved outwards by r, an area grows by r L + π r²; at concave corners it lacks a little.
    grown = ring.area + kerf / 2 * ring.length + math.pi * kerf**2 / 4
    assert found[0] == pytest.approx(grown, abs=0.02 * kerf * ring.length)
    moved = shapely.buffer(ring, kerf / 2, quad_segs=64).area
    assert found[0] == pytest.approx(moved, abs=0.003 * ring.length)
    for area, loop in zip(found[1:], sorted(inner, key=lambda one: one.area), strict=True):
        hole = 2 * math.sqrt(abs(loop.area) / math.pi)
        assert area == pytest.approx(math.pi / 4 * (hole - kerf) ** 2, rel=3e-3)


@pytest.mark.parametrize("name", PARTS)
def test_the_piece_that_is_left_has_the_outline_s_walls(name):
    job = sheet_of(PARTS[name])
    text, asked = beam(job, "linuxcnc-beam")
    (piece,) = asked.pieces
    kerf = job.kerf.width
    walls = shapely.MultiLineString([shapely.LineString(way) for way in ways(text)])
    for loop in piece.outline.loops:
        points = loop.flatten()
        off = shapely.distance(shapely.points(points), walls)
        # Nowhere nearer than half a kerf, nor farther but in corners that a round beam cannot fill.
        assert off.min() > kerf / 2 - 0.005
        assert np.median(off) == pytest.approx(kerf / 2, abs=0.003)
        assert off.max() < kerf / 2 * math.sqrt(2) + 0.005


@pytest.mark.parametrize("name", ["box", "plate", "lobes"])
@pytest.mark.parametrize("kerf", [0.1, 0.3])
def test_what_falls_of_a_row_is_every_part_and_nothing_else(name, kerf):
    """All ways of a sheet with common lines make polygons, each of which is a part or an opening of one."""
    sheet = {"length": 400.0, "width": 300.0, "margin": 2.0}
    job = sheet_of(copies(PARTS[name], 4), kerf=kerf, common_lines=True, sheet=sheet)
    text, asked = beam(job)
    assert len(job.common) == (0 if name == "lobes" else 3)
    lines = shapely.MultiLineString([shapely.LineString(way) for way in ways(text)])
    # Places within a micrometre are one: a stretch begins on a line to the last digit that is printed.
    faces = shapely.get_parts(shapely.polygonize([shapely.node(shapely.set_precision(lines, 1e-3))]))
    parts = [shapely.union_all(_of(faces, one.outline)) for one in asked.pieces]
    for one, face in zip(asked.pieces, parts, strict=True):
        ring = shapely.Polygon(one.outline.outer.flatten())
        # Half a kerf inside its face a part has its own area: each wall within 5 µm.
        piece = shapely.buffer(face, -kerf / 2, quad_segs=64)
        assert shapely.symmetric_difference(piece, ring).area < 0.005 * ring.length
        assert shapely.hausdorff_distance(piece, ring) < 0.25 * kerf + 0.005, "but for corners"
    apart = shapely.union_all([shapely.buffer(one, -1e-3) for one in parts])
    assert apart.area == pytest.approx(sum(shapely.buffer(one, -1e-3).area for one in parts), abs=1e-6)


def _of(faces, outline):
    """Faces inside an outline that is moved by the width of a hair more than the kerf."""
    around = shapely.buffer(shapely.Polygon(outline.outer.flatten()), 0.4)
    return [face for face in faces if shapely.covers(around, face)]

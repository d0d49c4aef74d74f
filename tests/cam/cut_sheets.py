"""Sheets for the tests of cutting, and the questions that their proofs are asked."""

import math

from planning_parts import bore, rounded_box

from mechwright.contracts.part import Instance, Part
from mechwright.geometry import Arc, Line, Loop, Outline
from mechwright_cut.cutting import question, wire_question
from mechwright_cut.jobs import cut_part
from mechwright_cut.nest import nested
from mechwright_cut.paths.order import contours
from mechwright_cut.paths.wire import wire_contours
from mechwright_cut.programs.grbl_laser import grbl_laser
from mechwright_cut.programs.iso_wire import iso_wire
from mechwright_cut.programs.linuxcnc_beam import linuxcnc_beam
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.figures import kerf_of, processes

SMALL = {"length": 90.0, "width": 60.0, "margin": 2.0}


def plate(name="plate", *inner, size=(24.0, 16.0, 3.0), material="acrylic", thickness=3.0, **more):
    return Part(name, Outline(rounded_box(*size), inner), thickness, material, **more)


def toothed(name="wheel", teeth=6, radius=9.0, hole=4.0, material="acrylic", thickness=3.0):
    """A wheel of straight flanks between arcs of tip and root; flanks are tagged as gears have it."""
    tip, root, step = radius, radius - 2.0, math.tau / teeth
    segments, here = [], None
    for k in range(teeth):
        at = k * step
        outer = Arc((0.0, 0.0), tip, at - 0.15 * step, 0.3 * step, "tip")
        inner = Arc((0.0, 0.0), root, at + 0.3 * step, 0.4 * step, "root")
        if here is not None:
            segments.append(Line(here, outer.start, "flank"))
        segments += [outer, Line(outer.end, inner.start, "flank"), inner]
        here = inner.end
    segments.append(Line(here, segments[0].start, "flank"))
    return Part(name, Outline(Loop(tuple(segments)), (bore(hole),)), thickness, material)


def copies(part, count):
    return Part(
        part.name,
        part.outline,
        part.thickness,
        part.material,
        tuple(Instance("ground") for _ in range(count)),
    )


def sheet_of(*parts, process="co2-laser", **said):
    settings = CutSettings(**{"sheet": SMALL, **said})
    kind, first = processes()[process], parts[0]
    kerf = kerf_of(kind.name, first.material, first.thickness, settings.kerfs)
    if settings.kerf is not None:
        kerf = type(kerf)(settings.kerf, 0.0, "cut.kerf", measured=True)
    return nested("sheet", [cut_part(part, kind, settings) for part in parts], kind, kerf, settings)


WRITERS = {"grbl-laser": grbl_laser, "linuxcnc-beam": linuxcnc_beam}


def beam(job, control="grbl-laser"):
    """The program of a sheet, and what its proof is asked."""
    return WRITERS[control](job, contours(job)), question(job, control)


def wire(job):
    """The same of a wire."""
    return iso_wire(job, wire_contours(job)), wire_question(job)

"""Linkages as made: the four-bar's figures, bores of three pins, split plates, rollers in their slots."""

import cmath
import zlib

import numpy as np
import pytest
from drawn_bars import four_bar

from mechwright.contracts.finding import Severity, Stage
from mechwright.contracts.made_part import MadeHole, MadePart, MadeRing, MadeSection
from mechwright.mechanics.linkage.parts.parts import part_name
from mechwright.mechanics.linkage.tolerance.as_made import links_as_made, pins_as_made
from mechwright.mechanics.linkage.tolerance.made_features import MadePlates
from mechwright.mechanics.linkage.tolerance.model import LinkageTolerances
from mechwright.mechanics.linkage.tolerance.plates import Plates
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable

LINKAGES = Linkages()


class Bored:
    """A plate whose bores are off by ``move`` of their drawn place, and larger by ``more``."""

    corridor = 0.004

    def __init__(self, move=lambda z: z, more=0.0):
        self.move, self.more = move, more

    def hole_at(self, x, y, diameter):
        made = self.move(complex(x, y))
        return MadeHole(made.real, made.imag, diameter + self.more + 0.001, diameter + self.more, 0.0)


def somewhere(name):
    """Bores off by up to 0.01 mm, whichever family asks; the posts where they are drawn."""

    def moved(place):
        if abs(place.imag) > 1 and name.startswith("ground"):
            return place
        seed = zlib.crc32(f"{name} {round(1e3 * place.real)} {round(1e3 * place.imag)}".encode())
        x, y = np.random.default_rng(seed).uniform(-0.01, 0.01, 2)
        return place + complex(x, y)

    return moved


def plates_of(params, **moves):
    names = [part_name(plate) for plate in LinkageTable.of(params).layout.outlines]
    return {name: [Bored(moves.get(name, lambda z: z))] for name in names}


@pytest.mark.parametrize(
    "table",
    [
        {"frame": "one"},
        {"frame": "two", "bushing_wall": 0.0},
        {"frame": "one", "coupler_point_x": 30.0, "coupler_point_y": 20.0, "bushing_wall": 0.0},
        {"frame": "two", "coupler_point_x": 30.0, "coupler_point_y": 20.0, "running_fit": 0.05},
    ],
)
def test_a_drawn_four_bar_has_the_figures_of_its_family(table):
    bar = FourBarParams(**table)
    params = four_bar(bar)
    made = {name: [Bored(somewhere(name), 0.002 * n)] for n, name in enumerate(plates_of(params))}
    known, found = FourBars().as_made(bar, made), LINKAGES.as_made(params, made)
    names = {"follower.error": "output.error"}
    # Across the line of the pivots the family four-bar leaves out what is of the second order.
    within = 1e-6 if table["frame"] == "one" else 2e-4
    assert [one.name for one in found.figures] == [names.get(one.name, one.name) for one in known.figures]
    for one, mine in zip(known.figures, found.figures, strict=True):
        for key in ("design", "made", "low", "high"):
            assert getattr(mine, key) == pytest.approx(getattr(one, key), rel=within)
        assert mine.unit == one.unit
    for one, mine in zip(known.curves, found.curves, strict=True):
        assert mine.x == pytest.approx(one.x, abs=1e-9)
        assert mine.x_title == one.x_title
        for line, values in one.lines.items():
            assert mine.lines[line] == pytest.approx(values, rel=within)
    assert found.findings == ()


CATALOGUE = ["jansen", "klann", "watt-1", "stephenson-1", "wiper", "pantograph"]


@pytest.mark.parametrize("name", CATALOGUE)
def test_plates_as_drawn_have_the_play_of_their_pins_alone(name):
    params = LinkageParams(linkage=name)
    said = LINKAGES.as_made(params, plates_of(params))
    assert {"output.error", "pin.room"} <= {one.name for one in said.figures}
    for one in said.figures:
        assert one.made == pytest.approx(one.design, rel=1e-9)
        assert one.low <= one.made <= one.high
    assert said.findings == ()


@pytest.mark.parametrize("frame", ["auto", "two"])
@pytest.mark.parametrize("name", CATALOGUE)
def test_a_plate_that_is_put_down_elsewhere_has_no_error(name, frame):
    """Each plate moved and turned as a whole: the distances of its bores are as drawn."""
    params = LinkageParams(linkage=name, frame=frame)
    plates = Plates.of(LinkageTable.of(params))
    split = plates.layout.scheme.split
    turn, shift = cmath.exp(0.3j), 2 - 1j
    moves = {one: lambda z: turn * z + shift for one in plates_of(params)}
    # What aligns two plates says where they are, and not how they are turned.
    moves |= {"ground": lambda z: z + shift, "ground-2": lambda z: z - 3 * shift}
    if split is not None:
        moves |= {
            part_name(split.link): lambda z: z + shift,
            part_name(split.second): lambda z: z - 2 * shift,
        }
    made = plates_of(params, **moves)
    links = links_as_made(MadePlates(plates, plates.layout, made))
    assert links
    assert max(abs(one.off) for one in links.values()) < 1e-9
    assert {one.spread for one in links.values()} <= {0.008, 0.016}


def test_sizes_as_made_are_those_of_the_contributors():
    """A third bore that is off along and across the line of the first two."""
    params = LinkageParams(linkage="watt-1")
    plates = Plates.of(LinkageTable.of(params))
    axes = plates.bores("coupler")
    a, b, c = (axis.places["coupler"] for axis in axes)
    along = (b - a) / abs(b - a)

    def moved(z):
        off = {0: 0.0, 1: 0.02, 2: 0.03 - 0.01j}
        return z + along * off[min(range(3), key=lambda n: abs(z - (a, b, c)[n]))]

    links = links_as_made(MadePlates(plates, plates.layout, plates_of(params, coupler=moved)))
    found = {name: one.off for name, one in links.items() if abs(one.off) > 1e-9}
    assert found == pytest.approx({"coupler": 0.02, "coupler-c-along": 0.03, "coupler-c-across": -0.01})
    # Both ends of the datum line off across it: the third bore is seen from the turned line.
    tilt = plates_of(params, coupler=lambda z: z + 1j * along * (0.01 if abs(z - b) < 1 else 0.0))
    links = links_as_made(MadePlates(plates, plates.layout, tilt))
    seen = (c - a) / along
    assert links["coupler-c-across"].off == pytest.approx(-0.01 * seen.real / abs(b - a), rel=1e-3)
    assert links["coupler-c-along"].off == pytest.approx(0.01 * seen.imag / abs(b - a), rel=1e-3)


def test_errors_as_made_are_those_of_the_machine_with_such_sizes():
    params = LinkageParams(linkage="watt-1", bushing_wall=0.0)
    made = plates_of(params, coupler=somewhere("coupler"), link5=somewhere("link5"))
    from mechwright.mechanics.linkage.made_error import EXACT

    plates = Plates.of(LinkageTable.of(params))
    links = links_as_made(MadePlates(plates, plates.layout, made))
    model = LinkageTolerances(LinkageTable.of(params), EXACT)
    off = [
        np.full((one.components, 1), links[one.name].off if one.name in links else 0.0)
        for one in model.contributors
    ]
    wanted = np.abs(model.errors("link5 angle", off, model.positions)).max()
    figure = LINKAGES.as_made(params, made).figures[0]
    assert figure.low == pytest.approx(1e6 * wanted, rel=1e-3)


def test_a_pin_of_three_links_has_a_room_in_each_plate_that_turns_on_it():
    params = LinkageParams(linkage="jansen", bushing_wall=0.0)
    plates = Plates.of(LinkageTable.of(params))
    made = plates_of(params) | {"c": [Bored(more=-0.01)]}
    rooms = {name: one.room for name, one in pins_as_made(MadePlates(plates, plates.layout, made)).items()}
    assert rooms["pin-b0-c"] == pytest.approx(0.01)
    for name in ("pin-b0-shoulder", "pin-m-j", "pin-m-k", "shaft"):
        assert rooms[name] == pytest.approx(0.015)
    tight = {name: [Bored(more=-0.04)] if name == "c" else one for name, one in made.items()}
    (jammed,) = LINKAGES.as_made(params, tight).findings
    assert (jammed.code, jammed.parameter, jammed.severity) == (
        "linkage.as-made",
        "running_fit",
        Severity.ERROR,
    )
    assert "B0 in c" in jammed.message
    assert jammed.stage is Stage.MACHINING


def ring(points):
    z = np.asarray(points)
    return MadeRing(
        np.column_stack([z.real, z.imag]), np.zeros((z.size, 2)), np.zeros(z.size), np.zeros(z.size, bool)
    )


def circle(middle, diameter):
    return ring(middle + diameter / 2 * np.exp(-1j * np.linspace(0, 2 * np.pi, 90, endpoint=False)))


def plate_with(outline, corridor=0.001, *, wider=0.0, across=0.0):
    """A plate as its outline; openings that are no circles are wider, and off to the left of their line."""
    rings = []
    for loop in outline.inner:
        z = loop.flatten(0.0005) @ np.array([1, 1j])
        z = z[:-1] if abs(z[0] - z[-1]) < 1e-9 else z
        middle = z.mean()
        if np.ptp(np.abs(z - middle)) > 0.5:
            ends = z[np.argmax(np.abs(z - middle))] - middle
            way = ends / abs(ends)
            way = way * (1 if (way.real, way.imag) > (0, 0) else -1)
            seen = (z - middle) / way
            inside = np.abs(seen.real) < np.abs(seen.real).max() - 1e-6
            seen = np.where(
                inside, seen.real + 1j * (seen.imag * (1 + wider / np.ptp(seen.imag)) + across), seen
            )
            dense = np.concatenate(
                [np.linspace(a, b, 40) for a, b in zip(seen, np.roll(seen, -1), strict=True)]
            )
            z = middle + way * dense
        rings.append(ring(z))
    outer = outline.outer.flatten(0.01) @ np.array([1, 1j])
    return MadePart("p", "p", corridor, (MadeSection(0.0, 6.0, (ring(outer), *rings)),))


def shaper(**table):
    return LinkageParams(linkage="crank-shaper", **table)


def shaped(params, corridor=0.001, **slots):
    outlines = LinkageTable.of(params).layout.outlines
    return {
        part_name(plate): [plate_with(outline, corridor, **slots.get(plate, {}))]
        for plate, outline in outlines.items()
    }


def test_slots_as_drawn_leave_the_fit_of_their_rollers():
    params = shaper()
    said = LINKAGES.as_made(params, shaped(params))
    figures = {one.name: one for one in said.figures}
    assert set(figures) == {"output.error", "pin.room", "slot.room"}
    assert figures["slot.room"].made == pytest.approx(params.running_fit, abs=1e-4)
    assert figures["slot.room"].low == pytest.approx(params.running_fit - 0.002, abs=1e-4)
    assert figures["output.error"].unit == "mm"
    assert figures["output.error"].made == pytest.approx(figures["output.error"].design, rel=0.02)
    assert said.findings == ()
    assert said.curves[0].x_title == "crank, degrees"


def test_a_slot_that_is_cut_wider_gives_its_roller_more_room():
    params = shaper()
    wide = {one.name: one for one in LINKAGES.as_made(params, shaped(params, lever={"wider": 0.04})).figures}
    usual = {one.name: one for one in LINKAGES.as_made(params, shaped(params)).figures}
    assert wide["output.error"].made > usual["output.error"].made
    found = MadePlates(
        Plates.of(LinkageTable.of(params)),
        LinkageTable.of(params).layout,
        shaped(params, lever={"wider": 0.04}),
    ).slots()
    assert found["lever-slide"][1].least == pytest.approx(
        LinkageTable.of(params).layout.sizes.slot_width + 0.04, abs=1e-4
    )


def test_a_bump_on_the_wall_of_a_slot_takes_the_room_of_its_roller():
    params = shaper()
    made = shaped(params)
    (part,) = made["lever"]
    (section,) = part.sections
    rings, bumps = [], []
    for one in section.rings:
        slot = LinkageTable.of(params).layout.slots[0]
        z = one.points @ np.array([1, 1j])
        seen = (z - (slot.first + slot.last) / 2) * abs(slot.last - slot.first) / (slot.last - slot.first)
        bump = (np.abs(seen.real) < 3) & (np.abs(seen.imag - slot.width / 2) < 0.01) & (one.area < 0)
        rings.append(ring(z - 0.012j * bump * (slot.last - slot.first) / abs(slot.last - slot.first)))
        bumps.append(bump.any())
    assert sum(bumps) == 1
    bumped = made | {"lever": [MadePart("p", "p", 0.001, (MadeSection(0.0, 6.0, tuple(rings)),))]}
    figures = {one.name: one for one in LINKAGES.as_made(params, bumped).figures}
    assert figures["slot.room"].made == pytest.approx(params.running_fit - 0.012, abs=1e-4)


def test_a_slot_that_is_cut_aside_offsets_its_line():
    params = shaper()
    plates = Plates.of(LinkageTable.of(params))
    found = MadePlates(plates, plates.layout, shaped(params, lever={"across": 0.02}))
    slot, made, _ = found.slots()["lever-slide"]
    way = (slot.last - slot.first) / abs(slot.last - slot.first)
    sign = 1 if (way.real, way.imag) > (0, 0) else -1
    assert made.across == pytest.approx(sign * 0.02, abs=1e-4)
    links = links_as_made(found)
    line = (
        sign
        * cmath.exp(1j * float(next(s for s in plates.slides if s.name == "lever-slide").direction("lever")))
        / way
    )
    assert links["lever-slide"].off == pytest.approx(0.02 * line.real, abs=1e-4)
    assert max(abs(one.off) for name, one in links.items() if name != "lever-slide") < 1e-4


def test_a_roller_that_jams_is_refused_with_a_fit_that_works():
    params = shaper()
    (jammed,) = LINKAGES.as_made(params, shaped(params, lever={"wider": -0.05})).findings
    assert (jammed.code, jammed.parameter, jammed.severity) == (
        "linkage.as-made",
        "running_fit",
        Severity.ERROR,
    )
    assert "lever-slide jams in its slot" in jammed.message
    better = float(jammed.remedy.split()[2].rstrip(":"))
    assert better == pytest.approx(0.03 + 0.02 + 0.002 + 0.001, abs=0.0011)
    again = shaper(running_fit=better)
    assert LINKAGES.as_made(again, shaped(again, lever={"wider": -0.05})).findings == ()


def test_without_a_plate_or_a_bore_nothing_is_said():
    params = LinkageParams(linkage="klann")
    made = plates_of(params)
    made.pop("crank")
    assert LINKAGES.as_made(params, made).figures == ()

    class Blank(Bored):
        def hole_at(self, x, y, diameter):
            return None

    assert LINKAGES.as_made(params, plates_of(params) | {"crank": [Blank()]}).figures == ()
    whole = shaper()
    assert (
        LINKAGES.as_made(
            whole, shaped(whole) | {"lever": [plate_with(LinkageTable.of(whole).layout.outlines["crank"])]}
        ).figures
        == ()
    )

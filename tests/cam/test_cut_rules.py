"""What is refused of cutting, each by name, with the nearest that works."""

from pathlib import Path

import pytest
from cut_sheets import plate, sheet_of, toothed
from planning_parts import bore, rounded_box

from mechwright.contracts.details import Chamfer, Thread
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.own_materials import OwnMaterial, add_materials
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline
from mechwright.pipeline import Build
from mechwright.pipeline.process import ChosenProcesses
from mechwright.plugins.host import host
from mechwright_cut.cutting import Cutting
from mechwright_cut.jobs import cut_part
from mechwright_cut.rules.part_rules import part_findings, refused
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.cut_table import CutTable
from mechwright_cut.settings.figures import able, kerf_of, processes, refusal

GENEVA = Path(__file__).parents[2] / "examples" / "geneva-straight.toml"
PLAIN = CutSettings()


def findings(part, process="co2-laser", kerf=0.2, **said):
    settings = CutSettings(**said)
    kind = processes()[process]
    return list(part_findings(cut_part(part, kind, settings), kind, kerf, settings))


def of(code, found):
    return [one for one in found if one.code == code]


# -- materials -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("process", "name", "why"),
    [
        ("co2-laser", "hdpe", "melts and burns"),
        ("diode-laser", "polycarbonate", "takes up the beam"),
        ("co2-laser", "steel", "reflects"),
        ("co2-laser", "7075", "reflects"),
        ("fibre-laser", "acrylic", "goes through it"),
        ("co2-laser", "pom", "formaldehyde"),
        ("waterjet", "plywood", "swells"),
        ("wire", "acrylic", "does not conduct"),
        ("plasma", "brass", "zinc"),
        ("co2-laser", "pvc-sheet", "chlorine"),
        ("diode-laser", "clear-acrylic", "blue beam"),
        ("co2-laser", "carbon-plate", "resin"),
        ("co2-laser", "abs", "cyanide"),
        ("fibre-laser", "ptfe", "fluorine"),
        ("co2-laser", "foam-board", "fires"),
    ],
)
def test_what_must_not_be_cut_is_refused_with_its_reason(process, name, why):
    assert why in refusal(process, name).why


def test_a_material_of_the_shop_is_known_by_the_name_by_which_it_is_ordered():
    add_materials({"sheet-7": OwnMaterial(like="acrylic", order="rigid PVC, grey")})
    try:
        assert "chlorine" in refusal("co2-laser", "sheet-7").why
    finally:
        add_materials({})


def test_extraction_lifts_the_refusal_of_pom_alone():
    part = plate(material="pom")
    process = processes()["co2-laser"]
    assert "cut.extraction = true" in refused(part, process, PLAIN)
    # Nothing is known of the thickness that it cuts, and it says so.
    assert "nothing is known" in refused(part, process, CutSettings(extraction=True))
    assert "melts" in refused(plate(material="hdpe"), process, CutSettings(extraction=True))


def test_what_cuts_a_material_of_a_thickness():
    assert able("steel", 3) == ["fibre-laser", "waterjet", "plasma", "wire"]
    assert able("steel", 30) == ["waterjet", "wire"]
    assert able("plywood", 3) == ["co2-laser", "diode-laser"]
    assert able("hdpe", 5) == ["waterjet"]


# -- kerfs ---------------------------------------------------------------------------------------------------


def test_a_kerf_lies_between_its_neighbours_and_a_measured_one_goes_first():
    at = [kerf_of("co2-laser", "plywood", t).width for t in (1.0, 1.6, 3.0, 4.5, 6.0, 9.0)]
    assert at == [0.15, 0.15, 0.2, 0.225, 0.25, 0.25]
    mine = CutSettings(
        kerfs=[
            {"process": "co2-laser", "material": "plywood", "thickness": 3, "kerf": 0.31},
            {"process": "co2-laser", "material": "any", "thickness": 3, "kerf": 0.99},
        ]
    ).kerfs
    assert kerf_of("co2-laser", "plywood", 3, mine).width == 0.31
    assert kerf_of("co2-laser", "mdf", 3, mine).width == 0.99
    assert kerf_of("diode-laser", "mdf", 3, mine).width == 0.15
    assert kerf_of("co2-laser", "pom", 3) is None


# -- parts ---------------------------------------------------------------------------------------------------


def test_recesses_thickness_and_shapes_that_overlap_are_refused():
    laser = processes()["co2-laser"]
    pocket = Pocket("dish", rounded_box(6, 6, 1), (), 0, 1)
    outside = Profile("outside", rounded_box(24, 16, 3), "outside", 0, 3)
    assert "dish does not go through" in refused(plate(machined=(pocket, outside)), laser, PLAIN)
    blind = Bore("seat", (0, 0), 5, 0, 2)
    assert "seat does not go through" in refused(plate(machined=(blind, outside)), laser, PLAIN)
    assert "up to 6 mm, and it is 8 mm" in refused(plate(thickness=8.0), laser, PLAIN)
    assert "openings 1 and 2 overlap" in refused(plate("p", bore(6), bore(6, (4, 0))), laser, PLAIN)
    assert "opening 1 crosses the outside" in refused(plate("p", bore(6, (11, 0))), laser, PLAIN)
    assert refused(plate("p", bore(6)), laser, PLAIN) is None


def test_holes_below_the_least_are_refused_or_marked():
    part = plate("p", bore(1.2), bore(1.2, (5, 0)), bore(6, (-5, 0)))
    (told,) = of("cut.hole", findings(part))
    assert told.severity is Severity.ERROR
    assert "2 holes of 1.2 mm" in told.message
    assert told.limit == 1.5
    assert told.proposed == ({"cut.small_holes": "spot"},)
    assert not of("cut.hole", findings(part, small_holes="spot"))
    cut = cut_part(part, processes()["co2-laser"], CutSettings(small_holes="spot"))
    assert len(cut.outline.inner) == 1
    assert len(cut.strokes) == 4
    assert cut.finishing[0] == "drill a hole of 1.2 mm at (0, 0), where a cross marks it"


@pytest.mark.parametrize(
    ("process", "material", "said", "step"),
    [
        ("co2-laser", "acrylic", {"fits": "bush"}, "anneal at 70 °C"),
        ("co2-laser", "acrylic", {}, ""),
        ("waterjet", "acrylic", {"fits": "bush"}, ""),
        ("fibre-laser", "steel", {}, "drill through the hard edge"),
        ("fibre-laser", "steel", {"fits": "bush"}, ""),
        ("fibre-laser", "aluminium", {}, ""),
        ("wire", "steel", {}, ""),
    ],
)
def test_what_suffers_from_heat_has_a_step_before_it(process, material, said, step):
    fit = hole_fit(5.0, "H6")
    bored = (
        Bore("bore", (0.0, 0.0), 5.0, 0.0, 3.0, fit=fit),
        Profile("outside", rounded_box(24, 16, 3), "outside", 0, 3),
    )
    part = plate("p", bore(5), material=material, machined=bored)
    cut = cut_part(part, processes()[process], CutSettings(**said))
    assert cut.finishing, "the fit is made afterwards"
    first = cut.finishing[0]
    assert step in first if step else "before" not in first
    told = of("cut.heat", findings(part, process, **said))
    assert [step in one.message for one in told] == ([True] if step else [])


def slotted(width, material="acrylic", *, through=True):
    """A plate of 60 x 40 mm with a slot, from its edge or closed, about (40, 20) or (25, 20)."""
    low, high = 20 - width / 2, 20 + width / 2
    if through:
        loop = [(0, 0), (60, 0), (60, low), (20, low), (20, high), (60, high), (60, 40), (0, 40)]
        return Part("plate", Outline(Loop.polygon(loop)), 3, material)
    slot = Loop.polygon([(10, low), (40, low), (40, high), (10, high)]).reversed()
    return Part("plate", Outline(Loop.polygon([(0, 0), (60, 0), (60, 40), (0, 40)]), (slot,)), 3, material)


@pytest.mark.parametrize("through", [True, False])
@pytest.mark.parametrize(
    ("process", "material", "width", "said"),
    [
        ("co2-laser", "acrylic", 0.15, "set cut.kerf = 0.149 if a test cut shows that"),
        ("co2-laser", "plywood", 0.18, 'set cut.laser = "diode"'),
        ("waterjet", "steel", 0.5, 'set process = "wire"'),
        ("waterjet", "acrylic", 0.5, 'set process = "laser", with cut.laser co2'),
    ],
)
def test_a_kerf_that_is_wider_than_a_slot_names_what_goes_in(process, material, width, said, through):
    """The place is one of the part; a kerf of what is named goes into the slot."""
    part = slotted(width, material, through=through)
    kerf = kerf_of(process, material, 3).width
    (told,) = of("cut.path", findings(part, process, kerf))
    assert told.severity is Severity.ERROR
    assert f"the kerf of {kerf:g} mm is wider than the slot at (" in told.message
    x, y = (float(word) for word in told.message.rpartition("(")[2].rstrip(")").split(", "))
    assert 10 <= x <= 60
    assert abs(y - 20) <= width / 2
    assert said in told.remedy
    assert f"draw it {kerf + 0.001:g} mm wide" in told.remedy
    own = float(told.remedy.partition("cut.kerf = ")[2].split()[0])
    assert own == pytest.approx(width, abs=2e-3)
    assert not of("cut.path", findings(part, process, own))
    assert not of("cut.path", findings(slotted(kerf + 0.001, material, through=through), process, kerf))
    assert not of("cut.corner", findings(part, process, kerf)), "the slot is no corner"


def test_a_slot_for_a_wire_has_room_for_its_widest_pass_and_for_a_start_hole():
    part = slotted(0.38, "steel")
    assert not of("cut.path", findings(part, "wire", 0.355))
    (told,) = of("cut.path", findings(part, "wire", 0.355, passes=3))
    assert "0.455 mm, which the wire takes with D1, is wider than the slot" in told.message
    own = float(told.remedy.partition("cut.kerf = ")[2].split()[0])
    assert not of("cut.path", findings(part, "wire", own, passes=3))
    given = of("cut.path", findings(part, "wire", 0.355, passes=1, offsets=[0.2]))
    assert "cut.kerf" not in given[0].remedy, "offsets that are given do not follow it"


@pytest.mark.parametrize(
    ("width", "remedy"), [(2.1, ""), (1.85, "set cut.start_hole = 0.8"), (0.9, "draw it 1.3 mm wide")]
)
def test_an_opening_without_room_for_a_start_hole_is_told_before_it_is_threaded(width, remedy):
    found = of("cut.start-hole", findings(slotted(width, "steel", through=False), "wire", 0.3))
    assert [remedy in one.remedy for one in found] == ([True] if remedy else [])
    if "start_hole" in remedy:
        change = found[0].proposed[0]["cut.start_hole"]
        part = slotted(width, "steel", through=False)
        assert not of("cut.start-hole", findings(part, "wire", 0.3, start_hole=change))


def test_a_slot_is_told_of_a_process_that_is_not_chosen(tmp_path):
    """Its own kerf counts, and not the one that the file gives for the chosen process."""
    text = GENEVA.read_text(encoding="utf-8")
    file = tmp_path / "g.toml"
    file.write_text('process = "wire"\n' + text + "\n[cut]\nkerf = 0.1\n", encoding="utf-8")
    with Build(file, host()) as build:
        cutting, part = Cutting(build), next(one for one in build.parts if one.name == "wheel")
        kinds = processes()
        assert cutting.kerf(kinds["wire"], part).width == 0.1
        assert cutting.kerf(kinds["waterjet"], part, chosen=False) == kerf_of(
            "waterjet", part.material, part.thickness
        )


@pytest.mark.parametrize(
    ("process", "more", "why"),
    [
        ("wire", {}, "the control moves the wire aside for one part"),
        ("plasma", {}, "its cut is square on one side alone"),
        ("service", {}, "each drawing has one part"),
        ("laser", {"joints": 2}, "2 micro-joints"),
    ],
)
def test_common_lines_that_make_no_sense_are_refused_by_name(tmp_path, process, more, why):
    head = f'process = "{process}"\n'
    keys = "".join(f"{key} = {value}\n" for key, value in more.items())
    text = GENEVA.read_text(encoding="utf-8").replace('material = "aluminium"', 'material = "steel"')
    for common, told in (("true", 1), ("false", 0)):
        file = tmp_path / f"g{told}.toml"
        file.write_text(
            f"{head}{text}\n[cut]\n{keys}common_lines = {common}\nlaser = 'fibre'\n", encoding="utf-8"
        )
        with Build(file, host()) as build:
            found = of("cut.common-lines", Cutting(build).findings)
        assert len(found) == told
        assert all(why in one.message and "cut.common_lines = false" in one.remedy for one in found)


def test_common_lines_that_no_parts_share_are_a_warning(tmp_path):
    file = tmp_path / "g.toml"
    text = GENEVA.read_text(encoding="utf-8")
    file.write_text(
        f'process = "waterjet"\n{text}\n[cut]\ncommon_lines = true\nsmall_holes = "spot"\n', encoding="utf-8"
    )
    with Build(file, host()) as build:
        (told,) = of("cut.common-lines", Cutting(build).findings)
    assert told.severity is Severity.WARNING


@pytest.mark.parametrize(("off", "told"), [(2.2, True), (2.0, True), (1.0, False)])
def test_thin_webs_are_told(off, told):
    """3 mm of acrylic want 2.1 mm between a hole and the rim."""
    part = plate("p", bore(4, (0, 8 - 2 - 2.1 + off - 1.5)))
    assert bool(of("cut.web", findings(part))) is told


def test_inside_corners_keep_the_radius_of_the_beam():
    sharp = Loop.polygon([(-6, -4), (-6, 4), (6, 4), (6, -4)])
    part = Part("p", Outline(rounded_box(30, 20, 3), (sharp,)), 3, "steel")
    (told,) = of("cut.corner", findings(part, "waterjet", 0.88))
    # R (√2 - 1) stays in a right angle.
    assert told.value == pytest.approx(0.5 * (2**0.5 - 1), abs=0.01)
    assert not of("cut.corner", findings(part, "fibre-laser", 0.2))


def fitted(name="P7", material="steel"):
    fit = hole_fit(8, name)
    hole = Bore("seat", (0.0, 0.0), fit.middle, 0, 3.0, fit)
    loop = bore(fit.middle)
    outside = Profile("outside", rounded_box(24, 16, 3), "outside", 0, 3.0)
    return plate("p", loop, material=material, machined=(hole, outside))


def test_a_fit_that_no_kerf_holds_is_reamed_bushed_or_refused():
    part = fitted("H7")
    (note,) = of("cut.fit", findings(part, "fibre-laser"))
    assert note.severity is Severity.NOTE
    cut = cut_part(part, processes()["fibre-laser"], PLAIN)
    assert 2 * cut.outline.inner[0].segments[0].radius == pytest.approx(8.0075 - 0.5, abs=1e-3)
    assert cut.finishing[-1:] == ("ream to 8 H7 (0/+0.015): seat at (0, 0)",)
    bushed = cut_part(part, processes()["fibre-laser"], CutSettings(fits="bush"))
    assert 2 * bushed.outline.inner[0].segments[0].radius == pytest.approx(11.0)
    assert bushed.finishing[0].startswith("bond a bush of 11 x 8 H7")
    (told,) = of("cut.fit", findings(part, "fibre-laser", fits="refuse"))
    assert told.severity is Severity.ERROR
    assert told.proposed == ({"cut.fits": "ream"},)


def test_a_press_fit_in_plastic_is_refused_but_for_a_bush():
    assert of("cut.press-fit", findings(fitted("P7", "acrylic")))
    assert not of("cut.press-fit", findings(fitted("P7", "steel"), "fibre-laser"))
    assert not of("cut.press-fit", findings(fitted("P7", "acrylic"), fits="bush"))


def test_threads_and_chamfers_are_finished_afterwards():
    loop = rounded_box(24, 16, 3)
    part = plate(
        "p", bore(5), details=(Thread("t", (0, 0), 6.0, 1.0, 3.0), Chamfer("rim", loop, "outside", 0.3))
    )
    said = cut_part(part, processes()["co2-laser"], PLAIN).finishing
    assert said == ("tap M6x1 at (0, 0)", "break the edge rim: 0.3 mm x 45°")


# -- the table -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"power": 20, "engrave_power": 30}, "a mark would go through: set engrave_power = 5"),
        ({"passes": 2, "offsets": [0.2]}, "offsets has 1 values for 2 passes"),
        ({"passes": 2, "offsets": [0.1, 0.2]}, "sort them downwards"),
        ({"kerff": 0.2}, "kerf"),
        ({"laser": "yag"}, "laser"),
    ],
)
def test_a_table_that_is_wrong_says_where(table, said):
    with pytest.raises(DesignError, match=said):
        CutTable().read(table, Path("design.toml"))


def build_of(tmp_path, process, table="", **parameters):
    text = GENEVA.read_text(encoding="utf-8")
    for key, value in parameters.items():
        text = "\n".join(
            f"{key} = {value}" if line.startswith(f"{key} =") else line for line in text.splitlines()
        )
    file = tmp_path / "geneva.toml"
    file.write_text(f'process = "{process}"\n{text}\n\n[cut]\n{table}\n', encoding="utf-8")
    return Build(file, host())


def test_aluminium_is_not_cut_by_a_co2_laser_and_the_line_to_type_says_what_does(tmp_path):
    with build_of(tmp_path, "laser") as build:
        told = errors(ChosenProcesses().findings(build))
        assert len(told) == 3
        assert "bare metal reflects the beam" in told[0].message
        assert told[0].remedy.startswith(
            'process = { default = "laser", parts.wheel = "mill" }, or "print" or '
        )
        assert not build.made(Cutting).programs


@pytest.mark.parametrize(
    ("process", "table", "code"),
    [
        ("waterjet", "joints = 2", "cut.joints"),
        ("waterjet", 'control = "grbl-laser"', "cut.control"),
        ("waterjet", "sheet = { length = 100, width = 100 }", "cut.sheet"),
        ("waterjet", "kerf = 9.0", "cut.path"),
        ("wire", "start_hole = 9.0", "cut.start-hole"),
    ],
)
def test_settings_that_do_not_go_are_findings(tmp_path, process, table, code):
    with build_of(tmp_path, process, table + '\nsmall_holes = "spot"') as build:
        assert code in {one.code for one in errors(build.made(Cutting).findings)}


@pytest.mark.parametrize("process", ["waterjet", "wire"])
def test_the_geneva_is_cut_and_proven(tmp_path, process):
    said = "passes = 2" if process == "wire" else 'small_holes = "spot"'
    with build_of(tmp_path, process, said) as build:
        cutting = build.made(Cutting)
        assert not errors(cutting.findings)
        assert [len(one.job.pieces) for one in cutting.programs] == [1, 1, 1]
        assert all(one.proof.ok for one in cutting.programs)


def test_a_wheel_and_a_plate_share_a_sheet_without_touching():
    job = sheet_of(toothed(), plate())
    one, two = (piece.outline.polygon() for piece in job.pieces)
    assert one.distance(two) > 2

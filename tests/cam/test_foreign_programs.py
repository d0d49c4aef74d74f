"""Programs of other people, proven against a drawing of the part, or against a design."""

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from foreign import LONG, THICK, coupler_drawing, coupler_program, freecad_gear

from mechwright.errors import DesignError
from mechwright_cam.commands.drawing import read_drawing
from mechwright_cam.commands.verify_drawing import job_of
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of

ROOT = Path(__file__).parents[2]

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PLATE = ("--thickness", "6", "--stock", "20", "--tools", "1=mill-6,2=drill-5", "--control", "linuxcnc")


@pytest.fixture
def drawing(tmp_path: Path) -> Path:
    return coupler_drawing(tmp_path / "coupler.dxf")


def verified(run, tmp_path: Path, drawing: Path, text: str, *more: str):  # type: ignore[no-untyped-def]
    program = tmp_path / "program.ngc"
    program.write_text(text)
    return run("verify", program, "--dxf", drawing, *PLATE, *more)


@pytest.mark.parametrize("hold", ["vacuum", "tape", "tabs"])
def test_a_coupler_of_another_program_is_proven(
    command_line, tmp_path: Path, drawing: Path, hold: str
) -> None:  # type: ignore[no-untyped-def]
    text = coupler_program(hold="tabs" if hold == "tabs" else "vacuum")
    code, out, err = verified(command_line, tmp_path, drawing, text, "--hold", hold)
    assert (code, err) == (0, ""), err
    assert out.endswith("program.ngc: proven\n")
    if hold == "tabs":
        assert "pass [tabs] 4 tabs are found, and strong enough" in out


def test_the_same_without_tabs_needs_something_that_holds(
    command_line, tmp_path: Path, drawing: Path
) -> None:  # type: ignore[no-untyped-def]
    code, _, err = verified(command_line, tmp_path, drawing, coupler_program())
    assert code == 1
    assert "FAIL [holding] line" in err
    assert "the part comes loose: nothing holds it when this is cut; leave tabs" in err
    assert err.count("FAIL") == 2  # and that there are no tabs


def test_coarse_chords_are_stock_left(command_line, tmp_path: Path, drawing: Path) -> None:  # type: ignore[no-untyped-def]
    code, _, err = verified(command_line, tmp_path, drawing, coupler_program(chord=0.02), "--hold", "vacuum")
    assert code == 1
    assert "FAIL [leftover] 0.0" in err
    assert err.count("FAIL") == 1


def test_a_gear_as_freecad_posts_it_is_refused_for_its_six_reasons(command_line, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    design, program = ROOT / "examples" / "elliptic-pair.toml", tmp_path / "gear.ngc"
    rim = np.array(
        outline_of(EllipticGearParams(**tomllib.loads(design.read_text())["parameters"])).outer.flatten()
    )

    def said(text: str) -> dict[str, str]:
        program.write_text(text)
        code, _, err = command_line("verify", program, "--design", design, "--part", "gear")
        assert code == 1
        return {line.split("[")[1].split("]")[0]: line.split("] ")[1] for line in err.splitlines()}

    text = freecad_gear(rim)
    lines = text.splitlines()
    first_move, change = (
        next(k for k, line in enumerate(lines, 1) if line.startswith(w)) for w in ("G0", "M6")
    )
    profile = lines.index("(Profile)") + 1
    found = said(text)
    assert found.keys() == {"positions", "path-tolerance", "tool-change", "gouge", "tabs", "leftover"}
    assert found["positions"].startswith(
        f"line {first_move}: moves from an unknown height or place; first retract"
    )
    assert found["path-tolerance"].startswith(
        f"line {first_move}: nothing bounds how far LinuxCNC leaves the path"
    )
    assert found["tool-change"].startswith(f"line {change}: a tool is changed without a retract")
    for rule, what in (
        ("gouge", r"cuts 0\.03\d mm into the finished part"),
        ("tabs", r"cuts 1\.400 mm into a tab"),
    ):
        blamed = re.match(rf"line (\d+): {what}", found[rule])
        assert blamed, found[rule]
        assert int(blamed[1]) > profile
    assert re.match(
        r"0\.0[23]\d mm of stock stay where a cutter of the program could go, .* at X", found["leftover"]
    )

    # Each of them is what it says: without it, the part is still cut free where tabs should hold it.
    mended = freecad_gear(rim, 0.003).replace("G17 G54 G40", "G61\nG17 G54 G40", 1)
    mended = mended.replace("M6 ", "G53 G0 Z0\nM6 ")
    assert said(mended).keys() == {"tabs"}


def test_the_report_is_json_and_a_page(command_line, tmp_path: Path, drawing: Path) -> None:  # type: ignore[no-untyped-def]
    page = tmp_path / "report.html"
    code, out, _ = verified(
        command_line, tmp_path, drawing, coupler_program(), "--hold", "tape", "--json", "--page", str(page)
    )
    report = json.loads(out)
    assert code == 0
    assert report["ok"]
    assert report["part"] == "coupler"
    text = page.read_text()
    assert "proven" in text
    assert "<svg" in text
    assert text.count('class="pass"') == len(report["checks"])
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    job = tmp_path / "job.html"
    more = ("--page", str(page), "--job", str(job))
    code, _, _ = verified(command_line, tmp_path, drawing, coupler_program(), *more)
    assert code == 1
    assert "does not cut the part" in job.read_text()
    assert '"kind":"failed"' in job.read_text()
    assert "does not cut the part" in page.read_text()
    assert "the part comes loose" in page.read_text()


@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
@pytest.mark.parametrize("width", [1200, 500])
def test_the_page_is_not_wider_than_the_window(
    command_line, tmp_path: Path, drawing: Path, width: int
) -> None:  # type: ignore[no-untyped-def]
    page = tmp_path / "report.html"
    verified(command_line, tmp_path, drawing, coupler_program(), "--page", str(page))
    probe = "<script>document.title = document.documentElement.scrollWidth + ' of ' + innerWidth</script>"
    page.write_text(page.read_text().replace("</body>", probe + "</body>"))
    assert CHROMIUM is not None
    flags = ("--headless", "--no-sandbox", "--disable-gpu", f"--window-size={width},900", "--dump-dom")
    shown = subprocess.run(
        [CHROMIUM, *flags, page.as_uri()], capture_output=True, text=True, check=True
    ).stdout
    wide, window = shown.split("<title>")[1].split("</title>")[0].split(" of ")
    assert int(wide) <= int(window)


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (("--tools", "1=mill-6,2"), "--tools: '2' is no tool; write T number and name, as in 1=mill-6"),
        (("--tools", "1=mill-6,1=drill-5"), "--tools: T1 is named twice"),
        (("--tools", "1=mill-66"), "--tools: no tool 'mill-66' in the library"),
        (("--material", "cheese"), "--material: 'cheese' is not known; one of: "),
        (
            ("--hold", "magnet"),
            "--hold: 'magnet' is not known; one of: tabs, bore, vacuum, tape, vice, clamps",
        ),
        (("--stock", "big"), "--stock: 'big' is no plate"),
        (("--thickness", "0"), "--thickness: 0 mm is no plate"),
        (("--control", "siemens"), "--control: 'siemens' is not known; one of: "),
        (("--layers", "CUT"), "--layers: there is no layer 'CUT'; it has: 0"),
        (("--units", "ell"), "--units: 'ell' is not known; one of: mm, cm, inch"),
        (("--set", "hold"), "--set: 'hold' is no setting; write KEY=VALUE"),
        (("--set", "clearence=3"), "clearence"),
        (("--set", "clearance=300"), "cam.clearance"),
        (("--set", "tools=mill-6"), "--set: tools: say the cutters with --tools"),
        (("--set", "tool_library=own.toml"), "--set: tool_library: say it with --library"),
        (("--set", "part.coupler.tools=mill-6"), "--set: tools: say the cutters with --tools"),
        (("--set", "part.rod.deburr=1"), "--set: cam.part.rod.deburr: no plate part has this name"),
        (("--set", "cutting.mill-66.chip_load=1"), "--set: cutting: no tool 'mill-66' in the library"),
        (("--set", "measured.lengths.mill-66=7"), "--set: measured.lengths: no tool 'mill-66'"),
        (("--set", "machine=vf-9"), "--set: cam.machine.model: unknown machine 'vf-9'; known: "),
        (("--library", "none.toml"), "none.toml: cannot be read: No such file or directory"),
        (("--library", "."), ".: cannot be read: it is a folder; name a regular file"),
    ],
)
def test_what_is_asked_wrongly_is_one_line(command_line, tmp_path, drawing, more, said) -> None:  # type: ignore[no-untyped-def]
    code, out, err = verified(command_line, tmp_path, drawing, coupler_program(), *more)
    assert (code, out, err.count("\n")) == (2, "", 1), err
    assert said in err


MINE = """[[tool]]
name = "mine"
number = 77
kind = "end-mill"
diameter = {diameter}
flutes = 3
flute_length = 20
[tool.cutting.aluminium]
cutting_speed = 150
chip_load = 0.025
"""


def test_cutters_of_a_library_of_ones_own(command_line, tmp_path: Path, drawing: Path) -> None:  # type: ignore[no-untyped-def]
    own, program = tmp_path / "own.toml", tmp_path / "program.ngc"
    program.write_text(coupler_program(mill=6.3))
    more = ("--tools", "1=mine,2=drill-5", "--library", own, "--hold", "tape")
    own.write_text(MINE.format(diameter=6.3))
    asked = ("verify", program, "--dxf", drawing, *PLATE, *more)
    code, _, err = command_line(*asked)
    assert (code, err) == (0, ""), err
    # The same program with a wider cutter of that name cuts into the part, by as much as it is wider.
    own.write_text(MINE.format(diameter=6.4))
    code, _, err = command_line(*asked)
    assert code == 1
    assert "FAIL [gouge]" in err
    assert "0.049 mm" in err or "0.050 mm" in err, err
    # What is said of it with --set counts as in a design file.
    own.write_text(MINE.format(diameter=6.3))
    code, _, err = command_line(*asked, "--set", "cutting.mine.chip_load=0.004")
    assert code == 1
    assert "FAIL [chips]" in err
    own.write_text(MINE.format(diameter=-1))
    code, _, err = command_line(*asked)
    assert (code, err.count("\n")) == (2, 1)
    assert "own.toml: tool 'mine'.diameter" in err


def test_what_is_set_counts_as_in_a_design_file(drawing: Path) -> None:
    asked = {"control": "", "material": "", "hold": "", "stock": "", "units": "", "layers": ()}
    changes = ("machine=haas-vf-2", "deburr=0.4", "part.coupler.holes.bore-1.thread=M6")
    job = job_of(drawing, 6.0, "1=mill-2", library=None, **asked, changes=changes)
    assert job.settings.machine.travel_x == 762
    assert sorted(type(detail).__name__ for detail in job.part.details) == [*3 * ["Chamfer"], "Thread"]


def test_it_has_to_be_said_what_is_cut(command_line, tmp_path: Path, drawing: Path) -> None:  # type: ignore[no-untyped-def]
    program = tmp_path / "p.ngc"
    program.write_text("M2\n")
    for more in ((), ("--dxf", drawing, "--design", drawing)):
        code, _, err = command_line("verify", program, *more)
        assert code == 2
        assert "say what the program cuts: --design and --part, or --dxf" in err
    code, _, err = command_line("verify", program, "--design", drawing)
    assert "--part: name the part of the design" in err


@pytest.mark.parametrize(
    "more",
    [
        ("--thickness", "6"),
        ("--tools", "1=mill-6"),
        ("--library", "own.toml"),
        ("--material", "steel"),
        ("--hold", "tabs"),
        ("--stock", "20"),
        ("--units", "mm"),
        ("--layers", "CUT"),
        ("--set", "hold.tabs=3"),
    ],
    ids=lambda more: more[0],
)
def test_what_a_design_says_is_not_said_again(command_line, tmp_path: Path, drawing: Path, more) -> None:  # type: ignore[no-untyped-def]
    program = tmp_path / "p.ngc"
    program.write_text("M2\n")
    code, _, err = command_line("verify", program, "--design", "d.toml", "--part", "gear", *more)
    assert code == 2
    assert f"{more[0]}: only with --dxf" in err
    code, _, err = verified(command_line, tmp_path, drawing, "M2\n", "--part", "gear")
    assert code == 2
    assert "--part: only with --design" in err


def test_a_thin_drawing_asks_for_tabs_that_it_has_room_for(drawing: Path) -> None:
    asked = {"control": "", "material": "", "hold": "", "stock": "", "units": "", "layers": ()}
    thin = job_of(drawing, 1.0, "1=mill-2", library=None, **asked, changes=()).settings.hold
    assert (thin.method, thin.tab_height) == ("tabs", 0.5)
    assert job_of(drawing, 6.0, "1=mill-2", library=None, **asked, changes=()).settings.hold.tab_height == 1.0
    said = job_of(drawing, 1.0, "1=mill-2", library=None, **asked, changes=("hold.tab_height=0.8",))
    assert said.settings.hold.tab_height == 0.8


# -- drawings ------------------------------------------------------------------------------------------------


def drawn(tmp_path: Path, draw, units: int = 4) -> Path:  # type: ignore[no-untyped-def]
    document = ezdxf.new("R2010", units=units)
    draw(document.modelspace())
    document.saveas(tmp_path / "part.dxf")
    return tmp_path / "part.dxf"


def square(space, x: float = 0, size: float = 20) -> None:  # type: ignore[no-untyped-def]
    space.add_lwpolyline([(x, 0), (x + size, 0), (x + size, size), (x, size)], close=True)


@pytest.mark.parametrize(("unit", "scale"), [(1, 25.4), (4, 1.0), (5, 10.0), (6, 1000.0)])
def test_units_of_a_drawing_are_taken_as_it_says(tmp_path: Path, unit: int, scale: float) -> None:
    part = read_drawing(coupler_drawing(tmp_path / "c.dxf", unit=unit, scale=scale), THICK, "steel")
    assert part.outline is not None
    assert part.outline.bounds == pytest.approx((-10, -10, LONG + 10, 10), abs=1e-6)
    assert sorted(f.name for f in part.features) == ["bore-1", "bore-2", "outside"]


def test_a_drawing_without_units_has_to_be_told_them(tmp_path: Path) -> None:
    path = drawn(tmp_path, square, units=0)
    with pytest.raises(
        DesignError, match=r"says no unit that a mill knows .* say it with --units: mm, cm, inch"
    ):
        read_drawing(path, THICK, "steel")
    found = read_drawing(path, THICK, "steel", "inch").outline
    assert found is not None
    assert found.bounds == pytest.approx((0, 0, 508, 508))


def test_polylines_with_bulges_splines_ellipses_and_blocks(tmp_path: Path) -> None:
    def draw(space) -> None:  # type: ignore[no-untyped-def]
        space.add_lwpolyline([(0, 0, 0), (40, 0, 1), (40, 20, 0), (0, 20, 1)], format="xyb", close=True)
        space.add_ellipse((10, 10), (4, 0), 0.5)
        space.add_spline(fit_points=[(30, 6), (36, 10), (30, 14), (26, 10), (30, 6)])
        block = space.doc.blocks.new("HOLE")
        block.add_circle((0, 0), 2)
        space.add_blockref("HOLE", (20, 10))
        space.add_line((-50, 10), (90, 10), dxfattribs={"linetype": "CENTER"})
        space.doc.linetypes.add("CENTER", [2.5, 1.25, -0.5, 0.25, -0.5])
        space.add_mtext("part 7")

    part = read_drawing(drawn(tmp_path, draw), THICK, "steel")
    assert part.outline is not None
    assert part.outline.bounds == pytest.approx((-10, 0, 50, 20), abs=1e-6)
    assert len(part.outline.inner) == 3
    areas = sorted(-loop.area for loop in part.outline.inner)
    assert areas[0] == pytest.approx(12.566, abs=1e-3)
    assert areas[1] == pytest.approx(25.133, abs=2e-2)


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (
            lambda space: space.add_line((0, 0), (5, 0)),
            "the contour is open at X5.000 Y0.000, where LINE",
        ),
        (lambda space: (square(space), square(space, 30)), "lies beside the outline; draw one plate"),
        (lambda space: (square(space), space.add_circle((20, 10), 5)), "crosses the outline at X20.000 Y"),
        (
            lambda space: (square(space), space.add_circle((10, 10), 6), space.add_circle((10, 10), 3)),
            "the circles of CIRCLE .* are of two holes about one axis",
        ),
        (
            lambda space: space.add_lwpolyline([(0, 0), (20, 20), (20, 0), (0, 20)], close=True),
            "crosses itself at X10.000 Y10.000; draw it as one simple loop",
        ),
        (lambda space: space.add_text("nothing"), "the drawing shows no curve"),
        (
            lambda space: [
                space.add_line(a, b) for a, b in (((0, 0), (9, 0)), ((9, 0), (9, 9)), ((9, 0), (0, 9)))
            ],
            "3 curves meet at X9.000 Y0.000",
        ),
    ],
)
def test_what_is_no_single_part_is_refused_with_its_place(tmp_path: Path, draw, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(DesignError, match=said):
        read_drawing(drawn(tmp_path, draw), THICK, "steel")


@pytest.mark.parametrize(
    "data", [b"", b"hello", b"  0\nSECTION\n", b"\x00\xff" * 500, b"AutoCAD Binary DXF\r\n\x1a\x00"]
)
def test_no_drawing_is_one_line(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "x.dxf"
    path.write_bytes(data)
    with pytest.raises(DesignError) as error:
        read_drawing(path, THICK, "steel")
    assert "\n" not in str(error.value)


def test_holes_are_drilled_from_one_r_plane_to_the_next(command_line, tmp_path: Path, drawing: Path) -> None:  # type: ignore[no-untyped-def]
    """G99 on a bare plate; where clamps on its edge are not named, or a plane is asked for, it is too low."""
    text = coupler_program().replace("G98 G83", "G99 G83")
    assert text.count("G99") == 1
    code, _, err = verified(command_line, tmp_path, drawing, text, "--hold", "vacuum")
    assert (code, err) == (0, ""), err
    low = text.replace("R2.", "R0.1")
    code, _, err = verified(command_line, tmp_path, drawing, low, "--hold", "vacuum")
    assert "a sideways rapid over the stock at Z0.1, the least is Z0.2; go up first" in err
    code, _, err = verified(command_line, tmp_path, drawing, text, "--hold", "vacuum", "--set", "clearance=5")
    assert (
        "the clearance plane is Z5; go up first, or set cam.clearance if nothing stands higher there" in err
    )
    code, _, err = verified(command_line, tmp_path, drawing, text)
    assert "[rapid-height]" in err

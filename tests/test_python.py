"""Mechwright from Python: what scripts and notebooks ask for, and what they are told."""

import doctest
import html
import importlib.util
import json
import re
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import mechwright as mw
from mechwright.extras import install_line, optional

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "elliptic-pair.toml"


@pytest.fixture(scope="module")
def pair():
    return mw.design("elliptic-gears", eccentricity=0.4, teeth=25)


def test_the_page_on_python_says_what_happens():
    page = ROOT / "docs" / "python.md"
    text = page.read_text(encoding="utf-8")
    if importlib.util.find_spec("pyarrow") is None:
        text, _, rest = text.partition("## Many designs of a family")
        text += "".join(rest.partition("\n## ")[1:])
    shown = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    done = doctest.DocTestRunner().run(shown)
    assert done.attempted > 10
    assert done.failed == 0


def test_the_lines_of_the_readme_run(capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    (block,) = re.findall(r"^```python\n(.*?)^```$", (ROOT / "README.md").read_text(), re.M | re.S)
    assert len(block[block.index("pair =") :].splitlines()) <= 5
    exec(compile(block, "README.md", "exec"), {})  # noqa: S102 - our own page
    *sweep, proof = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in sweep] == ["0.1", "0.2", "0.3", "0.4", "0.5", "0.6"]
    assert re.fullmatch(r"<Proof of gear: proven, \d+ checks, [\d.]+ min>", proof)


def test_every_name_of_a_mechanism_in_the_page_is_there(pair):
    page = (ROOT / "docs" / "python.md").read_text()
    table = page[page.index("## Members of a mechanism") : page.index("An error is one line")]
    names = set(re.findall(r"`\.(\w+)", table)) - {"text", "files", "proof"}
    assert {"findings", "motion", "parts", "with_", "write", "page"} <= names
    owners = (type(pair), mw.Part, mw.Named, mw.Findings)
    assert [name for name in sorted(names) if not any(hasattr(owner, name) for owner in owners)] == []


def test_importing_the_package_brings_in_nothing_but_itself():
    code = "import sys; import mechwright; print(*{name.partition('.')[0] for name in sys.modules})"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    assert not {"numpy", "pydantic", "typer", "pluggy", "pandas", "plotly", "cadquery"} & set(loaded)


def test_a_design_from_a_file_and_from_keywords_are_the_same(tmp_path, pair):
    path = pair.save(tmp_path / "elliptic-gears.toml")
    opened = mw.load(str(path))
    assert opened.design.params == pair.design.params
    assert opened.design.tables == pair.design.tables
    manifests = [
        json.loads(
            (
                one.asked(command="solve", samples=9).write(tmp_path / name).folder / "manifest.json"
            ).read_text()
        )
        for one, name in ((opened, "opened"), (pair, "made"))
    ]
    assert manifests[0] == manifests[1]
    with pytest.raises(mw.OutputError, match="is there already"):
        pair.save(path)


def test_another_parameter_is_another_mechanism_and_leaves_the_first_alone(pair):
    other = pair.with_(eccentricity=np.float64(0.3), teeth=np.int64(27), cam={"control": "haas"})
    assert (other.design.params.eccentricity, other.design.params.teeth) == (0.3, 27)
    assert other.programs  # planned for the other control
    assert other.design.tables["cam"] != pair.design.tables["cam"]
    assert (pair.design.params.eccentricity, pair.design.params.teeth) == (0.4, 25)
    assert mw.load(EXAMPLE).with_(eccentricity=0.3).design.params.speed == 60


def test_the_sweep_of_the_page_takes_less_than_two_seconds(pair):
    mw.design("elliptic-gears", eccentricity=0.25).motion  # noqa: B018 - imports do not count
    start = time.process_time()
    peaks = [
        mw.design("elliptic-gears", teeth=25, eccentricity=e).motion.scalars["alpha4_max"].value
        for e in np.linspace(0.1, 0.6, 6)
    ]
    assert time.process_time() - start < 2
    assert peaks == sorted(peaks)
    # Of the ratio's closed form: at e = 0.4 it runs up to 7/3.
    assert pair.motion.scalars["ratio_max"].value == pytest.approx((1 + 0.4) / (1 - 0.4))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: mw.load("nowhere.toml"), "nowhere.toml: cannot be read"),
        (lambda: mw.design("eliptic-gears"), "family 'eliptic-gears' is not installed; known: cam-follower, elliptic-gears"),
        (lambda: mw.design("elliptic-gears", eccentricity=1.5), "parameters.eccentricity: 1.5 should be"),
        (lambda: mw.design("elliptic-gears", name="a/b"), "'a/b' cannot be a file name"),
        (lambda: mw.design("elliptic-gears").with_(cam={"contrl": 1}), "unknown key 'contrl'; did you mean 'control'"),
        (lambda: mw.design("elliptic-gears").parts["geer"], "nothing is named 'geer'; did you mean 'gear'?"),
        (lambda: mw.design("elliptic-gears").motion["omega"], "has no channel 'omega'; it has time, theta2"),
        (lambda: mw.design("elliptic-gears").result("sheets"), "'sheets' of a mechanism is not installed; known: assembly"),
        (lambda: mw.synthesize("elliptic-gear", "stroke"), "family 'elliptic-gear' is not installed"),
        (lambda: mw.synthesize("four-bar", "paths"), "unknown kind 'paths'; did you mean 'path'?"),
        (lambda: mw.synthesize("nowhere.toml"), "nowhere.toml: cannot be read"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_one_line(wrong, said):
    with pytest.raises(mw.MechwrightError) as caught:
        wrong()
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_programs_are_refused_as_the_command_refuses_them(pair):
    with pytest.raises(mw.RefusedError) as caught:
        pair.with_(teeth=13).programs  # noqa: B018 - it raises
    assert {finding.code for finding in caught.value.findings} == {"gear.undercut"}
    assert caught.value.findings == pair.with_(teeth=13).findings.errors


def test_programs_are_those_of_the_command(command_line, tmp_path):
    built = mw.load(EXAMPLE)
    program = built.programs["gear"]
    assert program.proof.ok
    assert program is built.programs[0], "made once"
    code, _, err = command_line("cam", EXAMPLE, "-o", tmp_path / "out")
    assert code == 0, err
    assert (tmp_path / "out" / "gear.nc").read_text() == program.text
    assert json.loads((tmp_path / "out" / "proof.json").read_text())["gear"]["ok"] is True


def test_a_script_writes_what_the_command_writes(command_line, tmp_path):
    told = []
    built = mw.load(EXAMPLE).asked(command="solve", samples=91)
    written = built.write(tmp_path / "one", lambda done, what: told.append((done, what)))
    assert command_line("solve", EXAMPLE, "-o", tmp_path / "two", "--samples", 91)[0] == 0
    for name in (*written.files, "manifest.json"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes(), name
    parts = [done for done, _ in told]
    assert parts == sorted(parts)
    assert 0 == parts[0] < parts[-1] < 1


def test_solids_and_assemblies_are_those_of_cadquery(pair):
    import cadquery as cq

    solid = pair.parts["gear"].solid
    assert type(solid) is cq.Solid
    assert solid.Volume() == pytest.approx(pair.parts[0].outline.area * 10)
    assert isinstance(pair.assembly, cq.Assembly)
    assert len(pair.assembly.children) == 2
    assert pair.assembly is pair.assembly


def test_the_script_for_viewers_runs_with_its_parameters():
    from cadquery import Assembly, cqgi

    with warnings.catch_warnings():  # it asks for kinds of constants that newer Pythons warn of
        warnings.simplefilter("ignore", DeprecationWarning)
        model = cqgi.parse((ROOT / "examples" / "cqgi" / "elliptic_pair.py").read_text())
    assert set(model.metadata.parameters) == {"eccentricity", "teeth", "thickness", "crank_angle"}
    built = model.build({"eccentricity": 0.3, "crank_angle": 40.0})
    assert built.success, built.exception
    (shown,) = built.results
    assert isinstance(shown.shape, Assembly)
    assert shown.options["name"] == "elliptic pair"


def test_reprs_are_short(pair):
    part = pair.parts["gear"]
    program = pair.programs["gear"]
    spline = mw.BSpline(1, (0.0, 0.0, 1.0, 1.0), ((0.0, 0.0), (1.0, 0.0)))
    for one in (
        pair,
        part,
        part.outline,
        part.outline.outer,
        spline,
        pair.design,
        pair.findings[0],
        program,
        program.proof,
    ):
        assert len(repr(one)) < 200, repr(one)
        assert repr(one).startswith("<"), repr(one)
    assert "elliptic-gears" in repr(pair)
    assert "25" not in repr(part)


def test_a_mechanism_shows_itself_in_a_frame_of_its_own(pair):
    shown = pair._repr_html_()
    frame = re.fullmatch(
        r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts" title="([^"]*)" style="[^"]*"></iframe>(.*)',
        shown,
        re.S,
    )
    assert frame is not None
    assert html.unescape(frame[1]) == pair.page
    assert len(shown) < 1_000_000
    assert "gear.mesh" in frame[3]


def test_a_mechanism_that_does_not_move_shows_why():
    stuck = mw.design("four-bar", ground=1000.0)
    assert stuck.findings.errors
    shown = stuck._repr_html_()
    assert "iframe" not in shown
    assert stuck.findings.errors[0].code in shown
    with pytest.raises(mw.RefusedError):
        stuck.page  # noqa: B018 - it raises


def test_what_is_shown_is_escaped():
    shown = mw.Findings([mw.Finding.note("a.b", "<script>alert(1)</script>")])._repr_html_()
    assert "<script" not in shown
    assert "&lt;script&gt;" in shown


@pytest.mark.parametrize("family", ["elliptic-gears", "geneva", "slider-crank", "four-bar"])
def test_every_plate_has_a_picture(family):
    import xml.etree.ElementTree as ElementTree

    for part in mw.design(family).parts:
        if part.outline is not None:
            picture = ElementTree.fromstring(part.picture)  # noqa: S314 - our own
            x, y, width, height = map(float, picture.attrib["viewBox"].split())
            x0, y0, x1, y1 = part.outline.bounds
            assert x < x0 < x1 < x + width
            assert y < -y1 < -y0 < y + height
            assert part.name in picture.attrib["aria-label"]


def test_libraries_that_are_missing_are_named_with_their_extra(monkeypatch, pair):
    def missing(name):
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)

    monkeypatch.setattr("mechwright.extras.import_module", missing)
    for asked, library in ((pair.motion.to_dataframe, "pandas"), (pair.motion.plot, "plotly")):
        with pytest.raises(mw.PluginError, match=rf"^{library} is not installed") as caught:
            asked()
        assert str(caught.value).endswith(f"the extra data brings: {install_line('data')}")


def test_a_library_that_is_there_and_broken_says_so_itself(monkeypatch):
    def broken(name):
        raise ModuleNotFoundError("No module named 'pytz'", name="pytz")

    monkeypatch.setattr("mechwright.extras.import_module", broken)
    with pytest.raises(ModuleNotFoundError, match="pytz"):
        optional("pandas")


def test_tables_and_plots_have_the_units_in_their_names(pair):
    pytest.importorskip("pandas")
    pytest.importorskip("plotly")
    frame = pair.motion.to_dataframe()
    assert list(frame.columns) == list(pair.motion.arrays)
    assert frame["omega4 [rad/s]"].to_numpy() == pytest.approx(pair.motion["omega4"])
    figure = pair.motion.plot("omega4", "alpha4")
    assert [line.name for line in figure.data] == ["omega4 [rad/s]", "alpha4 [rad/s^2]"]
    with pytest.raises(mw.KinematicsError, match="no channel 'omega9'"):
        pair.motion.plot("omega9")


def test_a_synthesis_gives_mechanisms_best_first(tmp_path):
    found = mw.synthesize("slider-crank", "stroke", stroke=120, time_ratio=1.2, name="ram")
    assert len(found) == len(list(found)) == 1
    for one in found:
        assert one.motion.scalars["stroke"].value == pytest.approx(120)
        assert one.motion.scalars["time_ratio"].value == pytest.approx(1.2)
    files = found.write(tmp_path / "out")
    assert files == ("gallery.html", "ram-1.toml", "synthesis.json")
    assert mw.load(tmp_path / "out" / "ram-1.toml").design.params == found[0].design.params
    assert "ram-1" in found._repr_html_()


def test_a_requirement_that_cannot_be_met_is_refused(tmp_path):
    found = mw.synthesize("slider-crank", "stroke", stroke=120, time_ratio=1.2, crank=10)
    assert len(found) == 0
    with pytest.raises(mw.RefusedError):
        found.write(tmp_path / "out")
    assert not (tmp_path / "out").exists()

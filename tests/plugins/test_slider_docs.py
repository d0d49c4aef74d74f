"""The pages of the slider-crank say what the code does, and those of its seeds are up to date."""

import importlib.util
import re
import sys
import tomllib
from pathlib import Path

import pytest
from by_night import thinned
from family_page import assert_keys

from mechwright.testing.commands import run
from mechwright_slider_crank.__main__ import main
from mechwright_slider_crank.family import SliderCrankFamily

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "slider-crank.md").read_text(encoding="utf-8")


def test_every_finding_is_on_the_page_and_no_other():
    sources = (ROOT / "plugins" / "mechwright_slider_crank").rglob("*.py")
    code = "".join(path.read_text(encoding="utf-8") for path in sources)
    said = set(re.findall(r'"(slider-crank\.[a-z-]+)"', code))
    said |= {f"slider-crank.{name}-range" for name in ("crank", "rod", "offset")}
    assert len(said) > 15
    assert set(re.findall(r"`(slider-crank\.[a-z-]+)`", PAGE)) == said


def test_keys_of_the_page_are_those_of_the_family():
    assert_keys(PAGE, SliderCrankFamily.Params)


@pytest.mark.parametrize("name", ["offset_slider_crank", "acceleration_poles"])
def test_the_page_of_a_seed_is_up_to_date(name):
    path = ROOT / "docs" / "seeds" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    assert module.PAGE.read_text(encoding="utf-8") == module.page(), f"run: python docs/seeds/{name}.py"
    if name == "acceleration_poles":
        assert module.FURTHER.read_text(encoding="utf-8") == module.further(), (
            f"run: python docs/seeds/{name}.py"
        )


def test_pictures_of_the_poles_are_up_to_date_and_on_the_page():
    import pole_figures

    pages = ("acceleration-poles", "acceleration-poles-further")
    page = "".join((ROOT / "docs" / "seeds" / f"{one}.md").read_text(encoding="utf-8") for one in pages)
    for name, make in pole_figures.DRAWN.items():
        picture = (pole_figures.IMAGES / f"{name}.svg").read_text(encoding="utf-8")
        assert picture == make() + "\n", "run: python docs/seeds/acceleration_poles.py"
        assert f"../images/{name}.svg" in page, name


def test_the_locus_is_printed(capsys):
    assert main(["1", "3", "1/2", "coupler"]) == 0
    assert capsys.readouterr().out.startswith("rho^i x^j, degree 28, 14-fold circular points, 75 terms\n")
    assert main(["1", "3", "0.5", "--json"]) == 0
    assert '"axis": "Y"' in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [(["1", "1", "0"], "no curve"), (["1", "x", "0"], "no finite number"), (["0", "1", "0"], "above 0")],
)
def test_lengths_without_a_locus_are_one_line(arguments, words, capsys):
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    assert words in said.err


EXAMPLES = sorted((ROOT / "examples").glob("slider-crank-*.toml"))
EXAMPLES = [path for path in EXAMPLES if not path.stem.endswith("-study")]


@pytest.mark.parametrize(
    "path", thinned(2, [p for p in EXAMPLES if "requirement" not in p.name]), ids=lambda p: p.stem
)
def test_examples_are_machined_without_a_warning(path, tmp_path):
    done = run("cam", path, "-o", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert {"base.nc", "rail.nc", "crank.nc", "rod.nc", "slider.nc"} <= {
        p.name for p in (tmp_path / "out").iterdir()
    }


@pytest.mark.parametrize("path", [p for p in EXAMPLES if "requirement" in p.name], ids=lambda p: p.stem)
def test_requirements_lead_to_the_examples(path, tmp_path):
    done = run("synthesize", path, "-o", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    kind = tomllib.loads(path.read_text(encoding="utf-8"))["requirement"]["kind"]
    example = {"stroke": "quick-return", "poles": "two-poles"}[kind]
    wanted = tomllib.loads((ROOT / "examples" / f"slider-crank-{example}.toml").read_text(encoding="utf-8"))
    best = tomllib.loads((tmp_path / "out" / f"{example}-1.toml").read_text(encoding="utf-8"))
    for key in ("crank", "rod", "offset"):
        assert best["parameters"][key] == pytest.approx(wanted["parameters"][key], rel=1e-9)

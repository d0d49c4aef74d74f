"""``check --tolerances``, the table ``[tolerances]`` and the page of a build."""

import json
import math
import re
from pathlib import Path

import pytest
from by_night import thinned

from mechwright import Build, Design, Host, Tolerances, Wanted
from mechwright.contracts.family import Family
from mechwright.contracts.tolerance_settings import OwnTolerance, ToleranceSettings
from mechwright.designs.design import load
from mechwright.designs.text import template
from mechwright.pipeline.tolerances import TolerancePage, TolerancesTable
from mechwright.plugins.host import host

EXAMPLES = Path(__file__).parents[1] / "examples"
DESIGNS = sorted(
    path for path in EXAMPLES.glob("*.toml") if not path.stem.endswith(("-requirement", "-study"))
)
FOUR_BAR = 'format = 1\nfamily = "four-bar"\nname = "rocker"\n'


@pytest.fixture
def run(command_line):
    return command_line


def design(folder, text):
    path = folder / "d.toml"
    path.write_text(FOUR_BAR + text)
    return path


def test_the_table_as_text(run, tmp_path):
    settings = (
        "[tolerances]\nlimit_angle = 0.05\nlength = 0.02\n[tolerances.of.crank]\nlower = 0\nupper = 0.04\n"
    )
    code, said, err = run("check", design(tmp_path, settings), "--tolerances")
    assert (code, err) == (0, "")
    assert re.search(r"^follower angle, mrad$", said, re.M)
    assert re.search(r"first order worst case at phi = [\d.]+ deg: worst case -[\d.]+ to [\d.]+", said)
    assert re.search(r"^    crank +30 mm +0\.\.0\.04 +normal ", said, re.M)
    assert re.search(
        r"yield within 0\.8727 mrad: [\d.]+ % \([\d.]+ % to [\d.]+ % with 95 % confidence\)", said
    )
    assert ": can be built" in said.splitlines()[-1]


def test_the_table_as_json(run, tmp_path):
    settings = "[tolerances]\nat = ['1 rad']\nlimit_angle = '0.9 mrad'\nsamples = 5000\nseed = 7\n"
    code, said, _ = run("check", design(tmp_path, settings), "--tolerances", "--json")
    data = json.loads(said)["tolerances"]
    (output,) = data["outputs"]
    (place,), (trial,) = output["places"], output["mechanisms"]
    assert code == 0
    assert (data["samples"], data["seed"], trial["samples"]) == (5000, 7, 5000)
    assert place["at"] == [pytest.approx(1.0)]
    assert sum(place["shares"].values()) == pytest.approx(1)
    assert place["shares"].keys() == {one["name"] for one in data["contributors"]}
    assert trial["kept"]["lower"] < trial["kept"]["value"] < trial["kept"]["upper"]
    assert output["worst"]["high"] > place["high"] > trial["greatest"]
    assert json.loads(run("check", design(tmp_path, settings), "--json")[1]).keys() == {
        "design",
        "ok",
        "to",
        "unmade",
        "findings",
        "processes",
    }


@pytest.mark.parametrize(
    ("text", "said"),
    {
        "a tolerance below zero": ("length = -0.01", "tolerances.length: -0.01 should be greater than or equal to 0"),
        "no fit": ("fit = 'H7/z6'", "tolerances.fit: 'H7/z6' is no fit"),
        "no samples": ("samples = 0", "tolerances.samples: 0 should be greater than or equal to 100"),
        "too many samples": ("samples = 1000000000000", "should be less than or equal to 10000000"),
        "no limit": ("limit_angle = 0", "tolerances.limit_angle: 0 should be greater than 0"),
        "an unknown key": ("lenght = 1", "tolerances: unknown key 'lenght'; did you mean 'length'?"),
        "an unknown key of one": ("of.crank.low = 1", "tolerances.of.crank: unknown key 'low'"),
        "no table": ("of = 3", "tolerances.of: is 3; write tables"),
        "not a number": ("length = nan", "tolerances.length"),
        "a truth value": ("length = true", "tolerances.length: true is no number"),
    }.values(),
)  # fmt: skip
def test_bad_input_is_a_line(run, tmp_path, text, said):
    code, _, err = run("check", design(tmp_path, f"[tolerances]\n{text}\n"))
    assert code == 2
    assert said in err
    assert len(err.splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "said"),
    {
        "a joint that jams": ("fit = 'H7/n6'", "tolerances.fit: 6 H7/n6 has a clearance of"),
        "a contributor that is not there": ("of.crnak.lower = 0", "known: crank, coupler, follower"),
        "a key of other families": (
            "centre = 0.1",
            "tolerances.centre: nothing depends on it here; leave it out",
        ),
    }.values(),
)
@pytest.mark.parametrize("command", ["check", "check --tolerances", "build"])
def test_what_the_family_cannot_obey_is_a_finding(run, tmp_path, text, said, command):
    words = command.split()
    output = ["-o", tmp_path / "o"] if command == "build" else []
    code, out, err = run(words[0], design(tmp_path, f"[tolerances]\n{text}\n"), *words[1:], *output)
    assert code == 1
    assert said in out + err
    assert "tolerances.key" in out + err
    assert not (tmp_path / "o").exists()


def test_a_design_that_does_not_move_has_no_table(run, tmp_path):
    code, said, _ = run("check", design(tmp_path, "[parameters]\ncoupler = 400\n"), "--tolerances")
    assert code == 1
    assert "first order" not in said


class Still(Family):
    """A family without an analysis of tolerances."""

    name, title, summary = "still", "Still", "Does not move."
    Params = type(host().family("four-bar")).Params

    def solve(self, params, samples):
        raise NotImplementedError

    def parts(self, params):
        return ()


def test_a_family_without_an_analysis_says_so_in_one_line(run, tmp_path, monkeypatch):
    monkeypatch.setattr(type(host().family("four-bar")), "tolerances", Family.tolerances)
    path = design(tmp_path, "")
    code, _, err = run("check", path, "--tolerances")
    assert code == 2
    assert err == f"mechwright: {path}: family four-bar has no tolerance analysis; leave out --tolerances\n"
    assert run("check", path)[0] == 0
    code, said, _ = run("check", design(tmp_path, "[tolerances]\nseed = 3\n"))
    assert code == 1
    assert "tolerances: family four-bar has no tolerance analysis; leave the table out" in said


@pytest.mark.parametrize("path", thinned(2, DESIGNS), ids=lambda path: path.stem)
def test_the_page_of_an_example(path):
    with Build(path, host(), Wanted("build")) as build:
        if type(build.design.family).tolerances is Family.tolerances:
            assert TolerancePage().files(build) == {}
            return
        page = TolerancePage().files(build)["tolerances.html"]
        assert page == TolerancePage().files(build)["tolerances.html"]
        family, params = build.design.family, build.design.params
        outputs = [one.name for one in family.tolerances(params, Tolerances()).outputs]
    assert re.findall(r"<h2>(.*?)</h2>", page) == outputs
    assert "nan" not in page.lower().replace("nano", "")
    assert "http" not in page
    assert page.count("<table>") == len(outputs)
    shares = [float(width) for width in re.findall(r'height="10"/></svg></td><td class="n">([\d.]+) %', page)]
    assert sum(shares) == pytest.approx(100 * len(outputs), abs=0.1 * len(shares))


def test_a_family_without_an_analysis_has_no_page():
    family = Still()
    with Build(Design("still", family, family.Params(), Path("still.toml"), ""), Host()) as build:
        assert TolerancePage().files(build) == {}


def test_the_table_is_written_and_read_again(tmp_path):
    table = TolerancesTable()
    text = template(host().family("four-bar"), "d", [table])
    (tmp_path / "d.toml").write_text(text)
    assert load(tmp_path / "d.toml", host()).table(TolerancesTable) == Tolerances()
    value = Tolerances(
        ToleranceSettings(fit="H8/f7", at=(10.0, 20.0), angle=0.5),
        {"a b": OwnTolerance(lower=-0.1, upper="0.2 mm"), "pin-a": OwnTolerance(fit="H7/g6")},
    )
    lines = [FOUR_BAR, *table.text(value)]
    (tmp_path / "d.toml").write_text("\n".join(lines))
    assert load(tmp_path / "d.toml", host()).table(TolerancesTable) == value
    assert table.text(Tolerances()) == []


def test_a_million_mechanisms_of_a_file_are_those_of_the_reference(run, tmp_path):
    """The handbook's fit on a linkage of round lengths: first order and mechanisms agree."""
    settings = "[tolerances]\nsamples = 1000000\nfit = 'H7/g6'\nlength = 0.02\n"
    data = json.loads(run("check", design(tmp_path, settings), "--tolerances", "--json")[1])["tolerances"]
    (output,) = data["outputs"]
    assert output["mechanisms"][0]["sigma"] == pytest.approx(output["worst"]["sigma"], rel=2e-3)
    assert math.isclose(output["mechanisms"][0]["mean"], 0, abs_tol=5e-6)

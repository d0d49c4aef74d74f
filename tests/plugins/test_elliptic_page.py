"""The page of a train: its script computes what the code does, and a browser runs it."""

import json
import math
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.figure_eight import page
from mechwright_elliptic_gears.kinematics.equations import Turning, phase_offset
from mechwright_elliptic_gears.kinematics.figures import coupled_gears, point_peaks, point_window
from mechwright_elliptic_gears.kinematics.point import place, point_of_coupler

ROOT = Path(__file__).parents[2]
SCRIPT = Path(page.__file__).with_name("train.js")
NODE = shutil.which("node")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
Params = EllipticGears.Params
ANGLES = [-7.3, 0.0, 0.4, 1.9, math.pi, 4.4, 6.1, 9.0]
DESIGNS = [
    {"eccentricity": 0.4, "phase": 90.0, "band": 10.0},
    {"eccentricity": 0.4, "phase": 135.0, "band": 10.0},
    {"eccentricity": 0.8, "phase": 45.0, "band": 10.0},
    {"eccentricity": 0.23, "phase": 212.0, "point_along": 0.3, "point_across": 8.0, "semi_major": 31.0},
    {"eccentricity": 0.05, "phase": 20.0, "band": 100.0},
]


@pytest.fixture(scope="module")
def computed():
    """What the script says of the designs."""
    if NODE is None:
        pytest.skip("no node here")
    designs = [page.data_of(Params(stages=2, speed=95.49296585513721, **table)) for table in DESIGNS]
    code = f"""{SCRIPT.read_text(encoding="utf-8")}
    const found = {json.dumps(designs)}.map((one) => {{
      const design = {{ ...one, gamma: one.gamma * Math.PI / 180 }};
      return {{ ...figuresOf(design, one.band), points: {json.dumps(ANGLES)}.map((angle) => at(angle, design)) }};
    }});
    console.log(JSON.stringify(found));"""
    done = subprocess.run([NODE, "-e", code], capture_output=True, text=True, check=True, timeout=60)
    return json.loads(done.stdout)


@pytest.mark.parametrize("number", range(len(DESIGNS)))
def test_the_script_computes_what_the_code_does(computed, number):
    params, found = Params(stages=2, speed=95.49296585513721, **DESIGNS[number]), computed[number]
    a, e = params.semi_major, params.eccentricity
    four, five = coupled_gears(Turning.of(np.array(ANGLES), 10.0), e, params.phase_angle)
    q = point_of_coupler(four, five, a, e, place(params.point_along, params.point_across, a))
    for key, values in (("speed", q.speed), ("acceleration", np.abs(q.acceleration))):
        assert [one[key] for one in found["points"]] == pytest.approx(values.tolist(), rel=1e-9)
    places = [complex(*one["q"]) for one in found["points"]]
    np.testing.assert_allclose(places, q.position, atol=1e-9)
    assert [one["five"]["omega"] for one in found["points"]] == pytest.approx(five.omega.tolist(), rel=1e-9)
    assert found["joint"] % math.tau == pytest.approx(phase_offset(params.phase_angle, e) % math.tau)
    tops, window = point_peaks(params), point_window(params)
    assert found["most"]["value"] == pytest.approx(tops["speed"].value, rel=1e-8)
    assert found["acceleration"]["value"] == pytest.approx(tops["acceleration"].value, rel=1e-8)
    assert found["window"]["length"] == pytest.approx(window.length, abs=2e-3)
    assert found["window"]["start"] == pytest.approx(window.start, abs=2e-3)
    assert found["window"]["low"] == pytest.approx(window.low, abs=0.1)


def test_a_speed_that_stays_within_the_band_has_a_whole_turn(computed):
    assert computed[-1]["window"]["length"] == pytest.approx(math.tau)


def test_trains_have_the_page_and_pairs_have_none(tmp_path):
    for stem, there in (
        ("figure-eight-variable", True),
        ("elliptic-pair", False),
        ("geneva-straight", False),
    ):
        with Build(ROOT / "examples" / f"{stem}.toml", host()) as build:
            files = page.FigureEightPage().files(build)
            assert list(files) == ([page.NAME] if there else [])
            assert files == page.FigureEightPage().files(build)


def test_the_page_needs_nothing_else():
    text = page.html("a<b>&", Params(stages=2, phase_joint="pins", phases=(10.0, 120.0)))
    assert "a&lt;b&gt;&amp;" in text
    assert set(re.findall(r"https?://[^\s\"']*", text)) == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"<(link|img|iframe|script src)", text)
    assert "default-src 'none'" in text
    assert re.findall(r'data-gamma="([^"]*)"', text) == ["10.0", "120.0"]
    assert text.count('<table id="machine">') == 1
    assert '<table id="machine">' not in page.html("fixed", Params(stages=2))
    assert 'id="gamma" type="range" min="0" max="360" step="0.5" value="10.0"' in text


@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
def test_a_browser_fills_both_tables_without_a_complaint(tmp_path):
    file = tmp_path / "figure-eight.html"
    table = {"stages": 2, "phase_joint": "pins", "speed": 95.49296585513721, "band": 10.0}
    file.write_text(page.html("train", Params(**table)), encoding="utf-8")
    done = subprocess.run(
        [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--enable-logging=stderr",
            f"--user-data-dir={tmp_path / 'profile'}",
            "--virtual-time-budget=5000",
            "--dump-dom",
            file.as_uri(),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert [line for line in done.stderr.splitlines() if "CONSOLE" in line] == []
    rows = re.findall(r'<tr data-cell="([^"]*)"([^>]*)>(.*?)</tr>', done.stdout)
    assert len(rows) == 5 + 2 * 5 * 4
    assert [cell for cell, marked, _ in rows if "now" in marked] == ["90 0.4"] * 3
    # The machine, table 2, then table 3 of the published train with the longest window.
    shown = [re.findall(r">([^<>]+)</t[hd]>", cells) for cell, _, cells in rows if cell == "90 0.4"]
    assert shown[1][4] == "2.204"
    assert shown[2][2:5] == ["701.53", "0.519", "13.7105"]
    machine = [re.findall(r">([^<>]+)</t[hd]>", cells) for _, _, cells in rows[:5]]
    assert [(one[0], one[2], one[5], one[6], one[7]) for one in machine] == [
        ("0°", "0.000°", "1.334", "945.13", "70.1728"),
        ("45°", "88.048°", "1.758", "937.96", "31.8687"),
        ("90°", "133.603°", "2.204", "701.53", "13.7105"),
        ("135°", "159.867°", "0.538", "551.13", "13.0708"),
        ("180°", "180.000°", "0.553", "444.58", "12.8889"),
    ]

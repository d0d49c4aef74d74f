"""The page on which a mechanism moves: its data against the motion, and the page in a browser."""

import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import thinned
from scipy.spatial.transform import Rotation

from mechwright.contracts.motion import Channel, Motion, Poses, Trace
from mechwright.contracts.part import Instance, Part, Pocket
from mechwright.designs.design import load
from mechwright.geometry import Loop, Outline, circle
from mechwright.plugins.host import host
from mechwright_cad.animation import motion_html
from mechwright_cad.animation.figures import significant
from mechwright_cad.animation.scene import PAGE_SAMPLES, scene
from mechwright_cad.viewer.forms import COARSE, is_light
from mechwright_cad.viewer.packed import corners as corners_of
from mechwright_cad.viewer.packed import indices

EXAMPLES = sorted(
    path
    for path in (Path(__file__).parents[2] / "examples").glob("*.toml")
    if not path.stem.endswith(("-requirement", "-study"))
    and 'family = "plate"' not in path.read_text(encoding="utf-8")  # what stands still has no such page
)
SIZE = 1_000_000
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


def data_of(page):
    return json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))


def page_of(name, family, params):
    motion = family.solve(params, PAGE_SAMPLES)
    return motion_html(name, family.title, family.parts(params), motion, solids=False)


def about(axis, angle):
    """Rotations (n, 3, 3) about x, y or z."""
    return Rotation.from_rotvec(angle[:, None] * np.eye(3)["xyz".index(axis)]).as_matrix()


def placed(found, body, points):
    """Points (k, 3) of a body at all samples, (n, k, 3), as the page places them."""
    pose = found["poses"][body]
    columns = np.column_stack([np.broadcast_to(column, PAGE_SAMPLES) for column in pose["columns"]])
    if "layers" in found:
        turn = about("z", columns[:, 2])
        turn = turn @ np.diag((1.0, -1.0 if pose.get("down") else 1.0, 1.0))
        place = np.column_stack((columns[:, :2], np.zeros(PAGE_SAMPLES)))
    else:
        turn = Rotation.from_quat(np.roll(columns[:, 3:], -1, axis=1)).as_matrix()
        place = columns[:, :3]
    return np.einsum("nij,kj->nki", turn, points) + place[:, None]


def polygon_of(path):
    rings = [
        np.array([pair.split() for pair in loop.split("L")], dtype=float)
        for loop in re.findall("M(.*?)Z", path)
    ]
    return shapely.Polygon(rings[0], rings[1:])


@pytest.mark.parametrize("path", thinned(2, EXAMPLES), ids=lambda path: path.stem)
def test_every_example_has_a_page_that_agrees_with_its_motion(path):
    design = load(path, host())
    page = page_of(design.name, design.family, design.params)
    assert len(page) < SIZE
    found = data_of(page)
    motion = design.family.solve(design.params, PAGE_SAMPLES)
    parts = design.family.parts(design.params)
    assert set(found["poses"]) == {instance.body for part in parts for instance in part.instances}
    corners = np.array([(0.0, 0, 0), (60, 0, 0), (0, 60, 0), (-30, 20, 0)])
    for body in found["poses"]:
        wanted = motion.poses[body].transform(corners)
        if "layers" in found:
            wanted = wanted * (1, 1, 0)
        np.testing.assert_allclose(placed(found, body, corners), wanted, atol=2.5e-3)
    for name, channel in motion.channels.items():
        assert found["channels"][name]["unit"] == channel.unit
        assert found["channels"][name]["label"] == channel.label != "", f"{name} says nothing to people"
        shown = np.array(found["channels"][name]["values"], dtype=float)
        nothing = 1e-9 * np.abs(channel.values).max() + 1e-12
        np.testing.assert_allclose(shown, channel.values, rtol=1e-5, atol=nothing)
        assert not (np.abs(shown[shown != 0]) < 1e-9 * np.abs(shown).max()).any(), "rounding of sums"
    assert len(set(motion.labels.values())) == len(motion.channels), "two channels with one label"
    for name, points in found["traces"].items():
        np.testing.assert_allclose(points, motion.path(name)[:, : len(points[0])], atol=1e-3)
    solids = {part.name for part in parts if not is_light(part) and part.instances}
    assert {name.partition(" ")[0] for name in found["missing"]} == solids
    assert found["round"] == (motion.rocks or abs(motion.channels[motion.input_name].values[-1]) > 6)


def test_families_name_the_points_whose_paths_are_drawn():
    for name, table, traced, channels in (
        ("elliptic-gears", {"point_across": 7}, "Q", ("Q.x", "Q.y")),
        ("four-bar", {"coupler_point_x": 30, "coupler_point_y": 12}, "P", ("xP", "yP")),
        ("slider-crank", {"coupler_x": 20, "coupler_y": 5}, "P", ("xP", "yP")),
        ("spherical", {}, "P", ("xP", "yP", "zP")),
    ):
        family = host().family(name)
        motion = family.solve(family.Params.model_validate(table), 13)
        assert list(motion.traces) == [traced]
        wanted = np.column_stack([motion.channels[channel].values for channel in channels])
        np.testing.assert_allclose(motion.path(traced)[:, : len(channels)], wanted, atol=1e-9)


ANGLE = np.linspace(0, math.tau, PAGE_SAMPLES)
SQUARE = Loop.polygon([(-20, -10), (20, -10), (20, 10), (-20, 10)])
STILL = Poses.planar(0.0, 0.0, 0 * ANGLE)


def motion_of(**poses):
    return Motion("phi", {"phi": Channel(ANGLE, "rad")}, poses)


def plate(name, z=0.0, **more):
    return Part(name, Outline(SQUARE), 8.0, "steel", (Instance(name, z),), **more)


def test_layers_are_those_of_the_plate_from_the_bottom_up():
    pocket = Pocket("pocket", Loop((circle((0, 0), 6),)), (), 0.0, 3.0)
    low = Part(
        "low",
        Outline(SQUARE, (Loop((circle((15, 0), 2, clockwise=True),)),)),
        8.0,
        "steel",
        (Instance("low", 1.0),),
        (1.0, 0.0, 0.2),
        machined=(pocket,),
    )
    turned = Poses(
        np.tile((30.0, 0.0, 20.0), (PAGE_SAMPLES, 1)), np.tile(np.diag((1.0, -1, -1)), (PAGE_SAMPLES, 1, 1))
    )
    found = scene([plate("high", 2.0), low], motion_of(low=STILL, high=turned), solids=False)
    assert [(layer["body"], layer["top"]) for layer in found["layers"]] == [
        ("low", 6),
        ("low", 9),
        ("high", 18),
    ]
    bottom, top, high = (polygon_of(layer["path"]) for layer in found["layers"])
    assert bottom.area == pytest.approx(800 - math.pi * 4, abs=0.1)
    assert top.area == pytest.approx(bottom.area - math.pi * 36, abs=0.5)
    assert found["layers"][0]["colour"] == "#ff0033"
    assert high.bounds == (-20, -10, 20, 10)
    assert found["poses"]["high"] == {"columns": [[30], [0], [0]], "down": True, "z": 20}
    x, y, width, height = found["window"]
    assert (x, y, x + width, y + height) == pytest.approx((-22.8, -12.8, 52.8, 12.8), abs=0.01)


def test_the_window_holds_the_whole_motion():
    swung = Poses.planar(40 * np.cos(ANGLE), 40 * np.sin(ANGLE), ANGLE)
    found = scene([plate("arm")], motion_of(arm=swung), solids=False)
    x, y, width, height = found["window"]
    corners = swung.transform(np.array([(a, b, 0.0) for a in (-20, 20) for b in (-10, 10)]))[..., :2]
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    border = 0.04 * (high - low).max()
    np.testing.assert_allclose((x, y), low - border, atol=0.01)
    np.testing.assert_allclose((width, height), high - low + 2 * border, atol=0.02)


def test_bodies_in_space_are_meshes_and_stand_on_the_largest_plate_at_rest():
    lean = about("x", np.array([0.4]))[0]
    base = Poses(np.zeros((PAGE_SAMPLES, 3)), np.tile(lean, (PAGE_SAMPLES, 1, 1)))
    spun = Poses(np.tile((0, 0, -50.0), (PAGE_SAMPLES, 1)), about("y", ANGLE))
    found = scene([plate("base"), plate("flap", -4.0)], motion_of(base=base, flap=spun), solids=False)
    for mesh, z in zip(found["meshes"], (0, -4), strict=True):
        form = found["forms"][mesh["form"]]
        points = corners_of(form) + np.array((0.0, 0.0, mesh.get("z", 0.0)))
        a, b, c = points[indices(form)].transpose(1, 0, 2)
        assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(6400, rel=1e-4)
        assert (points[:, 2].min(), points[:, 2].max()) == pytest.approx((z, z + 8), abs=1e-3)
    np.testing.assert_allclose(found["up"], -lean[:, 2], atol=1e-5)
    centre, radius = np.array(found["ball"]["centre"]), found["ball"]["radius"]
    reached = [
        poses.transform(np.array([(20, 10, h), (-20, -10, h)])) for poses, h in ((base, 8), (spun, 4.0))
    ]
    assert max(np.linalg.norm(points - centre, axis=-1).max() for points in reached) <= radius + 0.01


def test_solids_are_drawn_where_they_are_made():
    cq = pytest.importorskip("cadquery")
    cone = Part("cone", None, 0.0, "steel", (Instance("cone"),), build=lambda: cq.Solid.makeCone(6, 2, 10))
    pin = Part(
        "pin", None, 0.0, "steel", (Instance("cone", 30.0),), build=lambda: cq.Solid.makeCylinder(4, 9)
    )
    found = scene([cone, pin], motion_of(cone=STILL), solids=True)
    assert found["missing"] == []
    assert [(layer["name"], layer["top"]) for layer in found["layers"]] == [("cone", 10), ("pin", 39)]
    wide, slim = (polygon_of(layer["path"]) for layer in found["layers"])
    assert slim.area == pytest.approx(math.pi * 16, abs=math.tau * 4 * 0.02)
    assert wide.area == pytest.approx(math.pi * 36, abs=math.tau * 6 * (COARSE + 0.02))
    assert scene([cone, pin], motion_of(cone=STILL), solids=False)["missing"] == ["cone", "pin"]


def test_a_motion_goes_round_if_it_ends_where_it_began_or_after_whole_turns():
    there = Poses.planar(10 * np.sin(ANGLE / 2), 0.0, 0 * ANGLE)
    only = Poses.planar(ANGLE, 0.0, 0 * ANGLE)
    for unit, scale, poses, wanted in (
        ("rad", 1.0, only, True),
        ("rad", 0.3, only, False),
        ("mm", 0.3, there, True),
        ("mm", math.tau, only, False),
    ):
        motion = Motion("in", {"in": Channel(scale * ANGLE, unit)}, {"slide": poses})
        assert scene([plate("slide")], motion, solids=False)["round"] is wanted


def test_no_name_ends_the_element_it_stands_in_and_gaps_stay_gaps():
    values = np.where(ANGLE > 6, np.nan, ANGLE)
    motion = Motion(
        "phi",
        {"phi": Channel(ANGLE, "rad"), "a</script><b>": Channel(values, "<i>")},
        {"a": STILL},
        traces={"{{SCRIPT}}": Trace("a", (1, 2, 3))},
    )
    page = motion_html("a<b>&", "{{STYLE}}", [plate("a")], motion, solids=False)
    assert page.count("</script>") == 2
    assert "<b>" not in page
    assert "a&lt;b&gt;&amp;" in page
    found = data_of(page)
    assert found["channels"]["a</script><b>"]["values"][-1] is None
    assert found["traces"]["{{SCRIPT}}"][0] == [1, 2]
    assert significant(np.array([-0.0, 1 / 3, 2e-30, np.inf])) == [0, 0.333333, 0, None]


def test_the_page_needs_nothing_else_and_is_the_same_every_time():
    family = host().family("geneva")
    pages = [page_of("one", family, family.Params()) for _ in range(2)]
    assert pages[0] == pages[1]
    assert set(re.findall(r"https?://[^\s\"']*", pages[0])) == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"<(link|img|iframe|script src)", pages[0])
    assert "default-src 'none'" in pages[0]


def test_a_mechanism_without_parts_has_its_plots():
    found = scene(
        [], Motion("phi", {"phi": Channel(ANGLE, "rad"), "x": Channel(ANGLE**2, "mm")}), solids=False
    )
    assert (found["poses"], found["layers"], found["traces"]) == ({}, [], {})
    assert len(found["channels"]) == 2


def test_solve_writes_the_page_without_the_cad_kernel(tmp_path):
    code = (
        "import sys; from mechwright.cli import main\n"
        "try: main()\nfinally: print(*{'cadquery', 'OCP', 'ezdxf'} & set(sys.modules), file=sys.stderr)"
    )
    design = EXAMPLES[[path.stem for path in EXAMPLES].index("spherical-crank-rocker")]
    done = subprocess.run(
        [sys.executable, "-c", code, "solve", design, "-o", tmp_path / "out"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr.strip()) == (0, "")
    found = data_of((tmp_path / "out" / "motion.html").read_text())
    assert "crank" in found["missing"]
    names = {mesh["name"] for mesh in found["meshes"]}
    assert "base" in names, "a plate"
    assert not names & set(found["missing"])


@pytest.mark.skipif(CHROMIUM is None, reason="no chromium here")
@pytest.mark.parametrize(
    ("stem", "at"), [("figure-eight-train", 60), ("spherical-crank-rocker", 100), ("none", 30)]
)
def test_a_browser_runs_the_page_without_a_complaint(stem, at, tmp_path):
    if stem == "none":
        motion = Motion("phi", {"phi": Channel(ANGLE, "rad"), "x": Channel(np.full(PAGE_SAMPLES, 5.0), "mm")})
        page = motion_html("none", "", [], motion, solids=False)
    else:
        design = load(EXAMPLES[[path.stem for path in EXAMPLES].index(stem)], host())
        page = page_of(design.name, design.family, design.params)
    file = tmp_path / "motion.html"
    file.write_text(page)
    done = subprocess.run(
        [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--enable-logging=stderr",
            f"--user-data-dir={tmp_path / 'profile'}",
            "--virtual-time-budget=1000",
            "--dump-dom",
            f"{file.as_uri()}#at={at}",
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert [line for line in done.stderr.splitlines() if "CONSOLE" in line] == []
    found, shown = data_of(page), done.stdout
    assert f"= {at}.0°</output>" in shown
    if found.get("layers"):
        drawn = re.findall(r'<path class="part"[^>]*?transform="matrix\(([^)]*)\)"', shown)
        assert len(drawn) == len(found["layers"])
        for layer, numbers in zip(found["layers"], drawn, strict=True):
            a, b, c, d, e, f = map(float, numbers.split())
            corner = np.array([[30.0, 10.0, 0.0]])
            wanted = placed(found, layer["body"], corner)[at, 0, :2]
            np.testing.assert_allclose((a * 30 + c * 10 + e, b * 30 + d * 10 + f), wanted, atol=1e-3)
        assert shown.count('class="curve') == 6
    elif "meshes" in found:
        assert "<canvas" in shown
        assert "WebGL" not in shown.partition("<script")[0]

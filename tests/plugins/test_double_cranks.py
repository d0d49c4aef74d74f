"""Double cranks: two ground plates where one goes not, posts outside the sweep, and designs that build."""

import json
import re
import warnings
from dataclasses import dataclass
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import by_night, examples
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from tolerance_models import assert_exact
from typer.testing import CliRunner

from mechwright import GeometryError, Tolerances
from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity, errors
from mechwright.designs.design import load
from mechwright.mechanics.linkage import Boss, Plate, Spindle, hull_link, rectangle, stack
from mechwright.plugins.host import host
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.tolerances import FourBarTolerances, as_made
from mechwright_four_bar.table import FourBarTable

EXAMPLE = Path(__file__).parents[2] / "examples" / "double-crank.toml"
DRAG = {"crank": 70, "coupler": 60, "follower": 75, "ground": 30}
TURN = np.linspace(0, 2 * np.pi, 1441)

REFERENCE = (
    (FourBar(70, 60, 75, 30), 32.0891838633),
    (FourBar(60, 50, 70, 35), 14.5663276483),
    (FourBar(90, 70, 85, 20, branch=-1), 52.6168015821),
)
"""Drag links whose orders of layers were swept by other means, and the least angle in joint B, degrees."""


def bars(bar):
    """Links 12 mm wide as plates without a ground, and their poses."""
    poses = {name: body.poses() for name, body in close(bar, TURN).bodies(bar, 1.0).items()}
    poses["ground"] = poses["crank"].__class__.planar(0.0, 0.0, 0 * TURN)
    sizes = {"crank": bar.crank, "coupler": bar.coupler, "follower": bar.follower}
    return {name: hull_link([Boss(0j, 6), Boss(complex(a), 6)]) for name, a in sizes.items()}, poses


def free_orders(bar, sides):
    """Orders of the three links in which nothing meets, A0 below and B0 below or above."""
    outlines, poses = bars(bar)
    # Far off, the ground is in nobody's way; its plates are where the shafts end.
    far = rectangle(900 + 900j, 910 + 910j, 1.0)
    found = []
    for order in permutations(outlines):
        plates = [Plate("ground", "ground", far, 6.0, (0,))]
        plates += [Plate(name, name, outlines[name], 6.0, (1 + order.index(name),)) for name in outlines]
        if sides == 2:
            plates.append(Plate("ground-2", "ground", far, 6.0, (4,)))
        # The sweep had pins of 12 mm. Between samples the safe side is taken, and one clears a link by 0.6 mm.
        spindles = [
            Spindle("A0", "crank", 0j, 5.4, ("ground", "crank")),
            Spindle("A", "crank", complex(bar.crank), 5.4, ("crank", "coupler")),
            Spindle("B", "follower", complex(bar.follower), 5.4, ("follower", "coupler")),
            Spindle("B0", "follower", 0j, 5.4, ("follower", "ground-2" if sides == 2 else "ground")),
        ]
        try:
            stack(plates, spindles, poses, 0.0, 0.5)
        except GeometryError:
            continue
        found.append(order)
    return found


@pytest.mark.parametrize(("bar", "least"), REFERENCE)
def test_free_orders_of_drag_links(bar, least):
    assert np.degrees(bar.least_transmission_angle()) == pytest.approx(least, abs=1e-6)
    assert free_orders(bar, 1) == []
    # As many again with A0 above: six in all.
    found = free_orders(bar, 2)
    assert ("crank", "coupler", "follower") in found
    assert len(found) == 3


def layout_of(params):
    return FourBarTable.of(params).layout


@pytest.mark.parametrize("changes", [{}, {"branch": "crossed"}, {"direction": "cw", "ground_angle": 110}])
def test_the_drag_link_stands_between_two_plates(changes):
    params = FourBarParams(**DRAG, **changes)
    layout = layout_of(params)
    assert layout.stack.layer == {"ground": 0, "crank": 1, "coupler": 2, "follower": 3, "ground-2": 4}
    parts = {part.name: part for part in FourBars().parts(params)}
    assert {"ground", "ground-2", "post", "bolt", "shaft", "shaft-b0"} <= set(parts)
    assert len(parts["post"].instances) == len(parts["bolt"].instances) == 4
    # One bore for a pivot in each plate, and the bores of the posts on the same axes.
    for name, tag in (("ground", "A0"), ("ground-2", "B0")):
        bores = [loop.segments[0] for loop in parts[name].outline.inner]
        assert sorted(bore.tag for bore in bores) == sorted([tag, *["screw"] * 4])
        drilled = sorted(bore.centre for bore in bores if bore.tag == "screw")
        assert np.array(drilled) == pytest.approx(np.array(sorted((p.real, p.imag) for p in layout.posts)))
        assert all(y == round(y) for _, y in drilled)


def posts_clear(params):
    """The least distance, mm, of any moving plate from a post's surface, at twice the samples."""
    layout = layout_of(params)
    bar = FourBar(params.crank, params.coupler, params.follower, params.ground, 0.0, 1)
    bar = bar if params.branch == "open" else FourBar(*bar.lengths, 0.0, -1)
    posts = shapely.multipoints([(at.real, at.imag) for at in layout.posts])
    least = np.inf
    for name, body in close(bar, np.linspace(0, 2 * np.pi, 721)).bodies(bar, 1.0).items():
        poses = body.poses()
        outer = layout.outlines[name].outer.flatten(0.01)
        turned = np.einsum("nij,kj->nki", poses.rotation[:, :2, :2], outer) + poses.position[:, None, :2]
        least = min(least, float(shapely.distance(shapely.polygons(turned), posts).min()))
    return least - params.pin_diameter / 2 - params.rim


@st.composite
def drag_links(draw):
    sizes = [draw(st.floats(12, 100)) for _ in range(3)]
    ground = draw(st.floats(2, min(sizes)))
    bar = FourBar(*sizes, ground)
    assume(bar.kind is Kind.DOUBLE_CRANK and bar.least_transmission_angle() > np.radians(15))
    return dict(zip(("crank", "coupler", "follower", "ground"), bar.lengths, strict=True))


@settings(max_examples=examples(4, 10), deadline=None)
@given(drag_links(), st.sampled_from(["open", "crossed"]))
def test_any_drag_link_its_mirror_and_its_inverse_have_layers(lengths, branch):
    other = "crossed" if branch == "open" else "open"
    back = lengths | {"crank": lengths["follower"], "follower": lengths["crank"]}
    for table in (lengths | {"branch": branch}, lengths | {"branch": other}, back | {"branch": branch}):
        params = FourBarParams.model_validate(table)
        assert errors(FourBars().check(params)) == []
        assert layout_of(params).scheme.sides == 2
        assert posts_clear(params) > params.clearance


def test_one_plate_is_refused_with_a_remedy_that_works():
    params = FourBarParams(**DRAG, frame="one")
    (fault,) = errors(FourBars().check(params))
    assert (fault.code, fault.parameter, fault.remedy) == ("four-bar.layers", "frame", 'set frame = "two"')
    assert errors(FourBars().check(params.model_copy(update={"frame": "two"}))) == []


@pytest.mark.parametrize("frame", ["auto", "one", "two"])
def test_motion_needs_no_layout(frame):
    """A coupler that cannot be bent has no plates; the linkage moves all the same."""
    params = FourBarParams(**DRAG, coupler_bend=20, web_width=17, frame=frame)
    assert {fault.code for fault in errors(FourBars().check(params))} == {"four-bar.bend"}
    assert set(FourBars().solve(params, 13).poses) > {"crank", "coupler", "follower"}


def test_a_crank_rocker_takes_one_plate_unless_two_are_asked_for():
    assert layout_of(FourBarParams()).scheme.sides == 1
    assert layout_of(FourBarParams(frame="two")).scheme.sides == 2
    assert errors(FourBars().check(FourBarParams(frame="two"))) == []


def test_a_ground_too_short_for_both_bores_takes_two_plates():
    short = {"crank": 40, "coupler": 40, "follower": 42, "ground": 8}
    assert errors(FourBars().check(FourBarParams(**short))) == []
    codes = {fault.code for fault in errors(FourBars().check(FourBarParams(**short, frame="one")))}
    assert codes == {"four-bar.bores"}


def test_a_point_between_the_plates_is_said_and_one_beside_them_is_not():
    def said(x, y, **bar):
        params = FourBarParams(**bar, coupler_point_x=x, coupler_point_y=y)
        found = FourBars().check(params)
        assert errors(found) == []
        assert posts_clear(params) > params.clearance
        return [finding.severity for finding in found if finding.code == "four-bar.point"]

    assert said(30, 20, **DRAG) == [Severity.WARNING]
    # What joins the plates stands outside the path, and the path of a drag link goes all the way round.
    assert said(30, 260, **DRAG) == [Severity.WARNING]
    assert said(160, 0, frame="two") == [Severity.WARNING]
    assert said(160, -80, frame="two") == []


@dataclass
class Bored:
    """A plate as made whose bores are off by so much."""

    moved: dict
    corridor: float = 0.0

    def hole_at(self, x, y, diameter):
        dx = self.moved.get(complex(x, y), self.moved.get("all", 0.0))
        return type("Hole", (), {"x": x + dx, "y": y, "least": diameter, "radius": diameter / 2})()


def test_the_distance_of_the_pivots_as_made_is_that_from_the_posts():
    params = FourBarParams(**DRAG)
    plates = {name: [Bored({})] for name in layout_of(params).outlines}
    axis = complex(params.ground)

    def error(**moved):
        found = as_made(FourBarTable.of(params), plates | {name: [Bored(off)] for name, off in moved.items()})
        (figure,) = [one for one in found.figures if one.name == "follower.error"]
        return figure.low

    assert error() == pytest.approx(0.0, abs=1e-9)
    # A plate that is off as a whole is brought in line by its bolts.
    assert error(**{"ground-2": {"all": 0.05}}) == pytest.approx(0.0, abs=1e-6)
    longer = error(**{"ground-2": {axis: 0.05}})
    assert longer > 100
    assert error(ground={0j: -0.05}) == pytest.approx(longer)
    assert error(ground={0j: 0.05}, **{"ground-2": {axis: 0.05}}) == pytest.approx(0.0, abs=1e-6)
    assert len(layout_of(params).posts) == 4


def test_tolerances_of_two_plates():
    model = FourBarTolerances(
        FourBarTable.of(FourBarParams(**DRAG, coupler_point_x=20, coupler_point_y=10)), Tolerances()
    )
    names = {one.name for one in model.contributors}
    assert {"ground", "ground-2", "shaft-b0"} <= names
    assert_exact(model, np.linspace(0.1, 6.0, 7))


@by_night
def test_the_example_builds_without_a_warning(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        done = CliRunner().invoke(make_app(), ["build", str(EXAMPLE), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output
    made = {file.name for file in (tmp_path / "out").iterdir()}
    plates = ("ground", "ground-2", "crank", "coupler", "follower")
    assert {f"{part}.{kind}" for part in plates for kind in ("dxf", "step", "nc")} <= made
    assert {"assembly.step", "post.step", "bolt.step", "shaft-b0.step"} <= made
    assert json.loads((tmp_path / "out" / "proof.json").read_text(encoding="utf-8"))


def test_the_example_has_its_poles_where_it_says():
    design = load(EXAMPLE, host())
    text = EXAMPLE.read_text(encoding="utf-8")
    said = [complex(float(x), float(y)) for x, y in re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)", text)]
    assert len(said) == 3
    motion = FourBars().solve(design.params, 721)
    poles = motion.channels["xG"].values + 1j * motion.channels["yG"].values
    assert np.abs(poles[[0, 240, 480]] - said).max() < 0.01

"""Measured parts: limits, the next piece, pairs, and how the mechanism runs with them."""

import csv
import io
import itertools
import json

import numpy as np
import pytest

from mechwright.cli.hosting import open_host
from mechwright.contracts.inspected import inspected
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.pipeline import Build
from mechwright.pipeline.measured.corrections import corrections, mean_offset
from mechwright.pipeline.measured.pairing import least_greatest, pairings
from mechwright.pipeline.measured.readings import Reading, empty_table, read_readings
from mechwright.pipeline.measured.running import as_measured, measured_tolerances

BATCHES = 100
NOISE = 0.002
"""Of what measures the batches, mm: pins and a micrometer."""


@pytest.fixture(scope="module")
def build(request) -> Build:
    return Build(load(request.config.rootpath / "examples/geneva-straight.toml", open_host()), open_host())


def cut(part, off: float, rng, copy: str = "1") -> list[Reading]:
    """A copy of a plate whose walls keep ``off`` mm of stock, as measured."""
    return [
        Reading(part, copy, one, one.target + one.walls * off + NOISE * float(rng.standard_normal()))
        for one in inspected(part)
        if one.walls
    ]


def test_a_worn_cutter_is_corrected_so_that_the_next_piece_is_within_limits(build):
    rng = np.random.default_rng(1)
    part = build.parts["locking-disc"]
    worn_out, next_out = 0, 0
    for _ in range(BATCHES):
        wear = float(rng.uniform(0.004, 0.02))
        batch = [one for copy in "12345" for one in cut(part, wear, rng, copy)]
        (found,) = corrections(build, batch)
        assert found.process == "mill"
        assert found.words.startswith(f"set the wear of D {-found.off:+.4f} mm")
        assert abs(found.off - wear) < 4 * found.error + 1e-4
        worn_out += any(not one.is_within for one in batch)
        true_next = [one.target + one.walls * (wear - found.off) for one in inspected(part) if one.walls]
        next_out += any(
            not one.is_within(value)
            for one, value in zip([d for d in inspected(part) if d.walls], true_next, strict=True)
        )
    assert worn_out > 0.8 * BATCHES
    assert next_out == 0


def test_walls_inside_and_outside_are_told_apart_where_they_differ(build):
    rng = np.random.default_rng(2)
    part = build.parts["locking-disc"]
    readings = [
        Reading(
            part,
            str(copy),
            one,
            one.target + (-0.06 if one.walls < 0 else 0.002) + 1e-3 * rng.standard_normal(),
        )
        for copy in range(4)
        for one in inspected(part)
        if one.walls
    ]
    found = {one.walls: one for one in corrections(build, readings)}
    assert set(found) == {"inside", "outside"}
    assert found["inside"].off == pytest.approx(0.03, abs=1e-3)
    assert found["outside"].off == pytest.approx(0.001, abs=1e-3)


def test_the_offset_is_that_of_least_squares(build):
    part = build.parts["crank"]
    rng = np.random.default_rng(3)
    readings = cut(part, 0.011, rng)
    walls = np.array([one.dimension.walls for one in readings], float)
    more = np.array([one.off for one in readings])
    (slope,), _, _, _ = np.linalg.lstsq(walls[:, None], more, rcond=None)
    off, error = mean_offset(readings)
    assert off == pytest.approx(slope, abs=1e-6)
    rest = more - slope * walls
    assert error == pytest.approx(np.sqrt(rest @ rest / (len(walls) - 1) / (walls @ walls)))


def test_pairs_have_the_least_greatest_play_of_all():
    rng = np.random.default_rng(4)
    for _ in range(40):
        size = int(rng.integers(2, 6))
        plays = rng.normal(0.015, 0.02, (size, size))
        costs = np.where(plays < 0, 1e3 - plays, plays)
        best = min(
            max(costs[i, j] for i, j in enumerate(order)) for order in itertools.permutations(range(size))
        )
        assert max(costs[i, j] for i, j in least_greatest(plays)) == pytest.approx(best)


def test_pairing_lowers_the_greatest_play_as_order_statistics_say(build):
    rng = np.random.default_rng(5)
    crank, roller = build.parts["crank"], build.parts["roller"]
    names = [(one.name, one) for one in inspected(roller) if one.name == "step-1"]
    count, sigma, gained, said = 12, 0.006, [], []
    del names
    hole = next(one for one in inspected(crank) if one.name == "pin-1")
    for _ in range(BATCHES):
        holes = hole.target + sigma * rng.standard_normal(count)
        shafts = hole.nominal - 0.03 + sigma * rng.standard_normal(count)
        plays = -np.subtract.outer(shafts, holes)
        pairs = least_greatest(plays)
        gained.append(np.diag(plays).max() - max(plays[i, j] for i, j in pairs))
        said.append(np.diag(plays).max() - (np.sort(holes) - np.sort(shafts)).max())
    # copies in the order of their sizes are the best there is
    assert gained == pytest.approx(said, abs=1e-9)
    assert np.mean(gained) > sigma  # from 1.63 sqrt(2) sigma of the greatest of twelve to a third of it


def test_the_play_of_measured_pairs_is_found_and_the_mechanism_runs_with_it(build):
    host = open_host()
    four = Build(load(build.path.parent / "four-bar-double-rocker.toml", host), host)
    rng = np.random.default_rng(6)
    half = []
    for more in (0.0, 0.2):
        readings = []
        for part in four.parts:
            for one in inspected(part):
                if one.walls:
                    grown = more if one.walls < 0 and part.kind == "turned" else 0.0
                    readings.append(Reading(part, "1", one, one.target + grown))
        found = corrections(four, readings)
        pairs = pairings(four, readings)
        moving = [pair for pair in pairs if pair.moves]
        assert moving
        for pair in moving:
            assert pair.plays[0, 0] == pytest.approx(pair.as_chosen)
        half.append([one.half for one in as_measured(four, pairs, found)])
    assert half[0]
    assert all(after > before for before, after in zip(*half, strict=True))
    del rng


def test_each_joint_has_the_play_of_its_own_pair(build):
    """Pins of one diameter are told apart by the joints that they make."""
    host = open_host()
    four = Build(load(build.path.parent / "four-bar-double-rocker.toml", host), host)
    grown = {"pin-a": 0.0, "pin-b": 0.02, "pin-b0": 0.04, "shaft": 0.06}
    readings = [
        Reading(part, "1", one, one.target - grown.get(part.name, 0.0))
        for part in four.parts
        for one in inspected(part)
        if one.walls
    ]
    pairs = pairings(four, readings)
    joints = {pair.shaft.partition(".")[0]: pair.joints for pair in pairs if pair.moves}
    assert joints == {"pin-a": ("A",), "pin-b": ("B",), "pin-b0": ("B0",), "shaft": ("A0",)}
    plays = measured_tolerances(four, pairs, []).plays
    least = plays["A"][0]
    for joint, pin in (("A", "pin-a"), ("B", "pin-b"), ("B0", "pin-b0"), ("A0", "shaft")):
        assert plays[joint] == pytest.approx((least + grown[pin],) * 2)
    model = four.design.family.tolerances(four.design.params, measured_tolerances(four, pairs, []))
    seen = {one.name: one.upper for one in model.contributors if one.name in grown}
    assert {name: play - seen["pin-a"] for name, play in seen.items()} == pytest.approx(grown)


def test_bores_of_spherical_links_are_measured_and_paired(build):
    host = open_host()
    links = Build(load(build.path.parent / "spherical-crank-rocker.toml", host), host)
    coupler = links.parts["coupler"]
    names = [one.name for one in inspected(coupler)]
    assert names == [bore.name for bore in coupler.free_form.bores]
    readings = [
        Reading(part, "1", one, one.target + (0.03 if (part.name, one.name) == ("coupler", "a") else 0.0))
        for part in links.parts
        for one in inspected(part)
        if one.walls
    ]
    pairs = pairings(links, readings)
    plays = measured_tolerances(links, pairs, []).plays
    assert {"a0", "a", "c", "b0"} <= set(plays)
    assert plays["a"][1] - plays["c"][1] == pytest.approx(0.03)
    before, after = (
        [one.half for one in as_measured(links, some, [])] for some in (pairings(links, _plain(links)), pairs)
    )
    assert all(more > less for less, more in zip(before, after, strict=True))


def _plain(build: Build) -> list[Reading]:
    return [
        Reading(part, "1", one, one.target) for part in build.parts for one in inspected(part) if one.walls
    ]


class Seen(Tolerances):
    """Keeps the joint of each pin that a family asks for."""

    def __init__(self) -> None:
        super().__init__()
        object.__setattr__(self, "joints", [])

    def pin(self, name, diameter, own, *, member=False, joint=""):
        self.joints.append(joint or name)
        return super().pin(name, diameter, own, member=member, joint=joint)


@pytest.mark.parametrize(
    "example",
    [
        "four-bar-double-rocker",
        "five-bar-published",
        "slider-crank-quick-return",
        "geneva-straight",
        "spherical-crank-rocker",
        "spherical-five-bar-refined",
        "linkages/jansen",
        "linkages/crank-shaper",
    ],
)
def test_every_pin_of_an_analysis_is_a_joint_of_the_motion(build, example):
    design = load(build.path.parent / f"{example}.toml", open_host())
    seen = Seen()
    design.family.tolerances(design.params, seen)
    joints = design.solve(2).joints
    assert seen.joints
    assert set(seen.joints) <= set(joints)
    assert {joints[name].kind for name in seen.joints} <= {"revolute", "fixed"}


def filled(build: Build, change) -> str:
    rows = list(csv.DictReader(io.StringIO(empty_table(build.parts))))
    for row in rows:
        row["measured"] = change(row)
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def middle(row) -> str:
    if not row["least"]:
        return row["nominal"]
    return f"{(float(row['least']) + float(row['greatest'])) / 2:.4f}"


def test_a_table_is_written_filled_in_and_judged(build, tmp_path, command_line):
    table = tmp_path / "values.csv"
    code, out, _ = command_line("measure", build.path, "-o", table)
    assert code == 0
    assert "fill in the column measured" in out
    assert table.read_text() == empty_table(build.parts)
    table.write_text(filled(build, middle))
    code, out, _ = command_line("measure", build.path, table)
    assert code == 0
    assert "all within limits" in out
    table.write_text(
        filled(build, lambda row: "10.05" if row["part"] == "wheel" and row["feature"] == "bore" else "")
    )
    code, out, _ = command_line("measure", build.path, table)
    assert code == 1
    assert "wheel 1 bore: 10.05 mm, 10.000 to 10.015: out by 0.035 mm" in out
    code, out, _ = command_line("measure", build.path, table, "--json")
    assert json.loads(out)["values"][0]["within"] is False


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ("wheel,1,bore,0.394", "10.008 mm: it was measured in inches"),
        ("wheel,1,bore,7.0", "far off 10 mm"),
        ("whel,1,bore,10", "no part is named 'whel'"),
        ("wheel,1,bor,10", "has no dimension 'bor'"),
        ("wheel,1,bore,ten", "'ten' is no number"),
        ("wheel,1,bore,10\nwheel,1,bore,10.01", "is there twice"),
        ("wheel,1,bore,", "has no value"),
    ],
)
def test_wrong_values_are_named(build, tmp_path, row, said):
    table = tmp_path / "values.csv"
    table.write_text(f"part,copy,feature,measured\n{row}\n")
    with pytest.raises(DesignError, match=said.replace("(", "\\(")):
        read_readings(table, build.parts)

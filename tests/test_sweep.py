"""Studies: what is drawn, what is best, and tables that are the same whoever makes them."""

import json
import math
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
from by_night import by_night
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pydantic import Field
from typer.testing import CliRunner

from mechwright import Channel, DesignError, Family, Finding, Motion, Parameters, Scalar, Stage
from mechwright.cli.app import make_app
from mechwright.contracts.evaluation import Batch, one_by_one
from mechwright.plugins.host import host
from mechwright.sweep.draw import drawn
from mechwright.sweep.front import Front, around
from mechwright.sweep.pareto import front_of, spread
from mechwright.sweep.shard import read, shard_of
from mechwright.sweep.study import Asked, study_of
from mechwright.units import Degrees, Millimetres

ROOT = Path(__file__).parents[1]


class Inner(Parameters):
    """A table in the table."""

    width: Millimetres = Field(1.0, ge=0, le=50, description="A width.")


class BowlParams(Parameters):
    """A bowl: x² and (x - 2)² are to be small at once, which x in [0, 2] is best at."""

    x: float = Field(1.0, ge=-10, le=10, description="A number.")
    teeth: int = Field(10, ge=5, le=20, description="A whole number.")
    tilt: Degrees = Field(0.0, ge=-90, le=90, description="An angle.")
    shape: str = Field("round", description="A name.")
    inner: Inner = Field(Inner(), description="A table.")


class Bowl(Family[BowlParams]):
    name, title, summary = "bowl", "Bowl", "A closed form."
    Params = BowlParams
    batch: ClassVar[int] = 64

    def check(self, params):
        if params.x > 3:
            return [Finding.error("bowl.deep", "x", "is too deep", stage=Stage.PARTS)]
        return []

    def solve(self, params, samples):
        angle = np.linspace(0, math.tau, samples)
        turning = Channel(params.x * np.sin(angle), "rad")
        return Motion(
            "angle",
            {"angle": Channel(angle, "rad"), "swing": turning},
            scalars={"left": Scalar(params.x**2, "mm"), "right": Scalar((params.x - 2) ** 2, "mm"),
                     "lean": Scalar(math.radians(params.tilt), "rad")},
        )  # fmt: skip

    def parts(self, params):
        return []


BOWL = Bowl()


@dataclass
class OneFamily:
    """The host, with one family more."""

    own: Family

    def of(self, contract):
        return {**host().of(contract), "bowl": None} if contract is Family else host().of(contract)

    def family(self, name):
        return self.own


def study(**changed):
    table = {
        "count": 300,
        "ranges": {"x": {"least": -4, "greatest": 6}},
        "objectives": {"left": "least", "right": "least"},
        **changed,
    }
    content = {"family": "bowl", "study": {key: value for key, value in table.items() if value is not None}}
    return study_of(content, Path("bowl.toml"), OneFamily(BOWL))


@given(arrays(float, st.tuples(st.integers(0, 60), st.integers(1, 4)), elements=st.integers(0, 6).map(float)))
@settings(max_examples=100, deadline=None)
def test_the_front_is_what_nothing_dominates(costs):
    def dominated(k):
        return any((one <= costs[k]).all() and (one < costs[k]).any() for one in costs)

    assert front_of(costs).tolist() == [k for k in range(len(costs)) if not dominated(k)]


def test_designs_without_a_number_are_in_no_front():
    costs = np.array([[1.0, np.nan], [2.0, 2.0], [np.inf, 0.0]])
    assert front_of(costs).tolist() == [1]
    assert front_of(np.empty((0, 2))).tolist() == []


def test_large_fronts_are_found_in_blocks():
    x = np.random.default_rng(1).permutation(3000) / 3000
    assert front_of(np.column_stack([x, 1 - x])).size == 3000
    assert front_of(np.column_stack([x, x])).tolist() == [int(np.argmin(x))]


def test_what_is_shown_of_a_front_are_its_ends_and_what_is_far_from_them():
    x = np.linspace(0, 1, 11)
    chosen = spread(np.column_stack([x, 1 - x]), 3)
    assert sorted(chosen) == [0, 5, 10]
    assert spread(np.empty((0, 2)), 3) == []


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube", "random"])
def test_the_same_number_gives_the_same_designs(method):
    asked = study(method=method, count=150)
    one, two = drawn(asked, 1), drawn(asked, 1)
    assert len(one) == 64
    assert len(drawn(asked, 2)) == 150 - 128
    assert (one["x"] == two["x"]).all()
    assert not np.intersect1d(one["x"], drawn(asked, 0)["x"]).size
    assert one["x"].min() >= -4
    assert one["x"].max() <= 6
    assert (drawn(study(method=method, count=150, seed=2), 1)["x"] != one["x"]).any()


def test_sobol_and_hypercube_fill_their_range_evenly():
    for method in ("sobol", "latin-hypercube"):
        x = drawn(study(method=method, count=64), 0)["x"]
        assert sorted(np.floor((x + 4) / 10 * 64).astype(int)) == list(range(64))


def test_a_grid_holds_each_design_once():
    ranges = {
        "x": {"least": 0, "greatest": 0.3, "step": 0.1},
        "teeth": {"least": 8, "greatest": 12, "step": 2},
        "inner": {"width": {"least": "1 cm", "greatest": 30, "count": 3}},
        "shape": {"values": ["round", "square"]},
    }
    asked = study(method="grid", count=1000, ranges=ranges, batch=7)
    assert asked.count == 4 * 3 * 3 * 2
    found = [
        tuple(row)
        for number in range(asked.batches)
        for row in zip(*(drawn(asked, number)[axis.name].tolist() for axis in asked.axes), strict=True)
    ]
    assert len(set(found)) == len(found) == asked.count
    assert found[0] == (0.0, 8, 10.0, "round")
    assert found[-1] == (0.3, 12, 30.0, "square")
    assert {x for x, *_ in found} == {0.0, 0.1, 0.2, 0.3}


def test_equal_ratios_and_whole_numbers():
    asked = study(
        ranges={"x": {"least": 0.01, "greatest": 1, "log": True}, "teeth": {"least": 8, "greatest": 11}}
    )
    batch = drawn(asked, 0)
    assert np.mean(batch["x"] < 0.1) == pytest.approx(0.5, abs=0.05)
    assert set(batch["teeth"].tolist()) == {8, 9, 10, 11}
    assert isinstance(batch.one(0).teeth, int)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"ranges": {"y": {"least": 0, "greatest": 1}}}, "study.ranges.y: unknown parameter 'y'"),
        (
            {"ranges": {"x": {"least": 0, "greatest": 11}}},
            "study.ranges.x.greatest: 11.0: input should be less",
        ),
        ({"ranges": {"x": {"least": 1, "greatest": 1}}}, "least has to be smaller"),
        ({"ranges": {"x": {"least": 0}}}, "needs least and greatest, or values"),
        ({"ranges": {"x": {"least": 0, "greatest": 1, "step": 0}}}, "has to be more than 0"),
        ({"ranges": {"x": {"least": -1, "greatest": 1, "log": True}}}, "equal ratios need more than 0"),
        ({"ranges": {"shape": {"least": "a", "greatest": "b"}}}, "give its values"),
        ({"ranges": {}}, "varies at least one parameter"),
        ({"method": "grid"}, "a grid needs a count, a step or values"),
        (
            {"method": "grid", "count": 5, "ranges": {"x": {"least": 0, "greatest": 1, "count": 6}}},
            "the grid has 6 designs and the count is 5",
        ),
        ({"count": 1 << 33}, "Sobol has 4,294,967,296 points"),
        ({"objectives": {"lefft": "least"}}, "unknown column 'lefft'; did you mean 'left'?"),
        ({"objectives": {"left": "small"}}, 'none of "least" and "greatest"'),
        ({"constraints": {"left": {"at_least": 2, "at_most": 1}}}, "nothing is at least 2 and at most 1"),
        ({"constraints": {"left": 3}}, "write { at_least = ... }"),
        ({"constraints": {"lean": {"at_most": "3 kg"}}}, "cannot be read in deg"),
        ({"columns": ["speed"]}, "study.columns: unknown column"),
        ({"refine": 1, "objectives": {}}, "needs objectives"),
    ],
)
def test_what_a_study_cannot_ask_for_is_one_line(changed, said):
    with pytest.raises(DesignError) as caught:
        study(**changed)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_columns_are_those_of_solve_with_angles_in_degrees():
    asked = study(
        ranges={"x": {"least": -4, "greatest": 6}, "tilt": {"least": -90, "greatest": 90}},
        columns=["lean", "swing.greatest"],
        constraints={"lean": {"at_most": "0.5 rad"}},
    )
    assert asked.units == {
        "x": "", "tilt": "deg", "lean": "deg", "left": "mm", "right": "mm", "swing.greatest": "deg",
    }  # fmt: skip
    (bound,) = asked.bounds
    assert bound.high == pytest.approx(math.degrees(0.5))
    batch = drawn(asked, 0)
    found = asked.family.evaluate(batch, asked.measured)
    free = found.forbidden == 0
    assert np.allclose(found.values["lean"][free], batch["tilt"][free])
    assert np.allclose(found.values["left"][free], batch["x"][free] ** 2)
    assert np.allclose(found.values["swing.greatest"][free], np.degrees(np.abs(batch["x"][free])))
    assert found.counts == {"bowl.deep": int((batch["x"] > 3).sum())}
    assert np.isnan(found.values["left"][~free]).all()


def test_what_a_table_refuses_is_forbidden_by_its_key():
    class Picky(BowlParams):
        teeth: int = Field(10, ge=8, le=20, description="A whole number.")

    batch = Batch(Picky, {}, {"x": np.array([0.0, 1.0]), "teeth": np.array([5, 9])})
    found = one_by_one(BOWL.judge, BOWL.solve, batch, ("left",), Stage.PARTS)
    assert [found.codes[code] for code in found.forbidden] == ["parameters.teeth", ""]
    assert (
        one_by_one(
            BOWL.judge, BOWL.solve, Batch(BowlParams, {}, {"x": np.array([5.0])}), (), Stage.MOTION
        ).counts
        == {}
    )


def test_refinement_stays_in_its_ranges_and_finds_what_is_known_to_be_best():
    asked = study(count=64, ranges={"x": {"least": -4, "greatest": 6}, "teeth": {"least": 5, "greatest": 20}})
    front = Front(asked)

    def take(first, batch):
        found = asked.family.evaluate(batch, asked.measured)
        free = found.forbidden == 0
        values = {name: batch[name] for name in batch.varied} | dict(found.values)
        front.take(
            {"design": np.arange(first, first + len(batch))[free]} | {k: v[free] for k, v in values.items()}
        )

    take(0, drawn(asked, 0))
    before = len(front)
    for number in range(3):
        values = around(front, number, spread(front.costs, 12))
        assert values["x"].min() >= -4
        assert values["x"].max() <= 6
        assert set(values["teeth"].tolist()) <= set(range(5, 21))
        known = {(x, n) for x, n in zip(front.columns["x"], front.columns["teeth"], strict=True)}
        assert not known & set(zip(values["x"], values["teeth"], strict=True))
        take(1000 * (number + 1), Batch(BowlParams, {}, values))
    x = front.columns["x"]
    assert len(front) > 5 * before
    assert x.min() > -0.01  # the front in closed form, but for gaps of what was drawn
    assert x.max() < 2.01
    assert x.min() < 0.02
    assert x.max() > 1.98
    assert np.allclose(np.sqrt(front.costs).sum(axis=1), 2.0, atol=0.03)


def test_texts_that_are_varied_come_to_the_front(tmp_path):
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    asked = study(ranges={"x": {"least": -4, "greatest": 6}, "shape": {"values": ["round", "flat"]}})
    table = read(shard_of(asked, drawn(asked, 0), 0))
    front = Front(asked)
    front.take(table)
    assert {front.design(place)["shape"] for place in range(len(front))} <= {"round", "flat"}
    assert set(table["shape"].tolist()) == {"round", "flat"}
    values = around(front, 0, list(range(len(front))))
    assert Batch(BowlParams, {}, values).one(0).shape in {"round", "flat"}


def test_the_front_of_a_study_contains_the_known_optimum(tmp_path):
    """A pair's acceleration grows with its eccentricity, its size with the semi-major axis: one corner is best."""
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    content = {
        "family": "elliptic-gears",
        "study": {
            "method": "grid",
            "count": 20000,
            "ranges": {
                "eccentricity": {"least": 0.2, "greatest": 0.5, "count": 16},
                "semi_major": {"least": 40, "greatest": 60, "count": 11},
                "teeth": {"values": [25, 27, 29]},
            },
            "constraints": {"ratio_max": {"at_least": 2.0}},
            "objectives": {"alpha4_max": "least", "centre_distance": "least"},
        },
    }
    asked = study_of(content, Path("pairs.toml"), host())
    front = Front(asked)
    for number in range(asked.batches):
        front.take(read(shard_of(asked, drawn(asked, number), number * asked.batch)))
    # (1 + e)/(1 - e) is at least 2 from e = 1/3 on; 0.34 is the next of the grid
    assert {round(front.design(place)["eccentricity"], 9) for place in range(len(front))} == {0.34}
    assert {front.design(place)["semi_major"] for place in range(len(front))} == {40.0}
    e = 0.34
    cos = (-(1 + e * e) + math.sqrt((1 + e * e) ** 2 + 32 * e * e)) / (4 * e)
    ratio = 2 * e * (1 - e * e) * math.sqrt(1 - cos * cos) / (1 + e * e - 2 * e * cos) ** 2
    assert np.allclose(front.columns["alpha4_max"], ratio * (60 * math.tau / 60) ** 2, rtol=1e-12)


TEXT = """
family = "slider-crank"
name = "strokes"
[study]
count = 24
batch = 8
stage = "motion"
front = 0
{more}
[study.ranges]
crank = {{ least = 20, greatest = 40 }}
rod = {{ least = 60, greatest = 160 }}
[study.objectives]
stroke = "greatest"
least_transmission_angle = "greatest"
"""


def swept(folder, *more, text=""):
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    path = folder.parent / "strokes.toml"
    path.write_text(TEXT.format(more=text))
    return CliRunner().invoke(make_app(), ["sweep", str(path), "-o", str(folder), *more])


def bytes_of(folder):
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_a_sweep_that_was_stopped_goes_on_to_the_same_bytes(tmp_path):
    done = swept(tmp_path / "one", "--workers", "1", "--json")
    assert done.exit_code == 0, done.output
    said = json.loads(done.stdout)
    assert said["counts"]["designs"] == 24
    before = bytes_of(tmp_path / "one")
    assert {"front.parquet", "manifest.json", "study.html", "study.json", "summary.json"} <= set(before)
    assert sum(name.startswith("tables/") for name in before) == 3
    (tmp_path / "one" / "tables" / "part-000001.parquet").unlink()
    (tmp_path / "one" / "tables" / "part-000002.part").write_bytes(b"torn")
    (tmp_path / "one" / "summary.json").unlink()
    assert swept(tmp_path / "one", "--workers", "1").exit_code == 0
    assert bytes_of(tmp_path / "one") == before
    other = swept(tmp_path / "one", text="seed = 2")
    assert other.exit_code == 1
    assert "holds the sweep of another study (study)" in str(other.exception)


def test_a_study_in_which_nothing_is_allowed_says_what_forbids(tmp_path):
    constraint = "[study.constraints]\nstroke = { at_least = 1000 }"
    done = swept(tmp_path / "none", "--workers", "1", text="columns = []\n" + constraint)
    assert done.exit_code == 1
    assert "no design is allowed: [constraint.stroke] forbids 24 of 24" in done.stderr
    assert "No design is allowed" in (tmp_path / "none" / "study.html").read_text()


def test_a_folder_of_somebody_else_is_left_alone(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear")
    done = swept(tmp_path / "mine")
    assert done.exit_code == 1
    assert "holds files that this program has not written" in str(done.exception)
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["letter.txt"]


@by_night
def test_processes_make_the_same_bytes_as_one(tmp_path):
    assert swept(tmp_path / "one", "--workers", "1").exit_code == 0
    assert swept(tmp_path / "two", "--workers", "2").exit_code == 0
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")


@pytest.fixture
def cluster(tmp_path):
    pytest.importorskip("distributed", reason="pip install 'mechwright[scale]'")
    started = []

    def start(*words):
        command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:]]
        with (tmp_path / f"log-{len(started)}").open("wb") as out:
            started.append(subprocess.Popen(command, stdout=out, stderr=out, start_new_session=True))
        return started[-1]

    yield start
    for process in started:
        process.terminate()
    for process in started:
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def scheduler_of(cluster, port):
    return cluster(
        "dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard", "--no-show"
    )


def worker_of(cluster, port, folder):
    return cluster(
        "dask_worker", f"tcp://127.0.0.1:{port}", "--host", "127.0.0.1", "--nthreads", "1", "--no-nanny",
        "--no-dashboard", "--local-directory", str(folder), "--death-timeout", "60",
    )  # fmt: skip


@by_night
def test_a_cluster_makes_the_same_bytes_though_a_worker_is_killed_and_the_scheduler_ends(tmp_path, cluster):
    assert swept(tmp_path / "one", "--workers", "1", text="keep = 'all'").exit_code == 0
    port = 20000 + os.getpid() % 20000
    first = scheduler_of(cluster, port)
    workers = [worker_of(cluster, port, tmp_path / name) for name in "ab"]
    path = tmp_path / "strokes.toml"
    command = [sys.executable, "-m", "mechwright", "sweep", str(path), "-o", str(tmp_path / "two")]
    running = subprocess.Popen(
        [*command, "--scheduler", f"tcp://127.0.0.1:{port}"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    tables = tmp_path / "two" / "tables"
    end = time.monotonic() + 120
    while not (tables.is_dir() and any(tables.iterdir())) and time.monotonic() < end:
        time.sleep(0.05)
    workers[0].send_signal(signal.SIGKILL)
    first.kill()
    first.wait()
    scheduler_of(cluster, port)
    worker_of(cluster, port, tmp_path / "c")
    said, _ = running.communicate(timeout=240)
    assert running.returncode == 0, said.decode()
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")


@by_night
def test_an_address_where_nobody_answers_is_one_line(tmp_path):
    pytest.importorskip("distributed", reason="pip install 'mechwright[scale]'")
    done = swept(tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")
    assert done.exit_code == 1
    assert "nobody answers within 10 s" in str(done.exception)


def test_the_example_and_the_page_on_it_are_one_study():
    page = (ROOT / "docs" / "scale.md").read_text()
    shown = tomllib.loads(page.split("```toml\n")[1].split("```")[0])
    example = tomllib.loads((ROOT / "examples" / "four-bar-study.toml").read_text())
    for told in (shown, example):
        study_of(told, ROOT / "examples" / "four-bar-study.toml", host())
    assert {k: v for k, v in example["study"].items() if isinstance(v, dict)}.keys() == {
        k: v for k, v in shown["study"].items() if isinstance(v, dict)
    }.keys()
    named = {line.split("`")[1] for line in page.split("| key |")[1].split("\n\n")[0].splitlines()[2:]}
    assert named == set(Asked.model_fields)


@by_night
def test_the_example_gives_designs_that_build(tmp_path):
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    text = (ROOT / "examples" / "four-bar-study.toml").read_text()
    few, path = {"count": 256, "refine": 1, "front": 2}, tmp_path / "few.toml"
    for key, value in few.items():
        text = re.sub(rf"^{key} = \d+$", f"{key} = {value}", text, flags=re.M)
    path.write_text(text)
    done = CliRunner().invoke(make_app(), ["sweep", str(path), "-o", str(tmp_path / "out"), "--json"])
    assert done.exit_code == 0, done.output
    said = json.loads(done.stdout)
    assert said["front"] > 10
    written = [one for one in said["chosen"] if one["name"]]
    assert len(written) == 2
    for one in written:
        assert (
            CliRunner().invoke(make_app(), ["check", str(tmp_path / "out" / f"{one['name']}.toml")]).exit_code
            == 0
        )

"""Which processes could make each plate: able, refused or with a line more, with time and losses."""

import json
from pathlib import Path

import pytest

from mechwright.errors import DesignError
from mechwright.pipeline import Build
from mechwright.pipeline.process import Process
from mechwright.pipeline.process_options import options_sentence, options_table, process_options
from mechwright.plugins.host import Host, Registered, host

GENEVA = Path(__file__).parents[2] / "examples" / "geneva-straight.toml"


def design(tmp_path, head="", more="", **parameters):
    text = GENEVA.read_text(encoding="utf-8")
    for key, value in parameters.items():
        text = "\n".join(
            f"{key} = {value}" if line.startswith(f"{key} =") else line for line in text.splitlines()
        )
    file = tmp_path / "geneva.toml"
    file.write_text(f"{head}\n{text}\n{more}\n", encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def options():
    with Build(GENEVA, host()) as build:
        return {(one.part, one.process): one for one in process_options(build)}


def test_every_process_is_asked_of_every_plate(options):
    parts, processes = ({key[n] for key in options} for n in (0, 1))
    assert parts == {"wheel", "locking-disc", "crank"}
    assert {"mill", "laser", "waterjet", "plasma", "wire", "service", "print"} <= processes
    assert len(options) == len(parts) * len(processes)
    assert {name for _, name in (key for key in options if options[key].chosen)} == {"mill"}


def test_what_is_able_refused_or_needs_a_line(options):
    assert options["wheel", "wire"].able
    assert "bare metal" in options["wheel", "laser"].refused
    jet = options["crank", "waterjet"]  # holes of 2.6 mm in 6 mm
    assert not jet.able
    assert not jet.refused
    assert jet.remedies == ('set cut.small_holes = "spot"',)


def test_losses_name_fits_lengths_and_taper(options):
    assert options["locking-disc", "wire"].loses == (
        "6 H7 of bore: ± 0.025 mm",
        "3 H7 of dowel-1, dowel-2: ± 0.025 mm",
        "lengths ± 0.025 mm",
    )
    assert "taper up to 0.15 mm between the faces" in options["wheel", "waterjet"].loses
    assert options["wheel", "mill"].loses == ()
    assert options["wheel", "print"].loses[0].startswith("PLA in place of aluminium")


@pytest.mark.parametrize(("part", "proof"), [("wheel", 288), ("locking-disc", 631), ("crank", 254)])
def test_milling_is_estimated_without_a_program(options, part, proof):
    """Times of the proofs of these programs, s."""
    assert 0.6 * proof < options[part, "mill"].seconds < 1.3 * proof


def test_a_feed_that_nobody_has_given_is_no_time(options, tmp_path):
    assert options["wheel", "waterjet"].seconds is None
    lines = options_table(list(options.values()))
    for process, said in (
        ("waterjet", "by cut.feed"),
        ("wire", "by cut.wire_rate"),
        ("service", "by the service"),
    ):
        assert options["wheel", process].untimed == said
        line = next(line for line in lines if line.split()[:2] == ["wheel", process])
        assert said in line or "refused" in line
    with Build(design(tmp_path, more="[cut]\nfeed = 100\npierce = 6\npasses = 2"), host()) as build:
        found = {(one.part, one.process): one for one in process_options(build)}
        outline = next(part.outline for part in build.parts if part.name == "wheel")
    assert found["wheel", "waterjet"].untimed == ""
    wanted = 2 * (60 * outline.polygon().length / 100 + 2 * 6)
    assert found["wheel", "waterjet"].seconds == pytest.approx(wanted)


def test_a_wire_takes_the_time_of_the_area_of_its_walls(tmp_path):
    """600 mm² a minute over two passes; an inch is 25.4 mm."""
    times = []
    for rate in ("300", '"0.93 in^2/min"'):
        more = f"[cut]\nwire_rate = {rate}\npasses = 2"
        with Build(design(tmp_path, more=more), host()) as build:
            found = {(one.part, one.process): one for one in process_options(build)}
            part = next(part for part in build.parts if part.name == "wheel")
        times.append(found["wheel", "wire"].seconds)
    walls = part.outline.polygon().length * part.thickness
    assert times[0] == pytest.approx(2 * 60 * walls / 300)
    assert times[1] == pytest.approx(2 * 60 * walls / (0.93 * 645.16))


def test_a_plate_that_no_mill_reaches_is_not_milled(tmp_path):
    """A machine of 20 mm of travel; the wire makes the plates all the same."""
    file = design(tmp_path, 'process = "wire"', "[cam.machine]\ntravel_x = 20\ntravel_y = 20")
    with Build(file, host()) as build:
        found = {(one.part, one.process): one for one in process_options(build)}
    assert not found["wheel", "mill"].able
    assert found["wheel", "wire"].able
    assert found["wheel", "wire"].chosen


class Broken(Process):
    """Cannot obey a table."""

    name = "broken"
    title = "breaking"

    def refuses(self, part, build):
        raise DesignError("broken.key: no such file; write another")


def test_what_a_process_cannot_say_is_its_refusal():
    known = host().registered
    with Build(
        GENEVA,
        Host(
            {
                Process: {"broken": Registered(Broken(), "here", "broken")},
                **{kind: those for kind, those in known.items() if kind is not Process},
            }
        ),
    ) as build:
        found = process_options(build)
        assert {one.refused for one in found} == {"broken.key: no such file; write another"}
    assert "no other process" in options_sentence(found)


def test_the_table_has_what_is_chosen_first(options):
    lines = options_table(list(options.values()))
    assert lines[0].split()[:3] == ["part", "process", "time"]
    assert lines[1].split()[:2] == ["wheel", "mill*"]
    assert "refused: CO2 laser must not cut" in next(line for line in lines if "laser" in line)
    assert options_sentence(list(options.values())).startswith(
        "all plates could also be made by print or wire"
    )


def test_check_says_it_in_json_with_figures_and_where_a_process_is_named(tmp_path, command_line):
    plain = design(tmp_path)
    _, out, _ = command_line("check", plain)
    assert "all plates could also" not in out
    _, out, _ = command_line("check", plain, "--json")
    rows = json.loads(out)["processes"]
    assert {
        "part",
        "process",
        "chosen",
        "able",
        "refused",
        "remedies",
        "seconds",
        "loses",
        "untimed",
    } == rows[0].keys()
    _, out, _ = command_line("check", plain, "--json", "--to", "parts")
    assert "processes" not in json.loads(out)
    named = design(tmp_path, 'process = "wire"')
    _, out, _ = command_line("check", named)
    assert "all plates could also be made by mill or print; check --figures" in out
    _, out, _ = command_line("check", named, "--figures")
    assert "wheel         wire*" in out

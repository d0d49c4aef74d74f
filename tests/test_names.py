"""Names that meet: of a design, its parts and bodies, its nests, and the files of all of them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.cli.orders import into
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.file_names import DEVICES, file_key, name_fault
from mechwright.contracts.finding import Stage, errors
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part, check_name, name_from
from mechwright.contracts.surroundings import Surroundings
from mechwright.contracts.table import Table
from mechwright.designs.design import load
from mechwright.errors import DesignError, GeometryError, OutputError
from mechwright.geometry import Loop, Outline
from mechwright.output.folder import Output, distinct_files
from mechwright.pipeline import WORK, Build, FileName, Page, Wanted
from mechwright.pipeline.file_names import FileNames, files_of
from mechwright.plugins.host import host
from mechwright.scripting.mechanism import Mechanism
from mechwright.testing.names import design_names, name_faults, writing_faults
from mechwright_cad.bodies import assembly_name, bodies_of
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.siemens_840d import LONGEST_NAME, program_identifier

EXAMPLES = Path(__file__).parents[1] / "examples"
NEST = 'format = 1\nfamily = "geneva"\nname = "indexer"\n[cam.nest]\nname = "{}"\nparts = ["wheel"]\n'
SQUARE = Outline(Loop.polygon([(0, 0), (9, 0), (9, 9), (0, 9)]))


def written(folder: Path, text: str) -> Path:
    file = folder / "design.toml"
    file.write_text(text)
    return file


def run(*arguments: object):
    return CliRunner().invoke(make_app(), [str(one) for one in arguments])


@pytest.mark.parametrize(
    ("family", "name"), [("geneva", "wheel"), ("elliptic-gears", "gear-2"), ("cam-follower", "cam")]
)
def test_a_design_may_be_called_like_its_body(tmp_path, family, name):
    file = written(tmp_path, f'format = 1\nfamily = "{family}"\nname = "{name}"\n')
    with Mechanism(load(file, host()), host(), Wanted("model")) as build:
        assert not errors(FileNames().findings(build))
        whole = build.assembly
    assert whole.name == f"{name}-assembly"
    assert name in [child.name for child in whole.children]


def test_model_writes_a_design_that_is_called_like_its_body(tmp_path):
    file = written(tmp_path, 'format = 1\nfamily = "geneva"\nname = "wheel"\n')
    done = run("model", file, "-o", tmp_path / "out", "--also", "glb,mjcf")
    assert done.exit_code == 0, done.output
    text = (tmp_path / "out" / "assembly.step").read_text()
    assert "PRODUCT('wheel-assembly'" in text
    assert "PRODUCT('wheel'" in text


def motion(*names: str) -> Motion:
    still = Poses(np.zeros((2, 3)), np.tile(np.eye(3), (2, 1, 1)))
    return Motion("time", {"time": Channel(np.arange(2.0), "s", "time")}, dict.fromkeys(names, still), {})


def test_bodies_of_the_assembly_keep_apart_whatever_they_are_called():
    part = [Part(name, SQUARE, 3.0, "steel", (Instance("a"), Instance("a"))) for name in ("p", "p-2")]
    other = Part("q", SQUARE, 3.0, "steel", (Instance("a-p"), Instance("a-p-3")))
    names = [body.name for body in bodies_of([*part, other], motion("a", "a-p", "a-p-3"))]
    assert names == ["a-p-2", "a-p-4", "a-p-2-2", "a-p-2-3", "a-p", "a-p-3"]
    bodies = bodies_of(
        [Part("q", SQUARE, 3.0, "steel", (Instance("w"), Instance("w-assembly")))], motion("w", "w-assembly")
    )
    assert [assembly_name(name, bodies) for name in ("w", "other")] == ["w-assembly-2", "other"]


@pytest.mark.parametrize("name", ["roller", "assembly-drawing"])
def test_a_nest_whose_files_are_those_of_something_else_is_refused_by_check(tmp_path, name):
    file = written(tmp_path, NEST.format(name))
    done = run("check", file)
    assert done.exit_code == 1
    said = [line for line in done.output.splitlines() if line.startswith("error")]
    assert len(said) == 1
    assert f"would both be written as {name}.dxf" in said[0]
    assert f'set cam.nest.name = "{name}-nest" (now "{name}")' in said[0]


def test_a_nest_that_is_called_like_a_part_is_refused_with_another_name(tmp_path):
    file = written(tmp_path, NEST.format("wheel"))
    with Mechanism(load(file, host()), host(), Wanted("check")) as build:
        (found,) = errors(build.check())
    assert (found.parameter, found.fix) == ("cam.nest.name", {"cam.nest.name": "wheel-nest"})
    assert found.stage is Stage.MACHINING


def test_a_plate_may_be_called_like_the_assembly_or_a_device(tmp_path):
    drawing = (EXAMPLES / "nema-17-plate.dxf").read_bytes()
    for name, part in (("assembly", "assembly"), ("Con", "con-1"), ("setup", "setup")):
        (tmp_path / f"{name}.dxf").write_bytes(drawing)
        text = f'format = 1\nfamily = "plate"\nname = "bench"\n[parameters]\ndrawing = "{name}.dxf"\n'
        build = Build(load(written(tmp_path, text), host()), host(), Wanted("model"))
        assert build.parts.names == (part,)
        assert not errors(FileNames().findings(build))
    names = [one.name for one in files_of(build, Wanted("build"))]
    assert len(set(map(file_key, names))) == len(names)


class Twin(Table[None]):
    name = "twin-of-a-test"

    def read(self, content, path):
        return None

    def text(self, value=None):
        return []

    def surroundings(self, value, family, params):
        return Surroundings((Part("wheel", SQUARE, 3.0, "steel"),))


def test_a_part_beside_the_mechanism_has_a_name_of_its_own(tmp_path):
    design = load(written(tmp_path, 'format = 1\nfamily = "geneva"\n'), host())
    both = replace(design, readers=(*design.readers, Twin()), tables={**design.tables, Twin.name: None})
    with pytest.raises(GeometryError, match="part 'wheel' stands in the mechanism and around it"):
        both.parts()


@pytest.mark.parametrize("name", ["Wheel", "WHEEL", "wheel.", "wh eel", "we\u0301"])
def test_a_name_that_no_file_has_everywhere_is_refused_with_one_that_has(tmp_path, name):
    file = written(tmp_path, f'format = 1\nfamily = "geneva"\nname = "{name}"\n')
    with pytest.raises(DesignError, match="cannot be a file name") as told:
        load(file, host())
    other = str(told.value).rpartition('such as "')[2].rstrip('"')
    assert "\n" not in str(told.value)
    assert load(written(tmp_path, file.read_text().replace(name, other)), host()).name == other


def test_a_name_of_any_length_is_refused_in_a_short_line():
    with pytest.raises(DesignError, match=r"name 'a{64}'\.\.\. \(1,000,000 characters\) cannot be") as told:
        check_name("a" * 1_000_000)
    assert len(str(told.value)) < 300


class Listing(Page):
    name = "listing-of-a-test"
    commands = frozenset({"model"})

    def names(self, build, wanted):
        return [FileName("Wheel.STEP", "the listing")]

    def files(self, build):
        return {"Wheel.STEP": "no step"}


def test_files_that_differ_in_case_alone_are_refused_before_work(tmp_path, monkeypatch):
    known = type(host()).all
    monkeypatch.setattr(
        type(host()), "all", lambda self, kind: [*known(self, kind), *([Listing()] if kind is Page else [])]
    )
    file = written(tmp_path, 'format = 1\nfamily = "geneva"\nname = "indexer"\n')
    for command in ("check", "model"):
        build = Build(load(file, host()), host(), Wanted(command))
        (found,) = errors(FileNames().findings(build), Stage.ASSEMBLY)
        assert "part wheel and the listing would both be written as" in found.message
        assert found.remedy == "rename the listing"
    assert not FileNames().findings(Build(load(file, host()), host(), Wanted("cam")))


@pytest.mark.parametrize("name", ["gear.STEP", "GEAR.step", "gear.step.", "g\u0065ar.step"])
def test_no_file_takes_the_place_of_another(name):
    output = Output({"gear.step": b""})
    with pytest.raises(OutputError, match=r"would be one|no plain file name"):
        output.add(name, "x")
    with pytest.raises(OutputError):
        distinct_files([("gear.step", "a"), (name, "b")])


def test_accents_written_in_two_ways_are_one_file(tmp_path):
    output = Output({"\u00e9.txt": b""})
    with pytest.raises(OutputError, match="would be one"):
        output.add("e\u0301.txt", "x")
    with pytest.raises(DesignError, match="would both be written into"):
        into([tmp_path / "\u00e9.toml", tmp_path / "e\u0301.toml"], tmp_path)


@pytest.mark.parametrize("name", ["manifest.json", "Manifest.JSON"])
def test_the_manifest_is_no_file_of_a_page(name):
    with pytest.raises(OutputError, match=r"'manifest.json' and .* would be one"):
        Output().add(name, "x")


def test_devices_are_names_of_nothing():
    for device in DEVICES:
        assert "device" in name_fault(f"{device.upper()}.step")
        assert check_name(name_from(device, "design"))
        with pytest.raises(
            DesignError, match="that of a device" if device.isalnum() and device.isascii() else "cannot be"
        ):
            check_name(device)


def test_programs_of_siemens_have_names_that_it_takes():
    names = (
        "driver-locking-disc-underside",
        "driver-locking-disc-underside-2",
        "a" * 64,
        "1-" + "b" * 40,
        "gear-1",
    )
    found = [program_identifier(name) for name in names]
    assert max(map(len, found)) == LONGEST_NAME
    assert len({one.casefold() for one in found}) == len(names)
    assert all(one[:2].isalpha() or one[:3] == "P_1" for one in found)
    assert found[-1] == "gear_1"


@pytest.mark.parametrize("name", sorted(host().of(Control)))
def test_files_of_programs_are_named_before_they_are_planned(tmp_path, name):
    text = f'format = 1\nfamily = "plate"\nname = "sample"\n[cam]\ncontrol = "{name}"\n'
    with Build(load(written(tmp_path, text), host()), host(), Wanted("cam")) as build:
        pages = [page for page in host().all(Page) if "cam" in page.commands]
        for page in pages:
            named = {one.name for one in page.names(build, build.wanted)}
            assert set(page.files(build)) <= named, page.name


BY_DAY = ("geneva-straight", "geneva-behind-gears", "noncircular-lobes", "nema-17-plate")
DESIGNS = sorted(
    path
    for path in [*EXAMPLES.glob("*.toml"), *(EXAMPLES / "chains").glob("*.toml")]
    if not path.stem.endswith(("-requirement", "-study"))
)


@pytest.mark.parametrize(
    "path", [pytest.param(one, marks=() if one.stem in BY_DAY else by_night, id=one.stem) for one in DESIGNS]
)
def test_an_example_may_have_any_name(path):
    design = load(path, host())
    names = design_names(design)
    assert name_faults(design, names) == []
    assert writing_faults(design, names, host().all(Exporter)) == []


@pytest.mark.parametrize(
    "path",
    [pytest.param(one, marks=() if one.stem in BY_DAY[2:] else by_night, id=one.stem) for one in DESIGNS],
)
def test_pages_write_what_they_have_named(path):
    with Build(load(path, host()), host(), Wanted("model", formats=("stl", "glb"))) as build:
        named = {one.name for one in files_of(build, build.wanted)}
        for page in [page for page in host().all(Page) if "model" in page.commands]:
            assert set(page.files(build)) <= named, page.name
    # A process besides milling brings a command of its own.
    assert set(WORK) <= {command for page in host().all(Page) for command in page.commands}

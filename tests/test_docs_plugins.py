"""Every contract has its section in the pages on plugins, which begins with a whole plugin that works."""

import importlib
import math
import pkgutil
import re
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest
import typer
from typer.testing import CliRunner

import mechwright
import mechwright_cad
import mechwright_cam
from mechwright import Build, Design, Host, Instance, Loop, Outline, Part, Plugin, Stage, Wanted, circle
from mechwright.contracts.finding import errors
from mechwright.contracts.fits import hole_fit
from mechwright.designs.design import load
from mechwright.plugins.host import HOOK

ROOT = Path(__file__).parents[1]
FRONT = ROOT / "docs" / "plugins.md"
PAGES = {
    page.relative_to(FRONT.parent).as_posix(): page.read_text(encoding="utf-8")
    for page in (FRONT, *sorted((FRONT.parent / "plugins").glob("*.md")))
}
"""The pages on plugins, from the folder of the first one."""
FOUND = [
    (name, page, text)
    for page, whole in PAGES.items()
    for name, text in re.findall(r"^## `(\w+)`: [^\n]+\n(.*?)(?=^## |\Z)", whole, re.M | re.S)
]
SECTIONS = {name: text for name, _, text in FOUND}
"""Contract to the text of its section."""
WHERE = {name: page for name, page, _ in FOUND}
"""Contract to the page that has its section."""
MOST = 2500
"""Words of a page on plugins."""
COMMON = {name for name in {**vars(Plugin), **Plugin.__annotations__} if not name.startswith("_")}
"""What every contract has, which the page says once."""


def contracts():
    for package in (mechwright, mechwright_cad, mechwright_cam):
        for item in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not item.name.endswith("__main__"):
                importlib.import_module(item.name)
    ours = ("mechwright.", "mechwright_cad.", "mechwright_cam.")
    return {cls for cls in Plugin.__subclasses__() if cls.__module__.startswith(ours)}


@cache
def example(contract):
    """The whole plugin at the head of a section, as a module."""
    return loaded(SECTIONS[contract], f"docs/{WHERE[contract]}, {contract}")


def loaded(text, where):
    """The whole plugin that a text has, as a module."""
    (code,) = (block for block in re.findall(r"^```python\n(.*?)^```$", text, re.M | re.S) if HOOK in block)
    module = ModuleType("example_of_" + re.sub(r"\W", "_", where).lower())
    exec(compile(code, where, "exec"), module.__dict__)  # noqa: S102 - our own pages
    return module


def hosted(*names):
    host = Host()
    for name in names:
        host.add(example(name), "the page on plugins", name.lower())
    assert [str(broken) for broken in host.broken] == []
    return host


@cache
def one(contract, cls):
    """The instance that the host makes of a class of an example."""
    (made,) = (
        item for item in hosted(contract).all(cls) if type(item).__module__ == example(contract).__name__
    )
    return made


@pytest.fixture
def flywheel():
    family = one("Family", mechwright.Family)
    design = Design("wheel", family, family.Params(), Path("wheel.toml"), "")
    with Build(design, Host(), Wanted(samples=5)) as build:
        yield build


def test_every_contract_has_its_section_with_an_example_that_the_host_takes():
    found = {cls.__name__: cls for cls in contracts()}
    assert {"Family", "Control", "Exporter", "Page", "Inspection", "Table", "Command"} <= found.keys()
    assert found.keys() == SECTIONS.keys()
    for name, cls in found.items():
        assert hosted(name).all(cls), f"the example of {name} registers none"


def test_every_section_stands_in_the_table_of_contracts():
    assert len(FOUND) == len(SECTIONS), "a contract has two sections"
    table = re.findall(r"^\| \[`(\w+)`\]\(([\w/.-]+)#", PAGES[FRONT.name], re.M)
    assert sorted(table) == sorted(WHERE.items())


def test_every_page_is_named_by_the_first_one_and_short():
    linked = set(re.findall(r"\((plugins/[\w-]+\.md)", PAGES[FRONT.name]))
    assert {FRONT.name, *linked} == PAGES.keys()
    assert [page for page, text in PAGES.items() if len(text.split()) > MOST] == []


def test_every_member_of_a_contract_is_in_its_section():
    missing = {
        f"{cls.__name__}.{name}"
        for cls in contracts()
        for name in {**vars(cls), **vars(cls).get("__annotations__", {})}
        if not (name.startswith("_") or re.search(rf"`{name}[`(]", SECTIONS[cls.__name__]) or name in COMMON)
    }
    assert missing == set()
    page = "\n".join(PAGES.values())
    assert sorted(name for name in COMMON if f"`{name}`" not in page and f"`{name}()`" not in page) == []


def test_the_family_moves_is_made_and_is_refused_where_it_has_to_be(flywheel):
    family = flywheel.design.family
    assert list(family.check(family.Params())) == []
    (fault,) = errors(family.check(family.Params(bore=72)))
    assert (fault.value, fault.remedy) == (4, "make bore at most 70")
    assert list(family.check(family.Params(bore=70))) == []
    assert flywheel.motion.channels["time"].values[-1] == pytest.approx(0.1)
    (part,) = flywheel.parts
    assert part.outline.area == pytest.approx(math.pi * (40**2 - (hole_fit(10, "H7").middle / 2) ** 2))


def test_the_control_spells_and_reads_its_own_words():
    from mechwright_cam.controls.contract import Control
    from mechwright_cam.machining import machine
    from mechwright_cam.testing import plate_job

    spruce = one("Control", Control)
    made = machine(plate_job(control="spruce"), spruce)
    assert "\nM108\n" in made.text
    assert made.proof.ok
    assert spruce.table_words("tool.tbl") == "Copy tool.tbl into the folder of the machine."


def test_the_operation_cuts_what_it_claims_and_its_program_is_proven():
    from mechwright_cam.controls.linuxcnc import LinuxCnc
    from mechwright_cam.machining import machine
    from mechwright_cam.operations.contract import Operation
    from mechwright_cam.planning import Assignments
    from mechwright_cam.setup.lay_out import make_job
    from mechwright_cam.shop.library import load_library
    from mechwright_cam.shop.settings import CamSettings

    square = Loop.polygon([(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)])
    hole = Loop((circle((0.0, 0.0), 3.0, clockwise=True),))
    part = Part("plate", Outline(square, (hole,)), 4.0, "aluminium")
    settings = CamSettings.model_validate({"operations": ["plunge"]})
    job = make_job(part, settings, [load_library().get("mill-6")])
    made = machine(job, LinuxCnc(), assignments=Assignments([one("Operation", Operation)]))
    assert "bore-1: plunge" in [cut.name for section in made.program.sections for cut in section.operations]
    assert made.proof.ok


def test_the_rule_refuses_what_is_too_fast():
    from mechwright import ProofError
    from mechwright_cam.controls.linuxcnc import LinuxCnc
    from mechwright_cam.machining import machine
    from mechwright_cam.proof import Rule
    from mechwright_cam.testing import plate_job

    rule = one("Rule", Rule)
    with pytest.raises(ProofError, match="our limit is F400; lower the feed"):
        machine(plate_job(), LinuxCnc(), rules=[rule])


def test_the_exporter_writes_the_contour(flywheel):
    contour = one("Exporter", mechwright.Exporter)
    lines = contour.part(flywheel.parts[0]).decode().splitlines()
    radii = [math.hypot(*map(float, line.split(","))) for line in lines]
    assert radii == pytest.approx([40] * len(lines), abs=1e-3)


@pytest.mark.parametrize("name", [FRONT.name, "for/plugin-author.md"])
def test_the_smallest_plugin_works(name, flywheel):
    text = (FRONT.parent / name).read_text(encoding="utf-8")
    module, host = loaded(text, f"docs/{name}"), Host()
    host.add(module, "the first page on plugins", "smallest")
    assert [str(broken) for broken in host.broken] == []
    (page,) = (page for page in host.all(mechwright.Page) if page.name == "part-names")
    assert page.files(flywheel) == {"parts.txt": "wheel\n"}


def test_the_page_tells_the_travels(flywheel):
    files = one("Page", mechwright.Page).files(flywheel)
    assert "angle,rad,0,6.28319\n" in files["travels.csv"]


def test_the_raw_stock_has_one_sheet_for_each_thickness(flywheel):
    sheets = one("RawStock", mechwright.RawStock)
    assert [blank.parts for blank in sheets.blanks(flywheel)] == [("wheel",)]
    disc = Outline(Loop((circle((0.0, 0.0), 40.0),)))
    sizes = {"one": 3.0, "two": 3.0, "thick": 5.0}
    flywheel._kept["parts"] = [Part(name, disc, size, "steel") for name, size in sizes.items()]
    assert [(blank.parts, blank.size[2]) for blank in sheets.blanks(flywheel)] == [
        (("one", "two"), 3.0),
        (("thick",), 5.0),
    ]


def test_the_result_is_made_of_a_build_by_its_name(flywheel):
    host = hosted("Result")
    with Build(flywheel.design, host) as build:
        rim, bores = build.parts[0].outline.outer, build.parts[0].outline.inner
        made = build.result("cutting-length")
    assert made > 0
    around = sum(math.sqrt(4 * math.pi * abs(loop.area)) for loop in (rim, *bores))
    assert made >= around * (1 - 1e-3), "a circle is the shortest way around an area"


def test_the_inspection_finds_what_is_too_heavy_and_nothing_else(flywheel):
    handling = one("Inspection", mechwright.Inspection)
    assert list(handling.findings(flywheel)) == []
    disc = Outline(Loop((circle((0.0, 0.0), 400.0),)))
    flywheel._kept["parts"] = [Part("disc", disc, 40.0, "steel", (Instance("disc"),))]
    (heavy,) = handling.findings(flywheel)
    assert heavy.message == "part disc has 20.1 dm³, the limit is 15"
    assert heavy.stage is Stage.MACHINING


def test_the_table_is_read_written_and_used(tmp_path):
    host = hosted("Family", "Table")
    table = host.get(mechwright.Table, "title-block")
    path = tmp_path / "wheel.toml"
    path.write_text('family = "flywheel"\n\n[title-block]\nauthor = "Ada"\n', encoding="utf-8")
    with Build(load(path, host), host) as build:
        files = host.get(mechwright.Page, "title-page").files(build)
    assert files == {"title.txt": "wheel, drawn by Ada, a4\n"}
    path.write_text("\n".join(['family = "flywheel"', *table.text()]), encoding="utf-8")
    assert load(path, host).tables["title-block"].author == ""
    path.write_text('family = "flywheel"\n[title-block]\nauthr = "Ada"\n', encoding="utf-8")
    with pytest.raises(
        mechwright.DesignError, match="title-block: unknown key 'authr'; did you mean 'author'"
    ):
        load(path, host)


def test_the_command_prints_what_it_says():
    app = typer.Typer()
    app.command("weigh")(one("Command", mechwright.Command).run)
    done = CliRunner().invoke(app, [str(ROOT / "examples" / "slider-crank-quick-return.toml")])
    assert done.exit_code == 0, done.output
    assert re.search(r"^rod: [\d.]+ g$", done.output, re.M)

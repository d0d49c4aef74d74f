"""Design files: what is read, and how every kind of mistake is refused in one line."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from pydantic import Field

from mechwright.contracts.family import Family
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.design import load
from mechwright.designs.text import template
from mechwright.errors import DesignError, MechwrightError, OutputError, PluginError
from mechwright.plugins.host import Host, Registered
from mechwright.units import Degrees, Millimetres
from mechwright_cam.shop.table import CamTable, settings_of


class DiscParams(Parameters):
    diameter: Millimetres = Field(40.0, gt=1, le=500, description="Diameter of the disc.")
    holes: int = Field(6, ge=0, le=24, description="Number of holes.")
    lead: Degrees = Field(0.0, ge=-90, le=90, description="First hole.")
    boss: Millimetres | None = Field(None, gt=0, le=100, description="Boss, if any.")


class Disc(Family[DiscParams]):
    name = "disc"
    title = "Disc"
    summary = "A disc."
    Params = DiscParams

    def solve(self, params: DiscParams, samples: int) -> Any:
        raise NotImplementedError

    def parts(self, params: DiscParams) -> list[Any]:
        return []


@pytest.fixture
def host() -> Host:
    return Host(
        {
            Family: {"disc": Registered(Disc(), "here", "disc")},
            Table: {"cam": Registered(CamTable(), "here", "cam")},
        }
    )


def write(folder: Path, text: str) -> Path:
    path = folder / "a.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_units_are_converted_and_defaults_filled(tmp_path: Path, host: Host) -> None:
    path = write(tmp_path, 'family = "disc"\n[parameters]\ndiameter = "2 in"\nlead = "0.5 rad"\n')
    design = load(path, host)
    assert design.name == "a"
    assert design.params.model_dump() == {
        "diameter": pytest.approx(50.8),
        "holes": 6,
        "lead": pytest.approx(28.64788975654116),
        "boss": None,
    }
    assert settings_of(design).cam.work_offset == "G54"


def test_the_template_is_a_design_file_with_the_defaults(tmp_path: Path, host: Host) -> None:
    text = template(Disc(), "disc", [CamTable()])
    design = load(write(tmp_path, text), host)
    assert design.params == DiscParams()
    assert "Diameter of the disc. (mm, above 1, at most 500)" in text
    tables = tomllib.loads(text)
    assert set(tables["cam"]) >= {"machine", "stock", "hold"}


PREFIX = 'family = "disc"\n'

MISTAKES = {
    "unknown key": (
        PREFIX + "[parameters]\ndiametr = 3\n",
        "parameters: unknown key 'diametr'; did you mean 'diameter'?",
    ),
    "unknown nested key": (
        PREFIX + "[cam.hold]\nmethd = 'bore'\n",
        "cam.hold: unknown key 'methd'; did you mean 'method'?",
    ),
    "unknown table": (PREFIX + "[camera]\n", "unknown key 'camera'; did you mean 'cam'?"),
    "wrong kind of unit": (
        PREFIX + "[parameters]\ndiameter = '3 kg'\n",
        "parameters.diameter: '3 kg' cannot be read in mm",
    ),
    "no number": (
        PREFIX + "[parameters]\ndiameter = 'wide'\n",
        "parameters.diameter: 'wide' cannot be read in mm",
    ),
    "out of bounds": (
        PREFIX + "[parameters]\nholes = 25\n",
        "parameters.holes: 25 should be less than or equal to 24",
    ),
    "bounds after conversion": (
        PREFIX + "[parameters]\ndiameter = '1 m'\n",
        "should be less than or equal to 500",
    ),
    "not finite": (PREFIX + "[parameters]\ndiameter = nan\n", "parameters.diameter:"),
    "true is no number": (
        PREFIX + "[parameters]\nholes = true\n",
        "parameters.holes: true is no number",
    ),
    "fraction of a count": (PREFIX + "[parameters]\nholes = 2.5\n", "parameters.holes: 2.5"),
    "no table": (PREFIX + "parameters = 3\n", "write a table [parameters]"),
    "broken TOML": ("family = \n", "is no valid TOML"),
    "no family": ("[parameters]\n", "family: is missing; name one of: disc"),
    "family is a number": ("family = 3\n", "family: 3 is no text; name one of: disc"),
    "other format": ("format = 7\n" + PREFIX, "format: 7 is not known"),
    "name leads away": (PREFIX + 'name = "../x"\n', "cannot be a file name"),
    "name is a path": (PREFIX + 'name = "a/b"\n', "cannot be a file name"),
    "library leads away": (PREFIX + "[cam]\ntool_library = '../t.toml'\n", "leads out of the folder"),
    "absolute library": (PREFIX + "[cam]\ntool_library = '/etc/passwd'\n", "leads out of the folder"),
    "library is no file name": (PREFIX + '[cam]\ntool_library = "a\\u0000"\n', "is no file: embedded null"),
    "work offset": (
        PREFIX + "[cam]\nwork_offset = 'G53'\n",
        "cam.work_offset: 'G53' should be G54 to G59",
    ),
    "no list": (PREFIX + "[cam]\ntools = 'mill-6'\n", "cam.tools: 'mill-6' should be a list"),
    "format is true": ("format = true\n" + PREFIX, "format: True is not known"),
    "control characters": (
        PREFIX + '[parameters]\ndiameter = "a\\nb\\u001b[31m"\n',
        "'a\\nb\\x1b[31m' cannot be read in mm",
    ),
}


@pytest.mark.parametrize(("text", "said"), MISTAKES.values(), ids=MISTAKES.keys())
def test_a_mistake_is_one_line_that_names_file_and_place(
    tmp_path: Path, host: Host, text: str, said: str
) -> None:
    path = write(tmp_path, text)
    with pytest.raises(DesignError) as caught:
        load(path, host)
    assert said in str(caught.value)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_two_mistakes_are_two_lines(tmp_path: Path, host: Host) -> None:
    with pytest.raises(DesignError) as caught:
        load(write(tmp_path, PREFIX + "[parameters]\nholes = -1\ndiameter = 0\n"), host)
    assert [line.split(": ")[1] for line in str(caught.value).splitlines()] == [
        "parameters.diameter",
        "parameters.holes",
    ]


def test_what_cannot_be_read_is_named(tmp_path: Path, host: Host) -> None:
    with pytest.raises(OutputError, match="cannot be read"):
        load(tmp_path / "none.toml", host)
    with pytest.raises(OutputError, match="cannot be read"):
        load(tmp_path, host)
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(DesignError, match="no UTF-8"):
        load(tmp_path / "binary.toml", host)
    (tmp_path / "huge.toml").write_bytes(b"#" * 1_000_001)
    with pytest.raises(DesignError, match="larger than"):
        load(tmp_path / "huge.toml", host)
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(DesignError, match="tool_library: 'loop' is no file"):
        load(write(tmp_path, PREFIX + "[cam]\ntool_library = 'loop'\n"), host)
    with pytest.raises(PluginError, match=r"a\.toml: family: family 'dsic' is not installed; known: disc"):
        load(write(tmp_path, 'family = "dsic"\n'), host)


def test_deep_nesting_is_refused_without_a_crash(tmp_path: Path, host: Host) -> None:
    with pytest.raises(MechwrightError):
        load(write(tmp_path, "x = " + "[" * 50_000 + "]" * 50_000), host)


def test_a_byte_order_mark_is_ignored(tmp_path: Path, host: Host) -> None:
    path = tmp_path / "bom.toml"
    path.write_bytes(b"\xef\xbb\xbf" + PREFIX.encode())
    assert load(path, host).params == DiscParams()


@pytest.mark.parametrize(
    ("stem", "name"),
    [("Pair m0.5", "pair-m0-5"), ("gear_2", "gear_2"), ("齿", "design"), ("x" * 80, "x" * 64)],
)
def test_a_design_without_a_name_gets_one_from_any_file(
    tmp_path: Path, host: Host, stem: str, name: str
) -> None:
    """The file was refused for a name that nobody had given."""
    path = tmp_path / f"{stem}.toml"
    path.write_text(PREFIX, encoding="utf-8")
    assert load(path, host).name == name

"""The tool table of LinuxCNC, ``tool.tbl``.

It has T, pocket, Z and D, in the units of the machine, which it does not name; what a tool is stands nowhere.
So the remark of a line says it, in the words of our own tables: its name, its kind, and ``key=value``::

    ;units=mm
    T24 P24 Z77.05 D6 ;mill-6 end-mill flutes=3 flute_length=24
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote, unquote

from mechwright.designs.files import read_text
from mechwright.designs.inches import FACTORS, Units, scaled
from mechwright.errors import DesignError
from mechwright_cam.shop.formats.contract import Format, OmittedToolError, ToolRecord, number, tool_number
from mechwright_cam.shop.tool import HOLLOW, Tool, ToolKind

UNITS = {"mm": 1.0, "in": 25.4, "inch": 25.4}
"""What ``;units=`` may say, to mm."""
LENGTHS = (
    "flute_length",
    "corner_radius",
    "tip_diameter",
    "neck_diameter",
    "pitch",
    "shank_diameter",
    "stick_out",
    "holder_diameter",
    "diameter",
    "length",
    "wear_length",
    "wear_diameter",
)
SWITCHES = ("centre_cutting", "left_hand", "floating")
"""Keys that are true or false."""
OF_TAPS = ("chamfer_length", "left_hand", "floating")
_LAST = ("diameter_offset", "centre_cutting", "substrate", "life")
OTHERS = ("flutes", "point_angle", "ramp_angle", *OF_TAPS, *_LAST)
"""Keys that a remark may say besides lengths, which are in the units of the table; the last go first where
the line ends."""
TEXTS = ("holder", "purpose", "coating")
"""Keys whose blanks are written as %20."""
ROW_OF = "d-of"
"""What a row says that holds a D offset, and no tool of its own: the T number of the tool."""
LETTERS = frozenset("TPXYZABCUVWDIJQ")
"""Words of a line; offsets of other axes than Z are not taken over."""
LINE = 250
"""Characters of a line that LinuxCNC reads."""
_WORD = re.compile(r"([A-Za-z])\s*([+-]?(?:\d+\.?\d*|\.\d+))")
_CURE = "write behind its semicolon what it is, such as ;mill-6 end-mill flutes=3 flute_length=24"


class LinuxCncTable(Format):
    """``tool.tbl``."""

    title = "a LinuxCNC tool table"
    suffixes = (".tbl",)
    fields = {"number": "T", "diameter": "D", "length": "Z"}  # noqa: RUF012 - as the contract has it

    def read(self, path: Path) -> list[ToolRecord]:
        """A tool for each line; raises DesignError where the table says no units."""
        text = read_text(path, older="latin-1")[0]
        lines = [(n, line.strip()) for n, line in enumerate(text.splitlines(), start=1) if line.strip()]
        heads = "\n".join(line for _, line in lines if line.startswith(";"))
        units = re.search(r"^;\s*units\s*=\s*(\S+)", heads, re.I | re.M)
        if units is None or units[1].lower() not in UNITS:
            raise DesignError(
                f"{path}: the table does not say its units, which are those of the machine; write ;units=mm "
                "or ;units=in as its first line"
            )
        scale = UNITS[units[1].lower()]
        rows = [(n, line) for n, line in lines if not line.startswith(";")]
        return [_said(path, n, line, scale) for n, line in rows if f" {ROW_OF}=" not in line]

    def files(self, tools: Sequence[Tool], path: Path) -> dict[Path, bytes]:
        """One table in mm, with the pocket of every tool's own number."""
        return {path: table_text(Row(tool.number, tool, tool.diameter) for tool in tools).encode()}


@dataclass(frozen=True)
class Row:
    """A row of the table: its number, the tool, and what its D holds, mm."""

    number: int
    tool: Tool
    d: float


def table_text(rows: Iterable[Row], units: Units = "mm") -> str:
    """The table of tools, by number, in the units of the machine; what it has no word for is in the remarks.

    A row of another number than its tool's holds a D offset, and is no tool when the table is read again.
    """
    scale = FACTORS["mm"] if units == "inch" else 1.0
    lines = [f";units={'in' if units == 'inch' else 'mm'}"]
    lines += [_line(row, scale) for row in sorted(rows, key=lambda row: row.number)]
    return "".join(line + "\n" for line in lines)


def _said(path: Path, place: int, line: str, scale: float) -> ToolRecord:
    body, _, remark = line.partition(";")
    words = {letter.upper(): value for letter, value in _WORD.findall(body)}
    if _WORD.sub("", body).strip() or "T" not in words or not words.keys() <= LETTERS:
        raise DesignError(f"{path}: line {place}: {line[:60]!r} is no tool; write T1 P1 Z0 D6 ;remark")
    said = ToolRecord(remark.strip() or f"line {place}")
    try:
        said.keys["number"] = tool_number(words["T"])
        if float(words.get("D", 0)) > 0:
            said.keys["diameter"] = scaled(float(words["D"]), scale)
        elif " diameter=" not in remark:
            raise OmittedToolError("has no diameter (D); write it into its line")
        if float(words.get("Z", 0)):
            said.keys["length"] = scaled(float(words["Z"]), scale)
        _remark(said, remark.split(), scale)  # what it says of both is without wear
    except OmittedToolError as error:
        said.fault = str(error)
    return said


def _remark(said: ToolRecord, words: list[str], scale: float) -> None:
    """What a remark says: a name, a kind, and ``key=value``; other words are for people."""
    named = dict(word.split("=", 1) for word in words if "=" in word)
    plain = [word for word in words if "=" not in word]
    kind = next((word for word in plain if word in set(ToolKind)), None)
    if kind is None or "flute_length" not in named:
        raise OmittedToolError(
            f"the table does not say its {'kind' if kind is None else 'flute_length'}; {_CURE}"
        )
    said.keys["kind"] = kind
    if plain[0] != kind:
        said.label = plain[0]
    for key, value in named.items():
        if key in LENGTHS:
            said.keys[key] = scaled(number(value) or 0.0, scale) if number(value) is not None else value
        elif key in SWITCHES:
            said.keys[key] = {"true": True, "false": False}.get(value, value)
        elif key in OTHERS:
            said.keys[key] = value
        elif key in TEXTS:
            said.keys[key] = unquote(value)
        else:
            raise OmittedToolError(f"unknown key {key!r}; one of {', '.join((*LENGTHS, *OTHERS, *TEXTS))}")


def _line(row: Row, scale: float) -> str:
    tool, value = row.tool, row.d
    line = f"T{row.number} P{row.number} Z{_word(tool.worn_length / scale)} D{_word(value / scale)}"
    line += f" ;{tool.name} {tool.kind}"
    if row.number != tool.number:
        return f"{line} {ROW_OF}={tool.number}"
    said = tool.model_dump(exclude_none=True)
    usual = {name: field.default for name, field in Tool.model_fields.items()}
    usual["centre_cutting"] = tool.kind not in HOLLOW
    if value == tool.diameter:
        usual["diameter"] = value
    if not tool.wear_length:
        usual["length"] = tool.length
    for key in (*LENGTHS, *OTHERS, *TEXTS):
        if key in said and said[key] != usual[key]:
            word = f" {key}={_spelt(key, said[key], scale)}"
            if len(line) + len(word) <= LINE:
                line += word
    return line


def _spelt(key: str, value: object, scale: float) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return quote(value, safe="")
    assert isinstance(value, (int, float))  # noqa: S101 - there are no others
    return _word(value / scale if key in LENGTHS else value)


def _word(value: float) -> str:
    """A number without an exponent, which LinuxCNC would not read, to a millionth of the unit."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text

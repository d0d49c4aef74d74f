"""Lists what controls read: ``python docs/control_words.py`` writes the tables of ``docs/controls.md``."""

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import groupby
from pathlib import Path

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.words import klartext, sinumerik
from mechwright_cam.controls.words.kept import Kept, Then
from mechwright_cam.controls.words.table import Address, Code, Use, Words

PAGE = Path(__file__).parent / "controls.md"
BEGIN, END = "<!-- words -->\n", "<!-- end of words -->\n"
NONE = "–"
THEN = {Then.REFUSED: "refused", Then.TOLD: "told", Then.RESET: "reset", Then.SHEET: "on the sheet"}


def controls() -> dict[str, GcodeControl]:
    """The built-in controls by name."""
    found = host().of(Control).items()
    return {name: one.item for name, one in found if isinstance(one.item, GcodeControl)}


def table_of(name: str, control: GcodeControl) -> Words:
    """A control's table in its own words."""
    own = {"siemens-840d": sinumerik.WORDS, "heidenhain-tnc": klartext.WORDS}
    return own.get(name, control.dialect.words).with_tools(control.highest_tool)


def page() -> str:
    """The page with its tables as the controls declare them."""
    text = PAGE.read_text(encoding="utf-8")
    return text.partition(BEGIN)[0] + BEGIN + tables() + END + text.partition(END)[2]


def tables() -> str:
    """All tables."""
    every = controls()
    words = {name: table_of(name, control) for name, control in every.items()}
    written = {name: table for name, table in words.items() if name != "heidenhain-tnc"}
    return "\n".join(
        [
            "### Codes and the words that they take\n",
            _codes(written),
            "### Blocks of Klartext\n",
            _blocks(),
            "### Blocks\n",
            _facts(written),
            "### Numbers\n",
            _numbers(words),
            "### Lines\n",
            _lines(every),
            "### States that outlive a program\n",
            _kept(every),
        ]
    )


def _rows(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(row)} |\n" for row in lines)


def _codes(words: dict[str, Words]) -> str:
    """Every code, with what it takes on each control; codes that are alike in one row."""
    names = {
        row.word for table in words.values() for row in table.known.values() if row.use is not Use.REFUSED
    }
    names |= {row.word for table in words.values() for row in table.known.values() if row.word[1:2].isdigit()}
    ordered = sorted(names, key=lambda word: (word[0] not in "GM", word[0], _number(word), word))
    cells = [(word, tuple(_cell(table.known.get(word)) for table in words.values())) for word in ordered]
    alike = groupby(sorted(cells, key=lambda one: (one[0][0], one[1])), key=lambda one: (one[0][0], one[1]))
    found = [([word for word, _ in group], row) for (_, row), group in alike]
    found.sort(key=lambda one: ordered.index(one[0][0]))
    return _rows(["code", *map(_code, words)], [[", ".join(_code(w) for w in ws), *row] for ws, row in found])


def _cell(row: Code | None) -> str:
    if row is None:
        return NONE
    if row.use is Use.REFUSED:
        return "refused"
    takes = " ".join((f"**{one}**" if one == row.needs or row.one_of == (one,) else one) for one in row.takes)
    takes = " or ".join(row.first_of) if row.first_of else takes
    if row.drops:
        return f"drops {' '.join(row.drops)}"
    return " ".join(filter(None, ["idle" if row.use is Use.IDLE else "", takes])) or "✓"


def _blocks() -> str:
    rows = [
        [_code(row.word), " ".join(row.takes) or NONE, " ".join(row.one_of) or NONE]
        for row in klartext.WORDS.known.values()
        if row.use in {Use.ONCE, Use.IDLE} and not row.word[1:].isdigit()
    ]
    return _rows(["block", "takes", "needs"], rows)


FACTS: tuple[tuple[str, Callable[[Words], bool]], ...] = (
    ("one M code in a block", lambda table: table.one_m),
    ("M7 beside M8", lambda table: not _same_group(table, "M7", "M8") and not table.one_m),
    ("two codes that take the axes are refused", lambda table: table.one_takes_axes),
    ("no axis word while G80 is in force", lambda table: table.axes_need_motion),
    ("G80 beside G0 to G3; behind it the earlier motion holds", lambda table: table.cycles_apart),
    ("G4 beside a motion is refused", lambda table: table.known["G4"].alone),
    ("M3 or M4 beside a feed is refused", lambda table: not table.known["M3"].before_feed),
    (
        "G28 while a cycle is in force is refused",
        lambda table: "G28" in table.known and not table.known["G28"].in_cycles,
    ),
    ("an arc names an axis of its plane", lambda table: table.known["G2"].ends_in_plane),
)


def _same_group(table: Words, one: str, other: str) -> bool:
    first, second = (table.known[word] for word in (one, other) if word in table.known)
    return bool(first.group) and first.group == second.group


def _facts(words: dict[str, Words]) -> str:
    rows = [[said, *("yes" if asked(table) else NONE for table in words.values())] for said, asked in FACTS]
    return _rows(["", *map(_code, words)], rows)


def _numbers(words: dict[str, Words]) -> str:
    letters = sorted(
        {one.letter for table in words.values() for one in table.numbers}, key=lambda one: (len(one), one)
    )
    rows = [[_code(letter), *(_range(table.of(letter)) for table in words.values())] for letter in letters]
    return _rows(["address", *map(_code, words)], rows)


def _range(one: Address) -> str:
    if not one.letter:
        return NONE
    bounds = "" if math.isinf(one.least) else f"from {one.least:,g}"
    if not math.isinf(one.most):
        bounds = f"{one.least:,.10g} to {one.most:,.10g}"
    point = {"free": "", "never": "no point", "needed": "point", "inches": "point in inches"}[one.point]
    return ", ".join(filter(None, [bounds, point])) or "any"


def _lines(every: dict[str, GcodeControl]) -> str:
    texts = {name: control.dialect.text for name, control in every.items()}
    texts["heidenhain-tnc"] = texts["heidenhain-tnc"]
    longest = [str(text.longest) for text in texts.values()]
    longest[list(texts).index("heidenhain-tnc")] = str(klartext.LONGEST)
    rows = [
        ["longest line", *longest],
        ["without comments and blanks", *("yes" if text.counts_code else NONE for text in texts.values())],
        ["`;` begins a comment", *("yes" if text.semicolon_comments else NONE for text in texts.values())],
        ["comments in ASCII", *("yes" if text.ascii_comments else NONE for text in texts.values())],
        ["capitals", *("yes" if text.capitals else NONE for text in texts.values())],
        ["digits of a number", *(str(text.digits or NONE) for text in texts.values())],
        ["O and a number begin it", *("yes" if text.program_numbers else NONE for text in texts.values())],
    ]
    return _rows(["", *map(_code, every)], rows)


def _kept(every: dict[str, GcodeControl]) -> str:
    states: dict[str, Kept] = {}
    for control in every.values():
        for one in control.dialect.kept:
            states.setdefault(one.name, one)
    rows = []
    for name, first in states.items():
        found = [next((one for one in c.dialect.kept if one.name == name), None) for c in every.values()]
        rule = f" (`{first.rule}`)" if first.rule else ""
        rows.append([f"{name}{rule}", first.words, *(THEN[one.then] if one else NONE for one in found)])
    return _rows(["state", "words", *map(_code, every)], rows)


def _code(text: str) -> str:
    return f"`{text}`"


def _number(word: str) -> float:
    digits = word[1:]
    return float(digits) if digits.replace(".", "", 1).isdigit() else math.inf


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")

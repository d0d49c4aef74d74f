"""Programs in Klartext, the language of HEIDENHAIN controls, in the words that the interpreter reads.

What is read says one thing whatever the machine and earlier programs have set; all else is refused by its
name. A line stays a line, so that what is found in the words is told by the line of the program.

Glossary
--------
CC
    Centre of the arcs that follow, and pole of polar coordinates.
FMAX
    Rapid, for its block alone.
preset
    Row of the preset table that cycle 247 puts in force: a work offset.
IPA, IZ
    Angle and height of a helix, from where the tool stands.
"""

import re
from collections.abc import Callable

from mechwright_cam.controls.reading.arcs import rotated
from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.klartext_labels import Labels
from mechwright_cam.controls.reading.klartext_words import (
    NAME,
    NUMBER,
    SMALLEST_TURN,
    check_length,
    dwell_of,
    functions_of,
    plain,
    refused,
    tolerance_of,
    turns_of,
    words_of,
    worked_out,
)
from mechwright_cam.controls.words.klartext import NO_CYCLE, WORDS

TENTHS = 10.0
"""Feeds of a program in inches are in tenths of an inch a minute."""
LAST_PRESET = int(WORDS.of("Q339").most)
"""The presets that a job's work offsets G54 to G59 are: rows 1 to 6."""
LARGEST_TURN = WORDS.of("IPA").most
"""The largest IPA that the control takes, degrees."""
HEAD = "G17 G90 G90.1 G94"
"""What holds at the start of every program, whatever ran before it; arcs have absolute centres here."""

_BLOCK = re.compile(r"\s*(\d+)(?:\s*(/)\s*|\s+|$)(.*)")
_BEGIN = re.compile(r"BEGIN PGM (\S+) (MM|INCH)")
_END = re.compile(r"END PGM (\S+) (MM|INCH)")
_FORM = re.compile(rf"BLK FORM 0\.([12])( Z)? X({NUMBER}) Y({NUMBER}) Z({NUMBER})")
_CALL = re.compile(rf"TOOL CALL(?: (\d+))?(?: ([XYZ]))?((?: (?:S|F|DL|DR)({NUMBER}))*)")
_CALL_WORD = re.compile(rf"(S|F|DL|DR)({NUMBER})")
_DEF = re.compile(r"TOOL DEF (\d+)")
_CYCL = re.compile(r"CYCL DEF (\d+)(?:\.(\d))?(?: (.*))?")
_DATUM = re.compile(r"(?:[A-Z][A-Z .-]*?)?(?: ?Q339 ?= ?([+]?\d+))?")
_CYCLE_NAME = re.compile(r"TOLERAN(CE|Z)|DWELL( TIME)?|VERWEILZEIT|")
_NAMED = re.compile(r"([A-Z]+)")
_ODD = re.compile(r"[^\t -~]")


def translated(text: str, block_delete: bool) -> str:
    r"""The program in words that the interpreter reads, as many lines.

    Raises
    ------
    ProgramError
        A block is not read, or says something only together with what the text does not say.

    Examples
    --------
    >>> program = "0 BEGIN PGM P MM\n1 TOOL CALL 3 Z S900\n2 L X+0 Y-2,5 R0 FMAX M3\n3 CC X+5 Y+0"
    >>> print(translated(program + "\n4 C X+5 Y+5 DR- F90\n5 M30\n6 END PGM P MM", False))
    G21 G17 G90 G90.1 G94
    T3 M6 G43 S900 G17
    G0 G40 X0 Y-2.5 M3
    <BLANKLINE>
    G2 X5 Y5 I5 J0 F90
    M30
    <BLANKLINE>
    """
    lines, reading = text.split("\n"), _Reading()
    for index, line in enumerate(lines):
        lines[index] = reading.line(index + 1, line, block_delete)
    reading.finish(len(lines))
    return "\n".join(lines)


class _Reading:
    """What the blocks of a program say together."""

    def __init__(self) -> None:
        self.expected = 0
        self.name = self.units = ""
        self.ended = self.closed = False
        self.joined: list[str] | None = None
        """Pieces of a block whose next line belongs to it."""
        self.skipped = False
        """Whether the block that goes on is skipped."""
        self.cycle: tuple[int, int] | None = None
        """A cycle of several blocks, and the part that has to come next."""
        self.axis = False
        """Whether a tool with its axis has been called, so that arcs have a plane."""
        self.labels = Labels()
        self.centre: tuple[str, str] | None = None
        self.place: dict[str, float | None] = dict.fromkeys("XYZ")
        """Where the tool stands, as the text says; None where it does not."""
        self.kinds: dict[str, Callable[[int, str], str]] = {
            "L": self._straight,
            "C": self._arc,
            "CR": self._arc,
            "CP": self._helix,
            "CC": self._pole,
            "BLK": self._form,
            "TOOL": self._tool,
            "CYCL": self._cycl,
            "STOP": self._stop,
            "END": self._end,
        }

    def line(self, number: int, text: str, block_delete: bool) -> str:
        """One line translated."""
        if not text.strip() and self.joined is None:
            return ""
        check_length(number, text)
        if self.closed:
            raise fail(number, "stands behind END PGM, where nobody reads it; take it out")
        code, mark, comment = text.partition(";")
        if match := _ODD.search(code):
            raise fail(number, f"{match[0]!r} is no character of a program; write ASCII")
        goes_on = text.rstrip().endswith("~")
        said = " " + mark + comment.rstrip().removesuffix("~") if mark else ""
        code = code.rstrip().removesuffix("~")
        if self.joined is None:
            deleted, code = self._numbered(number, code)
            if code.startswith("*"):
                if goes_on:
                    raise fail(number, "~ behind a heading; take it out")
                return ";" + code[1:]
            self.skipped = deleted and block_delete
            start = "/" if deleted else ""
        else:
            self.joined.append(code)
            start, code = self.joined[0], " ".join(self.joined[1:])
            self.joined = None
        if goes_on:
            kind = _NAMED.match(code.upper().lstrip())
            if kind is None or kind[1] in (self.kinds.keys() - {"CYCL"}) | {"M"}:
                raise fail(number, "~ behind a block that is no cycle; take it out")
            self.joined = [start, code]
            return said.strip()
        code = " ".join(code.upper().split())
        made = "" if self.skipped or not code else self._block(number, code)
        return (start + made + (said if made else said.lstrip())).strip()

    def finish(self, lines: int) -> None:
        """Refuse a program that does not come to its last block."""
        if self.joined is not None or not self.closed:
            raise fail(lines, "the program ends without END PGM; a part of it is missing")

    def _numbered(self, number: int, code: str) -> tuple[bool, str]:
        """Whether a block may be skipped, and the block without its number."""
        match = _BLOCK.fullmatch(code)
        if match is None:
            raise fail(number, "a block without its number; blocks are numbered 0, 1, 2 and so on")
        if int(match[1]) != self.expected:
            raise fail(
                number,
                f"block {match[1]} where block {self.expected} is due; one is missing, or stands twice",
            )
        self.expected += 1
        return bool(match[2]), match[3].strip()

    def _block(self, number: int, code: str) -> str:
        if match := _BEGIN.fullmatch(code):
            return self._begin(number, match)
        if not self.name:
            raise fail(number, "a block before BEGIN PGM; write 0 BEGIN PGM NAME MM first")
        if called := self.labels.read(number, code, self.ended):
            # Where the tool stands in a subprogram, and behind it, another place of the text says.
            self.place, self.centre = dict.fromkeys("XYZ"), None
            return called
        if self.ended and not self.labels.inside and not code.startswith("END"):
            raise fail(number, "a block behind the end of the program, where only labels stand; take it out")
        if self.cycle is not None and not code.startswith(f"CYCL DEF {self.cycle[0]}.{self.cycle[1]}"):
            cycle, part = self.cycle
            raise fail(number, f"CYCL DEF {cycle}.{part} has to follow CYCL DEF {cycle}.{part - 1} here")
        found = _NAMED.match(code)
        kind = found[1] if found else code[:1]
        if kind == "M":
            return self._functions(number, code)
        if kind not in self.kinds:
            raise refused(number, kind)
        return self.kinds[kind](number, code)

    def _begin(self, number: int, match: re.Match[str]) -> str:
        if self.name:
            raise fail(number, "BEGIN PGM begins another program; keep one program in a file")
        self.name, self.units = match[1], match[2]
        return f"{'G20' if self.units == 'INCH' else 'G21'} {HEAD}"

    def _end(self, number: int, code: str) -> str:
        self.labels.finish(number)
        match = _END.fullmatch(code)
        if match is None or (match[1], match[2]) != (self.name, self.units):
            raise fail(number, f"{code}: the program ends with END PGM {self.name} {self.units}")
        self.closed = True
        return ""

    def _form(self, number: int, code: str) -> str:
        """The blank that the control draws, of two blocks; it changes no path."""
        if _FORM.fullmatch(code) is None:
            raise fail(number, f"{code}: a blank is BLK FORM 0.1 Z X Y Z, then BLK FORM 0.2 X Y Z")
        return ""

    def _stop(self, number: int, code: str) -> str:
        if code != "STOP":
            raise fail(number, f"{code}: write M functions in a block of their own before STOP")
        return "M0"

    # -- tools and cycles -----------------------------------------------------------------------------------

    def _tool(self, number: int, code: str) -> str:
        if match := _DEF.fullmatch(code):
            return f"T{int(match[1])}"
        match = _CALL.fullmatch(code)
        if match is None:
            raise fail(number, f"{code}: call tools by number, TOOL CALL 3 Z S900, or make ready, TOOL DEF 4")
        words: dict[str, str] = {}
        for name, value in _CALL_WORD.findall(match[3]):
            if name in words:
                raise fail(number, f"two {name} words in TOOL CALL; take one out")
            words[name] = value
        for name in ("DL", "DR"):
            if float(plain(words.pop(name, "0"))):
                raise fail(number, f"{name} makes the tool another than in the tool table; enter it there")
        if match[2] != "Z":
            raise fail(
                number, "TOOL CALL without the tool axis Z; the tools of this interpreter stand along Z"
            )
        if match[1] is None and "S" not in words:
            raise fail(number, "TOOL CALL without tool and speed says nothing; write both")
        said = f"S{plain(words['S'])}" if "S" in words else ""
        if "F" in words:
            said += f" F{self._feed(words['F'])}"
        if match[1] is None:
            return f"{said} G17".strip()
        tool, self.axis = int(match[1]), True
        self.place["Z"] = None
        return f"T{tool} M6 {'G43' if tool else 'G49'} {said} G17".replace("  ", " ")

    def _cycl(self, number: int, code: str) -> str:
        match = _CYCL.fullmatch(code)
        if match is None:
            raise fail(number, f"{code}: CALL and its kin are not read; {NO_CYCLE}")
        cycle, part, rest = int(match[1]), match[2], match[3] or ""
        if cycle == 247 and part is None:
            return self._datum(number, rest)
        if cycle in {9, 32} and part == "0":
            if not _CYCLE_NAME.fullmatch(rest):
                raise fail(
                    number, f"CYCL DEF {cycle}.0 {rest}: the name of the cycle stands there and no word"
                )
            self.cycle = cycle, 1
            return ""
        if cycle in {9, 32} and part == "1" and self.cycle == (cycle, 1):
            self.cycle = None
            return dwell_of(number, rest) if cycle == 9 else tolerance_of(number, rest)
        if cycle in {9, 32} and part == "1":
            raise fail(number, f"CYCL DEF {cycle}.1 without CYCL DEF {cycle}.0 before it")
        name = f"CYCL DEF {cycle}" + (f".{part}" if part else "")
        row = WORDS.known.get(f"CYCL{cycle}")
        why = NO_CYCLE if row is None else row.remedy
        raise fail(number, f"{name} is no cycle that is read in programs for {NAME}; {why}")

    def _datum(self, number: int, rest: str) -> str:
        match = _DATUM.fullmatch(rest)
        if match is None or match[1] is None:
            raise fail(number, "CYCL DEF 247 needs Q339, the number of the preset, and nothing else")
        preset = int(match[1])
        if not 1 <= preset <= LAST_PRESET:
            raise fail(number, f"preset {preset}: those of a job are 1 to {LAST_PRESET}, its G54 to G59")
        self.place = dict.fromkeys("XYZ")
        return f"G{53 + preset}"

    # -- moves ----------------------------------------------------------------------------------------------

    def _straight(self, number: int, code: str) -> str:
        words = words_of(number, code, WORDS.known["L"])
        axes = {axis: words[axis] for axis in "XYZ" if axis in words}
        ms = self._ms(number, words.get("M", ""), moving=bool(axes))
        machine = "M91" in ms.split()
        functions = ms.replace("M91", "").strip()
        if not axes:
            if machine:
                raise fail(number, "M91 without a place; write the axes")
            said = [words.get("R", ""), self._feed_word(number, words), functions]
            if not any(said):
                raise fail(number, "L without a place says nothing; take it out")
            return " ".join(filter(None, said))
        rapid = words.get("F") == "MAX"
        if machine and not rapid:
            raise fail(number, "M91 with a feed; machine coordinates are read with FMAX alone")
        for axis, value in axes.items():
            self.place[axis] = None if machine else float(value)
        said = ["G53" if machine else "", "G0" if rapid else "G1", words.get("R", "")]
        said += [axis + value for axis, value in axes.items()]
        return " ".join(filter(None, [*said, self._feed_word(number, words), functions]))

    def _pole(self, number: int, code: str) -> str:
        words = words_of(number, code, WORDS.known["CC"])
        if set(words) != {"X", "Y"}:
            raise fail(number, "CC is read with X and Y and nothing else, the centre in full")
        self.centre = words["X"], words["Y"]
        return ""

    def _arc(self, number: int, code: str) -> str:
        name = "CR" if (by_radius := code.startswith("CR")) else "C"
        row = WORDS.known[name]
        words = words_of(number, code, row)
        if not set(row.one_of) <= set(words):
            raise fail(number, f"{name} needs {'X, Y, R and DR' if by_radius else 'X, Y and DR'}")
        centre = f"R{words['RADIUS']}" if by_radius else "I{} J{}".format(*self._pole_of(number))
        self._in_plane(number, words)
        self.place["X"], self.place["Y"] = float(words["X"]), float(words["Y"])
        said = [
            words["DR"],
            words.get("R", ""),
            f"X{words['X']} Y{words['Y']}",
            centre,
            self._feed_word(number, words),
        ]
        return " ".join(filter(None, [*said, self._ms(number, words.get("M", ""), moving=True)]))

    def _helix(self, number: int, code: str) -> str:
        words = words_of(number, code, WORDS.known["CP"])
        if not {"IPA", "DR"} <= set(words):
            raise fail(number, "CP needs IPA and DR")
        self._in_plane(number, words)
        centre = self._pole_of(number)
        x, y, z = (self.place[axis] for axis in "XYZ")
        turn, down = float(words["IPA"]), float(words.get("IZ", "0"))
        if x is None or y is None or (z is None and down):
            raise fail(number, "CP from a place that the text has not said; write X, Y and Z before it")
        if not SMALLEST_TURN / 2 < abs(turn) <= LARGEST_TURN:
            raise fail(number, f"IPA{turn:g}: a block turns by {LARGEST_TURN} degrees at most, and not by 0")
        if (turn > 0) != (words["DR"] == "G3"):
            raise fail(number, "IPA and DR turn to different sides; give both one sign")
        turns, part = turns_of(turn)
        if part:
            x, y = rotated((x, y), (float(centre[0]), float(centre[1])), part)
        said = [words["DR"], words.get("R", ""), f"X{worked_out(x)} Y{worked_out(y)}"]
        self.place["X"], self.place["Y"] = float(worked_out(x)), float(worked_out(y))
        if z is not None:
            self.place["Z"] = z + down
            said.append(f"Z{worked_out(z + down)}" if down else "")
        said += ["I{} J{}".format(*centre), f"P{turns}" if turns > 1 else ""]
        said.append(self._feed_word(number, words))
        return " ".join(filter(None, [*said, self._ms(number, words.get("M", ""), moving=True)]))

    def _pole_of(self, number: int) -> tuple[str, str]:
        if self.centre is None:
            raise fail(number, "an arc without a centre; write CC before it")
        return self.centre

    def _in_plane(self, number: int, words: dict[str, str]) -> None:
        if not self.axis:
            raise fail(number, "an arc before TOOL CALL has said the tool axis; call the tool first")
        if words.get("F") == "MAX":
            raise fail(number, "an arc at FMAX; give it a feed")

    # -- words ----------------------------------------------------------------------------------------------

    def _feed_word(self, number: int, words: dict[str, str]) -> str:
        value = words.get("F", "MAX")
        if value == "MAX":
            return ""
        if value.startswith("-"):
            raise fail(number, "F is below 0")
        return f"F{self._feed(value)}"

    def _feed(self, value: str) -> str:
        """A feed in the units of the program, by the minute."""
        value = plain(value)
        return worked_out(float(value) / TENTHS) if self.units == "INCH" else value

    def _functions(self, number: int, code: str) -> str:
        """M functions in a block of their own."""
        words = words_of(number, f"- {code}", WORDS.known["M"])
        if set(words) != {"M"}:
            raise fail(number, f"{code}: M functions beside other words; write L before them")
        return self._ms(number, words["M"], moving=False)

    def _ms(self, number: int, code: str, *, moving: bool) -> str:
        """M functions as the interpreter has them; behind M2 and M30 nothing is read."""
        said = functions_of(number, code, moving=moving)
        self.ended = self.ended or bool({"M2", "M30"} & set(said.split()))
        return said

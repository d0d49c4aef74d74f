"""From a line of text to its words.

Glossary
--------
block
    One line of a program.
word
    A letter and a number, such as ``X12.5``.
"""

import re
from dataclasses import dataclass, field

from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.words.assign import RefusedError, check_codes
from mechwright_cam.controls.words.groups import spell
from mechwright_cam.controls.words.table import Code

NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)"
LARGEST_NUMBER = 1e9
"""Numbers beyond this are a slip of the pen: no control has so many digits."""
_WORD = re.compile(rf"([A-Z@^])({NUMBER})")
_LETTERS = frozenset("DFGHIJKLMNPQRSTXYZ")
_JUMP = re.compile(r"(IF|GOTO|WHILE|THEN|DO(?=[0-9])|END(?=[0-9]))")
_PROGRAM = re.compile(r"[O:][0-9]{1,5}")
POLAR = frozenset("@^")
"""LinuxCNC's polar coordinates: distance from X0 Y0, and angle, degrees."""
_OTHER_AXES = frozenset("ABCUVW")
_COMMENT = re.compile(r"\([^)]*\)|;.*")
_COMMENT_MARK = re.compile(r"[();]")
_MARK = "\1"
_IN_WORD = re.compile(
    rf"[^0-9.\]>\s/{_MARK}]\s*{_MARK}"  # behind a letter, or in a value
    rf"|[^\s{_MARK}]\s*/\s*{_MARK}|{_MARK}\s*[^A-Z@^#;\s{_MARK}]",
    re.IGNORECASE,
)
"""Places of comments, each of which is :data:`_MARK`, where no word could begin."""
_O_WORD = re.compile(rf"[\s{_MARK}]*(?:/\s*)?(?:N[0-9]+\s*)?O", re.IGNORECASE)
_BLANKS = {ord(" "): None, ord("\t"): None}


_NONE: dict[str, float] = {}


@dataclass(slots=True)
class Block:
    """One line: its codes, its other words by letter, its comments, and the letters without a point."""

    line: int
    g: list[int] = field(default_factory=list)
    m: list[int] = field(default_factory=list)
    words: dict[str, float] = field(default_factory=dict)
    comments: list[str] = field(default_factory=list)
    bare: set[str] = field(default_factory=set)
    deleted: bool = False
    title: bool = False
    """Whether it is a program number, such as O1234."""
    late_number: bool = False
    """Whether a line number would stand behind a comment."""
    shares: dict[str, dict[str, float]] = field(default_factory=dict)
    """Code to the words that it takes, of which it takes out those that it has used."""

    def of(self, code: int | str) -> dict[str, float]:
        """The words of a code, given in tenths or as it is written."""
        return self.shares.get(code if isinstance(code, str) else spell(code), _NONE)

    def again(self, line: int) -> "Block":
        """The same for another line, with words of its own to be taken out."""
        words = self.words.copy()
        return Block(line, self.g, self.m, words, self.comments, self.bare, self.deleted, self.title)


def no_code(word: str, dialect: Dialect) -> str:
    """What is said of a code that the interpreter does not have: the control itself may know it."""
    return f"{word} is no code that is read in programs for {dialect.name}; post the program without it"


def fail(line: int, reason: str) -> ProgramError:
    """The error for one line, ready to raise."""
    return ProgramError(f"line {line}: {reason}")


def read_block(line: int, text: str, dialect: Dialect) -> Block:
    """Split a line, by its number from 1 and its text without the end, into words.

    Raises
    ------
    ProgramError
        A comment is not closed, a number is bad, a letter comes twice, or two codes exclude each other.

    Examples
    --------
    >>> block = read_block(7, "N10 g01 X-.5 (to the edge) F200", Dialect())
    >>> block.g, block.words, block.comments
    ([10], {'X': -0.5, 'F': 200.0}, ['to the edge'])
    """
    block = Block(line)
    for character in dialect.text.forbidden:
        if character in text:
            raise fail(line, f"{dialect.name} obeys {character!r} wherever it stands; take it out")
    code = _strip_comments(block, text, dialect) if "(" in text or ";" in text or ")" in text else text
    if block.comments and code and not code.isspace():
        check_comments(line, text)
        block.late_number = text.lstrip().startswith("(")
    code = code.translate(_BLANKS)
    small = next((c for c in code if c.islower()), "") if dialect.text.capitals else ""
    code = code.upper()
    if dialect.text.counts_code and len(code) > dialect.text.longest:
        raise fail(line, f"{len(code)} characters; {dialect.name} reads at most {dialect.text.longest}")
    if dialect.text.program_numbers and _PROGRAM.fullmatch(code):
        block.title = True
        return block
    if code.startswith("/"):
        block.deleted = True
        code = code[1:]
        if code[:1].isdigit():
            raise fail(line, f"/{code[0]} is a level of its own; write / for lines that may be skipped")
    position = 0
    while position < len(code):
        match = _WORD.match(code, position)
        if match is None:
            raise fail(line, _explain(code[position:]))
        _add(block, match[1], match[2], dialect, first=position == 0)
        position = match.end()
    if small:
        raise fail(line, f"the small letter {small!r} is no word to {dialect.name}; write words in capitals")
    if len(block.g) + len(block.m) > 1:
        try:
            check_codes(dialect.words, rows_of(block, dialect))
        except RefusedError as error:
            raise fail(line, str(error)) from None
    if dialect.words.one_m and len(block.m) > 1:
        raise fail(line, f"several M codes; {dialect.name} obeys one in a line, write a line for each")
    return block


def rows_of(block: Block, dialect: Dialect) -> list[Code]:
    """The rows of a block's codes in the table of the control; a code that it does not know has none."""
    g, m = dialect.words.g, dialect.words.m
    return [g[code] for code in block.g if code in g] + [m[code] for code in block.m if code in m]


def check_comments(line: int, text: str) -> None:
    """Raise ProgramError if a comment stands in a word or a value, or in an O-word other than at its end.

    >>> check_comments(3, "G1 X1 (to the edge) Y2 (and up)")
    >>> check_comments(3, "G1 X1(2).5")
    Traceback (most recent call last):
    mechwright.errors.ProgramError: line 3: a comment stands inside of a word; put it at the end of the line
    """
    marked = _COMMENT.sub(lambda match: _MARK if match[0][0] == "(" else "", text)
    inside = _MARK in marked.rstrip(f" \t{_MARK}") if _O_WORD.match(marked) else _IN_WORD.search(marked)
    if inside:
        raise fail(line, "a comment stands inside of a word; put it at the end of the line")


def check_points(block: Block, dialect: Dialect, *, inches: bool = False) -> None:
    """A length without a point is a trap: 10 may be 10 mm or 10 µm, by a setting. 0 is 0 in any case.

    So is a feed, on some controls or in inches alone. What is no length is told by the row of its code.
    """
    table = dialect.words
    for code, share in block.shares.items():
        row = table.known.get(code)
        for letter, value in share.items():
            if letter not in block.bare or not value or (row is not None and letter in row.pointless):
                continue
            point = table.of(letter).point
            if point == "needed" or (point == "inches" and inches):
                many = "hundredths or less" if letter == "F" else "thousandths"
                raise fail(
                    block.line,
                    f"{letter}{value:g} has no decimal point, and {dialect.name} may read {many}; "
                    f"write {letter}{value:g}.",
                )


def _strip_comments(block: Block, text: str, dialect: Dialect) -> str:
    kept = []
    position = 0
    while (found := _COMMENT_MARK.search(text, position)) is not None:
        kept.append(text[position : found.start()])
        character, position = found[0], found.start()
        if character == "(":
            end = text.find(")", position)
            if end < 0:
                raise fail(block.line, "the comment is not closed; put a ) at its end")
            comment = text[position + 1 : end]
            if "(" in comment:
                raise fail(block.line, "a comment stands inside a comment")
            _keep_comment(block, comment, dialect)
            position = end
        elif character == ")":
            raise fail(block.line, "a ) without its (")
        elif character == ";" and dialect.text.semicolon_comments:
            _keep_comment(block, text[position + 1 :], dialect)
            return "".join(kept)
        else:
            kept.append(character)
        position += 1
    return "".join([*kept, text[position:]])


def _keep_comment(block: Block, comment: str, dialect: Dialect) -> None:
    comment = comment.strip()
    if comment.lower().startswith(dialect.text.active_comments):
        raise fail(
            block.line,
            f"{dialect.name} carries out the comment {comment[:20]!r}, which is not simulated; take it out",
        )
    block.comments.append(comment)


def _explain(rest: str) -> str:
    letter = rest[0]
    if (jump := _JUMP.match(rest)) is not None:
        return f"jumps and loops of macros ({jump[1]}) are not read; post the program without them"
    if letter in "#[O=<" or (letter in _LETTERS | _OTHER_AXES and rest[1:2] in {"#", "["}):
        return "parameters, expressions and O-words are not read; post the program without them"
    if letter == "%":
        return "a % stands in a line of its own"
    if letter == "/":
        return "a / stands at the start of its line"
    if letter.isdigit():
        return f"a number without its letter: {rest[:12]!r}"
    if letter in _LETTERS | _OTHER_AXES:
        return f"{letter} is followed by no number: {rest[:12]!r}"
    return f"{letter!r} starts no word: {rest[:12]!r}"


def _add(block: Block, letter: str, number: str, dialect: Dialect, *, first: bool) -> None:
    value = float(number)
    if not abs(value) <= LARGEST_NUMBER:
        raise fail(block.line, f"{letter}{value:.3g} is a number that no control reads")
    address = dialect.words.of(letter)
    if letter == "G":
        _add_code(block, "G", block.g, round(value * 10), value * 10)
    elif letter == "M":
        if "." in number and address.point == "never":
            raise fail(block.line, _pointed(letter, number, dialect))
        usual = dialect.standard_m(round(value))
        if usual is None:
            raise fail(block.line, no_code(f"M{number}", dialect))
        _add_code(block, "M", block.m, usual, value + usual - round(value))
    elif letter == "N":
        if not first or (dialect.macros and block.late_number):
            raise fail(block.line, "a line number stands at the start of its line")
        whole = number.isdigit() or (address.parts and number[0].isdigit() and number[-1] != ".")
        if not whole or value > address.most:
            raise fail(block.line, f"N{number[:12]}: line numbers are whole, from 0 to {address.most:.0f}")
    elif letter == "O":
        raise fail(block.line, _explain("O"))
    elif letter in _OTHER_AXES:
        raise fail(block.line, f"axis {letter} is not read; this is a three-axis interpreter")
    elif letter not in _LETTERS and not (dialect.words.polar and letter in POLAR):
        raise fail(block.line, f"{letter!r} starts no word: {letter}{number}")
    elif letter in block.words:
        raise fail(block.line, f"two {letter} words")
    elif "." in number and address.point == "never":
        raise fail(block.line, _pointed(letter, number, dialect))
    elif value > address.most:
        raise fail(
            block.line, f"{letter}{number[:20]}: {dialect.name} takes up to {letter}{address.most:.0f}"
        )
    else:
        block.words[letter] = value
        if "." not in number:
            block.bare.add(letter)


def _pointed(letter: str, number: str, dialect: Dialect) -> str:
    return f"{letter}{number} has a decimal point, and {dialect.name} takes {letter} whole"


def _add_code(block: Block, letter: str, codes: list[int], code: int, exact: float) -> None:
    if abs(code - exact) > 1e-9 or code < 0:  # rounding of the product only; no control has such a code
        raise fail(block.line, f"{letter}{exact / (10 if letter == 'G' else 1):g} is no code")
    codes.append(code)

"""Values of parameters and expressions (RS274/NGC, 3.3.2.2 and 3.3.2.3; LinuxCNC's named parameters)."""

import math
import operator
import re
from collections.abc import Callable, Sequence

from mechwright_cam.controls.reading.blocks import NUMBER

TRUE, FALSE = 1.0, 0.0
DEEPEST = 40
"""Brackets inside of each other beyond which an expression is refused."""
EQUAL = 1e-6
"""Two values nearer than this are equal to EQ and NE: LinuxCNC's own tolerance."""
HIGHEST = 5601
"""The highest number of a parameter in LinuxCNC."""
HELD = "\0"
"""Stands in a text for a number that is kept beside it."""
_NUMBER = re.compile(rf"{NUMBER}|[+-]?{HELD}")
_NAME = re.compile(r"<([^<>]*)>")
_UNARY: dict[str, Callable[[float], float]] = {
    "abs": abs,
    "acos": lambda x: math.degrees(math.acos(x)),
    "asin": lambda x: math.degrees(math.asin(x)),
    "cos": lambda x: math.cos(math.radians(x)),
    "exp": math.exp,
    "fix": math.floor,
    "fup": math.ceil,
    "ln": math.log,
    "round": lambda x: math.copysign(math.floor(abs(x) + 0.5), x),
    "sin": lambda x: math.sin(math.radians(x)),
    "sqrt": math.sqrt,
    "tan": lambda x: math.tan(math.radians(x)),
}
_BINARY: tuple[dict[str, Callable[[float, float], float]], ...] = (
    {
        "and": lambda a, b: float(bool(a) and bool(b)),
        "or": lambda a, b: float(bool(a) or bool(b)),
        "xor": lambda a, b: float(bool(a) != bool(b)),
    },
    {
        "eq": lambda a, b: float(abs(a - b) < EQUAL),
        "ne": lambda a, b: float(abs(a - b) >= EQUAL),
        "gt": lambda a, b: float(a > b),
        "ge": lambda a, b: float(a >= b),
        "lt": lambda a, b: float(a < b),
        "le": lambda a, b: float(a <= b),
    },
    {"+": operator.add, "-": operator.sub},
    {"*": operator.mul, "/": operator.truediv, "mod": lambda a, b: a % abs(b)},
    {"**": operator.pow},
)
"""Operators by precedence, the loosest first; those of one row are worked out from left to right. MOD is
never negative, whatever its divisor."""
_ROW = {name: row for row, names in enumerate(_BINARY) for name in names}
_FUNCTION = re.compile(rf"({'|'.join([*_UNARY, 'atan', 'exists'])})\[")
_OPERATOR = re.compile("|".join(re.escape(name) for name in sorted(_ROW, key=len, reverse=True)))


Known = Callable[[float | str], float]
"""Gives the value of a parameter, by number or name; raises ValueError if it has none."""
Worked = Callable[[Known, Sequence[float]], float]
"""Works out a value, of parameters and of the numbers that :data:`HELD` stands for."""


class MissingError(ValueError):
    """A name has no value, and no earlier program can have given it one."""


class Formulas:
    """Understands values in a line without blanks, in small letters, so that they can be worked out often.

    :data:`HELD` stands for a number without a sign that is given when a value is worked out, so that lines
    which differ in their numbers alone are understood once.
    """

    def __init__(self, text: str, at: int = 0) -> None:
        self.text, self.at, self.depth, self.held = text, at, 0, 0

    def real(self) -> Worked:
        """A number, a parameter, an expression in brackets or a function, from the present place on.

        Raises
        ------
        ValueError
            There is none; the text says what was found.
        """
        text, at = self.text, self.at
        first, second = text[at : at + 1], text[at + 1 : at + 2]
        if first in {"+", "-"} and second in {"#", "["}:
            self.at += 1
            inner = self.real()
            return (lambda known, held: -inner(known, held)) if first == "-" else inner
        if match := _NUMBER.match(text, at):
            self.at = match.end()
            return self._number(match[0])
        if first == "#":
            return _value_of(self.parameter())
        if first == "[":
            return self.bracket()
        if (match := _FUNCTION.match(text, at)) is None:
            raise ValueError(f"no value at {text[at : at + 12]!r}")
        self.at = match.end(1)
        if match[1] == "exists":
            return self._exists()
        argument = self.bracket()
        if match[1] == "atan":
            self._skip("/")
            below = self.bracket()
            return lambda known, held: math.degrees(math.atan2(argument(known, held), below(known, held)))
        function = _UNARY[match[1]]
        return lambda known, held: float(function(argument(known, held)))

    def _number(self, text: str) -> Worked:
        if text[-1] != HELD:
            constant = float(text)
            return lambda _known, _held: constant
        which, sign = self.held, -1.0 if text[0] == "-" else 1.0
        self.held += 1
        return (lambda _known, held: held[which]) if sign > 0 else (lambda _known, held: -held[which])

    def parameter(self) -> str | Worked:
        """The name of a parameter, or what gives its number, after its #."""
        self._skip("#")
        if match := _NAME.match(self.text, self.at):
            self.at = match.end()
            return match[1]
        return self.real()

    def bracket(self) -> Worked:
        """An expression in brackets."""
        self._skip("[")
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError(f"brackets are nested more than {DEEPEST} deep")
        result = self._level(0)
        self.depth -= 1
        self._skip("]")
        return result

    def _level(self, level: int) -> Worked:
        """What operators of a row of :data:`_BINARY`, and of those that bind more, make of values."""
        result = self.real()
        while match := _OPERATOR.match(self.text, self.at):
            own = _ROW[match[0]]
            if own < level:
                break
            self.at = match.end()
            result = _joined(match[0], result, self._level(own + 1))
        return result

    def _exists(self) -> Worked:
        self._skip("[")
        parameter = self.parameter()
        self._skip("]")

        def exists(known: Known, held: Sequence[float]) -> float:
            if not isinstance(parameter, str):
                return TRUE if 1 <= parameter(known, held) <= HIGHEST else FALSE
            try:
                known(parameter)
            except MissingError:
                return FALSE
            return TRUE

        return exists

    def _skip(self, wanted: str) -> None:
        if not self.text.startswith(wanted, self.at):
            raise ValueError(f"{wanted} expected at {self.text[self.at : self.at + 12]!r}")
        self.at += len(wanted)


def _value_of(parameter: str | Worked) -> Worked:
    if isinstance(parameter, str):
        return lambda known, _held: known(parameter)
    return lambda known, held: known(parameter(known, held))


def _joined(name: str, first: Worked, second: Worked) -> Worked:
    function = _BINARY[_ROW[name]][name]

    def result(known: Known, held: Sequence[float]) -> float:
        a, b = first(known, held), second(known, held)
        try:
            return float(function(a, b))
        except (ZeroDivisionError, OverflowError, TypeError) as error:
            raise ValueError(f"{a:g} {name} {b:g} has no value ({error})") from None

    return result


class Reader:
    """Reads values out of a line without blanks, in small letters; ``value`` gives those of parameters."""

    def __init__(self, text: str, value: Known) -> None:
        self.text, self.value, self.at = text, value, 0

    def real(self) -> float:
        """What :meth:`Formulas.real` understands at the present place, worked out."""
        return self._worked_out(Formulas.real)

    def bracket(self) -> float:
        """An expression in brackets, worked out."""
        return self._worked_out(Formulas.bracket)

    def _worked_out(self, understand: Callable[[Formulas], Worked]) -> float:
        formulas = Formulas(self.text, self.at)
        worked = understand(formulas)
        self.at = formulas.at
        return worked(self.value, ())

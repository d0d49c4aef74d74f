"""Values of parameters and expressions (RS274/NGC, 3.3.2.2 and 3.3.2.3; LinuxCNC's named parameters)."""

import math
import operator
import re
from collections.abc import Callable

from mechwright_cam.controls.reading.blocks import NUMBER

TRUE, FALSE = 1.0, 0.0
DEEPEST = 40
"""Brackets inside of each other beyond which an expression is refused."""
EQUAL = 1e-6
"""Two values nearer than this are equal to EQ and NE: LinuxCNC's own tolerance."""
_NUMBER = re.compile(NUMBER)
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
_OPERATOR = re.compile("|".join(re.escape(name) for name in sorted(_ROW, key=len, reverse=True)))


class Reader:
    """Reads values out of a line without blanks, in small letters.

    ``value`` gives the value of a parameter, by number or name; it raises ValueError if it has none.
    """

    def __init__(self, text: str, value: Callable[[float | str], float]) -> None:
        self.text, self.value, self.at, self.depth = text, value, 0, 0

    def real(self) -> float:
        """A number, a parameter, an expression in brackets or a function, from the present place on.

        Raises
        ------
        ValueError
            There is none; the text says what was found.
        """
        rest = self.text[self.at :]
        if rest[:1] in {"+", "-"} and rest[1:2] in {"#", "["}:
            self.at += 1
            return -self.real() if rest[0] == "-" else self.real()
        if match := _NUMBER.match(rest):
            self.at += match.end()
            return float(match[0])
        if rest[:1] == "#":
            return self.value(self.parameter())
        if rest[:1] == "[":
            return self.bracket()
        for name, function in _UNARY.items():
            if rest.startswith(name + "["):
                self.at += len(name)
                return float(function(self.bracket()))
        if rest.startswith("atan["):
            self.at += 4
            top = self.bracket()
            self._skip("/")
            return math.degrees(math.atan2(top, self.bracket()))
        if rest.startswith("exists["):
            return self._exists()
        raise ValueError(f"no value at {rest[:12]!r}")

    def parameter(self) -> float | str:
        """The number or the name of a parameter, after its #."""
        self._skip("#")
        if match := _NAME.match(self.text, self.at):
            self.at = match.end()
            return match[1]
        return self.real()

    def bracket(self) -> float:
        """An expression in brackets."""
        self._skip("[")
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError(f"brackets are nested more than {DEEPEST} deep")
        result = self._level(0)
        self.depth -= 1
        self._skip("]")
        return result

    def _level(self, level: int) -> float:
        """What operators of a row of :data:`_BINARY`, and of those that bind more, make of values."""
        result = self.real()
        while match := _OPERATOR.match(self.text, self.at):
            found = match[0]
            own = _ROW[found]
            if own < level:
                break
            self.at = match.end()
            other = self._level(own + 1)
            try:
                result = float(_BINARY[own][found](result, other))
            except (ZeroDivisionError, OverflowError, TypeError) as error:
                raise ValueError(f"{result:g} {found} {other:g} has no value ({error})") from None
        return result

    def _exists(self) -> float:
        self.at += len("exists")
        self._skip("[")
        name = self.parameter()
        self._skip("]")
        try:
            self.value(name)
        except ValueError:
            return FALSE
        return TRUE

    def _skip(self, wanted: str) -> None:
        if not self.text.startswith(wanted, self.at):
            raise ValueError(f"{wanted} expected at {self.text[self.at : self.at + 12]!r}")
        self.at += len(wanted)

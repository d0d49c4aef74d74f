"""Units of design files.

A design file speaks millimetres, degrees and revolutions per minute. A bare number is in the unit that its
field declares; a string may carry any unit of the same kind (``"2 in"``, ``"0.5 rad"``). A parameter object
holds the declared unit, exactly as the file says it; everything computed from it is in millimetres, radians
and seconds.
"""

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

# A number, then units multiplied and divided, each with a one-digit power. Nothing else reaches pint, whose
# parser would also work out arithmetic, and "9**9**9 mm" would keep it busy for ever.
_UNIT = r"[^\W\d_]+(?:_[^\W\d_]+)*|[°%]"
_POWER = r"(?:(?:\^|\*\*)-?\d|[²³])?"
_TERM = rf"(?:{_UNIT}|1){_POWER}"
_UNITS = re.compile(rf"{_TERM}(?:\s*[*/·]\s*{_TERM}|\s+{_TERM})*")
_QUANTITY = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(/\s*\d+)?\s*([^\d/].*?)\s*")
_MIXED = re.compile(r"\s*([+-]?)(\d+)\s+(\d+)\s*/\s*(\d+)(?=\D)")
"""Whole inches and a fraction, as in ``"3 1/2 in"``."""
_TORQUE = re.compile(r"\b([mkM]?N)([cm]?m)\b")
"""Newton metres as they are written, ``Nm``: pint takes them for metres of a number of yarn."""
_INCH_MARKS = frozenset('"″”')
"""What stands behind inches on drawings and on tools."""
_TWO_MEANINGS = {"grad", "Grad"}
"""A degree to some and a hundredth of a right angle to others (``gon``)."""

LONGEST = 200
"""Characters of a quantity: the patterns that read one take the square of its length."""

_SIGNIFICANT = 15
"""Digits a converted value keeps: every decimal of 15 digits survives, the rounding of a factor does not."""


@cache
def _registry() -> Any:
    # pint takes 0.2 s to import; most design files carry no unit strings.
    import pint

    registry: pint.UnitRegistry[float] = pint.UnitRegistry()
    registry.define("@alias revolution = rev")  # rev/min is what a machinist writes; pint knows rpm only
    return registry


@cache
def _parse(symbol: str) -> Any:
    """The unit of pint with this symbol; raises ValueError if it is none."""
    if symbol and (not _UNITS.fullmatch(symbol) or _TWO_MEANINGS & set(re.findall(r"\w+", symbol))):
        raise ValueError(f"'{symbol}' is no unit")
    try:
        return _registry().parse_units(_TORQUE.sub(r"\1*\2", symbol.replace("·", "*")))
    except Exception as error:
        # pint lets a tokenizer's, a parser's and its own errors through: one meaning for the caller.
        raise ValueError(f"'{symbol}' is no unit") from error


@cache
def kind(symbol: str) -> str:
    """Give the kind of quantity a unit measures, in root units; an angle is a kind of its own.

    Two units convert into each other if and only if their kinds are equal. That keeps ``"Hz"`` out of
    ``rpm`` and ``"%"`` out of degrees, which a comparison of dimensions alone would let through. Raises
    ValueError where there is no such unit.

    >>> kind("mm/min") == kind("m/s"), kind("Hz") == kind("rpm"), kind("deg")
    (True, False, 'radian')
    """
    return str((1.0 * _parse(symbol)).to_root_units().units)


def convert(text: str, unit: str) -> float:
    """Read a quantity, such as ``"2 in"`` or ``"3 1/2 in"``, and give its magnitude in ``unit``.

    A number alone is taken to be in ``unit``, which is spelled as pint does; ``""`` is a pure number. Raises
    ValueError for a text that is no quantity, of another kind than ``unit``, or longer than ``LONGEST``.

    >>> convert("2 in", "mm"), convert("1/4 in", "mm"), convert('1/4"', "mm"), convert("40", "mm")
    (50.8, 6.35, 6.35, 40.0)
    >>> convert("2 kg", "mm")
    Traceback (most recent call last):
    ...
    ValueError: '2 kg' cannot be read in mm
    """
    if len(text) > LONGEST:
        raise ValueError(f"{text[:20]!r}... has {len(text):,} characters, and a quantity at most {LONGEST}")
    wrong = ValueError(f"{text!r} cannot be read in {unit or 'a plain number'}")
    try:
        value = float(text)
    except ValueError:
        value = _quantity(text, unit, wrong)
    if not math.isfinite(value):
        raise wrong
    return value


def _improper(mixed: re.Match[str]) -> str:
    """Seven halves for ``3 1/2``."""
    sign, whole, number, divisor = mixed.groups()
    return f"{sign}{int(whole) * int(divisor) + int(number)}/{divisor}"


def _quantity(text: str, unit: str, wrong: ValueError) -> float:
    match = _QUANTITY.fullmatch(_MIXED.sub(_improper, text, count=1))
    if match is None:
        raise wrong
    number, divisor, symbol = match.groups()
    symbol = "in" if symbol in _INCH_MARKS else symbol
    try:
        value = float(number) / (int(divisor.strip("/ ")) if divisor else 1)
        if kind(symbol) != kind(unit):
            raise wrong
        quantity = _registry().Quantity(value, _parse(symbol))
        return float(f"{quantity.to(_parse(unit)).magnitude:.{_SIGNIFICANT}g}")
    except (ValueError, ZeroDivisionError):
        raise wrong from None
    except Exception as error:  # noqa: BLE001,RUF100 - offset and logarithmic units fail in their own ways
        raise wrong from error


@dataclass(frozen=True, slots=True)
class Unit:
    """Annotation of a pydantic field: the unit its bare numbers are in."""

    symbol: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_before_validator_function(self._read, handler(source))

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return {**handler(schema), "unit": self.symbol}

    def _read(self, value: Any) -> Any:
        if isinstance(value, bool):
            raise PydanticCustomError("unit", "a truth value is no number; write a number", {})
        if not isinstance(value, str):
            return value
        try:
            return convert(value, self.symbol)
        except ValueError as error:
            if len(value) <= LONGEST and re.match(r"\s*[+-]?\d+,\d", value):
                raise PydanticCustomError(
                    "unit",
                    "{reason}; write a point for the decimal comma: '{meant}'",
                    {"reason": str(error), "meant": value.replace(",", ".")},
                ) from error
            raise PydanticCustomError(
                "unit",
                "{reason}; write a number, or a number with a unit such as '{example}'",
                {"reason": str(error), "example": f"12 {self.symbol}".strip()},
            ) from error


Millimetres = Annotated[float, Unit("mm")]
"""A length."""
Degrees = Annotated[float, Unit("deg")]
"""An angle in a design file."""
RevPerMin = Annotated[float, Unit("rpm")]
"""A speed of rotation in a design file."""
MillimetresPerMin = Annotated[float, Unit("mm/min")]
"""A feed rate."""
MetresPerMin = Annotated[float, Unit("m/min")]
"""A cutting speed."""
Newtons = Annotated[float, Unit("N")]
"""A force."""
NewtonMetres = Annotated[float, Unit("N*m")]
"""A torque."""
Kilowatts = Annotated[float, Unit("kW")]
"""A power."""
Seconds = Annotated[float, Unit("s")]
"""A time."""
Ratio = Annotated[float, Unit("")]
"""A pure number."""

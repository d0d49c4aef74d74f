"""Units of design files.

A design file speaks millimetres, degrees and revolutions per minute. A bare number is in the unit that its
field declares; a string may carry any unit of the same kind (``"2 in"``, ``"0.5 rad"``). A parameter object
holds the declared unit, exactly as the file says it; everything computed from it is in millimetres, radians
and seconds.
"""

from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError, core_schema


@cache
def _registry() -> Any:
    # pint takes 0.2 s to import; most design files carry no unit strings.
    import pint

    return pint.UnitRegistry()


def convert(text: str, unit: str) -> float:
    """Read a quantity with a unit, and give its magnitude in ``unit``.

    Parameters
    ----------
    text
        A number and a unit, such as ``"2 in"``; a number alone is taken to be in ``unit``.
    unit
        The wanted unit, as pint spells it; ``""`` for a pure number.

    Raises
    ------
    ValueError
        The text is no quantity, or of another kind than ``unit``.

    Examples
    --------
    >>> convert("2 in", "mm")
    50.8
    >>> convert("40", "mm")
    40.0
    >>> convert("2 kg", "mm")
    Traceback (most recent call last):
    ...
    ValueError: '2 kg' cannot be read in mm
    """
    try:
        return float(text)
    except ValueError:
        pass
    registry = _registry()
    try:
        quantity = registry.Quantity(text)
        if quantity.dimensionless != (unit == "") and unit not in {"deg", "rpm"}:
            raise ValueError(text)
        if unit in {"deg", "rpm"} and quantity.unitless:
            raise ValueError(text)
        return round(float(quantity.to(unit or "dimensionless").magnitude), 12)
    except Exception as error:
        # pint lets a tokenizer's, a parser's and its own errors through: one meaning for the user.
        raise ValueError(f"'{text}' cannot be read in {unit or 'a plain number'}") from error


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
        if not isinstance(value, str):
            return value
        try:
            return convert(value, self.symbol)
        except ValueError as error:
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
Seconds = Annotated[float, Unit("s")]
"""A time."""
Ratio = Annotated[float, Unit("")]
"""A pure number."""

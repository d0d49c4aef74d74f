"""How long a unit of a drawing is."""

from typing import TYPE_CHECKING, Literal, get_args

from mechwright.drawings.fault import Told

if TYPE_CHECKING:
    from ezdxf.document import Drawing

UnitName = Literal["drawing", "mm", "cm", "inch", "m", "foot", "mil", "um"]
"""What may be said of a drawing; ``drawing``: as it says itself."""

LENGTHS: dict[str, float] = {
    "mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 0.001, "inch": 25.4, "foot": 304.8, "mil": 0.0254,
}  # fmt: skip
"""mm."""

CODES = {1: "inch", 2: "foot", 4: "mm", 5: "cm", 6: "m", 9: "mil", 13: "um"}
"""$INSUNITS to the unit; miles and light years are no units of a plate."""

NAMES = tuple(name for name in get_args(UnitName) if name != "drawing")


def unit_of(document: "Drawing", asked: str, told: Told) -> float:
    """Length of a unit of the drawing, mm; a fault where neither the drawing nor the design says it."""
    code = int(document.header.get("$INSUNITS", 0))
    own = CODES.get(code)
    if asked != "drawing":
        if own is not None and own != asked:
            told.note(f"the drawing says it is in {own}; it is read in {asked}, as units asks for")
        return LENGTHS[asked]
    if own is not None:
        told.note(f"the drawing is in {own}")
        return LENGTHS[own]
    said = f"$INSUNITS {code}" if code else "no $INSUNITS"
    hint = {0: ", and $MEASUREMENT hints at inches", 1: ", and $MEASUREMENT hints at mm"}.get(
        int(document.header.get("$MEASUREMENT", -1)) if "$MEASUREMENT" in document.header else -1, ""
    )
    told.fault(
        "units",
        f"the drawing says no unit that a mill knows ({said}{hint})",
        f'say which one it is drawn in: units = "mm", or one of {", ".join(NAMES[1:])}',
        "units",
    )
    return 1.0

"""The family ``plate``."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

from mechwright import DesignError, Standing, refuse
from mechwright_plate.params import PlateParams

if TYPE_CHECKING:
    from mechwright import DesignTable, Part
    from mechwright.contracts.rule_list import Rules


class Plate(Standing[PlateParams]):
    """A plate from a DXF drawing: layers say what is cut, and how deep."""

    name = "plate"
    title = "Plate from a drawing"
    summary = "A flat part from a DXF drawing, whose layers say what is cut and how deep."
    Params = PlateParams
    bodies: ClassVar[tuple[str, ...]] = ("bench",)

    def draft(self, source: str, text: str) -> PlateParams:
        """A plate from a drawing, each of its layers with a meaning."""
        from mechwright import InputFile
        from mechwright.drawings.reading import layers_of

        if not source:
            return PlateParams()
        if not text:
            raise DesignError(
                f"--from: {source!r} is no file; name a DXF drawing that lies beside the design"
            )
        data = text.encode()
        return PlateParams(drawing=InputFile(source, data), layers=layers_of(data))

    def rules(self) -> "Rules[DesignTable[PlateParams]]":
        """What keeps the drawing from being a plate, each with its place; what was mended or left out."""
        from mechwright_plate.made import RULES

        return RULES

    def parts(self, params: PlateParams) -> "Sequence[Part]":
        """The plate."""
        from mechwright_plate.made import made

        found = made(params)
        refuse(found.findings)
        assert found.part is not None  # noqa: S101 - a drawing without faults is a part
        return [found.part]

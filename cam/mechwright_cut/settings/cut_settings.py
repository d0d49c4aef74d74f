"""The keys of ``[cut]``."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.parameters import FIRST, GIVEN, Parameters
from mechwright.units import Millimetres, MillimetresPerMin, Ratio, Seconds, Unit
from mechwright_cut.settings.figures import Process, ProcessName, processes
from mechwright_cut.settings.services import services

LASER, WATERJET, PLASMA, WIRE, SERVICE = NAMES = ("laser", "waterjet", "plasma", "wire", "service")
"""What ``process`` says."""
SKIMS = (0.0, 0.01, 0.05, 0.06)
"""By how much the offset of a wire's last pass, the one before, and so on, is above the last one, mm."""
Control = Literal["", "grbl-laser", "linuxcnc-beam"]
ServiceName = Literal["sendcutsend", "ponoko", "snapcut", "acute-laser"]


class MeasuredKerf(Parameters):
    """A kerf of yours: a row of ``kerfs``."""

    process: ProcessName = Field(description="Process.")
    material: str = Field(min_length=1, max_length=40, description='Material or group, or "any".')
    thickness: Millimetres = Field(gt=0, le=500, description="Thickness of the sheet.")
    kerf: Millimetres = Field(gt=0, le=10, description="Width of the slot.")


class CutSheet(Parameters):
    """The sheet that parts are cut from."""

    length: Millimetres = Field(600.0, gt=0, le=10000, description="Size in X.", json_schema_extra=GIVEN)
    width: Millimetres = Field(400.0, gt=0, le=10000, description="Size in Y.", json_schema_extra=GIVEN)
    margin: Millimetres = Field(5.0, ge=0, le=200, description="Between the edge and the nearest cut.")
    gap: Millimetres | None = Field(
        None, gt=0, le=100, description="Between two parts. Default: both leads and the least web."
    )


class CutSettings(Parameters):
    """The table ``[cut]`` of a design file."""

    laser: Literal["co2", "diode", "fibre"] = Field(
        "co2", description='Kind of the laser, where process = "laser".', json_schema_extra=FIRST
    )
    service: ServiceName = Field("sendcutsend", description='Who cuts, where process = "service".')
    by: Literal["laser", "waterjet", "plasma", "wire"] = Field("laser", description="How the service cuts.")
    control: Control = Field("", description="Control of a beam. Default: the usual one of the process.")
    kerf: Millimetres | None = Field(
        None, gt=0, le=10, description="Kerf. Default: measured or built in.", json_schema_extra=GIVEN
    )
    kerfs: tuple[MeasuredKerf, ...] = Field((), max_length=500, description="Measured kerfs.")
    feed: MillimetresPerMin = Field(
        600.0, gt=0, le=60000, description="Feed of the beam.", json_schema_extra=FIRST
    )
    power: Ratio = Field(80.0, gt=0, le=100, description="Power of the beam.", json_schema_extra=FIRST)
    full_power: int = Field(
        1000, ge=1, le=100000, description="S word of full power: $30 of Grbl.", json_schema_extra=GIVEN
    )
    passes: int = Field(1, ge=1, le=30, description="Passes of each contour.")
    pierce: Seconds = Field(0.0, ge=0, le=30, description="Time to pierce.")
    lead: Millimetres | None = Field(
        None, gt=0, le=50, description="Radius of the lead. Default: 2 kerfs, at least 1."
    )
    overcut: Millimetres = Field(0.5, ge=0, le=10, description="Way past the start of each contour.")
    joints: int = Field(0, ge=0, le=12, description="Micro-joints that hold each part in the sheet.")
    joint_width: Millimetres = Field(0.4, gt=0, le=5, description="Width of the material of a micro-joint.")
    common_lines: bool = Field(
        False, description="Parts that share a straight edge lie one kerf apart, and it is cut once."
    )
    engrave_power: Ratio = Field(20.0, gt=0, le=100, description="Power that marks the surface.")
    engrave_feed: MillimetresPerMin = Field(1500.0, gt=0, le=60000, description="Feed of engraving.")
    fits: Literal["ream", "bush", "refuse"] = Field(
        "ream",
        description="Holes whose fit is not held: cut small and reamed, cut for a bush, or refused.",
    )
    bush: Millimetres = Field(1.5, gt=0, le=20, description="Wall of such a bush.")
    small_holes: Literal["refuse", "spot"] = Field(
        "refuse", description="Holes below the least one: refused, or marked to be drilled."
    )
    extraction: bool = Field(False, description="Fumes are drawn off, and somebody watches for flames.")
    offsets: tuple[Millimetres, ...] = Field(
        (), max_length=9, description="Of wire: D1, D2 ... Default: by the number of passes."
    )
    start_hole: Millimetres = Field(1.0, gt=0, le=10, description="Diameter of start holes for the wire.")
    tab: Millimetres = Field(1.0, gt=0, le=20, description="Bridge that is cut last, by a wire.")
    wire_rate: Annotated[float, Field(gt=0, le=10000), Unit("mm^2/min")] | None = Field(
        None, description="Area of walls that your wire runs along in a minute, over all passes: for times."
    )
    sheet: CutSheet = Field(CutSheet(), description="The sheet.")

    @model_validator(mode="after")
    def _together(self) -> Self:
        if self.engrave_power >= self.power:
            raise ValueError(
                f"engrave_power {self.engrave_power:g} % is not below power {self.power:g} %; a mark would "
                f"go through: set engrave_power = {self.power / 4:g}"
            )
        if self.offsets and len(self.offsets) != self.passes:
            raise ValueError(
                f"offsets has {len(self.offsets)} values for {self.passes} passes; give one each"
            )
        if any(after > before for before, after in zip(self.offsets, self.offsets[1:], strict=False)):
            raise ValueError("offsets rise; a later pass comes nearer to the wall: sort them downwards")
        return self

    def registers(self, kerf: float) -> tuple[float, ...]:
        """D1, D2 ... of a wire, mm: those that are given, or the usual ones; the last is half the kerf.

        A skim leaves the next one little: usual differences, by practice, are in ``SKIMS``.

        >>> CutSettings(passes=3).registers(0.28)
        (0.19, 0.15, 0.14)
        """
        if self.offsets:
            return self.offsets
        left = SKIMS[: self.passes] + (0.0,) * (self.passes - len(SKIMS))
        return tuple(round(kerf / 2 + left[self.passes - 1 - number], 4) for number in range(self.passes))

    @property
    def cutting(self) -> tuple[float, float]:
        """S word and feed, mm/min, of a cut."""
        return self.full_power * self.power / 100, self.feed

    @property
    def marking(self) -> tuple[float, float]:
        """S word and feed, mm/min, of a mark."""
        return self.full_power * self.engrave_power / 100, self.engrave_feed

    def kind(self, process: str, material: str) -> Process:
        """The figures of what cuts a material: of a service, that by which it does, with its own limits.

        A service has a fibre laser for metals.

        >>> CutSettings(laser="diode").kind("laser", "mdf").words
        'diode laser'
        >>> [CutSettings(by=by).kind("service", "steel").words for by in ("laser", "wire")]
        ['fibre laser of SendCutSend', 'wire erosion of SendCutSend']
        """
        if process == SERVICE:
            return services()[self.service].limited(self._by_service(material))
        return processes()[f"{self.laser}-laser" if process == LASER else process]

    def _by_service(self, material: str) -> Process:
        if self.by != LASER:
            return processes()[self.by]
        metal = MATERIALS[material].kind in {"steel", "soft metal"} if material in MATERIALS else False
        return processes()["fibre-laser" if metal else "co2-laser"]

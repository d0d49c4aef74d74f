"""The design table of a Geneva mechanism."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.contracts.fits import HoleClass
from mechwright.contracts.keyed import KeywayRelief, KeywayWidth
from mechwright.units import Millimetres, RevPerMin, Unit
from mechwright_geneva.defaults.proportions import FLOOR, floor_of

LawName = Literal[
    "cycloidal",
    "modified-sine",
    "modified-trapezoid",
    "3-4-5",
    "4-5-6-7",
    "simple-harmonic",
    "straight",
    "polynomial",
    "table",
]

Coefficient = Annotated[float, Field(ge=-1e6, le=1e6), Unit("")]
Share = Annotated[float, Field(ge=-1, le=2), Unit("")]


class GenevaParams(Parameters):
    """A driver with rollers and a wheel with slots.

    Examples
    --------
    >>> GenevaParams(slots=6).construction
    'auto'
    """

    also: ClassVar[Mapping[str, str]] = {
        "stations": "they are called slots",
        "steps": "they are called slots",
        "divisions": "they are called slots",
        "wheel_diameter": "entry_radius tells it: from the wheel's axis to where a roller's centre enters",
        "wheel_radius": "entry_radius tells it: from the wheel's axis to where a roller's centre enters",
        "diameter": "entry_radius tells the wheel's: from its axis to where a roller's centre enters",
        "index_time": "it is crank_half_angle / (3 speed) s, in degrees and rev/min",
        "dwell": "crank_half_angle tells it: the wheel rests for 360 degrees less twice as much",
    }

    slots: int = Field(
        4,
        ge=3,
        le=12,
        description="Number of slots n of the wheel, which turns by 360/n.",
        json_schema_extra=FIRST,
    )
    law: LawName = Field(
        "cycloidal",
        description="How the wheel goes from rest to rest: straight slots with a jerk, curved ones smoothly.",
        json_schema_extra=FIRST,
    )
    polynomial: Annotated[tuple[Coefficient, ...], Field(max_length=16)] | None = Field(
        None, description='Coefficients c0, c1, ... of s(u) for law = "polynomial"; s and u run from 0 to 1.'
    )
    table: Annotated[tuple[tuple[Share, Share], ...], Field(max_length=1000)] | None = Field(
        None, description='Rows [u, s] for law = "table", both from 0 to 1.'
    )
    crank_half_angle: Annotated[float, Field(ge=5, le=120), Unit("deg")] | None = Field(
        None,
        description=(
            "Half the crank's angle of a stroke. Default: 90 - 180/n for straight slots, usual for others."
        ),
    )
    offset_angle: Annotated[float, Field(ge=-60, le=60), Unit("deg")] | None = Field(
        None,
        description=(
            "Half the angle between the mouths of a slot; its sign tells the island's side. Default: "
            "0 for straight slots, usual for others."
        ),
    )
    entry_radius: Annotated[float, Field(ge=5, le=1000), Unit("mm")] | None = Field(
        None,
        description=(
            "Radius of the wheel, where the roller's centre enters. Default: as centre_distance wants it, "
            "or 100, and more where the driver needs room."
        ),
        json_schema_extra=FIRST,
    )
    centre_distance: Annotated[float, Field(ge=5, le=3000), Unit("mm")] | None = Field(
        None, description="Distance of the axes. Default: as wheel and angles give it."
    )
    roller_radius: Annotated[float, Field(ge=0.5, le=100), Unit("mm")] | None = Field(
        None,
        description=(
            "Radius of the rollers. Default: the largest standard one up to a twentieth of entry_radius "
            "with which the slots are sound."
        ),
        json_schema_extra=FIRST,
    )
    groove_clearance: Millimetres = Field(
        0.08, ge=0, le=2, description="How much wider a slot is than the roller; 0.08 runs as made."
    )
    rollers: int = Field(
        1, ge=1, le=4, description="Number of rollers on the driver, evenly spaced.", json_schema_extra=FIRST
    )
    lock_radius: Annotated[float, Field(ge=1, le=1000), Unit("mm")] | None = Field(
        None, description="Radius of the locking disc. Default: the largest that leaves the least wall."
    )
    lock_clearance: Millimetres = Field(
        0.1, ge=0.005, le=2, description="Gap between the locking disc and the wheel."
    )
    least_wall: Annotated[float, Field(ge=0.2, le=50), Unit("mm")] | None = Field(
        None,
        description=(
            "Thinnest wall that may stay anywhere: webs, horns, islands, hubs. Default: 2, less on wheels "
            "below 70."
        ),
    )
    thickness: Millimetres = Field(
        10.0, ge=1, le=200, description="Thickness of the wheel, floor included.", json_schema_extra=FIRST
    )
    construction: Literal["auto", "through", "blind", "backed"] = Field(
        "auto",
        description=(
            "Slots cut through, blind grooves, or slots cut through with the islands on a backing plate; "
            "auto: through if straight, else blind."
        ),
    )
    floor: Millimetres = Field(
        FLOOR,
        ge=0.2,
        le=100,
        description=(
            "Thickness of the floor under the grooves, or of the backing plate. Default: 3, or three tenths "
            "of a wheel below 10."
        ),
        json_schema_extra=FITTED,
    )
    bore: Annotated[float, Field(ge=0, le=300), Unit("mm")] | None = Field(
        None,
        description=(
            "Shaft bore of the wheel, 0 for none. Default: the largest standard one up to 0.12 "
            "entry_radius that leaves the walls."
        ),
        json_schema_extra=FIRST,
    )
    keyway_width: KeywayWidth = Field(
        0.0, description="Width of the wheel's keyway (DIN 6885-1); 0 for none."
    )
    counterbore_diameter: Millimetres = Field(
        0.0, ge=0, le=300, description="Recess about the wheel's bore, for the shaft's screw; 0 for none."
    )
    counterbore_depth: Millimetres = Field(3.0, ge=0.2, le=100, description="Depth of that recess.")
    counterbore_radius: Millimetres = Field(
        0.0, ge=0, le=20, description="Fillet between floor and wall of that recess; 0 for a sharp corner."
    )
    counterbore_side: Literal["top", "underside"] = Field(
        "top", description="Side of the wheel on which that recess is."
    )
    hub_diameter: Millimetres = Field(
        0.0, ge=0, le=500, description="Diameter of a hub plate under the wheel; 0 for none."
    )
    hub_height: Millimetres = Field(8.0, ge=1, le=200, description="Height of the hub plate.")
    driver_bore: Annotated[float, Field(ge=0, le=300), Unit("mm")] | None = Field(
        None,
        description="Shaft bore of the driver, 0 for none. Default: found as bore is.",
        json_schema_extra=FIRST,
    )
    driver_keyway_width: KeywayWidth = Field(
        0.0, description="Width of the driver's keyway (DIN 6885-1); 0 for none."
    )
    keyway_relief: KeywayRelief = 0.0
    crank_thickness: Annotated[float, Field(ge=1, le=100), Unit("mm")] | None = Field(
        None,
        description="Thickness of the crank plate. Default: 8, with pins below 2 three and a half of them.",
    )
    disc_thickness: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Thickness of the locking disc. Default: the thinnest plate that is sold and locks the "
        "wheel along its whole thickness.",
    )
    pin_diameter: Annotated[float, Field(ge=0.5, le=150), Unit("mm")] | None = Field(
        None,
        description=(
            "Diameter of the rollers' pins, and of their holes in the crank. Default: the largest standard "
            "one up to 1.2 roller_radius."
        ),
    )
    pin_fit: Literal["none"] | HoleClass = Field(
        "H7",
        description=(
            "ISO 286 class to the middle of which the pins' holes are made: F7 runs on an h6 pin, "
            "H7 locates it, N7 and P7 hold it; none for the bare diameter."
        ),
    )
    fixing: Annotated[float, Field(ge=0, le=30), Unit("mm")] | None = Field(
        None,
        description=(
            "Diameter of the dowels that join stacked plates, 0 for none. Default: 4, or the largest "
            "standard one that the driver has room for."
        ),
    )
    axial_gap: Millimetres = Field(
        0.5, ge=0.05, le=10, description="Gap along the axes between wheel, crank plate and rollers."
    )
    material: MaterialName = Field("steel", description="Material of the plates.", json_schema_extra=FIRST)
    roller_material: MaterialName = Field("steel", description="Material of rollers and pins.")
    speed: RevPerMin = Field(
        60.0,
        ge=0.001,
        le=20000,
        description="Speed of the driver: constant, mean, at the first entry, or that it comes to from rest.",
        json_schema_extra=FIRST,
    )
    driver_law: Literal["constant", "accelerating", "from-rest", "harmonic"] = Field(
        "constant",
        description=(
            "Speed of the driver: constant; accelerating all along from speed at the first entry; from rest "
            "at the first entry up to speed; or varying once a turn, fastest in the middle of a stroke."
        ),
    )
    driver_acceleration: Annotated[float, Field(ge=-1e6, le=1e6), Unit("rad/s^2")] | None = Field(
        None, description="Acceleration of the driver that accelerates; below 0 it slows down."
    )
    driver_variation: Annotated[float, Field(gt=0, le=0.9), Unit("")] | None = Field(
        None, description="Share of speed by which a harmonic driver is faster, and slower."
    )
    driver_direction: Literal["forwards", "backwards"] = Field(
        "forwards",
        description="Sense of the driver: clockwise, the wheel counter-clockwise, or backwards.",
    )
    load_inertia: Annotated[float, Field(ge=0, le=1e4), Unit("kg*m^2")] | None = Field(
        None,
        description=(
            "Moment of inertia that turns with the wheel, its own included. Default: 0.01, and of wheels "
            "below 100 less, with the fourth power of entry_radius."
        ),
        json_schema_extra=FIRST,
    )
    load_torque: Annotated[float, Field(ge=0, le=1e6), Unit("N*m")] = Field(
        0.0, description="Constant torque against the wheel's turning.", json_schema_extra=FIRST
    )

    def fitted(self) -> Mapping[str, Any]:
        """The floor of a thin wheel."""
        return {} if "floor" in self.model_fields_set else {"floor": floor_of(self.thickness)}

    @property
    def slots_made(self) -> Literal["through", "blind", "backed"]:
        """How the slots are made."""
        if self.construction != "auto":
            return self.construction
        return "through" if self.law == "straight" else "blind"

    @property
    def groove_depth(self) -> float:
        """Depth of the slots, mm."""
        return self.thickness - (0.0 if self.slots_made == "through" else self.floor)

    @property
    def roller_length(self) -> float:
        """Length of the roller in the slot, mm: over a floor it keeps the axial gap."""
        return self.groove_depth - (0.0 if self.slots_made == "through" else self.axial_gap)

    @model_validator(mode="after")
    def _together(self) -> Self:
        for law in ("polynomial", "table"):
            given = getattr(self, law)
            if self.law == law and not given:
                raise ValueError(f'law = "{law}" needs {law}; give it, or name another law')
            if self.law != law and given is not None:
                raise ValueError(
                    f'{law} is given but law is "{self.law}"; set law = "{law}", or leave it out'
                )
        self._driven("driver_acceleration", self.driver_acceleration, ("accelerating", "from-rest"))
        self._driven("driver_variation", self.driver_variation, ("harmonic",))
        if self.driver_law == "from-rest" and (self.driver_acceleration or 0) <= 0:
            raise ValueError("driver_acceleration: from rest it is above 0; driver_direction has the sense")
        return self

    def _driven(self, key: str, value: float | None, laws: tuple[str, ...]) -> None:
        """Whether what a law of the driver needs is there, and with no other law."""
        if self.driver_law in laws and value is None:
            raise ValueError(f'driver_law = "{self.driver_law}" needs {key}; give it, or name another law')
        if self.driver_law not in laws and value is not None:
            raise ValueError(
                f'{key} is given but driver_law is "{self.driver_law}"; set it to "{laws[0]}", or leave '
                f"{key} out"
            )


class Sizes(GenevaParams):
    """A design table without open dimensions; :mod:`mechwright_geneva.defaults.dimensions` completes one."""

    crank_half_angle: float
    offset_angle: float
    entry_radius: float
    centre_distance: float
    roller_radius: float
    least_wall: float
    bore: float
    driver_bore: float
    pin_diameter: float
    crank_thickness: float
    disc_thickness: float
    fixing: float
    load_inertia: float
    left_out: tuple[str, ...] = ()
    """The keys of the above that the design file leaves out."""

"""The design table of a Geneva mechanism."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from mechwright import MaterialName, Parameters
from mechwright.contracts.fits import HoleClass
from mechwright.units import Millimetres, RevPerMin, Unit

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

    slots: int = Field(4, ge=3, le=12, description="Number of slots n of the wheel, which turns by 360/n.")
    law: LawName = Field("cycloidal", description="How the wheel goes from rest to rest.")
    polynomial: Annotated[tuple[Coefficient, ...], Field(max_length=16)] | None = Field(
        None, description='Coefficients c0, c1, ... of s(u) for law = "polynomial"; s and u run from 0 to 1.'
    )
    table: Annotated[tuple[tuple[Share, Share], ...], Field(max_length=1000)] | None = Field(
        None, description='Rows [u, s] for law = "table", both from 0 to 1.'
    )
    crank_half_angle: Annotated[float, Field(ge=5, le=120), Unit("deg")] | None = Field(
        None,
        description=(
            "Half the crank's angle of a stroke; left out, 90 - 180/n for straight slots, 5 more for others."
        ),
    )
    offset_angle: Annotated[float, Field(ge=-60, le=60), Unit("deg")] | None = Field(
        None,
        description=(
            "Half the angle between the mouths of a slot; its sign tells the island's side. Left out, "
            "5, or 0 for straight slots."
        ),
    )
    entry_radius: Millimetres = Field(
        100.0, ge=5, le=1000, description="Radius of the wheel, where the roller's centre enters."
    )
    roller_radius: Millimetres = Field(5.0, ge=0.5, le=100, description="Radius of the rollers.")
    groove_clearance: Millimetres = Field(
        0.08, ge=0, le=2, description="How much wider a slot is than the roller; 0.08 runs as made."
    )
    rollers: int = Field(1, ge=1, le=4, description="Number of rollers on the driver, evenly spaced.")
    lock_radius: Annotated[float, Field(ge=1, le=1000), Unit("mm")] | None = Field(
        None, description="Radius of the locking disc; left out, the largest that leaves the least wall."
    )
    lock_clearance: Millimetres = Field(
        0.1, ge=0.005, le=2, description="Gap between the locking disc and the wheel."
    )
    least_wall: Millimetres = Field(
        2.0, ge=0.2, le=50, description="Thinnest wall that may stay anywhere: webs, horns, islands, hubs."
    )
    thickness: Millimetres = Field(10.0, ge=1, le=200, description="Thickness of the wheel, floor included.")
    construction: Literal["auto", "through", "blind", "backed"] = Field(
        "auto",
        description=(
            "Slots cut through, blind grooves, or slots cut through with the islands on a backing plate; "
            "auto: through if straight, else blind."
        ),
    )
    floor: Millimetres = Field(
        3.0, ge=0.2, le=100, description="Thickness of the floor under the grooves, or of the backing plate."
    )
    bore: Millimetres = Field(12.0, ge=0, le=300, description="Shaft bore of the wheel; 0 for none.")
    keyway_width: Millimetres = Field(
        0.0, ge=0, le=60, description="Width of the wheel's keyway (DIN 6885-1); 0 for none."
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
    driver_bore: Millimetres = Field(12.0, ge=0, le=300, description="Shaft bore of the driver; 0 for none.")
    driver_keyway_width: Millimetres = Field(
        0.0, ge=0, le=60, description="Width of the driver's keyway (DIN 6885-1); 0 for none."
    )
    keyway_relief: Millimetres = Field(
        0.0, ge=0, le=20, description="Diameter of the reliefs in the keyways' corners; 0 for none."
    )
    crank_thickness: Millimetres = Field(8.0, ge=1, le=100, description="Thickness of the crank plate.")
    pin_diameter: Millimetres = Field(
        6.0, ge=0.5, le=150, description="Diameter of the rollers' pins, and of their holes in the crank."
    )
    pin_fit: Literal["none"] | HoleClass = Field(
        "H7",
        description=(
            "ISO 286 class to the middle of which the pins' holes are made: F7 runs on an h6 pin, "
            "H7 locates it, N7 and P7 hold it; none for the bare diameter."
        ),
    )
    fixing: Millimetres = Field(
        4.0, ge=0, le=30, description="Diameter of the dowels that join stacked plates; 0 for none."
    )
    axial_gap: Millimetres = Field(
        0.5, ge=0.05, le=10, description="Gap along the axes between wheel, crank plate and rollers."
    )
    material: MaterialName = Field("steel", description="Material of the plates.")
    roller_material: MaterialName = Field("steel", description="Material of rollers and pins.")
    speed: RevPerMin = Field(60.0, ge=0.001, le=20000, description="Constant speed of the driver.")
    load_inertia: Annotated[float, Field(ge=0, le=1e4), Unit("kg*m^2")] = Field(
        0.01, description="Moment of inertia that turns with the wheel, the wheel's own included."
    )
    load_torque: Annotated[float, Field(ge=0, le=1e6), Unit("N*m")] = Field(
        0.0, description="Constant torque against the wheel's turning."
    )

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
        return self

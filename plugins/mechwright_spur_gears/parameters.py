"""The design table of spur gears."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from mechwright import FIRST, FITTED, MaterialName, Parameters
from mechwright.contracts.design_table import number
from mechwright.contracts.gear_fields import Backlash, FaceWidth, LoadTorque, ShaftBore
from mechwright.contracts.keyed import KeywayDepth, KeywayRelief, KeywayWidth, keyed_together
from mechwright.mechanics.gearing import rack_plate
from mechwright.mechanics.gearing.rim_rules import HOLE
from mechwright.mechanics.gearing.ring_plate import HOLES, outside_for
from mechwright.mechanics.gearing.usual import RIM, TIP_RADIUS, face_width, shaft_bore
from mechwright.units import Degrees, Ratio, RevPerMin, Unit
from mechwright_spur_gears.arrangements import ARRANGED, Arrangement
from mechwright_spur_gears.pair import (
    least_root,
    module_of,
    pair_of,
    rack_addendum,
    rack_pair_of,
    rack_tip_radius,
    ring_height,
    ring_pair_of,
    travel_of,
)

LEAST_MODULE = 0.3
"""mm."""

Member = Literal["sun", "ring", "carrier"]
"""Of a planetary set."""

PLANETS, CARRIER = 3, 8.0
"""Planets of a set that names no number, and the thickness of its carrier, mm."""

LEAST_RACK = 2
"""Teeth of a rack at least."""

Shift = Annotated[float, Field(ge=-1, le=1), Unit("")]


class SpurGearParams(Parameters):
    """Gears with involute teeth and profile shift: two, one in a ring, a planetary set, a rack and pinion.

    Examples
    --------
    >>> SpurGearParams(module=1.0).thickness
    4.0
    """

    also: ClassVar[Mapping[str, str]] = {
        "ratio": "it is mate_teeth over teeth",
        "pinion_teeth": "it is called teeth",
        "gear_teeth": "it is called mate_teeth",
        "dp": "it is called diametral_pitch",
        "x1": "it is called shift",
        "x2": "it is called mate_shift",
        "face_width": "it is called thickness",
        "internal": 'set arrangement = "internal"',
        "sun_teeth": "it is called teeth",
        "planet_teeth": "it is called mate_teeth",
        "number_of_planets": "it is called planets",
        "stroke": "it is called travel",
        "pinion": "its number of teeth is called teeth",
        "rack": 'set arrangement = "rack"',
    }

    arrangement: Arrangement = Field(
        "external",
        description="external: two gears. internal: a gear in a ring with teeth inside. planetary: a sun, "
        "planets about it on a carrier, and a ring. rack: a pinion that drives a straight rack.",
        json_schema_extra=FIRST,
    )
    teeth: int = Field(
        20,
        ge=6,
        le=600,
        description="Teeth z1 of the driver, of the sun, or of the pinion of a rack.",
        json_schema_extra=FIRST,
    )
    mate_teeth: int = Field(
        40, ge=6, le=600, description="Teeth z2 of the driven gear, or of a planet.", json_schema_extra=FIRST
    )
    module: Annotated[float, Field(ge=LEAST_MODULE, le=25), Unit("mm")] | None = Field(
        2.0,
        description="Reference diameter over the number of teeth; give this or diametral_pitch.",
        json_schema_extra=FIRST,
    )
    diametral_pitch: Annotated[float, Field(ge=1, le=85), Unit("")] | None = Field(
        None, description="Teeth per inch of reference diameter, in place of module."
    )
    pressure_angle: Degrees = Field(
        20.0, ge=14.5, le=30, description="Pressure angle of the rack.", json_schema_extra=FIRST
    )
    centre_distance: Annotated[float, Field(ge=2, le=3000), Unit("mm")] | None = Field(
        None,
        description="Distance of the axes, from which the sum of the shifts follows. Default: what the "
        "shifts make of it. Of a rack the distance of the pinion's axis from its reference line, r + x m.",
        json_schema_extra=FIRST,
    )
    shift: Shift | None = Field(
        None,
        description="Profile shift x1 of the driver, in modules. Default: chosen by shift_rule.",
        json_schema_extra=FIRST,
    )
    mate_shift: Shift | None = Field(
        None,
        description="Profile shift x2 of the driven gear, in modules. Default: chosen by shift_rule. Of a "
        "ring it is above 0 where teeth get thicker (DIN 3960). Default: that of the driver taken away.",
        json_schema_extra=FIRST,
    )
    shift_rule: Literal["no-undercut", "equal-sliding"] | None = Field(
        None,
        description="Choice of the shifts of two gears, where the table states none. no-undercut (default): "
        "none, or the least without undercut; the smaller gear gets more of a sum that the centre distance "
        "needs. equal-sliding: the same sum, shared so that the feet of both flanks slide alike.",
    )
    addendum: Ratio = Field(
        1.0, ge=0.5, le=1.3, description="Tooth height over the rack's pitch line, modules."
    )
    dedendum: Ratio = Field(1.25, ge=0.6, le=1.8, description="Depth below it, in modules.")
    tip_radius: Ratio = Field(
        TIP_RADIUS,
        ge=0,
        le=0.5,
        description="Radius at the tip of the rack, in modules. Default: 0.38, or what there is room for.",
        json_schema_extra=FITTED,
    )
    ring_addendum: Annotated[float, Field(ge=0.2, le=1.3), Unit("")] | None = Field(
        None,
        description="Height of the ring's teeth, in modules. Default: addendum, or what keeps them off the "
        "feet of the pinion's flanks.",
        json_schema_extra=FITTED,
    )
    ring_outside: Annotated[float, Field(gt=0, le=4000), Unit("mm")] | None = Field(
        None,
        description="Diameter of the ring. Default: what its rim needs.",
        json_schema_extra=FITTED,
    )
    ring_holes: Annotated[int, Field(ge=0, le=60)] | None = Field(
        None, description="Holes by which the ring is screwed on. Default: 6.", json_schema_extra=FITTED
    )
    ring_hole: Annotated[float, Field(ge=1, le=100), Unit("mm")] | None = Field(
        None, description="Diameter of these holes. Default: 5.5.", json_schema_extra=FITTED
    )
    ring_teeth: Annotated[int, Field(ge=18, le=1800)] | None = Field(
        None,
        description="Teeth of the ring about the planets. Default: teeth + 2 mate_teeth.",
        json_schema_extra=FITTED,
    )
    planets: Annotated[int, Field(ge=1, le=12)] | None = Field(
        None, description="Number of planets. Default: 3.", json_schema_extra=FITTED
    )
    planet_spacing: Literal["equal", "nearest"] | None = Field(
        None,
        description="equal (default): planets stand at equal angles. nearest: at the angles next to them at "
        "which they mesh.",
    )
    fixed_member: Member | None = Field(
        None, description="Member that stands still. Default: the ring.", json_schema_extra=FITTED
    )
    driving_member: Member | None = Field(
        None, description="Member that is driven from outside. Default: the sun.", json_schema_extra=FITTED
    )
    pin_diameter: Annotated[float, Field(ge=1, le=200), Unit("mm")] | None = Field(
        None,
        description="Of the pins on which planets run. Default: 10, or the largest standard one below that "
        "leaves the rim of a planet.",
        json_schema_extra=FITTED,
    )
    carrier_thickness: Annotated[float, Field(ge=0.5, le=200), Unit("mm")] | None = Field(
        None,
        description="Of the carrier's plate. Default: 8, or less with thinner gears.",
        json_schema_extra=FITTED,
    )
    rack_teeth: Annotated[int, Field(ge=2, le=4000)] | None = Field(
        None,
        description="Teeth of the rack. Default: the fewest with which flanks touch all over the travel.",
        json_schema_extra=FITTED,
    )
    travel: Annotated[float, Field(gt=0, le=3000), Unit("mm")] | None = Field(
        None,
        description="Way of the rack there, and back again. Default: 100, or what rack_teeth allow.",
        json_schema_extra=FITTED,
    )
    rack_addendum: Annotated[float, Field(ge=0.2, le=1.3), Unit("")] | None = Field(
        None,
        description="Height of the rack's teeth over its reference line, in modules. Default: addendum, or "
        "what keeps them off the fillets of the pinion.",
        json_schema_extra=FITTED,
    )
    rack_height: Annotated[float, Field(gt=0, le=1000), Unit("mm")] | None = Field(
        None,
        description="Height of the rack's body below its roots. Default: what its rim needs.",
        json_schema_extra=FITTED,
    )
    rack_holes: Annotated[int, Field(ge=0, le=200)] | None = Field(
        None,
        description="Holes by which the rack is screwed on. Default: 2, or fewer in a short rack.",
        json_schema_extra=FITTED,
    )
    rack_hole: Annotated[float, Field(ge=1, le=100), Unit("mm")] | None = Field(
        None, description="Diameter of these holes. Default: 5.5.", json_schema_extra=FITTED
    )
    backlash: Backlash | None = Field(
        None,
        description="Circumferential play on the operating pitch circles. Default: the least with which "
        "gears as made turn.",
    )
    thickness: FaceWidth = 10.0
    material: MaterialName = Field("aluminium", description="Workpiece material.", json_schema_extra=FIRST)
    bore: ShaftBore = Field(
        10.0,
        description="Diameter of the shaft bores, 0 for none. Default: 10, or the largest standard one "
        "below that leaves the rim of the smaller gear.",
    )
    keyway_width: KeywayWidth = Field(
        0.0, description="Width of both hub keyways, along +x at rest; 0 for none."
    )
    keyway_depth: KeywayDepth = None
    keyway_relief: KeywayRelief = 0.0
    speed: RevPerMin = Field(
        60.0,
        ge=0.001,
        le=20000,
        description="Constant speed of the driver; of a rack how often it goes there and back in a minute.",
        json_schema_extra=FIRST,
    )
    load_torque: LoadTorque = Field(
        0.0,
        description="Constant torque against the turning of the driven gear.",
    )
    load_force: Annotated[float, Field(ge=0, le=1e6), Unit("N")] = Field(
        0.0, description="Constant force against the rack, whichever way it goes.", json_schema_extra=FIRST
    )

    @model_validator(mode="before")
    @classmethod
    def _pitch_replaces_module(cls, table: Any) -> Any:
        if isinstance(table, dict) and table.get("diametral_pitch") is not None and "module" not in table:
            return {**table, "module": None}
        return table

    @model_validator(mode="after")
    def _together(self) -> Self:
        if (self.module is None) == (self.diametral_pitch is None):
            raise ValueError("give exactly one of module and diametral_pitch")
        keyed_together(self)
        for name, arrangements in ARRANGED.items():
            usual = type(self).model_fields[name].default
            if getattr(self, name) != usual and self.arrangement not in arrangements:
                raise ValueError(
                    f'{name} is for arrangement = "{arrangements[0]}"; leave it out of "{self.arrangement}"'
                )
        if self.centre_distance is not None and self.shift is not None and self.mate_shift is not None:
            raise ValueError(
                "centre_distance, shift and mate_shift: the sum of the shifts follows from the centre "
                "distance; leave one of the three out"
            )
        if self.arrangement == "rack" and self.centre_distance is not None and self.shift is not None:
            raise ValueError(
                "centre_distance and shift: the shift of a rack's pinion follows from the distance; leave "
                "one of both out"
            )
        if self.fixed_member is not None and self.fixed_member == self.driving_member:
            raise ValueError(
                f'fixed_member and driving_member are both "{self.fixed_member}"; set one of them to another '
                "of sun, ring and carrier"
            )
        return self

    def unused_fields(self) -> list[str]:
        """Keys of other arrangements."""
        return [name for name, arrangements in ARRANGED.items() if self.arrangement not in arrangements]

    def fitted(self) -> Mapping[str, Any]:
        """A face width that mills reach, and a bore that leaves the rim."""
        if (self.module is None) == (self.diametral_pitch is None):
            return {}
        found: dict[str, Any] = {}
        if "tip_radius" not in self.model_fields_set:
            found["tip_radius"] = number(rack_tip_radius(self))
        if "thickness" not in self.model_fields_set:
            found["thickness"] = number(face_width(module_of(self)))
        if self.arrangement == "rack":
            found |= self._rack(found)
        elif self.arrangement != "external":
            found |= self._ring(found)
        if "bore" not in self.model_fields_set:
            wall = RIM * module_of(self) * (self.addendum + self.dedendum)
            sized = self.model_copy(update=found)
            found["bore"] = number(shaft_bore(least_root(sized), wall))
        return found

    def _ring(self, found: Mapping[str, Any]) -> dict[str, Any]:
        """What a design leaves out of its ring and its planets."""
        left: dict[str, Any] = {}
        given = self.model_fields_set
        if self.arrangement == "planetary":
            left = self._planets(found)
        if "ring_addendum" not in given:
            left["ring_addendum"] = number(
                ring_height(self.model_copy(update={**found, **left, "ring_addendum": None}))
            )
        if "ring_holes" not in given:
            left["ring_holes"] = HOLES
        if "ring_hole" not in given:
            left["ring_hole"] = HOLE
        if "ring_outside" not in given:
            sized: Any = self.model_copy(update={**found, **left})
            pair = pair_of(sized)
            if self.arrangement == "planetary":
                pair = ring_pair_of(sized, pair)
            hole = np.where(np.asarray(sized.ring_holes) > 0, sized.ring_hole, 0.0)
            left["ring_outside"] = number(outside_for(-pair.root(1), hole, pair.tip(1) - pair.root(1)))
        return left

    def _rack(self, found: Mapping[str, Any]) -> dict[str, Any]:
        """What a design leaves out of its rack."""
        given = self.model_fields_set
        left: dict[str, Any] = {} if "rack_hole" in given else {"rack_hole": HOLE}
        if "rack_addendum" not in given:
            left["rack_addendum"] = number(rack_addendum(self.model_copy(update=dict(found))))
        sized: Any = self.model_copy(update={**found, **left})
        pair = rack_pair_of(sized)
        if "travel" not in given:
            left["travel"] = number(travel_of(sized, pair))
        if "rack_teeth" not in given:
            travel = np.asarray(left.get("travel", self.travel))
            teeth = np.maximum(pair.rack_teeth(travel), LEAST_RACK)
            left["rack_teeth"] = teeth if np.ndim(teeth) else int(teeth)
        sized = sized.model_copy(update=left)
        if "rack_holes" not in given:
            holes = rack_plate.holes_for(sized.rack_teeth * pair.pitch, sized.rack_hole + pair.module)
            left["rack_holes"] = holes if np.ndim(holes) else int(holes)
            sized = sized.model_copy(update=left)
        if "rack_height" not in given:
            hole = np.where(np.asarray(sized.rack_holes) > 0, sized.rack_hole, 0.0)
            left["rack_height"] = number(rack_plate.body_for(hole, pair.tip(1) - pair.root(1)))
        return left

    def _planets(self, found: Mapping[str, Any]) -> dict[str, Any]:
        """What a design leaves out of its planets and their carrier."""
        left: dict[str, Any] = {
            "ring_teeth": self.teeth + 2 * self.mate_teeth,
            "planets": PLANETS,
            "fixed_member": "carrier" if self.driving_member == "ring" else "ring",
            "driving_member": "carrier" if self.fixed_member == "sun" else "sun",
            "carrier_thickness": np.minimum(CARRIER, found.get("thickness", self.thickness)),
        }
        left = {name: value for name, value in left.items() if name not in self.model_fields_set}
        if "carrier_thickness" in left:
            left["carrier_thickness"] = number(left["carrier_thickness"])
        if "pin_diameter" not in self.model_fields_set:
            sized = self.model_copy(update={**found, **left})
            wall = RIM * module_of(self) * (self.addendum + self.dedendum)
            left["pin_diameter"] = number(shaft_bore(pair_of(sized).root(1), wall))
        return left

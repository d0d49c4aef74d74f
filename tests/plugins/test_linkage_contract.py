"""The contract of a family, for planar linkages."""

from typing import ClassVar

from day_contract import DayContract
from hypothesis import strategies as st

from mechwright.testing.results import Results
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.family import Linkages

DRAWN = {
    "linkage": "drawn",
    "points": {
        "A0": {"x": 0, "y": 0},
        "A": {"x": 25, "y": 20},
        "B": {"x": 120, "y": 10},
        "P": {"x": 60, "y": 50},
    },
    "links": {"ground": ["A0"], "crank": ["A0", "A"], "rod": ["A", "B", "P"], "slider": ["B"]},
    "slides": [{"block": "slider", "guide": "ground", "point": "B", "angle": 5}],
    "output": "slider",
}
"""A slider-crank whose rod carries a point."""

CYLINDER = {
    "linkage": "drawn",
    "points": {"A0": {"x": 0, "y": 0}, "B0": {"x": 100, "y": 0}, "B": {"x": 90, "y": 70}},
    "links": {"ground": ["A0", "B0"], "rocker": ["B0", "B"], "barrel": ["A0"], "rod": ["B"]},
    "slides": [{"block": "rod", "guide": "barrel", "point": "B", "angle": 37.874983651098}],
    "driver": "rod",
    "driver_on": "barrel",
    "output": "rocker",
    "stroke_from": -10,
    "stroke_to": 15,
}
"""A cylinder that turns a rocker."""


class TestLinkages(DayContract):
    family = Linkages
    examples: ClassVar = [{"linkage": "crank-shaper"}, DRAWN]
    refused: ClassVar = (
        ({"watt_1": {"crank": 40}}, "watt_1"),
        ({"points": {"A": {"x": 1}}}, "points"),
        ({**DRAWN, "driver": "rod"}, "driver"),
        ({**DRAWN, "output": "ram"}, "output"),
        ({**DRAWN, "scale": 0.05}, "points"),
        ({"linkage": "hoecken", "pin_diameter": 60}, "hoecken"),
        ({"linkage": "watt-2", "stroke_from": 0, "stroke_to": 5}, "stroke_from"),
        ({"linkage": "watt-2", "swing_from": 0, "swing_to": 0}, "swing_from"),
        ({"bushing_wall": 0.05}, "bushing_wall"),
    )
    variations: ClassVar = {
        "pairs": [[["rod", "ground"]], [["lever", "ground"]]],
        "loads": [[{"link": "ram", "force_x": 50}], [{"link": "slider", "force_x": 50}]],
        "springs": [
            [{"link": "ram", "point": "E", "on": "ground", "on_point": "A0", "rate": 0.5}],
            [{"link": "slider", "point": "B", "on": "ground", "on_point": "A0", "rate": 0.5}],
        ],
        "points": [{**DRAWN["points"], "A": {"x": 27, "y": 20}}],
        "links": [{**DRAWN["links"], "rod": ["A", "P", "B"]}],
        "slides": [[{**DRAWN["slides"][0], "angle": 8}]],
        "gears": [[{"one": "crank", "two": "second", "ratio": -2}]],
        "driver": ["slider"],
        "driver_on": ["rod"],
        "output": ["rod"],
        "swing_from": [None],
    }
    requirements: ClassVar = {
        "function": ({"linkages": ["watt-2"], "starts": 4000, "designs": 2},),
        "dwell": ({"linkages": ["stephenson-3"], "starts": 4000, "designs": 2},),
        "path": ({"linkages": ["klann"], "starts": 2000, "designs": 2},),
    }
    max_examples = 12

    def strategy(self):
        """Random tables near linkages of the catalogue."""
        return st.fixed_dictionaries(
            {"linkage": st.sampled_from(list(ENTRIES))},
            optional={
                "speed": st.floats(0.01, 3000),
                "pin_diameter": st.floats(1, 12),
                "bushing_wall": st.floats(0, 3),
                "rim": st.floats(0.5, 8),
                "web_width": st.floats(1, 20),
                "thickness": st.floats(1, 20),
                "frame": st.sampled_from(["auto", "one", "two"]),
                "guide_length": st.floats(5, 80),
                "output": st.sampled_from(["", "rod", "rocker", "coupler"]),
                "direction": st.sampled_from(["ccw", "cw"]),
            },
        )

    def test_every_parameter_counts(self):
        """Every field changes some result of some example, or of the linkage that it belongs to."""
        swung = [{"linkage": "hoecken", "swing_from": 100, "swing_to": 260}]
        tables = [*self.examples, *swung, CYLINDER, *({"linkage": name} for name in ENTRIES)]
        gears = self._geared()
        starts = [Results(self.family(), self.params(table)) for table in (*tables, gears)]
        fields = self.family.Params.model_fields
        idle = [name for name in fields if not self._counts(name, self._first(name, starts))]
        assert not idle, f"no result depends on {', '.join(idle)}"

    @staticmethod
    def _first(name, starts):
        """The linkage that a table belongs to before all others."""
        own = [one for one in starts if one.params.table_name == name]
        return own or starts

    @staticmethod
    def _geared():
        """A second crank that gears turn."""
        return {
            **DRAWN,
            "points": {**DRAWN["points"], "C0": {"x": 0, "y": -60}, "C": {"x": 20, "y": -60}},
            "links": {**DRAWN["links"], "ground": ["A0", "C0"], "second": ["C0", "C"]},
            "gears": [{"one": "crank", "two": "second", "ratio": -1}],
        }

"""The built-in family under the kit that third parties use."""

from typing import ClassVar

from by_night import examples as tried
from day_contract import DayContract
from hypothesis import strategies as st

from mechwright_noncircular_gears.family import NoncircularGears

SMALL = {"thickness": 4, "bore": 6}
LOBES = {"law": "ellipse", "mate_lobes": 2, "eccentricity": 0.15, "teeth": 18, "centre_distance": 70}

RING = {"law": "ellipse", "internal": True, "mate_lobes": 3, "eccentricity": 0.15, "teeth": 24}


class TestNoncircularGears(DayContract):
    family = NoncircularGears
    ci: ClassVar = (
        "test_every_parameter_counts",
        "test_fixes_of_random_designs",
        "test_fixes_of_refused_designs",
        "test_tolerances_of_random_designs",
    )
    night: ClassVar = {
        # One pair is built by day; of the other laws, findings and motion.
        name: {1, 2, 3, 4, 5, 6, 7, 8}
        for name in ("test_programs_are_proven", "test_no_interference", "test_solids", "test_drawings")
    }
    max_frames = tried(1, 40)
    derivatives = (("theta2", "omega2"), ("omega2", "alpha2"))
    input_rate = "omega1"
    samples = 2881
    examples = (
        {**SMALL, "teeth": 20, "module": 2.5, "sines": [8.0], "keyway_width": 2, "keyway_relief": 1.2},
        {**SMALL, **LOBES},
        {**SMALL, "law": "window", "teeth": 28, "window_ratio": 0.9},
        {**SMALL, "law": "table", "teeth": 20, "nodes": [[0, 0], [90, 100], [180, 180], [270, 260]]},
        {**SMALL, "law": "slider", "teeth": 36},
        {**SMALL, "law": "ratio", "ratio": "exp(0.15*cos(phi))", "teeth": 24},
        {**SMALL, "law": "angle", "angle": "phi + 0.1*sin(phi)", "teeth": 24},
        {**SMALL, **RING},
        {**SMALL, "law": "spiral", "sector": 100, "teeth": 16, "sector_hub": 20},
    )
    requirements: ClassVar = {
        "geneva": ({"harmonics": 4, "teeth": 40}, {"harmonics": 3, "slots": 6, "hollow": False}),
        "slider": ({"harmonics": 4, "pressure_limit": 45},),
        "quick-return": ({"harmonics": 3, "time_ratio": 1.3, "teeth": 30},),
        "approach": ({"harmonics": 3, "least_ratio": 0.4},),
    }
    refused = (
        ({"sines": [60.0]}, "law"),
        ({"law": "window", "blend": 150.0}, "blend"),
        ({"law": "limacon", "lobes": 2, "mate_lobes": 2, "cutter": "rack", "eccentricity": 0.3}, "law"),
        ({"sines": [24.0], "teeth": 20, "bore": 6}, "teeth"),
        ({"bore": 70}, "bore"),
        ({"addendum": 1.4, "dedendum": 1.55, "tip_radius": 0.05, "pressure_angle": 25}, "addendum"),
        ({"law": "table"}, "table"),
        ({"law": "ratio", "ratio": "1 + 1.1*cos(phi)"}, "ratio"),
        ({"law": "angle", "angle": "0.9*phi"}, "angle"),
        ({"law": "slider", "mate_lobes": 2}, "mate_lobes"),
        ({"eccentricity": 0.1}, "eccentricity"),
        ({"lobes": 2, "teeth": 41, "mate_lobes": 3}, "teeth"),
        ({"backlash": 0.0}, "backlash"),
        ({**RING, "ring_addendum": 0.9}, "ring_addendum"),
        ({**RING, "ring_outside": 158}, "ring_outside"),
        ({**RING, "mate_lobes": 1}, "mate_lobes"),
        ({"ring_hole": 4}, "ring_hole"),
    )
    variations: ClassVar = {
        "law": ["ellipse"],
        "cosines": [[3.0]],
        "sines": [[10.0]],
        "cutter": ["shaper"],
        "internal": [False],
        "ring_addendum": [0.5],
        "ring_outside": [190.0],
        "ring_holes": [5],
        "ring_hole": [6.6],
        "shaper_radius": [12.0],
        "load_torque": [2.0],
        "lobes": [2],
        "mate_lobes": [2, 4],
        "ratio": ["exp(0.1*sin(phi))"],
        "angle": ["phi + 0.05*sin(2*phi)"],
        "nodes": [[[0, 0], [90, 98], [180, 180], [270, 262]]],
        "stroke_start": [55.0],
        "stroke_end": [125.0],
        "window": [110.0],
    }
    max_examples = tried(4, 30)

    def test_every_parameter_counts(self):
        """Those of the law for Geneva wheels too, at whose jumps of i'' difference quotients would fail."""
        self.examples = (*self.examples, {**SMALL, "law": "geneva", "teeth": 60})
        super().test_every_parameter_counts()

    def strategy(self):
        """Random laws near designs that can be built."""
        common = {
            "teeth": st.integers(16, 60),
            "module": st.floats(0.8, 4),
            "thickness": st.floats(2, 20),
            "bore": st.floats(0, 12),
        }
        fourier = {"law": st.just("fourier"), "sines": st.lists(st.floats(-15, 15), min_size=1, max_size=3)}
        pitch = {
            "law": st.sampled_from(["ellipse", "limacon", "eccentric-circle"]),
            "eccentricity": st.floats(0, 0.4),
            "mate_lobes": st.integers(1, 3),
        }
        window = {
            "law": st.just("window"),
            "window_ratio": st.floats(0.6, 1.5),
            "window": st.floats(20, 120),
            "blend": st.floats(30, 110),
        }
        return st.one_of(*(st.fixed_dictionaries({**common, **law}) for law in (fourier, pitch, window)))

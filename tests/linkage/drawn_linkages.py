"""Planar linkages as data: links with their points, joints, and how their dyads are put together."""

from drawn import Drawn

# fmt: off
LINKAGES = {
    "fourbar": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (100, 0)}, "crank": {"A0": (0, 0), "A": (40, 0)},
            "coupler": {"A": (0, 0), "B": (120, 0), "C": (50, 30)}, "rocker": {"B0": (0, 0), "B": (80, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "coupler"),
            ("R", "B", "B", "coupler", "rocker"), ("R", "B0", "B0", "ground", "rocker"),
        ),
        "crank", "rocker",
        {},
        {"P": ("coupler", "C")},
    ),
    "watt1": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (100, 0)}, "crank": {"A0": (0, 0), "A": (35, 0)},
            "coupler": {"A": (0, 0), "B": (110, 0), "C": (70, 45)},
            "rocker": {"B0": (0, 0), "B": (70, 0), "D": (60, -45)},
            "link5": {"C": (0, 0), "E": (85, 0), "F": (60, 40)}, "link6": {"D": (0, 0), "E": (90, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "coupler"),
            ("R", "B", "B", "coupler", "rocker"), ("R", "B0", "B0", "ground", "rocker"),
            ("R", "C", "C", "coupler", "link5"), ("R", "D", "D", "rocker", "link6"),
            ("R", "E", "E", "link5", "link6"),
        ),
        "crank", "link5",
        {},
        {"F": ("link5", "F")},
    ),
    "watt2": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (110, 0), "C0": (200, -10)}, "crank": {"A0": (0, 0), "A": (30, 0)},
            "coupler": {"A": (0, 0), "B": (100, 0)}, "rocker": {"B0": (0, 0), "B": (65, 0), "D": (45, -40)},
            "link5": {"D": (0, 0), "E": (95, 0), "F": (40, 30)}, "link6": {"C0": (0, 0), "E": (70, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "coupler"),
            ("R", "B", "B", "coupler", "rocker"), ("R", "B0", "B0", "ground", "rocker"),
            ("R", "D", "D", "rocker", "link5"), ("R", "E", "E", "link5", "link6"),
            ("R", "C0", "C0", "ground", "link6"),
        ),
        "crank", "link6",
        {},
        {"F": ("link5", "F")},
    ),
    "stephenson1": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (100, 0)}, "crank": {"A0": (0, 0), "A": (35, 0), "F": (25, 30)},
            "coupler": {"A": (0, 0), "B": (110, 0)}, "rocker": {"B0": (0, 0), "B": (75, 0), "G": (60, 40)},
            "link5": {"F": (0, 0), "H": (110, 0), "K": (55, 25)}, "link6": {"G": (0, 0), "H": (95, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "coupler"),
            ("R", "B", "B", "coupler", "rocker"), ("R", "B0", "B0", "ground", "rocker"),
            ("R", "F", "F", "crank", "link5"), ("R", "G", "G", "rocker", "link6"),
            ("R", "H", "H", "link5", "link6"),
        ),
        "crank", "link6",
        {},
        {"K": ("link5", "K")},
    ),
    "stephenson3": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (100, 0), "C0": (60, 130)}, "crank": {"A0": (0, 0), "A": (30, 0)},
            "coupler": {"A": (0, 0), "B": (100, 0), "Pc": (60, 50)}, "rocker": {"B0": (0, 0), "B": (60, 0)},
            "link5": {"Pc": (0, 0), "Q": (75, 0), "K": (30, 20)}, "link6": {"C0": (0, 0), "Q": (65, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "coupler"),
            ("R", "B", "B", "coupler", "rocker"), ("R", "B0", "B0", "ground", "rocker"),
            ("R", "Pc", "Pc", "coupler", "link5"), ("R", "C0", "C0", "ground", "link6"),
            ("R", "Q", "Q", "link5", "link6"),
        ),
        "crank", "link6",
        {},
        {"K": ("link5", "K")},
    ),
    "crank-shaper": Drawn(
        {
            "ground": {"A0": (0, 25), "B0": (0, 0), "Q": (0, 50)}, "crank": {"A0": (0, 0), "A": (10, 0)},
            "lever": {"B0": (0, 0), "D": (65, 0)}, "block": {"A": (0, 0)},
            "rod": {"D": (0, 0), "E": (30, 0), "C": (12, 5)}, "ram": {"E": (0, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "block"),
            ("R", "B0", "B0", "ground", "lever"), ("R", "D", "D", "lever", "rod"),
            ("R", "E", "E", "rod", "ram"), ("P", "slot", "lever", "B0", 0, "block", "A", 0),
            ("P", "guide", "ground", "Q", 0, "ram", "E", 0),
        ),
        "crank", "ram",
        {"E": -1},
        {},
    ),
    "whitworth": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (0, -20), "Q": (0, -20)}, "crank": {"A0": (0, 0), "A": (50, 0)},
            "lever": {"B0": (0, 0), "D": (-40, 0)}, "block": {"A": (0, 0)},
            "rod": {"D": (0, 0), "E": (160, 0), "C": (80, 15)}, "ram": {"E": (0, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "block"),
            ("R", "B0", "B0", "ground", "lever"), ("R", "D", "D", "lever", "rod"),
            ("R", "E", "E", "rod", "ram"), ("P", "slot", "lever", "B0", 0, "block", "A", 0),
            ("P", "guide", "ground", "Q", 0, "ram", "E", 0),
        ),
        "crank", "ram",
        {},
        {},
    ),
    "scotch-yoke": Drawn(
        {
            "ground": {"A0": (0, 0), "G": (0, 5)}, "crank": {"A0": (0, 0), "A": (40, 0)},
            "block": {"A": (0, 0), "K": (6, 2)}, "yoke": {"Y": (0, 0), "C": (30, 60)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "block"),
            ("P", "slot", "yoke", "Y", 1.39626340159546, "block", "A", 0),
            ("P", "guide", "ground", "G", 0, "yoke", "Y", 0),
        ),
        "crank", "yoke",
        {},
        {},
    ),
    "jansen": Drawn(
        {
            "ground": {"O": (0, 0), "B0": (-38, -7.8)}, "crank": {"O": (0, 0), "M": (15, 0)},
            "j": {"M": (0, 0), "X": (50, 0)}, "k": {"M": (0, 0), "Z": (61.9, 0)},
            "tri1": {"B0": (0, 0), "X": (41.5, 0), "Y": (2.609879518072293, 40.01497880670621)},
            "c": {"B0": (0, 0), "Z": (39.3, 0)}, "f": {"Y": (0, 0), "W": (39.4, 0)},
            "tri2": {"Z": (0, 0), "W": (36.7, 0), "F": (-7.746594005449599, 48.38378118041967)},
        },
        (
            ("R", "O", "O", "ground", "crank"), ("R", "M", "M", "crank", "j"), ("R", "M-2", "M", "j", "k"),
            ("R", "B0", "B0", "ground", "tri1"), ("R", "B0-2", "B0", "ground", "c"),
            ("R", "X", "X", "j", "tri1"), ("R", "Y", "Y", "tri1", "f"), ("R", "W", "W", "f", "tri2"),
            ("R", "Z", "Z", "k", "c"), ("R", "Z-2", "Z", "c", "tri2"),
        ),
        "crank", "tri2",
        {"X": -1, "W": -1},
        {"foot": ("tri2", "F")},
    ),
    "klann": Drawn(
        {
            "ground": {"J15": (159.9, 75), "J9": (136.6, 136.6), "J11": (100.9, 57.4)},
            "crank": {"J15": (0, 0), "J29": (26.8, 0)},
            "rod": {"J29": (0, 0), "J27": (59, 0), "J35": (109.9, -11.6)},
            "lower": {"J11": (0, 0), "J27": (-26.8, 17.6)},
            "leg": {"J35": (0, 0), "J37": (63.4, 63.4), "F": (-23.2, -86.6)},
            "upper": {"J9": (0, 0), "J37": (-50, 13.4)},
        },
        (
            ("R", "J15", "J15", "ground", "crank"), ("R", "J29", "J29", "crank", "rod"),
            ("R", "J11", "J11", "ground", "lower"), ("R", "J27", "J27", "rod", "lower"),
            ("R", "J35", "J35", "rod", "leg"), ("R", "J9", "J9", "ground", "upper"),
            ("R", "J37", "J37", "leg", "upper"),
        ),
        "crank", "leg",
        {"J27": -1},
        {"foot": ("leg", "F")},
    ),
    "toggle-press": Drawn(
        {
            "ground": {"A0": (130, -70), "B0": (0, 0), "Q": (0, 0)}, "crank": {"A0": (0, 0), "A": (25, 0)},
            "rod": {"A": (0, 0), "B": (95, 0)}, "upper": {"B0": (0, 0), "B": (100, 0)},
            "lower": {"B": (0, 0), "D": (110, 0), "C": (55, 12)}, "ram": {"D": (0, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "rod"),
            ("R", "B", "B", "rod", "upper"), ("R", "B-2", "B", "upper", "lower"),
            ("R", "B0", "B0", "ground", "upper"), ("R", "D", "D", "lower", "ram"),
            ("P", "guide", "ground", "Q", -1.5707963267948966, "ram", "D", 0),
        ),
        "crank", "ram",
        {},
        {},
    ),
    "slider-crank": Drawn(
        {
            "ground": {"A0": (0, 0), "Q": (0, 20)}, "crank": {"A0": (0, 0), "A": (50, 0)},
            "rod": {"A": (0, 0), "B": (150, 0), "C": (60, 25)}, "slider": {"B": (0, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "rod"),
            ("R", "B", "B", "rod", "slider"), ("P", "S", "ground", "Q", 0, "slider", "B", 0),
        ),
        "crank", "slider",
        {},
        {},
    ),
    "peaucellier": Drawn(
        {
            "ground": {"O": (0, 0), "Q": (40, 0)}, "crank": {"Q": (0, 0), "B": (40, 0)},
            "oa": {"O": (0, 0), "A": (100, 0)}, "oc": {"O": (0, 0), "C": (100, 0)},
            "ab": {"A": (0, 0), "B": (45, 0)}, "cb": {"C": (0, 0), "B": (45, 0)},
            "ad": {"A": (0, 0), "D": (45, 0)}, "cd": {"C": (0, 0), "D": (45, 0)},
        },
        (
            ("R", "Q", "Q", "ground", "crank"), ("R", "O", "O", "ground", "oa"),
            ("R", "O-2", "O", "ground", "oc"), ("R", "B", "B", "crank", "ab"), ("R", "B-2", "B", "ab", "cb"),
            ("R", "A", "A", "oa", "ab"), ("R", "A-2", "A", "ab", "ad"), ("R", "C", "C", "oc", "cb"),
            ("R", "C-2", "C", "cb", "cd"), ("R", "D", "D", "ad", "cd"),
        ),
        "crank", "ad",
        {"C": -1},
        {"D": ("ad", "D")},
        (-1.2, 1.2),
    ),
    "tangent": Drawn(
        {
            "ground": {"A0": (0, 0), "V": (60, 0)}, "arm": {"A0": (0, 0), "L": (0, 4)},
            "b1": {"C": (0, 0), "K": (10, 5)}, "b2": {"C": (0, 0), "T": (15, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "arm"), ("R", "C", "C", "b1", "b2"),
            ("P", "on_arm", "arm", "L", 0, "b1", "C", 0),
            ("P", "on_ground", "ground", "V", 1.4, "b2", "C", 0),
        ),
        "arm", "b2",
        {},
        {},
        (-0.7, 0.9),
    ),
    "pantograph": Drawn(
        {
            "ground": {"O": (0, 0), "M": (90, 30)}, "crank": {"M": (0, 0), "D": (15, 0)},
            "a": {"O": (0, 0), "B": (60, 0), "C": (150, 0)}, "c": {"B": (0, 0), "D": (55, 0)},
            "d": {"D": (0, 0), "E": (90, 0)}, "b": {"C": (0, 0), "E": (55, 0), "F": (137.5, 0)},
        },
        (
            ("R", "O", "O", "ground", "a"), ("R", "M", "M", "ground", "crank"), ("R", "D", "D", "crank", "c"),
            ("R", "D-2", "D", "c", "d"), ("R", "B", "B", "a", "c"), ("R", "C", "C", "a", "b"),
            ("R", "E", "E", "b", "d"),
        ),
        "crank", "b",
        {},
        {"F": ("b", "F")},
    ),
    "wiper-tandem": Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (150, 20), "C0": (620, 30)}, "crank": {"A0": (0, 0), "A": (40, 0)},
            "rod1": {"A": (0, 0), "B": (160, 0)},
            "lever1": {"B0": (0, 0), "B": (-30, 50), "D": (27, -48), "T": (-194, 373)},
            "rod2": {"D": (0, 0), "E": (468, 0)}, "lever2": {"C0": (0, 0), "E": (58, 0), "T2": (-430, -20)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"), ("R", "A", "A", "crank", "rod1"),
            ("R", "B0", "B0", "ground", "lever1"), ("R", "B", "B", "rod1", "lever1"),
            ("R", "D", "D", "lever1", "rod2"), ("R", "E", "E", "rod2", "lever2"),
            ("R", "C0", "C0", "ground", "lever2"),
        ),
        "crank", "lever2",
        {"E": -1},
        {},
    ),
}

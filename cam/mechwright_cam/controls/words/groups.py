"""Modal groups: codes of one group exclude each other in a line (RS274/NGC, table 4)."""

GROUPS: dict[str, frozenset[int]] = {
    "motion": frozenset({0, 10, 20, 30, 331, 730, 740, 800, 810, 820, 830, 840, 850, 890}),
    "plane": frozenset({170, 180, 190}),
    "distance": frozenset({900, 910}),
    "arc centre": frozenset({901, 911}),
    "feed mode": frozenset({930, 940, 950}),
    "units": frozenset({200, 210}),
    "cutter compensation": frozenset({400, 410, 411, 420, 421}),
    "length offset": frozenset({430, 431, 490}),
    "return": frozenset({980, 990}),
    "work offset": frozenset({540, 541, 550, 560, 570, 580, 590, 591, 592, 593, 1540}),
    "path": frozenset({610, 611, 640}),
    "non-modal": frozenset({40, 100, 280, 300, 530, 921, 922}),
}
"""G groups, codes in tenths."""

M_GROUPS: dict[str, frozenset[int]] = {
    "stop": frozenset({0, 1, 2, 30}),
    "tool change": frozenset({6}),
    "spindle": frozenset({3, 4, 5, 19, 29}),
}
"""M groups. Coolant is none: on some controls M7 and M8 may stand in one line."""

G_GROUP = {code: name for name, codes in GROUPS.items() for code in codes}
M_GROUP = {code: name for name, codes in M_GROUPS.items() for code in codes}
MOTIONS = GROUPS["motion"]
STOPPING = frozenset({5, 9})
"""M codes that some controls carry out behind the move of their line."""

TAPPING = frozenset({740, 840})
"""Tapping cycles, left-hand and right-hand."""
CYCLES = frozenset({730, 810, 820, 830, 850, 890}) | TAPPING
"""Drilling cycles."""


def spell(code: int) -> str:
    """Write a G code given in tenths.

    >>> spell(591), spell(10)
    ('G59.1', 'G1')
    """
    whole, tenth = divmod(code, 10)
    return f"G{whole}.{tenth}" if tenth else f"G{whole}"


def tenths(word: str) -> int:
    """The number of a code: of G in tenths, of M as it is; 0 for any other name.

    >>> tenths("G59.1"), tenths("M30"), tenths("SUPA")
    (591, 30, 0)
    """
    number = word[1:]
    if word[0] not in "GM" or not number.replace(".", "").isdigit():
        return 0
    return round(float(number) * (10 if word[0] == "G" else 1))


EXTENDED = frozenset({541, 1540})
"""Work offsets that have a number, P."""

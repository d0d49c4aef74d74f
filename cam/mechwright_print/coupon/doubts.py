"""What is out of reason in a measured coupon: inches, exchanged rows, gross errors, rows that stand alone.

All of it is told at once, and nothing is written: a wrong row would go into every part that is printed.
"""

from collections.abc import Iterator, Mapping
from itertools import combinations, pairwise

from mechwright_print.coupon.features import GAPS, ROWS, WORDS, Row, trial_name
from mechwright_print.coupon.filled import Measured
from mechwright_print.coupon.fitted import fit

INCH = 25.4
"""mm."""
GROSS = 0.9
"""No size of a printer that works is off by so much, mm."""
GROWTH = 0.01
"""Nor is its growth of lengths larger."""
GAIN = 0.25
"""Exchanging two rows has to leave so small a share of their squared deviations."""
ALONE = 4.5
"""A row is an outlier beyond so many standard deviations of the others: one coupon of 400 has one so."""
FAR = 0.1
"""It is none that is nearer to the others than this, mm: two turns of a calliper's worst error."""


def doubts(measured: Measured) -> list[str]:
    """One line for each thing that is out of reason; none where the coupon can be believed."""
    sizes = measured.sizes
    inches = [row for row in ROWS if _is_inch(row, sizes[row.name])]
    if len(inches) == len(ROWS):
        return ["all values are in inches; write them in mm, or multiply them by 25.4"]
    found = [
        f"{row.name}: {sizes[row.name]:g} is {sizes[row.name] * INCH:.2f} mm: measured in inches; write mm"
        for row in inches
    ]
    exchanged = list(_exchanged(sizes))
    found += [
        f"{one.name} is {sizes[one.name]:g} and {two.name} is {sizes[two.name]:g}: the rows are "
        "exchanged; change them back"
        for one, two in exchanged
    ]
    known = {row.name for row in inches} | {row.name for pair in exchanged for row in pair}
    gross = [
        row for row in ROWS if row.name not in known and abs(sizes[row.name] - row.nominal) > _gross(row)
    ]
    found += [
        f"{row.name}: {sizes[row.name]:g} mm is {sizes[row.name] - row.nominal:+.2f} mm off its "
        f"{row.nominal:g} mm, and no printer is off by more than {_gross(row):g} mm; measure it again"
        for row in gross
    ]
    if not found:
        found += _alone(sizes)
    return [*found, *_trials(measured.trials)]


def _gross(row: Row) -> float:
    """By how much a size is off at the most, mm: lengths grow or shrink in proportion besides."""
    return GROSS + GROWTH * row.nominal


def _is_inch(row: Row, value: float) -> bool:
    """Whether a value is the nominal size in inches, to what a printer may be off, and not in mm."""
    return abs(value * INCH - row.nominal) < min(GROSS, 0.25 * row.nominal) and abs(
        value - row.nominal
    ) > min(GROSS, 0.5 * row.nominal)


def _exchanged(sizes: Mapping[str, float]) -> Iterator[tuple[Row, Row]]:
    taken: set[str] = set()
    off = {row.name: abs(sizes[row.name] - row.nominal) for row in ROWS}
    pairs = sorted(
        (
            (
                (sizes[one.name] - two.nominal) ** 2 + (sizes[two.name] - one.nominal) ** 2,
                one.kind != two.kind,
                number,
                one,
                two,
            )
            for number, (one, two) in enumerate(combinations(ROWS, 2))
            if min(off[one.name], off[two.name]) > GROSS / 3 and max(off[one.name], off[two.name]) > GROSS / 2
        ),
        key=lambda found: (found[1], found[0], found[2]),
    )
    for after, _, _, one, two in pairs:
        before = off[one.name] ** 2 + off[two.name] ** 2
        if taken & {one.name, two.name} or after > GAIN * before or after > 2 * GROSS**2:
            continue
        taken |= {one.name, two.name}
        yield one, two


def _alone(sizes: Mapping[str, float]) -> Iterator[str]:
    """Rows that the others contradict, the worst first; each is taken out before the next is looked for."""
    rest = dict(sizes)
    for _ in range(len(ROWS) // 4):
        found = fit(rest)
        name = max(found.studentised, key=lambda one: abs(found.studentised[one]))
        expected = rest[name] - found.without[name]
        if abs(found.studentised[name]) <= ALONE or abs(rest[name] - expected) <= FAR:
            return
        yield (
            f"{name}: {sizes[name]:g} mm stands {rest[name] - expected:+.2f} mm off what the other rows say "
            f"({expected:.2f} mm); measure it again"
        )
        rest[name] = expected


def _trials(trials: Mapping[float, str]) -> Iterator[str]:
    """A wider gap does no less."""
    known = [(gap, WORDS.index(trials[gap])) for gap in GAPS if gap in trials]
    for (narrow, before), (wide, after) in pairwise(known):
        if after < before:
            yield (
                f"{trial_name(wide)}: the pin is {WORDS[after]!r}, and {WORDS[before]!r} in the tighter "
                f"{trial_name(narrow)}; try both again"
            )

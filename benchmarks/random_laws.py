"""Random laws of non-circular gears: each is built, or refused by name with what to do.

Designs are drawn of every kind of law, in and out of rings. One that is not refused has to give two outlines
that mesh, in no more segments than their curves ask for. One that is refused has to say why in a finding;
the changes that it proposes, and those of the findings that come after them, have to end in a law that works.

Each law is drawn by the seed and its own number, so that portions, each from its first law on, add up.

Run:  python benchmarks/random_laws.py [LAWS [SEED [FIRST]]]
"""

import sys
from collections import Counter
from collections.abc import Iterator

import numpy as np
from pydantic import ValidationError

from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.errors import MechwrightError
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of

FAMILY = NoncircularGears()
SEGMENTS = 12
"""Per tooth, at most: six curves of one or two pieces."""


def drawn(rng: np.random.Generator) -> dict[str, object]:
    """A random design table."""
    law = str(rng.choice(list(LAWS)))
    table: dict[str, object] = {"law": law, "teeth": int(rng.integers(16, 72)), "bore": 4, "thickness": 5}
    if law == "spiral":
        table["sector"] = float(rng.integers(40, 200))
        table["teeth"] = int(rng.integers(8, 40))
    elif law not in {"slider", "geneva"}:
        table["mate_lobes"] = int(rng.integers(1, 4))
        if table["mate_lobes"] != 1 and rng.random() < 0.3:
            table["internal"] = True
    return {**table, **LAWS[law](rng, int(table.get("mate_lobes", 1)))}  # type: ignore[call-overload]


def _table(rng: np.random.Generator, mates: int) -> dict[str, object]:
    phi = np.arange(12) * 30.0
    psi = phi / mates + np.concatenate(([0.0], rng.uniform(-4, 4, 11))) / mates
    return {"nodes": [[float(a), max(0.0, round(float(b), 3))] for a, b in zip(phi, psi, strict=True)]}


def _shape(rng: np.random.Generator, _: int) -> dict[str, object]:
    return {"eccentricity": round(float(rng.uniform(0, 0.6)), 3)}


LAWS = {
    "fourier": lambda rng, mates: {
        "sines": [round(float(one), 2) for one in rng.uniform(-20, 20, 3) / mates]
    },
    "window": lambda rng, mates: {
        "window_ratio": round(float(rng.uniform(0.5, 1.6)) / mates, 3),
        "window": float(rng.integers(20, 160)),
        "blend": float(rng.integers(30, 110)),
    },
    "table": _table,
    "ratio": lambda rng, _: {
        "ratio": f"exp({rng.uniform(-0.6, 0.6):.2f}*cos(phi) + {rng.uniform(-0.2, 0.2):.2f}*sin(2*phi))"
    },
    "angle": lambda rng, mates: {
        "angle": f"phi/{mates} + {rng.uniform(-0.5, 0.5) / mates:.2f}*sin(phi)"
        f" + {rng.uniform(-0.15, 0.15) / mates:.2f}*(1 - cos(2*phi))"
    },
    "spiral": lambda rng, _: {
        "first_ratio": round(float(rng.uniform(0.4, 2.5)), 3),
        "last_ratio": round(float(rng.uniform(0.4, 2.5)), 3),
    },
    "slider": lambda rng, _: {
        "rod_ratio": round(float(rng.uniform(2.5, 6)), 2),
        "stroke_start": float(rng.integers(35, 70)),
        "stroke_end": float(rng.integers(110, 145)),
    },
    "geneva": lambda rng, _: {
        "slots": int(rng.integers(3, 10)),
        "ramp": round(float(rng.uniform(0.08, 0.4)), 3),
        "window": float(rng.integers(120, 215)),
    },
    "ellipse": _shape,
    "limacon": _shape,
    "eccentric-circle": _shape,
}
"""Law to its random fields, given the lobes of the mate."""


def judged(params: SizedParams) -> str:
    """What became of a design: built, refused and mended, or what is wrong with that."""
    try:
        found = FAMILY.check(params)
    except MechwrightError as error:
        return f"FAULT {type(error).__name__}: {error}"
    bad = errors(found, Stage.PARTS)
    if bad:
        return _refused(params, bad[0].code, bad[0].proposed)
    if any(one.code == "gear.contact" and one.severity is Severity.WARNING for one in found):
        return "built, with a warning of contact"
    for outline in table_of(params).outlines:
        if len((*outline.outer.segments, *(outline.inner[0].segments if params.internal else ()))) > (
            SEGMENTS * max(params.teeth, params.mate_teeth)
        ):
            return "FAULT an outline of too many segments"
    return "built"


MOST_CHANGES = 4
"""Findings that may come one after the other until a law works."""


def _refused(params: SizedParams, code: str, changes: object) -> str:
    """Whether proposed changes, of this finding and of those that it hid, lead to gears that work."""
    now, first, count = params, code, 0
    while count < MOST_CHANGES:
        tried = list(_past(now, code, changes))
        if not tried:
            return f"refused, {first}, with words only" + (f" at {code}" if count else "")
        mended, bad = next((one for one in tried if not one[1]), tried[0])
        count += 1
        if not bad:
            return f"refused, {first}, with the change to a law that works" + (
                "" if count == 1 else ", in steps"
            )
        bad = errors(FAMILY.check(mended), Stage.PARTS)  # which tells more of what helps
        now, code, changes = mended, bad[0].code, bad[0].proposed
    return f"refused, {first}, and still {code} after {count} changes"


def _past(params: SizedParams, code: str, changes: object) -> Iterator[tuple[SizedParams, list[Finding]]]:
    """Designs with a change that gets past a finding, and what is wrong with them then."""
    for change in changes:  # type: ignore[attr-defined]
        own = {key.removeprefix("parameters."): value for key, value in change.items()}
        try:
            mended = SizedParams.model_validate({**params.model_dump(), **own})
        except ValidationError:
            continue
        bad = errors(FAMILY.judge(mended), Stage.PARTS)
        if code not in [one.code for one in bad]:
            yield mended, bad


TOLD = 20
"""Laws after which the counts so far are said."""


def main(count: int, seed: int, first: int) -> None:
    """Draw, judge, count; designs of faults are printed."""
    said: Counter[str] = Counter()
    for number in range(first, first + count):
        table = drawn(np.random.default_rng([seed, number]))
        try:
            result = judged(SizedParams.model_validate(table))
        except ValidationError as error:
            result = f"no table: {error.errors()[0]['msg'].split(';')[0][:60]}"
        except Exception as error:
            result = f"FAULT {type(error).__name__}: {error}"
        if result.startswith("FAULT") or "words" in result or "still" in result:
            print(number, result, table, flush=True)
        said[result] += 1
        done = number + 1 - first
        if done == count or done % TOLD == 0:
            print(f"{done} laws of seed {seed} from number {first}")
            for what, times in said.most_common():
                print(f"{times:5d}  {what}", flush=True)


if __name__ == "__main__":
    main(*(int(one) for one in (*sys.argv[1:], *("100", "1", "0")[len(sys.argv) - 1 :])))

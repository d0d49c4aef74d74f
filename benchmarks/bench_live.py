"""What the live page waits for: ``python benchmarks/bench_live.py``.

Each question is of a design that was never asked for before. The anchor is its solution alone.
"""

import statistics
import time
from collections.abc import Callable
from pathlib import Path

from mechwright.plugins.host import host
from mechwright_cad.live import answers
from mechwright_cad.live.session import Session

EXAMPLES = Path(__file__).parents[1] / "examples"
EXAMPLE = EXAMPLES / "elliptic-pair.toml"
FRAMED = EXAMPLES / "elliptic-pair-machine.toml"
TIMES = 15
LIMITS = {"motion": 50.0, "in a frame": 50.0, "parts": 300.0}
"""Milliseconds that a person takes for at once."""


def measured(ask: Callable[[float], object]) -> float:
    """Median processor time of a question, ms."""
    found = []
    for number in range(TIMES):
        start = time.process_time()
        ask(0.3 + 0.001 * number)
        found.append(1000 * (time.process_time() - start))
    return statistics.median(found)


def main() -> int:
    """Print a table; the exit code is 1 where an answer is late."""
    session, framed = Session(EXAMPLE, host()), Session(FRAMED, host())
    answers.parts(session.design())  # what is imported, is
    solve = session.design().family.solve

    rows = {
        "solve alone": measured(
            lambda e: solve(session.changed({"parameters.eccentricity": e + 0.05}).params, 361)
        ),
        "motion": measured(lambda e: answers.motion(session.changed({"parameters.eccentricity": e + 0.02}))),
        "in a frame": measured(lambda e: answers.motion(framed.changed({"parameters.eccentricity": e}))),
        "parts": measured(lambda e: answers.parts(session.changed({"parameters.eccentricity": e}))),
    }
    late = False
    for name, took in rows.items():
        limit = LIMITS.get(name)
        late |= limit is not None and took > limit
        print(f"{name:12s} {took:7.1f} ms" + (f"   limit {limit:.0f}" if limit else ""))
    return int(late)


if __name__ == "__main__":
    raise SystemExit(main())

"""Timing of contestants in one run: medians, and ratios to an anchor.

Machines differ, and one machine differs from hour to hour, so only ratios of one run mean something. All
contestants take turns, round by round, and a round in which something else held the processor up falls out
with the median.
"""

import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True)
class Timing:
    """Median time of a contestant, s, and what it made last."""

    seconds: float
    result: object


def race(work: Mapping[str, Callable[[], object]], rounds: int = 5, warm: int = 1) -> dict[str, Timing]:
    """Let all contestants run ``rounds`` times in turns, after ``warm`` turns that do not count."""
    times: dict[str, list[float]] = {name: [] for name in work}
    results: dict[str, object] = {}
    for number in range(warm + rounds):
        for name, contestant in work.items():
            start = time.perf_counter()
            results[name] = contestant()
            if number >= warm:
                times[name].append(time.perf_counter() - start)
    return {name: Timing(median(times[name]), results[name]) for name in work}


def report(
    title: str,
    timings: Mapping[str, Timing],
    anchor: str,
    remark: Callable[[object], str] = lambda _: "",
) -> dict[str, float]:
    """Print a table, and give each contestant's time as a multiple of the anchor's."""
    base = timings[anchor].seconds
    width = max(map(len, timings))
    print(f"\n{title}")
    for name, timing in timings.items():
        ratio = f"{timing.seconds / base:7.2f} x"
        mark = " (anchor)" if name == anchor else ""
        print(f"  {name:<{width}} {1e3 * timing.seconds:9.1f} ms {ratio}  {remark(timing.result)}{mark}")
    return {name: timing.seconds / base for name, timing in timings.items()}


def child(code: str, *arguments: str) -> Callable[[], object]:
    """A contestant that runs Python code in a fresh interpreter: for the cost of imports and commands."""

    def run() -> str:
        command = [sys.executable, "-c", code, *arguments]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


def require(name: str, ratio: float, limit: float) -> bool:
    """Print whether a ratio keeps its limit, and say so."""
    kept = ratio <= limit
    print(f"  {'kept' if kept else 'MISSED'}: {name}: {ratio:.2f}, limit {limit:.2f}")
    return kept

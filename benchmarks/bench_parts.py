"""Parts of one design side by side: ``python benchmarks/bench_parts.py [DESIGN ...]``.

The programs of a design are made and proven by one process, and by this one with a second interpreter beside
it, in turns. Where two cores are free the work takes as long as the one of the two that has more to do: its
seconds of the processor, imports counted, are what is compared, since other work makes the clock longer and
leaves them. The texts have to be the same.
"""

import resource
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from harness import require

from mechwright.contracts.finding import errors
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.worker_pool.budget import limited_cores
from mechwright_cam.machining import Machining

EXAMPLES = Path(__file__).parents[1] / "examples"
DESIGNS = ("geneva-machine", "noncircular-window", "figure-eight-train")
ROUNDS, CORES = 3, 2

MOST = 0.8
"""Of the seconds of one process. Half is the least there can be, and imports, a second, come to it: a fifth
of the work of these designs."""


@dataclass(frozen=True)
class Taken:
    """Seconds of the clock, of the processor by this process, and by the other."""

    clock: float
    here: float
    there: float
    texts: tuple[str, ...]

    @property
    def longest(self) -> float:
        """Of the two."""
        return max(self.here, self.there)


def others() -> float:
    """Seconds of the processor that processes which have ended took."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def taken(path: Path, count: int) -> Taken:
    """By a design's programs on so many cores; what comes before them is not counted."""
    with limited_cores(count), Build(path, host(), Wanted("cam")) as build:
        machining = build.made(Machining)
        assert not errors(machining.findings)
        clock, here, there = time.perf_counter(), time.process_time(), others()
        texts = tuple(item.text for item in machining.proven_programs)
        return Taken(time.perf_counter() - clock, time.process_time() - here, others() - there, texts)


def main(names: list[str]) -> int:
    """Report each design; the exit code is 1 where texts differ, or too little is won."""
    ratios = []
    for name in names:
        pairs = [[taken(EXAMPLES / f"{name}.toml", count) for count in (1, CORES)] for _ in range(ROUNDS)]
        if len({one.texts for pair in pairs for one in pair}) > 1:
            print(f"{name}: the texts differ")
            return 1
        alone, here, there = (
            median(values)
            for values in (
                [one.here for one, _ in pairs],
                [two.here for _, two in pairs],
                [two.there for _, two in pairs],
            )
        )
        clock = median(two.clock / one.clock for one, two in pairs)
        ratios.append(median(two.longest / one.here for one, two in pairs))
        print(
            f"{name}: {len(pairs[0][0].texts)} programs, {alone:.1f} s by one; by two {here:.1f} s and "
            f"{there:.1f} s, {ratios[-1]:.2f} of it; {clock:.2f} by the clock"
        )
    return 0 if require("the longer share of two, of the work of one", max(ratios), MOST) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or list(DESIGNS)))

"""All four-bars through nine points: ``python benchmarks/bench_nine_points.py``.

Four problems: Wampler, Morgan and Sommese's third, one that a crank-rocker made, and two drawn here: a bean
with a dent, and a scribble, which no linkage made.
"""

import time

import numpy as np
from harness import require

from mechwright_four_bar.synthesis.burmester.rectify import Way, way_through
from mechwright_four_bar.synthesis.nine.solving import all_triples
from mechwright_four_bar.synthesis.nine.start import start
from mechwright_four_bar.synthesis.nine.synthesis import drawn
from mechwright_four_bar.synthesis.nine.triples import TRIPLES, members

SECONDS = 30.0

PROBLEMS = {
    "Problem 3 of 1992": "0.25 0 0.52 0.1 0.8 0.7 1.2 1 1.4 1.3 1.1 1.48 0.7 1.4 0.2 1 0.02 0.4",
    "made by 1-3.2-2.9-3.6": (
        "0.929 2.533 1.172 3.066 0.756 3.201 0.225 2.961 -0.345 2.356 -0.584 1.775 -0.55 1.411 -0.252 1.344 "
        "0.285 1.787"
    ),
    "bean with a dent": (
        "30.13 2.41 22.37 15.29 9.18 16.43 -4.26 11.57 -17.39 14.12 -27.44 6.35 -21.07 -9.28 -3.61 -14.17 "
        "18.52 -12.74"
    ),
    "scribble": "0 0 13 4 21 15 17 28 3 31 -9 24 -13 12 -6 -3 5 -11",
}


def print_nothing(part):
    pass


def main() -> None:
    """Solve every problem and say what there is."""
    start()
    for name, text in PROBLEMS.items():
        numbers = text.split()
        texts = list(zip(numbers[::2], numbers[1::2], strict=True))
        begun = time.process_time()
        triples = all_triples(texts, print_nothing)
        seconds = time.process_time() - begun
        bars = drawn(triples, np.array([complex(float(x), float(y)) for x, y in texts]))
        ways = [way_through(one.a0, one.b0, one.a, one.b) for bar in bars for one in (bar, bar.driven_at_b0)]
        full = sum(isinstance(way, Way) and way.full for way in ways)
        levers = sum(isinstance(way, Way) and not way.full for way in ways)
        far = max(np.abs(members(one.z[None])).max() for one in triples.certified) * triples.size
        print(
            f"{name}: {len(triples.certified)} of {TRIPLES} certified, {len(triples.real)} real, {full} full "
            f"cranks and {levers} levers in order, farthest {far:.2f}, {triples.precise} paths in balls, "
            f"{triples.detours} detours"
        )
        require("triples that are missing", TRIPLES - len(triples.certified), 0)
        require("processor seconds", seconds, SECONDS)


if __name__ == "__main__":
    main()

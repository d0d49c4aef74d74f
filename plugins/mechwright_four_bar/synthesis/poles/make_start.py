"""Make the start of two poles: ``python -m mechwright_four_bar.synthesis.poles.make_start`` (minutes).

A linkage is drawn by lot, moved, and loops of its poles lead to the others, until they bring nothing new. A
second file proves that these are all; with ``cut`` it alone is made.
"""

import sys

from mechwright.mechanics.continuation import read
from mechwright.mechanics.continuation.making import make, make_cut
from mechwright_four_bar.synthesis.poles.all_poles import CUT, FILE, SOLUTIONS
from mechwright_four_bar.synthesis.poles.system import MOVING, TWO_POLES, any_parameters, any_solution


def main() -> int:
    """Write the files; 1 where the number is another than before, and nothing is written."""
    if sys.argv[1:] != ["cut"] and make(TWO_POLES, any_solution, any_parameters, FILE, SOLUTIONS):
        return 1
    return make_cut(TWO_POLES, read(FILE, TWO_POLES), MOVING, CUT)


if __name__ == "__main__":
    sys.exit(main())

"""Make the start of two poles: ``python -m mechwright_slider_crank.make_pole_start``, a minute of one core.

A linkage is drawn by lot, moved, and loops of its poles lead to the others, until they bring nothing new.
"""

import sys

from mechwright.mechanics.continuation.making import make
from mechwright_slider_crank.all_poles import FILE, SOLUTIONS
from mechwright_slider_crank.pole_system import TWO_POLES, any_parameters, any_solution


def main() -> int:
    """Write the file; 1 where the number is another than before, and nothing is written."""
    return make(TWO_POLES, any_solution, any_parameters, FILE, SOLUTIONS)


if __name__ == "__main__":
    sys.exit(main())

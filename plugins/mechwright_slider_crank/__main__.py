"""The exact locus of the rod's acceleration pole: ``python -m mechwright_slider_crank 1 3 1/2 fixed``."""

import argparse
import sys
from collections.abc import Sequence

from mechwright.errors import MechwrightError

_ABOUT = "Print the exact locus of the acceleration pole of a slider-crank's rod."


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the lengths and print the polynomial as a table or as JSON; exit 2 for lengths without a locus.

    >>> main(["1", "3/2", "1/2", "fixed"])  # doctest: +ELLIPSIS
    rho^i Y^j, degree 12, 6-fold circular points, 28 terms
    ...
    0
    """
    parser = argparse.ArgumentParser(prog="python -m mechwright_slider_crank", description=_ABOUT)
    for name, meaning in (("crank", "a"), ("rod", "c"), ("offset", "e")):
        parser.add_argument(name, help=f"{meaning}, as 2.5 or 5/2")
    parser.add_argument("plane", choices=("fixed", "coupler"), nargs="?", default="fixed")
    parser.add_argument("--json", action="store_true", help="the polynomial as JSON")
    given = parser.parse_args(arguments)
    try:
        from mechwright.mechanics.algebra import exact
        from mechwright_slider_crank.locus import locus

        curve, _ = locus(exact(given.crank), exact(given.rod), exact(given.offset), given.plane)
    except MechwrightError as error:
        sys.stderr.write(f"mechwright: {error}\n")
        return 2
    sys.stdout.write(curve.to_json() if given.json else curve.table() + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

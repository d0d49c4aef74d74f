"""The exact locus of the coupler's acceleration pole: ``python -m mechwright_four_bar 2 6 5 7 fixed``."""

import argparse
import sys
from collections.abc import Sequence

from mechwright.errors import MechwrightError

_ABOUT = "Print the exact locus of the acceleration pole of a four-bar's coupler."


def main(arguments: Sequence[str] | None = None) -> int:
    """Read the lengths and print the polynomial as a table or as JSON; exit 2 for lengths without a locus.

    >>> main(["3", "3", "5", "5", "fixed"])  # doctest: +ELLIPSIS
    rho^i X^j, degree 6, 3-fold circular points, 10 terms
    ...
    0
    """
    parser = argparse.ArgumentParser(prog="python -m mechwright_four_bar", description=_ABOUT)
    for name, meaning in (("crank", "a"), ("coupler", "c"), ("follower", "b"), ("ground", "f")):
        parser.add_argument(name, help=f"{meaning}, as 2.5 or 5/2")
    parser.add_argument("plane", choices=("fixed", "coupler"), nargs="?", default="fixed")
    parser.add_argument("--json", action="store_true", help="the polynomial as JSON")
    given = parser.parse_args(arguments)
    try:
        from mechwright.mechanics.algebra import exact
        from mechwright_four_bar.locus import locus

        lengths = [exact(text) for text in (given.crank, given.coupler, given.follower, given.ground)]
        curve = locus(lengths[0], lengths[1], lengths[2], lengths[3], given.plane)
    except MechwrightError as error:
        sys.stderr.write(f"mechwright: {error}\n")
        return 2
    sys.stdout.write(curve.to_json() if given.json else curve.table() + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""The command that prints the exact locus of an acceleration pole: ``python -m FAMILY LENGTHS [PLANE]``."""

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from mechwright.errors import MechwrightError
from mechwright.mechanics.algebra.curve import PlaneCurve
from mechwright.mechanics.algebra.numbers import exact


def locus_command(
    module: str,
    about: str,
    lengths: Mapping[str, str],
    locus: Callable[[Sequence[Fraction], str], PlaneCurve],
    arguments: Sequence[str] | None,
) -> int:
    """Read the lengths and print the polynomial as a table or as JSON; exit 2 for lengths without a locus.

    Parameters
    ----------
    module
        The family's, as ``python -m`` says it.
    about
        What is printed, a sentence.
    lengths
        Name of each length to its letter.
    locus
        The curve of lengths, in this order, and of the plane ``"fixed"`` or ``"coupler"``.
    arguments
        Of the command line; by default the process's.
    """
    parser = argparse.ArgumentParser(prog=f"python -m {module}", description=about)
    for name, letter in lengths.items():
        parser.add_argument(name, help=f"{letter}, as 2.5 or 5/2")
    parser.add_argument("plane", choices=("fixed", "coupler"), nargs="?", default="fixed")
    parser.add_argument("--json", action="store_true", help="the polynomial as JSON")
    given = parser.parse_args(arguments)
    try:
        curve = locus([exact(getattr(given, name)) for name in lengths], given.plane)
    except MechwrightError as error:
        sys.stderr.write(f"mechwright: {error}\n")
        return 2
    sys.stdout.write(curve.to_json() if given.json else curve.table() + "\n")
    return 0

"""The exact locus of the coupler's acceleration pole: ``python -m mechwright_four_bar 2 6 5 7 fixed``."""

import sys
from collections.abc import Sequence

from mechwright.mechanics.algebra.command import locus_command
from mechwright_four_bar.kinematics.locus import locus

LENGTHS = {"crank": "a", "coupler": "c", "follower": "b", "ground": "f"}


def main(arguments: Sequence[str] | None = None) -> int:
    """See :func:`mechwright.mechanics.algebra.command.locus_command`.

    >>> main(["3", "3", "5", "5", "fixed"])  # doctest: +ELLIPSIS
    rho^i X^j, degree 6, 3-fold circular points, 10 terms
    ...
    0
    """
    about = "Print the exact locus of the acceleration pole of a four-bar's coupler."
    return locus_command("mechwright_four_bar", about, LENGTHS, lambda x, plane: locus(*x, plane), arguments)


if __name__ == "__main__":
    sys.exit(main())

"""The exact locus of the rod's acceleration pole: ``python -m mechwright_slider_crank 1 3 1/2 fixed``."""

import sys
from collections.abc import Sequence

from mechwright.mechanics.algebra.command import locus_command
from mechwright_slider_crank.kinematics.locus import locus

LENGTHS = {"crank": "a", "rod": "c", "offset": "e"}


def main(arguments: Sequence[str] | None = None) -> int:
    """See :func:`mechwright.mechanics.algebra.command.locus_command`.

    >>> main(["1", "3/2", "1/2", "fixed"])  # doctest: +ELLIPSIS
    rho^i Y^j, degree 12, 6-fold circular points, 28 terms
    ...
    0
    """
    about = "Print the exact locus of the acceleration pole of a slider-crank's rod."
    module = "mechwright_slider_crank"
    return locus_command(module, about, LENGTHS, lambda x, plane: locus(*x, plane)[0], arguments)


if __name__ == "__main__":
    sys.exit(main())

"""How far controls leave the programmed path between two moves, and what a program can say about it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Corners:
    """What one control does at corners.

    A control that follows the path within a setting of the machine counts as exact here: no word of a program
    can change that. Where a word lets it go further, that word counts.
    """

    unsaid: float = 0.0
    """How far the control may leave the path while the program has chosen neither G61 nor G64, mm; inf
    without a bound."""
    after_g64: float = 0.0
    """The same after a G64 that gives no tolerance."""
    tolerance: bool = False
    """Whether G64 takes a tolerance, P (and Q)."""
    looser: tuple[tuple[int, str, frozenset[float], str], ...] = ()
    """Words that let the control go further than its setting: code in tenths, letter, the values of it that
    do not, what to do instead."""

    def bound(self, blend: float | None, merge: float | None) -> float:
        """How far the control may leave the path after G64 with P ``blend`` and Q ``merge``, mm.

        LinuxCNC first merges lines into one that passes within Q (as wide as P if there is no Q), then rounds
        the corners of what it has made within P; P 0 is to it no tolerance at all.

        >>> free = float("inf")
        >>> linuxcnc = Corners(unsaid=free, after_g64=free, tolerance=True)
        >>> linuxcnc.bound(0.002, None), linuxcnc.bound(0.002, 0.0)
        (0.004, 0.002)
        >>> linuxcnc.bound(0.0, 0.0), linuxcnc.bound(None, 0.01)
        (inf, inf)
        """
        if blend is None or not blend > 0:
            return self.after_g64
        return blend + (blend if merge is None or merge < 0 else merge)


EXACT = Corners()
"""A control that follows the path, or whose settings alone say how far it leaves it."""

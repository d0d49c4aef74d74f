"""The sheets that are cut, for the bill of materials."""

from collections.abc import Sequence

from mechwright.pipeline import Blank, Build, RawStock


class CutBlanks(RawStock):
    """One sheet for each program; a service has its own."""

    name = "cut-sheets"
    commands = frozenset({"build"})

    def blanks(self, build: Build) -> Sequence[Blank]:
        """The sheets with the parts that are cut from each."""
        from mechwright_cut.cutting import Cutting

        found = []
        for one in build.made(Cutting).programs:
            names = tuple(dict.fromkeys(piece.cut.part.name for piece in one.job.pieces))
            size = (*one.job.size, one.job.thickness)
            found.append(Blank(names, 1, one.job.material, size))
        return found

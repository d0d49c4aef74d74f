"""Subprograms in Klartext: LBL 1 to LBL 0 behind the end of the program, run by CALL LBL 1."""

import re

from mechwright_cam.controls.reading.blocks import fail

_LABEL = re.compile(r"LBL (\d{1,5})")
_CALL = re.compile(r"CALL LBL 0*([1-9]\d{0,3})")


class Labels:
    """The labels of a program as they are read, in the words that the interpreter has for subprograms.

    Examples
    --------
    >>> labels = Labels()
    >>> labels.read(5, "CALL LBL 1", False), labels.read(7, "LBL 1", True), labels.read(9, "LBL 0", True)
    ('M98 P1', 'O1', 'M99')
    """

    def __init__(self) -> None:
        self.inside = 0
        """The subprogram that the block stands in; 0 for none."""
        self._known: set[int] = set()

    def read(self, number: int, code: str, ended: bool) -> str:
        """A block that begins, ends or calls a subprogram; nothing for any other.

        ``number`` is that of its line, and ``ended`` says whether it stands behind the end of the program.
        """
        if code.startswith("CALL"):
            match = _CALL.fullmatch(code)
            if match is None:
                raise fail(number, f"{code}: subprograms are called by number and once, CALL LBL 1")
            return f"M98 P{match[1]}"
        match = _LABEL.fullmatch(code)
        if match is None:
            return ""
        label = int(match[1])
        if label == 0:
            if not self.inside:
                raise fail(number, "LBL 0 ends a subprogram that has not begun; write LBL 1 before it")
            self.inside = 0
            return "M99"
        if not ended:
            raise fail(number, f"LBL {label} before M30; subprograms are read behind the end of the program")
        if self.inside:
            raise fail(number, f"LBL {label} within LBL {self.inside}; end that with LBL 0")
        if label in self._known:
            raise fail(number, f"LBL {label} stands twice; give each a number of its own")
        self._known.add(label)
        self.inside = label
        return f"O{label}"

    def finish(self, number: int) -> None:
        """Refuse a program that ends within a subprogram."""
        if self.inside:
            raise fail(number, f"LBL {self.inside} has no end; write LBL 0")

"""Travel and holes: rapids that never go askew, drilling cycles, and the same in plain moves."""

import math

from mechwright_cam.controls.writing.spelling import Spelling
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Rapid, Tap
from mechwright_plane.text import number

PECK_GAP = 0.25
"""Height above the last depth at which a peck that is written out starts to feed, mm: out of the chips."""
EVERY_WAY = frozenset({"rigid", "rigid left", "floating", "floating left"})
"""The ways in which a control taps that has both cycles and keeps feed and spindle together."""


class Drilling(Spelling):
    """A control that drills with cycles, or without."""

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill one hole."""
        self.cycle(out, hole)

    def end_drilling(self, out: Writer) -> None:
        """Leave the drilling cycle, if one is in force."""
        if out.cycle:
            out.line("G80")
            out.cycle = ()
            out.motion = ""

    def rapid(self, out: Writer, move: Rapid) -> None:
        """Travel first and go down last, or go up first: never askew past a clamp or a wall."""
        upward = move.z is not None and not math.isnan(out.z) and move.z > out.z
        flat, upright = (move.x, move.y, None), (None, None, move.z)
        for axes in (upright, flat) if upward else (flat, upright):
            if move.z is not None and axes is upright and out.resumed is not None:
                section, out.resumed = out.resumed, None
                self.length_offset(out, section, max(move.z, out.program.clearance))
            words = out.axis_words(*axes, rapid=True)
            if words:
                out.line(out.motion_word("G0"), *words)

    def cycle(self, out: Writer, hole: Drill, *, every_word: bool = False) -> None:
        """Drill with G81, G82 (dwell), G83 (pecks) or G73 (broken chips); holes that agree share the cycle.

        With ``every_word`` each hole states the whole cycle.
        """
        if hole.peck is not None and hole.dwell > 0:
            self.end_drilling(out)  # no cycle does both on all controls
            self.drill_in_moves(out, hole)
            return
        pecking = "G73" if hole.breaking else "G83"
        code = pecking if hole.peck is not None else "G82" if hole.dwell > 0 else "G81"
        words = [code, "Z" + out.height(hole.bottom), "R" + out.height(hole.retract, up=True)]
        if hole.peck is not None:
            words.append("Q" + out.length(hole.peck))
        elif hole.dwell > 0:
            words.append("P" + self.waiting(hole.dwell))
        # The cycle itself returns to the height it started from, so z stays what it is.
        feed = out.feed_text(hole.feed)
        if self._goes_on(out, hole, (*words, feed), every_word=every_word):
            return
        place = out.axis_words(hole.x, hole.y, None)
        stated = out.feed_word(hole.feed) or (feed if every_word else "")
        out.line("G98", code, *place, *words[1:], stated)
        out.cycle = (*words, feed)
        out.motion = ""

    def _goes_on(
        self,
        out: Writer,
        hole: Drill | Tap,
        cycle: tuple[str, ...],
        before: tuple[str, ...] = (),
        *,
        every_word: bool,
    ) -> bool:
        """Whether the cycle in force makes this hole by its place alone; ``before`` leads a new one."""
        again = out.cycle == cycle
        if again and not every_word:
            place = out.axis_words(hole.x, hole.y, None)
            out.line(*(place or ["X" + out.length(hole.x)]))
            return True
        if not again:
            self.end_drilling(out)
            out.line(*before)
        out.x = out.y = math.nan  # the first line of a cycle states both
        return False

    def tap(self, out: Writer, hole: Tap) -> None:
        """Tap one hole."""
        self.tap_cycle(out, hole)

    def tap_cycle(
        self, out: Writer, hole: Tap, *, before: tuple[str, ...] = (), every_word: bool = False
    ) -> None:
        """Tap with G84, or G74 to the left; holes that agree share the cycle and what is ``before``."""
        code = "G74" if out.tapping.left_hand else "G84"
        words = [code, "Z" + out.height(hole.bottom), "R" + out.height(hole.retract, up=True)]
        if hole.dwell > 0 and out.tapping.floating and "P" in self.dialect.words.known[code].takes:
            words.append("P" + self.waiting(hole.dwell))
        feed = out.feed_text(hole.feed, exact=True)
        if self._goes_on(out, hole, (*words, feed), before, every_word=every_word):
            return
        place = out.axis_words(hole.x, hole.y, None)
        out.line("G98", code, *place, *words[1:], feed)
        out.cycle, out.feed = (*words, feed), ""
        out.motion = ""

    def drill_in_moves(self, out: Writer, hole: Drill) -> None:
        """Drill with plain moves, for controls and holes that no cycle serves."""
        top = max(out.z, hole.retract)
        self.rapid(out, Rapid(hole.x, hole.y))
        self.rapid(out, Rapid(z=hole.retract))
        depth = hole.retract
        while depth > hole.bottom:
            if depth < hole.retract:
                if not hole.breaking:
                    self.rapid(out, Rapid(z=hole.retract))
                self.rapid(out, Rapid(z=depth + PECK_GAP))
            depth = max(hole.bottom, depth - (hole.peck or math.inf))
            out.line(out.motion_word("G1"), *out.axis_words(None, None, depth), out.feed_word(hole.feed))
        if hole.dwell > 0:
            self.dwell(out, hole.dwell)
        self.rapid(out, Rapid(z=top))

    def dwell(self, out: Writer, seconds: float) -> None:
        """Wait."""
        out.line("G4", "P" + self.waiting(seconds))

    def waiting(self, seconds: float) -> str:
        """A time as P counts it: without a point in the smaller unit, where there are two."""
        bare = self.dialect.bare_dwell_unit
        return number(seconds, 3) if bare is None else number(seconds / bare, 0)

"""Tapping: in and out again with a spindle that turns back, in step with the feed or in a floating holder."""

import math

from mechwright_cam.controls.reading.blocks import Block, fail
from mechwright_cam.controls.reading.modes import Modal
from mechwright_cam.controls.reading.run import Kind
from mechwright_cam.controls.words.groups import spell

LEFT = 740
"""G74, which turns backwards into the hole."""


class Tapping(Modal):
    """A machine that taps."""

    def end_rigid(self) -> None:
        """What no tapping cycle goes on with: M29 has to be stated anew."""
        self.rigid = self.dialect.tapping == "always"

    def rigid_tap(self, block: Block, words: dict[str, float]) -> None:
        """G33.1: K mm in a turn, from here to Z and back, with the spindle turning as it does."""
        line = block.line
        if words.keys() & {"X", "Y"}:
            raise fail(line, "G33.1 with X or Y; go there before")
        if not self.absolute:
            raise fail(line, "G33.1 with distances (G91) is not supported; write G90")
        bottom = self._take(block, words, "Z", "G33.1 needs Z") * self.scale
        pitch = self._take(block, words, "K", "G33.1 needs the pitch, K") * self.scale
        if not pitch > 0:
            raise fail(line, f"G33.1 needs a pitch K above 0, not {pitch:g}")
        if not self.state.spindle_rotation:
            raise fail(line, "G33.1 while the spindle stands; write S and M3 before")
        top = self.z
        if not math.isfinite(self.x + self.y + top):
            raise self.astray(line, "G33.1")
        if bottom >= top:
            raise fail(line, "G33.1 goes down into the hole, and Z is not below the tool")
        self._in_and_out(line, bottom, top, self.state.rpm * pitch, self.state.spindle, 0.0, rigid=True)

    def tap(self, line: int, code: int, bottom: float, top: float, seconds: float) -> None:
        """G84 and G74: in, wait, and out to a height, at the feed."""
        hand = -1 if code == LEFT else 1
        if not self.feed > 0:
            raise fail(line, f"{spell(code)} without a feed; write F above 0")
        if self.state.side:
            raise fail(line, f"{spell(code)} while compensation is on; write G40 before")
        if self.dialect.taps_out and self.state.spindle != hand:
            way = "clockwise (M3)" if hand == 1 else "backwards (M4)"
            raise fail(line, f"{spell(code)} needs a spindle that turns {way}")
        # A control that keeps both together turns the spindle itself; others have it turning.
        turns = hand if self.rigid else self.state.spindle
        self._in_and_out(line, bottom, top, self.feed, turns, seconds, rigid=self.rigid)
        if self.rigid:
            self._set(spindle=0)
            self.keep_state()

    def _in_and_out(
        self, line: int, bottom: float, top: float, feed: float, turns: int, seconds: float, *, rigid: bool
    ) -> None:
        x, y, before = self.x, self.y, self.state
        for z, spindle in ((bottom, turns), (top, -turns)):
            self._set(spindle=spindle, synchronous=rigid)
            self.keep_state()
            self._row(Kind.FEED, line, x, y, z, feed=feed)
            if z == bottom and seconds > 0:
                self._row(Kind.DWELL, line, x, y, z, seconds=seconds)
        self._set(spindle=before.spindle, synchronous=before.synchronous)
        self.keep_state()

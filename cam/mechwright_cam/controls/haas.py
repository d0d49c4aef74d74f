"""Haas mills (Next Generation Control and before)."""

import math
from collections.abc import Sequence
from dataclasses import replace

from mechwright.contracts.finding import Finding
from mechwright_cam.controls.dialect import Corners
from mechwright_cam.controls.fanuc import SUBPROGRAMS, Fanuc
from mechwright_cam.controls.gcode import GcodeControl
from mechwright_cam.controls.offsets import G54_TO_G59, HAAS_OFFSETS
from mechwright_cam.controls.words import haas as words
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill, Tap
from mechwright_cam.shop.settings import CamSettings


class Haas(Fanuc):
    """Haas: as Fanuc, but for G53 retracts, G154 work offsets, and cycles with every word in every block.

    The next peck starts as setting 22 comes from the factory, 0.05 inch above the last depth.
    """

    name = "haas"
    title = "Haas"
    dialect = replace(
        Fanuc.dialect,
        calls="97",
        words=words.WORDS,
        kept=words.KEPT,
        tapping="always",
        peck_clearance=1.27,
        length_moves="",
        idle_most=math.inf,  # it looks many blocks ahead
        # Corners are rounded as settings 85 and 191 say; G187 P1 (rough) lets them go further.
        corners=Corners(looser=((1870, "P", frozenset({2.0, 3.0}), "write P2 (medium) or P3 (finish)"),)),
    )
    takes_back = "look that the offset of G52 is 0, and G50, G100 and G69 in force"
    offsets = replace(Fanuc.offsets, d_setting="setting 40")
    work_offsets = (G54_TO_G59, HAAS_OFFSETS)
    tap_needs = "G84 taps rigidly where the machine has the option; look whether it is turned on."
    highest_tool = 200
    retract_motion = "G0"

    def subprogram_number(self, out: Writer, number: int) -> int:  # noqa: ARG002 - blocks are of one program
        """The N number of its first block."""
        return SUBPROGRAMS + number

    def subprogram_begins(self, out: Writer, number: int) -> str:
        """Its first block, within the program itself."""
        return f"N{self.subprogram_number(out, number)}"

    def subprogram_call(self, out: Writer, number: int) -> str:
        """M97 stays within the program."""
        return f"M97 P{self.subprogram_number(out, number)}"

    def check(self, settings: CamSettings) -> Sequence[Finding]:
        """As Fanuc; N numbers are the places of subprograms, too."""
        found = list(super().check(settings))
        if settings.post.line_numbers and settings.more_offsets:
            said = "with more_offsets N numbers say where subprograms begin (M97)"
            remedy = "leave line_numbers out"
            found.append(Finding.error("cam.line-numbers", "cam.post.line_numbers", said, remedy=remedy))
        return found

    def retract_lines(self, z: float) -> Sequence[str]:
        """To the upper end of travel, in machine coordinates."""
        return GcodeControl.retract_lines(self, z)

    def needs(self, settings: CamSettings) -> Sequence[str]:  # noqa: ARG002
        """G20 and G21 do not switch the control: they have to agree with it."""
        unit = "INCH" if self.units == "inch" else "MM"
        return [f"Setting 9 has to be {unit}: {self.unit_word} only checks it, and offsets are shown in it."]

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with a cycle, stated in full: an edited or restarted block then means what it says."""
        self.cycle(out, hole, every_word=True)

    def tap(self, out: Writer, hole: Tap) -> None:
        """G84 and G74 keep feed and spindle together by themselves."""
        self.tap_cycle(out, hole, every_word=True)

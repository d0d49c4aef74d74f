"""The post for Haas mills (Next Generation Control and before)."""

from mechwright_cam.controls.fanuc import FanucPost
from mechwright_cam.controls.writing.writer import Writer
from mechwright_cam.program.moves import Drill


class HaasPost(FanucPost):
    """Haas: as Fanuc, but for G53 retracts, G154 work offsets, and cycles with every word in every block."""

    name = "haas"
    title = "Haas"
    dialect = "haas"
    work_offsets = ("G54 to G59", "G154 P1 to P99")
    highest_tool = 200

    def retract(self, out: Writer) -> None:
        """Go to the upper end of travel, in machine coordinates."""
        out.line("G53", "G0", "Z" + out.length(out.program.machine.retract_z))
        out.motion = "G0"
        out.lost_height()

    def drill(self, out: Writer, hole: Drill) -> None:
        """Drill with a cycle, stated in full: an edited or restarted block then means what it says."""
        self.cycle(out, hole, every_word=True)

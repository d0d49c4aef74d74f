"""The motion as tables."""

from mechwright.build.build import Build
from mechwright.build.page import Page


class MotionTables(Page):
    """``motion.csv`` and ``summary.json``."""

    name = "motion-tables"
    commands = frozenset({"solve", "build"})
    doing = "motion"

    def files(self, build: Build) -> dict[str, str]:
        """The channels over the motion, and its figures."""
        from mechwright.output.motion_files import motion_csv, summary_json

        return {"motion.csv": motion_csv(build.motion), "summary.json": summary_json(build.motion)}

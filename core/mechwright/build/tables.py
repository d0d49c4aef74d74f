"""The motion as tables."""

import io
import json

import numpy as np

from mechwright.build.build import Build
from mechwright.build.page import Page
from mechwright.contracts.motion import Motion


class MotionTables(Page):
    """``motion.csv`` and ``summary.json``."""

    name = "motion-tables"
    commands = frozenset({"solve", "build"})
    doing = "motion"

    def files(self, build: Build) -> dict[str, str]:
        """The channels over the motion, and its figures by name with their units."""
        scalars = build.motion.scalars.items()
        figures = {name: {"value": scalar.value, "unit": scalar.unit} for name, scalar in scalars}
        return {"motion.csv": motion_csv(build.motion), "summary.json": json.dumps(figures, indent=2) + "\n"}


def motion_csv(motion: Motion) -> str:
    """The channels as CSV, one row per sample, twelve significant digits, header ``name [unit]``."""
    header = ",".join(
        f"{name} [{channel.unit}]" if channel.unit else name for name, channel in motion.channels.items()
    )
    text = io.StringIO()
    table = np.column_stack([channel.values for channel in motion.channels.values()])
    np.savetxt(text, table, fmt="%.12g", delimiter=",", header=header, comments="")
    return text.getvalue()

"""The files of ``mechwright solve``."""

import io
import json

import numpy as np

from mechwright.contracts.motion import Motion


def motion_csv(motion: Motion) -> str:
    """The channels as CSV, one row per sample, twelve significant digits, header ``name [unit]``."""
    header = ",".join(
        f"{name} [{channel.unit}]" if channel.unit else name for name, channel in motion.channels.items()
    )
    text = io.StringIO()
    table = np.column_stack([channel.values for channel in motion.channels.values()])
    np.savetxt(text, table, fmt="%.12g", delimiter=",", header=header, comments="")
    return text.getvalue()


def summary_json(motion: Motion) -> str:
    """The figures of the motion as JSON: name to value and unit."""
    figures = {name: {"value": scalar.value, "unit": scalar.unit} for name, scalar in motion.scalars.items()}
    return json.dumps(figures, indent=2) + "\n"

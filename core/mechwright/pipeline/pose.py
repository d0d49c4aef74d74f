"""Where in its motion a mechanism stands in the assembly: the option ``--at``."""

import numpy as np

from mechwright.contracts.motion import Motion
from mechwright.errors import DesignError
from mechwright.units import convert

SAMPLES = 3601
"""Samples of the motion among which the nearest is taken: every tenth of a degree of one turn."""


def sample_at(motion: Motion, text: str) -> int:
    """The sample whose input is nearest to ``text``, such as ``"40 deg"``.

    A number alone is in degrees, or in the input's own unit where that is no angle. Raises DesignError for a
    text that is no such quantity, and for one that the motion does not reach.
    """
    channel = motion.channels[motion.input_name]
    turns = channel.unit == "rad"
    unit = "deg" if turns else channel.unit
    values = np.degrees(channel.values) if turns else channel.values
    try:
        wanted = convert(text, unit)
    except ValueError as error:
        raise DesignError(f"--at: {error}") from error
    low, high = float(values.min()), float(values.max())
    slack = (high - low) / (2 * max(motion.samples - 1, 1))
    if not low - slack <= wanted <= high + slack:
        raise DesignError(
            f"--at: {motion.input_name} = {wanted:g} {unit} is outside the motion; give {low:g} to {high:g}"
        )
    return int(np.argmin(np.abs(values - wanted)))

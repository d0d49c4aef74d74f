"""How far off an output is with links and pins as made, by the sensitivities of the tolerance model."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.as_made import MadeCurve, MadeFigure
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.contracts.tolerances import Output, ToleranceModel
from mechwright.mechanics.linkage.made import Joint, MadeLink
from mechwright.mechanics.tolerance.first_order import size

EXACT = Tolerances(ToleranceSettings(length=0.0, angle=0.0, clearance=0.0))
"""For models that are asked for sensitivities alone: no table of tolerances is looked at."""

_SHOWN = {"rad": ("µrad", 1e6), "mm": ("mm", 1.0)}


@dataclass(frozen=True)
class MadeError:
    """Size of the error of an output at the positions (n,) of its model, in its unit; of a point the length.

    Parameters
    ----------
    output
        What is off.
    at
        Positions, rad.
    drawn
        With pins as far off as the drawing lets them.
    centred
        Of the links as made alone, pins in the middle of their bores.
    made
        With each pin off in the worst direction.
    most
        With the path anywhere in its corridor besides.
    """

    output: Output
    at: Array
    drawn: Array
    centred: Array
    made: Array
    most: Array

    def figure(self, name: str, rule: str) -> MadeFigure:
        """The greatest of the period; NaN of dead centres does not count."""
        unit, scale = _SHOWN[self.output.unit]
        design, least, made, most = (
            float(np.nanmax(values)) * scale for values in (self.drawn, self.centred, self.made, self.most)
        )
        title = f"greatest error of the {self.output.name}"
        return MadeFigure(name, title, unit, None, design, made, least, most, rule)

    def curve(self, driven: str) -> MadeCurve:
        """Over the angle of the link that is ``driven``."""
        unit, scale = _SHOWN[self.output.unit]
        lines = {"as drawn": self.drawn, "as made": self.made, "over the path": self.most}
        scaled = {key: values * scale for key, values in lines.items()}
        return MadeCurve(
            f"Error of the {self.output.name}", f"{driven}, degrees", unit, np.degrees(self.at), scaled
        )


def made_errors(
    model: ToleranceModel,
    links: Mapping[str, MadeLink],
    joints: Mapping[str, Joint],
    drawn: Mapping[str, float],
) -> list[MadeError]:
    """The errors of all outputs.

    Parameters
    ----------
    model
        Of the design; its contributors have the names of links and joints.
    links
        What is off, in the unit of the contributor.
    joints
        The room of pins, or of a slider in its guide, mm.
    drawn
        How far the drawing lets pins stand off, mm.
    """
    names = [one.name for one in model.contributors]
    found = []
    for output in model.outputs:
        rates = dict(zip(names, model.sensitivities(output.name, model.positions), strict=True))
        sizes = {name: size(rate) for name, rate in rates.items()}
        none = np.zeros(model.positions.shape)
        off = np.sum([rates[name][:, 0] * one.off for name, one in links.items()], axis=0)
        centred = none + np.sqrt((off * off).sum(axis=0))
        made = centred + sum(sizes[name] * max(one.room, 0.0) for name, one in joints.items())
        most = made + sum(sizes[name] * one.spread for name, one in links.items())
        most = most + sum(sizes[name] * one.spread for name, one in joints.items())
        free = none + sum(sizes[name] * room for name, room in drawn.items())
        found.append(MadeError(output, model.positions, free, centred, made, most))
    return found


def room_figure(joints: Sequence[Joint], drawn: float, remark: str = "") -> MadeFigure:
    """The least play of a pin in its bore, on the diameter; ``drawn``: as the design has it, mm."""
    least = min(joints, key=lambda one: one.room - one.spread)
    low, high = (2 * (least.room + sign * least.spread) for sign in (-1, 1))
    title, rule = f"least play of a pin, in joint {least.name}", "in diameter" + remark
    return MadeFigure("pin.room", title, "mm", 0.0, drawn, 2 * least.room, low, high, rule)

"""What is to be seen to before taps run."""

from collections.abc import Sequence

from mechwright_cam.controls.contract import Control
from mechwright_cam.shop.tool import Tool, ToolKind


def about_taps(used: Sequence[Tool], control: Control) -> tuple[str, ...]:
    """How the taps among the tools of a program are held, and what the control needs; empty without taps."""
    lines, taps = [], [tool for tool in used if tool.kind is ToolKind.TAP]
    for floating in (False, True):
        names = ", ".join(f"T{tool.number} ({tool.name})" for tool in taps if tool.floating is floating)
        if names and floating:
            lines.append(f"{names}: in a floating holder, set so that it gives way both ways.")
        elif names:
            lines.append(f"{names}: in a collet that holds it fast. {control.tap_needs}")
    if lines:
        lines.append(
            "Overrides do nothing in a thread, and feed hold waits for its end. Cutting oil, and a first run "
            "above the plate: set the work offset's Z higher by more than the deepest thread."
        )
    return tuple(lines)

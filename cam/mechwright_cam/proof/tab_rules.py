"""The rule about tabs."""

import shapely

from mechwright.contracts.part import Profile
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.views import inside_of


def tabs(scene: Scene) -> Check:
    """The planned tabs remain, or those that are found are strong enough."""
    cut, limit, count = scene.in_tab, TOLERANCES.gouge, len(scene.job.tabs)
    hold = scene.job.settings.hold
    if hold.method == "tabs" and hold.tab_places == "found":
        weak = _too_weak(scene)
        return Check(weak is None, weak or f"{count} tabs are found, and strong enough")
    if not count:
        return Check(True, "there are no tabs")
    if cut is None or cut.depth <= limit:
        return Check(True, f"all {count} tabs remain")
    message = f"cuts {cut.depth:.3f} mm into a tab that holds the part, the limit is {limit:g} mm"
    return scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at)


def _too_weak(scene: Scene) -> str | None:
    """What is wrong with tabs that have been found; None if they hold half as well as the planned ones."""
    job, hold = scene.job, scene.job.settings.hold
    parts = [f for f in job.features if isinstance(f, Profile) and f.side == "outside"]
    wanted = hold.tabs * (hold.tab_width or 2.0) * hold.tab_height / 2
    for part in parts:
        own = [tab for tab in job.tabs if shapely.dwithin(inside_of(part), shapely.Point(tab.at), 1.0)]
        section = sum(tab.width * (tab.top + job.thickness) for tab in own)
        if len(own) < 2 or section < wanted:
            return (
                f"{len(own)} tab(s) of {section:.1f} mm² in all hold {part.name}, two and {wanted:.1f} mm² "
                "are needed, half of cam.hold.tabs, tab_width and tab_height; leave more, or ask for less"
            )
    return None

"""Draws the picture at the head of a family's page: ``python docs/family_pictures.py`` writes them anew."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "site"))

from stills import still

import mechwright as mw
from mechwright_cad.animation import PAGE_SAMPLES
from mechwright_cad.animation.scene import scene

IMAGES = Path(__file__).parent / "images"
EXAMPLES = Path(__file__).parents[1] / "examples"
SHOWN = {
    "four-bar": "crank-rocker-finished",
    "slider-crank": "slider-crank-quick-return",
    "spur-gears": "spur-gears",
    "noncircular-gears": "noncircular-hollow",
    "cam-follower": "cam-lever",
    "five-bar": "five-bar-slots",
    "linkage": "linkages/jansen",
    "plate": "nema-17-plate",
    "chains": "chains/geneva-behind-gears",
}
"""Page to the example that it shows."""


def picture(page: str) -> str:
    """The example of a page, as its moving page shows it at one instant."""
    path = EXAMPLES / f"{SHOWN[page]}.toml"
    mechanism = mw.load(path).asked(samples=PAGE_SAMPLES, command="solve")
    return still(scene(tuple(mechanism.parts), mechanism.motion, solids=True))


if __name__ == "__main__":
    for name in SHOWN:
        (IMAGES / f"family-{name}.svg").write_text(picture(name), encoding="utf-8")

"""Draws the pictures of the tour, each cut out of a page that ``mechwright build`` writes.

``python docs/tour.py``
"""

import re
import tempfile
from pathlib import Path

import mechwright as mw

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "images"
EXAMPLE = ROOT / "examples" / "elliptic-pair.toml"
PICTURES = {
    "tour-setup.svg": ("gear.setup.html", "Plan view of gear"),
    "tour-stock.svg": ("gear.setup.html", "The simulated stock"),
    "tour-walls.svg": ("gear.setup.html", "Deviation along the walls of gear"),
}
"""File to the page that has the picture, and its name there."""


def pictures() -> dict[str, str]:
    """File to content, from a build of the example; it takes as long as one."""
    with tempfile.TemporaryDirectory() as folder:
        mw.load(EXAMPLE).write(Path(folder) / "out")
        pages = {
            page: (Path(folder) / "out" / page).read_text(encoding="utf-8") for page, _ in PICTURES.values()
        }
    return {name: cut_out(pages[page], label) for name, (page, label) in PICTURES.items()}


def cut_out(page: str, label: str) -> str:
    """The picture of that name, with the rules of its page for what it holds, as a file of its own."""
    (drawn,) = (
        one for one in re.findall(r"<svg.*?</svg>", page, re.S) if f'"{label}' in one.partition(">")[0]
    )
    classes = {name for names in re.findall(r'class="([^"]+)"', drawn) for name in names.split()}
    rules = "".join(re.findall(r"<style>(.*?)</style>", page, re.S)).splitlines()
    kept = [rule.strip() for rule in rules if classes & set(re.findall(r"\.([a-z][\w-]*)", rule))]
    styles = f"<style>{' '.join(kept)}</style>" if kept else ""
    head, _, rest = drawn.partition(">")
    named = head if "xmlns=" in head else head.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"', 1)
    return f"{named}>{styles}{rest}\n"


if __name__ == "__main__":
    for file, content in pictures().items():
        (IMAGES / file).write_text(content, encoding="utf-8")

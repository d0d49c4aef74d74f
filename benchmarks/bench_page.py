"""Brushing on the page of a study of 100,000 designs, in Chromium.

    python benchmarks/bench_page.py [FOLDER]

A brush is dragged along an axis, with four moves of the pointer for each frame, as fast mice send them. What
a person feels is the time from frame to frame, which on a busy machine tells what else runs; the page's own
share is the processor's time of its thread for each frame. With a FOLDER pictures of the brushed page are
kept there.
"""

import sys
import tempfile
from pathlib import Path
from statistics import median

from harness import require
from playwright.sync_api import Page, sync_playwright
from typer.testing import CliRunner

from mechwright.cli.app import make_app

DESIGNS = 100_000
SIZES = ((1280, 900), (390, 844))
FRAMES, MOVES = 40, 4
MOST_FRAME = 50.0
"""Milliseconds of the page's thread for a frame: twenty pictures a second follow a hand."""

STUDY = f"""
format = 1
family = "four-bar"
name = "many"
[study]
count = {DESIGNS}
front = 0
columns = ["least_transmission_angle", "time_ratio"]
[study.ranges]
ground = {{ least = 80, greatest = 110 }}
crank = {{ least = 20, greatest = 45 }}
coupler = {{ least = 60, greatest = 120 }}
follower = {{ least = 50, greatest = 100 }}
[study.objectives]
swing = "greatest"
alpha_b_max = "least"
"""

BRUSH = """async ([frames, moves]) => {
  const canvas = document.getElementById("lines"), box = canvas.getBoundingClientRect();
  const x = box.left + box.width / 2, low = box.top + 60, high = box.bottom - 60, times = [];
  const send = (kind, y) => canvas.dispatchEvent(
    new PointerEvent(kind, { clientX: x, clientY: y, pointerId: 1, bubbles: true }));
  canvas.setPointerCapture = () => {};
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  send("pointerdown", low);
  let last = await frame();
  for (let n = 0; n < frames; n++) {
    for (let k = 1; k <= moves; k++) send("pointermove", low + (high - low) * (n + k / moves) / frames);
    const now = await frame();
    times.push(now - last);
    last = now;
  }
  send("pointerup", high);
  const told = document.getElementById("told").textContent;
  return { times, told };
}"""


def page_of(folder: Path) -> Path:
    """The page of a study, made by the command."""
    (folder / "many.toml").write_text(STUDY)
    done = CliRunner().invoke(make_app(), ["sweep", str(folder / "many.toml"), "-o", str(folder / "study")])
    assert done.exit_code == 0, done.output
    return folder / "study" / "study.html"


def brushed(page: Page, width: int) -> bool:
    """Report how it goes; whether it is fast enough."""
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})

    def used() -> float:
        metrics = session.send("Performance.getMetrics")["metrics"]
        return 1e3 * next(one["value"] for one in metrics if one["name"] == "TaskDuration")

    page.wait_for_timeout(1000)
    begun = used()
    found = page.evaluate(BRUSH, [FRAMES, MOVES])
    own, times = (used() - begun) / FRAMES, sorted(found["times"])
    print(f"\n{width} px wide: {found['told']}")
    print(f"  from frame to frame {median(times):.0f} ms in the middle, {times[-1]:.0f} ms at most")
    return require(f"ms of the page's thread for a frame at {width} px", own, MOST_FRAME)


def main(folder: Path | None) -> int:
    """Brush at both sizes."""
    kept = True
    with tempfile.TemporaryDirectory() as made, sync_playwright() as play:
        path = page_of(Path(made))
        browser = play.chromium.launch(executable_path="/usr/bin/chromium", args=["--no-sandbox"])
        for width, height in SIZES:
            page = browser.new_page(viewport={"width": width, "height": height})
            page.goto(path.as_uri())
            kept &= brushed(page, width)
            page.wait_for_timeout(1500)
            if folder is not None:
                page.screenshot(path=folder / f"brushed-{width}.png")
        browser.close()
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else None))

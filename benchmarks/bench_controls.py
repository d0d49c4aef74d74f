"""Reading and proving of long programs, on every control: ``python benchmarks/bench_controls.py``.

Targets in seconds hold for a machine of two cores where ``import cadquery`` takes 1.6 s; they are scaled by
what that import takes here and now.
"""

import sys
from functools import partial
from pathlib import Path

from harness import child, race, report, require

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))

from by_control import BY_NAME, interpret, prove
from long_program import long_program
from shop import plate_job

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control

MOVES = 100_000
SECONDS = 1.0
"""They have to be read and proven in this time: a third of what is promised."""
ANCHOR, ANCHOR_SECONDS = "import cadquery", 1.6


def main() -> int:
    program, job = long_program(MOVES), plate_job()
    texts = {name: host().get(Control, name).write(program) for name in BY_NAME}
    for name, text in texts.items():
        proof = prove(text, job, BY_NAME[name])
        print(
            f"{name}: {len(text.splitlines())} lines, {'proven' if proof.ok else proof.failures[0].message}"
        )
        if not proof.ok:
            return 1
    work = {ANCHOR: child("import cadquery")}
    work |= {f"{name}: read": partial(interpret, text, BY_NAME[name]) for name, text in texts.items()}
    work |= {
        f"{name}: read and proven": partial(prove, text, job, BY_NAME[name]) for name, text in texts.items()
    }
    ratios = report(f"{MOVES} moves", race(work, rounds=3), ANCHOR)
    limit = SECONDS / ANCHOR_SECONDS
    kept = [
        require(f"{name}, {MOVES} moves in {SECONDS:g} s", ratios[f"{name}: read and proven"], limit)
        for name in texts
    ]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())

"""Torque of the drive in a running simulation: ``python benchmarks/bench_simulated.py [EXAMPLE ...]``.

Ten designs of six families are written as MJCF, and MuJoCo runs them with its own time steps at the constant
speed of the design. A table in Markdown tells by how much the torque differs from ours, as a share of the
greatest: without gravity, with it, and what friction (0.1) and the play of the fits change. The exit code is
1 if a torque without friction and play is more than 1 % off. It takes two minutes.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
from mujoco_run import EXAMPLES, Case, example, rubbed

from mechwright import host
from mechwright.designs.design import load

CLOSE = 0.01
"""Share of the greatest torque by which the simulated one may be off."""
FRICTION = 0.1
NOTHING = 1e-9
"""N m: a mechanism that needs less needs no torque, and is compared with gravity alone."""


def share(values, of) -> float:
    return float(np.abs(values).max() / np.abs(of).max())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("examples", nargs="*", metavar="EXAMPLE")
    wanted = parser.parse_args().examples
    print("| design | greatest, mN m | off | with gravity | off | friction adds | off | with play, r.m.s. |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    worst = 0.0
    for name, up in EXAMPLES:
        if wanted and name not in wanted:
            continue
        design = load(example(name), host())
        cells = [name.rpartition("/")[2]]
        for direction in ("none", up):
            case = Case.of(design, direction)
            ours = case.ours
            most = float(np.abs(ours).max())
            if most < NOTHING:
                cells += ["0", ""]
                continue
            off = share(case.run() - ours, ours)
            worst = max(worst, off)
            cells += [f"{1000 * most:.4g}", f"{off:.2%}"]
        loss = rubbed(case, FRICTION)
        rubbing = case.run(friction=FRICTION) - ours
        cells += [f"{share(loss, ours):.1%}", f"{share(rubbing - loss, ours):.2%}"]
        loose = case.run(play=True) - ours
        cells.append(f"{float(np.sqrt((loose**2).mean())) / most:.1%}")
        print(f"| {' | '.join(cells)} |", flush=True)
    return int(worst > CLOSE)


if __name__ == "__main__":
    sys.exit(main())

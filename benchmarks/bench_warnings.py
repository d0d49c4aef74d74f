"""What every example is told on every control.

``python benchmarks/bench_warnings.py [--build] [--on CONTROL,...] [DESIGN ...]`` prints a line for each
warning, and for each error, with the design and the control that it is told on; those of all controls once.
With ``--build`` programs are made and proven as well, and a proof that fails is an error. Without names it
takes every design in ``examples``. The exit code is 1 if there is any line: what a design says nothing of the
program chooses, and its own choices are no reason for a warning.
"""

import argparse
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

from mechwright.cli.hosting import open_host
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.errors import MechwrightError
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import Host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machining

EXAMPLES = Path(__file__).parents[1] / "examples"


def told(path: Path, host: Host, control: str, build: bool) -> Iterator[str]:
    """What a design is warned of on a control, a line each."""
    try:
        design = load(path, host).changed({"cam.control": control})
        with Build(design, host, Wanted("verify")) as one:
            machining = one.made(Machining)
            for finding in [*design.check(), *machining.findings]:
                if finding.severity in {Severity.WARNING, Severity.ERROR}:
                    yield f"{finding.severity} {finding.code} {finding.parameter}: {finding.message}"
            if build:
                _ = machining.proven_programs
    except MechwrightError as error:
        yield f"refused: {error}"


def main(names: list[str], build: bool, controls: list[str]) -> int:
    """Print the table; the exit code."""
    host, lines = open_host(), 0
    controls = controls or list(host.of(Control))
    paths = [Path(name) for name in names] or [
        path for path in sorted(EXAMPLES.glob("*.toml")) if not path.stem.endswith(("-requirement", "-study"))
    ]
    for path in paths:
        found: defaultdict[str, list[str]] = defaultdict(list)
        for control in controls:
            for line in dict.fromkeys(told(path, host, control, build)):
                found[line].append(control)
        for line, where in found.items():
            lines += 1
            print(
                f"{path.stem}, {'every control' if where == controls else ', '.join(where)}: {line}",
                flush=True,
            )
    print(f"{lines} lines of {len(paths)} designs on {len(controls)} controls")
    return 1 if lines else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("designs", nargs="*")
    parser.add_argument("--build", action="store_true")
    parser.add_argument("--on", default="", metavar="CONTROL,...")
    args = parser.parse_args()
    sys.exit(main(args.designs, args.build, [name for name in args.on.split(",") if name]))

"""Do other kernels of numpy and its linear algebra give the same bytes?

    python benchmarks/bench_kernels.py [EXAMPLE ...]

Builds examples in child processes under the kernels that this processor has, and compares every file with
that of the kernel that numpy takes by itself. The manifest, which names the kernel, is left out.
``OPENBLAS_CORETYPE`` and ``NPY_DISABLE_CPU_FEATURES`` are never set in the suite, as some kernels compute
wrongly on some processors. The exit code is 1 where a file differs.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from harness import require

EXAMPLES = Path(__file__).parents[1] / "examples"
TEN = (
    "elliptic-pair", "figure-eight-train", "noncircular-window", "geneva-straight", "cam-flat", "spur-gears",
    "planetary-gears", "four-bar-slots", "slider-crank-quick-return", "nema-17-plate",
)  # fmt: skip
LINEAR_ALGEBRA = {
    "x86_64": ("Prescott", "Nehalem", "Sandybridge", "Haswell", "Zen", "SkylakeX"),
    "aarch64": ("ARMV8", "CORTEXA57", "NEOVERSEN1"),
}
"""Machine to kernels of OpenBLAS; in place of one that the processor has not the library takes another."""
STUDY = "elliptic-gears-study"


def environments() -> dict[str, dict[str, str]]:
    """Variables of each kind of kernel, those of the processor itself first."""
    import platform

    found = {"own": {}}
    for name in LINEAR_ALGEBRA.get(platform.machine().lower(), ()):
        found[f"OPENBLAS_CORETYPE={name}"] = {"OPENBLAS_CORETYPE": name}
    extensions = np.show_config(mode="dicts").get("SIMD Extensions", {}).get("found", [])
    for count in range(len(extensions)):
        without = ",".join(extensions[count:])
        found[f"NPY_DISABLE_CPU_FEATURES={without}"] = {"NPY_DISABLE_CPU_FEATURES": without}
    return found


def built(command: list[str], more: dict[str, str], out: Path) -> dict[str, bytes]:
    """The files of a command under some variables."""
    words = [sys.executable, "-m", "mechwright", *command, "-o", str(out)]
    done = subprocess.run(words, env=os.environ | more, capture_output=True, text=True, check=False)
    if done.returncode:
        return {"(error)": done.stderr.encode()}
    manifest = json.loads((out / "manifest.json").read_text())
    return {name: (out / name).read_bytes() for name in manifest["outputs"]} | {
        path.relative_to(out).as_posix(): path.read_bytes() for path in out.glob("tables/*")
    }


def main(names: list[str]) -> None:
    """Print what differs, and how many files were compared."""
    compared = differing = 0
    for name in names:
        command = ["sweep" if name.endswith("-study") else "build", str(EXAMPLES / f"{name}.toml")]
        with tempfile.TemporaryDirectory() as folder:
            found = {
                kernel: built(command, more, Path(folder, str(number)))
                for number, (kernel, more) in enumerate(environments().items())
            }
        own = found.pop("own")
        for kernel, files in found.items():
            for file in sorted(own.keys() | files.keys()):
                one, two = own.get(file, b"").splitlines(), files.get(file, b"").splitlines()
                compared += 1
                if one != two:
                    differing += 1
                    count = sum(a != b for a, b in zip(one, two, strict=False)) + abs(len(one) - len(two))
                    print(f"{name}, {kernel}: {file}: {count} of {len(one)} lines differ")
    print(f"{compared} files compared, {differing} differ")
    require({"no file differs": differing == 0})


if __name__ == "__main__":
    main(sys.argv[1:] or [*TEN, STUDY])

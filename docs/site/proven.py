"""Twenty mechanisms with their parts and proofs: ``python docs/site/proven.py`` builds them anew.

Each is built by ``mechwright cam`` as anybody would; ``mechwright-check`` judges its certificates. Pages of
the gallery show what ``proven.json`` says: a site is made without twenty builds.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import mechwright as mw

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[1] / "examples"
FILE = HERE / "proven.json"
TWENTY = (
    "elliptic-pair",
    "figure-eight-train",
    "noncircular-lobes",
    "noncircular-ring",
    "noncircular-slider",
    "spur-gears",
    "planetary-gears",
    "rack-and-pinion",
    "cam-lever",
    "cam-conjugate",
    "geneva-straight",
    "geneva-cycloidal",
    "geneva-motor",
    "slider-crank-quick-return",
    "crank-rocker-three-poles",
    "double-crank",
    "five-bar-three-phases",
    "klann",
    "jansen",
    "nema-17-plate",
)
"""Names of example files."""


def path_of(name: str) -> Path:
    """The file of an example."""
    return next(EXAMPLES.rglob(f"{name}.toml"))


def entry(name: str, folder: Path) -> dict[str, Any]:
    """Parts, programs and proofs of one of them, built into a folder."""
    path = path_of(name)
    _run("mechwright", "cam", str(path), "-o", str(folder))
    proofs = json.loads((folder / "proof.json").read_text(encoding="utf-8"))
    return {
        "parts": [
            {"name": part.name, "material": part.material, "thickness_mm": part.thickness}
            for part in mw.load(path).parts
        ],
        "programs": [_program(program, proof, folder) for program, proof in proofs.items()],
    }


def _program(name: str, proof: dict[str, Any], folder: Path) -> dict[str, Any]:
    certificate = folder / f"{name}.certificate.json"
    said = subprocess.run(  # noqa: S603 - our own words
        [sys.executable, "-m", "mechwright_check", str(certificate)],
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    return {
        "name": name,
        "proven": proof["ok"],
        "checks": sum(1 for check in proof["checks"].values() if check["passed"]),
        "gouge_um": round(1000 * proof["gouge_max_mm"], 1),
        "leftover_um": round(1000 * proof["leftover_reachable_max_mm"], 1),
        "minutes": round(proof["time_estimate_s"] / 60, 1),
        "certificate": ("consistent", "refuted", "not checkable")[said.returncode],
    }


def _run(*words: str) -> None:
    subprocess.run([sys.executable, "-m", *words], stdout=subprocess.DEVNULL, check=True)  # noqa: S603


def entries() -> dict[str, Any]:
    """What the file holds; empty before it is written first."""
    return dict(json.loads(FILE.read_text(encoding="utf-8"))) if FILE.exists() else {}


def _thickness(value: float) -> str:
    """Of a plate; turned parts have none."""
    return f"{value:g} mm" if value else "turned"


def lines(name: str) -> list[str]:
    """Lines of a page with parts and proofs of an example; none of one that is not among the twenty."""
    found = entries().get(name)
    if found is None:
        return []
    rows = ["## Its parts and their proof", "", "| part | material | thickness |", "| --- | --- | --- |"]
    rows += [
        f"| {one['name']} | {one['material']} | {_thickness(one['thickness_mm'])} |" for one in found["parts"]
    ]
    rows += [
        "",
        "| program | checks passed | gouge | leftover | time | certificate |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    rows += [
        f"| {one['name']} | {one['checks']} | {one['gouge_um']:g} µm | {one['leftover_um']:g} µm "
        f"| {one['minutes']:g} min | {one['certificate']} |"
        for one in found["programs"]
    ]
    return [
        *rows,
        "",
        "Gouge is the deepest cut into the part, leftover the thickest stock that a cutter could have "
        "reached. The [certificate](../certificate.md) is judged by a checker that shares no code with "
        "the proof.",
        "",
    ]


if __name__ == "__main__":
    chosen = sys.argv[1:] or TWENTY
    found = entries()
    for one in chosen:
        with tempfile.TemporaryDirectory() as place:
            found[one] = entry(one, Path(place) / "out")
        sys.stdout.write(f"{one}: {len(found[one]['programs'])} programs\n")
        sys.stdout.flush()
        ordered = {name: found[name] for name in TWENTY if name in found}
        FILE.write_text(json.dumps(ordered, indent=1) + "\n", encoding="utf-8")

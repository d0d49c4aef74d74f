"""Does the checker of certificates see what is wrong? Faults of text, part, shop and certificate, by outcome.

    python benchmarks/bench_certificates.py [EACH [SEED]]

A fault of a text is one of those of ``tests/cam/mutants.py``, EACH of every kind, in a program of
``tests/golden/operations`` that the checker confirms; its certificate claims whatever moves it makes, so that
only what these do to the part is left to refute. Faults of part, shop and certificate are sealed anew. A text
that is confirmed is judged by what the machine does with it, and by our proof.
"""

import copy
import json
import sys
import tempfile
import time
import zlib
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "cam"))
import golden_operations
import mutations
from by_control import BY_NAME, EVERY, prove
from golden_cases import CASES
from mutants import FAULTS, mutant

from mechwright.errors import ProgramError
from mechwright_cad.exporters import DxfExporter
from mechwright_cam.machining import Machined
from mechwright_cam.pages.certificate.content import certificate, unchecked
from mechwright_cam.pages.certificate.page import sealed
from mechwright_check import RefutedError, UnknownError
from mechwright_check.certificate import case_of, compare, load
from mechwright_check.checks import check_all
from mechwright_check.drawing import compare as compare_drawing

Content = dict[str, Any]
Change = Callable[[Content, np.random.Generator], None]


def sources() -> list[tuple[str, str, Machined, Content]]:
    """Operation, control, program and certificate of what the checker confirms."""
    found = []
    for operation, case in CASES.items():
        for control in EVERY:
            for item in golden_operations.made(operation, control) if control in case.controls else ():
                if not unchecked(item.job) and len(item.files) == 1:
                    content = json.loads(json.dumps(certificate(item, control, BY_NAME[control].suffix)))
                    found.append((operation, control, item, content))
    return found


def outcome(content: Content, text: str, *, claims: bool, drawing: Path | None = None) -> tuple[str, str]:
    """What the checker says, and why; with a drawing, held against that as well."""
    try:
        case = case_of(content, {content["files"][0]["name"]: text}, [])
        if claims:
            compare(case, content["moves"])
        if drawing is not None:
            compare_drawing(case, content["part"]["origin"], drawing)
        check_all(case)
    except RefutedError as error:
        return "refuted", str(error)
    except UnknownError as error:
        return "not checkable", str(error)
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        return "refuted", f"damaged: {error!r}"
    return "confirmed", ""


def judged(source: tuple[str, str, Machined, Content], text: str) -> str:
    """Why a text may be confirmed: the machine does the same, our proof says so too; or what that says."""
    operation, control, item, _ = source
    known = mutations.Source(f"{operation} {control}", control, item.job, item.text)
    try:
        if not mutations.judge(known, text)[0]:
            return "the same"
        proof = prove(text, item.job, BY_NAME[control])
    except ProgramError as error:
        return f"reading: {error}"
    return "proven too" if proof.ok else f"{proof.failures[0].name}: {proof.failures[0].message}"


def _ring(content: Content, rng: np.random.Generator) -> list[Any]:
    section = content["part"]["sections"][0] or content["part"]["sections"][-1]
    return section[int(rng.integers(len(section)))]


def _moved_ring(content: Content, rng: np.random.Generator) -> None:
    by = float(rng.choice((-1, 1)) * rng.uniform(30, 1000))
    for node in _ring(content, rng):
        node[0] += by
        if len(node) == 5:
            node[2] += by


def _moved_node(content: Content, rng: np.random.Generator) -> None:
    ring = _ring(content, rng)
    ring[int(rng.integers(len(ring)))][int(rng.integers(2))] += float(
        rng.choice((-1, 1)) * rng.uniform(30, 1000)
    )


def _level(content: Content, rng: np.random.Generator) -> None:
    by = float(rng.choice((-1, 1)) * rng.uniform(320, 2000))
    content["part"]["levels"][-1][1] -= by
    content["part"]["thickness"] += by
    content["limits"]["lowest"] -= by


def _tool(key: str, low: float, high: float) -> Change:
    def change(content: Content, rng: np.random.Generator) -> None:
        tool = content["tools"][str(rng.choice(list(content["tools"])))]
        by = float(rng.uniform(low, high))
        tool[key] = (tool[key] or 0) + by if key == "radius" else (tool[key] or 1) * by
        if tool["slope"] is None:
            tool["tip"] = tool["radius"]

    return change


def _claim(axis: str) -> Change:
    def change(content: Content, rng: np.random.Generator) -> None:
        column = content["moves"][axis]
        column[int(rng.integers(len(column)))] += int(rng.choice((-2, 2)))

    return change


CHANGES: dict[str, Change] = {
    "part: a contour is moved": _moved_ring,
    "part: a corner is moved": _moved_node,
    "part: a hole is missing": lambda c, _: c["part"]["sections"][-1].pop(),
    "part: thicker or thinner": _level,
    "shop: a thicker tool": _tool("radius", 20, 1000),
    "shop: a thinner tool": _tool("radius", -1000, -30),
    "shop: short flutes": _tool("flute_length", 0.01, 0.06),
    "shop: a slower edge": _tool("speed", 0.1, 0.6),
    "shop: another work offset": lambda c, _: c["machine"].update(work_offset="G58"),
    "shop: a smaller machine": lambda c, rng: c["machine"].update(y=[0.0, float(rng.uniform(100, 9000))]),
    "shop: a slower spindle": lambda c, rng: c["machine"].update(spindle=[10, float(rng.uniform(100, 2000))]),
    "shop: a jaw in the way": lambda c, _: c["hold"]["prisms"].append(
        {"top": 5000, "stop": 0, "rings": [[[-9e4, -9e4], [9e4, -9e4], [9e4, 9e4], [-9e4, 9e4]]]}
    ),
    "certificate: another x": _claim("x"),
    "certificate: another z": _claim("z"),
    "certificate: another line": _claim("line"),
    "certificate: wider limits": lambda c, rng: c["limits"].update(gouge=float(rng.uniform(6, 50))),
    "certificate: another control": lambda c, _: c.update(
        control="haas" if c["control"] == "grbl" else "grbl"
    ),
    "certificate: a table is missing": lambda c, rng: c.pop(str(rng.choice(["part", "tools", "moves"]))),
}


def texts(every: list[Any], each: int, seed: int, found: Counter[tuple[str, str]]) -> None:
    """Faults of texts."""
    for kind in FAULTS:
        rng, count = np.random.default_rng(zlib.crc32(f"{kind} {seed}".encode())), 0
        for place in rng.integers(len(every), size=20 * each).tolist():
            made = mutant(every[place][2].text, kind, rng)
            if count == each or made is None:
                continue
            count += 1
            said, _ = outcome(every[place][3], made.text, claims=False)
            if said == "confirmed":
                why = judged(every[place], made.text)
                said = why if why in {"the same", "proven too"} else said
                if said == "confirmed":
                    print(
                        f"{every[place][:2]} {kind} line {made.line}: {made.change} | {why[:99]}", flush=True
                    )
            found["text", said] += 1


def changes(every: list[Any], each: int, seed: int, found: Counter[tuple[str, str]]) -> None:
    """Faults of part, shop and certificate, and of its bytes; a part is held against its drawing."""
    drawn = Path(tempfile.mkdtemp()) / "drawing.dxf"
    for kind, change in CHANGES.items():
        rng = np.random.default_rng(zlib.crc32(f"{kind} {seed}".encode()))
        for place in rng.integers(len(every), size=each).tolist():
            content = copy.deepcopy(every[place][3])
            change(content, rng)
            drawn.write_bytes(DxfExporter("arc").part(every[place][2].job.part))
            own = drawn if kind.startswith("part") else None
            said, _ = outcome(content, every[place][2].text, claims=True, drawing=own)
            if said == "confirmed":
                print(f"{every[place][:2]} {kind}", flush=True)
            found[kind.partition(":")[0], said] += 1
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "any.certificate.json"
        for place in rng.integers(len(every), size=10 * each).tolist():
            text = bytearray(sealed(every[place][3]).encode())
            spot = int(rng.integers(len(text)))
            text[spot] ^= 1 << int(rng.integers(7))
            path.write_bytes(bytes(text) if rng.random() < 0.8 else bytes(text[:spot]))
            try:
                load(path)
                found["bytes", "confirmed"] += 1
            except (RefutedError, UnknownError) as error:
                found["bytes", "refuted" if isinstance(error, RefutedError) else "not checkable"] += 1


def main(each: int = 2, seed: int = 0) -> int:
    """Print how many of each are refuted; 1 if any fault of part, shop or certificate is confirmed."""
    start, every, found = time.perf_counter(), sources(), Counter[tuple[str, str]]()
    print(f"{len(every)} programs", flush=True)
    texts(every, each, seed, found)
    changes(every, 5 * each, seed, found)
    for (what, said), count in sorted(found.items()):
        print(f"{what:12} {said:14} {count:5d}")
    print(f"{sum(found.values())} faults, {time.perf_counter() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))

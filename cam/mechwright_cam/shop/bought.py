"""Screws and pins that a mechanism takes, against those that a shop keeps."""

import re
from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.part import Part
from mechwright_cam.shop.workshop_file import Shop

SCREWS = frozenset({"ISO 4762", "ISO 10642", "ISO 4026"})
PINS = frozenset({"ISO 2338", "ISO 8734"})
_SIZE = re.compile(r" - M?(\d+(?:\.\d+)?)\b")


def not_kept(parts: Sequence[Part], shop: Shop) -> list[Finding]:
    """A warning for each size of screw or pin that the shop does not keep, with the nearest that it does.

    A shop that lists none of them keeps all.
    """
    found: dict[tuple[str, float], list[str]] = {}
    for part in parts:
        size = _SIZE.search(part.bought.designation) if part.bought is not None else None
        if part.bought is None or size is None:
            continue
        kind = "screw" if part.bought.standard in SCREWS else "pin" if part.bought.standard in PINS else ""
        if kind:
            found.setdefault((kind, float(size[1])), []).append(part.name)
    kept = {"screw": [float(one[1:]) for one in shop.workshop.screws], "pin": list(shop.workshop.pins)}
    return [
        _lacking(kind, size, names, kept[kind], shop)
        for (kind, size), names in sorted(found.items())
        if kept[kind] and size not in kept[kind]
    ]


def _lacking(kind: str, size: float, names: Sequence[str], kept: Sequence[float], shop: Shop) -> Finding:
    nearest = min(kept, key=lambda one: (abs(one - size), one))
    letter, unit = ("M", "") if kind == "screw" else ("", " mm")
    many = f"{names[0]} and {len(names) - 1} more take" if len(names) > 1 else f"{names[0]} takes"
    message = f"{many} {kind}s {letter}{size:g}{unit}, and {shop.path.name} does not list them"
    remedy = f"buy them, or take the nearest that it lists: {letter}{nearest:g}{unit}"
    code = f"shop.{kind}s"
    return Finding.warning(code, "shop", message, size, nearest, "mm", remedy, stage=Stage.MACHINING)

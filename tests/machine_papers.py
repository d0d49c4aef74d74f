"""Limits of size in the papers of a machine: drawings, setup sheets, the guide, the page of tolerances."""

import html
import io
import re
from collections.abc import Iterator, Mapping, Sequence

import ezdxf

from mechwright.contracts.part import Bore, Part
from mechwright.contracts.turned import limited
from mechwright.mechanics.mating.rounds import Match
from mechwright_cad.assembly_order.plan import Plan

TAG = re.compile(r"<svg.*?</svg>|<style.*?</style>|<[^>]+>", re.DOTALL)
FITS = re.compile(r"⌀(\S+(?: [A-Za-z]+\d+)?) / ([\d.]+(?: [a-z]+\d+)?)")
BOTH = re.compile(r"(\S+) \((\d+)\) (?:in|slides in|and|goes through) (\S+) \((\d+)\)")
PLAY = re.compile(
    r"(?P<tight>[\d.]+) to (?P<tightest>[\d.]+) mm tight|from (?P<least>[\d.]+) mm tight to (?P<most>[\d.]+) mm "
    r"loose|(?P<low>-?[\d.]+) to (?P<high>[\d.]+) mm"
)
ROUNDED = 0.0006


def fitted_bores(part: Part) -> list[Bore]:
    """Bores of a plate that have limits."""
    return [one for one in part.features if isinstance(one, Bore) and one.fit is not None]


def drawing_faults(parts: Sequence[Part], files: Mapping[str, bytes]) -> Iterator[str]:
    """Limits that a drawing does not have, or others than the part's."""
    for part in parts:
        name = f"{part.name}.dxf"
        if part.bought is not None or name not in files:
            continue
        drawn = ezdxf.read(io.StringIO(files[name].decode()))
        words = [one.dxf.text for one in drawn.modelspace().query("TEXT")]
        words += [one.dxf.text for one in drawn.modelspace().query("DIMENSION")]
        if part.outline is not None:
            circles = [
                (complex(*c.dxf.center.vec2), 2 * c.dxf.radius) for c in drawn.modelspace().query("CIRCLE")
            ]
            yield from _plate(part, name, words, circles)
        elif part.turned is not None:
            fits = [step.fit for step in part.turned.steps if step.fit is not None]
            fits += [part.turned.bore_fit] if part.turned.bore_fit is not None else []
            wanted = [f"%%c{fit.text}" for fit in fits]
            wanted += [
                limited(one.nominal, one.lower, one.upper).replace("±", "%%p") for one in part.turned.lengths
            ]
            yield from (f"{name}: no {one}" for one in wanted if not any(one in word for word in words))


def _plate(
    part: Part, name: str, words: Sequence[str], circles: Sequence[tuple[complex, float]]
) -> Iterator[str]:
    for bore in fitted_bores(part):
        if f"{bore.name}: %%c{bore.fit.text}" not in words:
            yield f"{name}: {bore.name} is not {bore.fit.text}"
        round_ = [d for centre, d in circles if abs(centre - complex(*bore.centre)) < 1e-4]
        if round_ and not any(abs(d - bore.fit.middle) < 1e-4 for d in round_):
            yield f"{name}: {bore.name} is drawn at {round_}, and {bore.fit.middle} is the middle"


def sheet_faults(parts: Sequence[Part], files: Mapping[str, bytes]) -> Iterator[str]:
    """Limits that a setup sheet does not have: the row of what is measured, and its note of the hole."""
    for part in parts:
        name = f"{part.name}.setup.html"
        if name not in files or f"{part.name}.nc" not in files:
            continue
        text = re.sub(r"\s+", " ", TAG.sub(" ", html.unescape(files[name].decode())))
        for bore in fitted_bores(part):
            low, high = bore.fit.limits
            row = f"{bore.fit.size:.4f} {low:.4f} {high:.4f} {bore.fit.name}".rstrip()
            if not re.search(rf"{re.escape(bore.name)} ⌀, at X \S+ Y \S+ {re.escape(row)}", text):
                yield f"{name}: {bore.name} is not measured from {low:.4f} to {high:.4f}"
            if f"{bore.name}: Ø{bore.fit.text}, made to {bore.fit.middle:g}" not in text:
                yield f"{name}: {bore.name} is not made to {bore.fit.middle:g}, {bore.fit.text}"


def guide_faults(parts: Sequence[Part], plan: Plan, files: Mapping[str, bytes]) -> Iterator[str]:
    """Fits that the guide tells otherwise or not at all, and bodies that none of its steps names."""
    name = "assembly.html"
    if len(plan.bodies) < 2:
        return
    if name not in files:
        yield f"{name} is not there"
        return
    text = html.unescape(files[name].decode())
    known: dict[tuple[str, str], list[Match]] = {}
    for match in plan.order.seats.matches:
        pair = (plan.bodies[match.pin].part.name, plan.bodies[match.hole].part.name)
        known.setdefault(pair, []).append(match)
    told = set()
    for line in (TAG.sub("", one) for one in re.findall(r"<li>.*?</li>", text, re.DOTALL)):
        both, fits = BOTH.search(line), FITS.search(line)
        if both is None or fits is None:
            continue
        pair = (both[1], both[3])
        told.add(pair)
        those = [one for one in known.get(pair, ()) if one.text == fits[0]]
        if not those:
            yield f"{name}: {pair[0]} in {pair[1]} is {fits[0]}, and not {[m.text for m in known.get(pair, ())]}"
        elif (play := PLAY.search(line)) is not None and not _tells(play, those[0]):
            yield f"{name}: {pair[0]} in {pair[1]} has {play[0]}, and not {those[0].play}"
    for pair, those in known.items():
        if pair not in told and all(plan.order.seats.kind(one) in {"pressed", "bonded"} for one in those):
            yield f"{name}: nothing of {pair[0]} in {pair[1]}, {those[0].text}"
    for part in dict.fromkeys(body.part.name for body in plan.bodies):
        if not re.search(rf"\b{re.escape(part)} \(\d+\)", TAG.sub(" ", text)):
            yield f"{name}: no step names {part}"


def _tells(said: re.Match[str], match: Match) -> bool:
    least, most = match.play
    if said["tight"]:
        numbers = (-float(said["tightest"]), -float(said["tight"]))
    elif said["least"]:
        numbers = (-float(said["least"]), float(said["most"]))
    else:
        numbers = (float(said["low"]), float(said["high"]))
    return abs(numbers[0] - least) < ROUNDED and abs(numbers[1] - most) < ROUNDED


def tolerance_faults(plan: Plan, files: Mapping[str, bytes]) -> Iterator[str]:
    """Play of pins on the page of tolerances that is not that of their limits."""
    if "tolerances.html" not in files:
        return
    text = html.unescape(files["tolerances.html"].decode())
    rows = re.findall(r"<tr><th>([^<]+)</th>(.*?)</tr>", text, re.DOTALL)
    running: dict[str, list[tuple[float, float]]] = {}
    for match in plan.order.seats.matches:
        if not plan.order.seats.is_fast(match) and not match.missing_fits:
            running.setdefault(plan.bodies[match.pin].part.name, []).append(match.play)
    for pin, rest in rows:
        cell = re.search(r"(-?[\d.]+)\.\.(-?[\d.]+)", TAG.sub(" ", rest))
        if pin in running and cell is not None and "on diameter" in rest:
            told = (float(cell[1]), float(cell[2]))
            if not any(
                max(abs(a - b) for a, b in zip(told, play, strict=True)) < ROUNDED for play in running[pin]
            ):
                yield f"tolerances.html: {pin} has {cell[0]}, and its limits give {running[pin]}"

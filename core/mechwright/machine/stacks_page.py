"""``stacks.html`` and ``stacks.json``: axial stacks, worst case and statistics, and the shims to choose."""

import json
from collections.abc import Mapping
from typing import Any

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.turned import limited
from mechwright.mechanics.tolerance.axial_stacks import BOUGHT, stack_result
from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.figures import Grid, figures_page
from mechwright.pipeline.page import FileName, Page

HTML, JSON = "stacks.html", "stacks.json"
"""The files."""


class StacksPage(Page):
    """The axial stacks of a machine: lengths, worst case, statistics, and shim rings."""

    name = "stacks"
    commands = frozenset({"model", "build"})
    doing = "axial stacks"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Both files, where there are stacks."""
        return [FileName(name, "the axial stacks") for name in (HTML, JSON)] if build.design.stacks else []

    def files(self, build: Build) -> Mapping[str, str]:
        """Nothing of a design without stacks."""
        stacks = build.design.stacks
        if not stacks:
            return {}
        html = figures_page(
            build.design.name,
            f"{build.design.family.title}: axial stacks",
            _NOTES,
            [],
            [_summary(stacks), *(_grid(one) for one in stacks)],
        )
        return {HTML: html, JSON: json.dumps([as_data(one) for one in stacks], indent=2) + "\n"}


_NOTES = [
    "A stack is a closed loop of lengths along an axis. Its gap is the sum of all lengths with their signs. "
    "A gap above 0 is a play, one below 0 an interference.",
    "Worst case: every length stands at its limit. Statistics: the middle, and the root of the sum of the "
    f"squared half tolerances to both sides, taken {BOUGHT:g} times where a part is bought. The probability "
    "of a gap below 0 is that of a normal distribution whose standard deviation is a third of that root.",
    "A stack with shim rings is assembled without them. Measure its gap g with a dial gauge, and put in "
    "rings of the thickness that its table gives.",
]


def _summary(stacks: tuple[AxialStack, ...]) -> Grid:
    rows = []
    for one in stacks:
        found = stack_result(one)
        low, high = one.play
        rows.append(
            [
                one.name,
                _meant(one),
                _range(found.worst),
                _range(found.statistical),
                _percent(found.below_zero),
                "-" if one.shimming is None else _range((low, high)),
            ]
        )
    heads = ["", "meant, mm", "worst case", "by statistics", "below 0", "with shim rings"]
    return Grid("Gaps", heads, rows)


def _grid(one: AxialStack) -> Grid:
    found = stack_result(one)
    rows = [
        [
            part.name,
            part.part or "-",
            "+" if part.sign > 0 else "-",
            limited(part.nominal, part.lower, part.upper),
            _percent(share),
        ]
        for part, share in zip(one.lengths, found.shares, strict=True)
    ]
    title = one.name[0].upper() + one.name[1:]
    if (shimming := one.shimming) is not None:
        least, most = found.worst
        title += (
            f". Measure g, {least:.2f} to {most:.2f} mm; put in {shimming.designation} {shimming.where}: "
            f"g - {shimming.least:g} mm, rounded down to {shimming.step:g} mm"
        )
    return Grid(title, ["length", "part", "sign", "mm", "share"], rows)


def as_data(one: AxialStack) -> dict[str, Any]:
    """A stack with its results, as ``stacks.json`` has it."""
    found = stack_result(one)
    data: dict[str, Any] = {
        "name": one.name,
        "meant": [one.least, None if one.greatest == float("inf") else one.greatest],
        "lengths": [
            {
                "name": part.name,
                "part": part.part,
                "sign": part.sign,
                "nominal": round(part.nominal, 6),
                "lower": part.lower,
                "upper": part.upper,
                "bought": part.bought,
                "share": round(share, 6),
            }
            for part, share in zip(one.lengths, found.shares, strict=True)
        ],
        "nominal": round(one.nominal, 6),
        "worst": [round(value, 6) for value in found.worst],
        "statistical": [round(value, 6) for value in found.statistical],
        "below_zero": float(f"{found.below_zero:.6g}"),
        "play": [round(value, 6) for value in one.play],
    }
    if (shimming := one.shimming) is not None:
        data["shims"] = {
            "designation": shimming.designation,
            "thicknesses": list(shimming.thicknesses),
            "where": shimming.where,
            "leave_at_least": shimming.least,
            "step": shimming.step,
            "part": shimming.part,
        }
    return data


def _meant(one: AxialStack) -> str:
    if one.greatest == float("inf"):
        return f"{one.least:g} or more"
    return f"{one.least:g} to {one.greatest:g}"


def _range(values: tuple[float, float]) -> str:
    return f"{values[0]:.2f} to {values[1]:.2f}"


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share > 1e-6 else "0 %"

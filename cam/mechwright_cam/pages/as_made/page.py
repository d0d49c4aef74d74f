"""``as-made.json``, ``as-made.html``, and a drawing of every part as made."""

import json
from typing import Any

from mechwright.contracts.as_made import AsMade, MadeFigure
from mechwright.contracts.finding import Severity
from mechwright.contracts.made_part import MadePart
from mechwright.pipeline import Build, FileName, Page, Wanted

JSON, HTML, DRAWING = "as-made.json", "as-made.html", "-as-made.dxf"


class AsMadeFiles(Page):
    """What was asked for, what the design does, and what the made parts do."""

    name = "as-made"
    commands = frozenset({"build"})
    doing = "parts as made"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page, the data, and a drawing of every copy on a plate."""
        from mechwright_cam.pages.file_names import machined
        from mechwright_cam.proof.as_made_parts import placed_on

        machining = machined(build)
        if machining is None:
            return []
        labels = [one.label for job in machining.jobs if job.side == "top" for one in placed_on(job.part)]
        drawn = [FileName(_drawing(label), f"the drawing of {label} as made") for label in labels]
        return [*drawn, *(FileName(name, "the parts as made") for name in (JSON, HTML))]

    def files(self, build: Build) -> dict[str, str | bytes]:
        """Page, data and drawings; none where no program is made."""
        from mechwright_cam.as_made import AsMadeParts
        from mechwright_cam.pages.as_made.drawing import as_made_drawing

        made = build.made(AsMadeParts)
        parts = [part for part in made.parts if part.off.size]
        if not parts:
            return {}
        found: dict[str, str | bytes] = {_drawing(part.label): as_made_drawing(part) for part in parts}
        name = build.design.name
        found[JSON] = json.dumps(as_dict(name, parts, made.analysis), indent=2, ensure_ascii=False) + "\n"
        found[HTML] = html(name, build.path.name, parts, made.analysis)
        return found


def _drawing(label: str) -> str:
    return label.replace(" ", "-") + DRAWING


def as_dict(name: str, parts: list[MadePart], said: AsMade) -> dict[str, Any]:
    """Plain data for ``as-made.json``; lengths in mm to a hundredth of a micrometre."""
    return {
        "design": name,
        "runs": verdict(said),
        "parts": [_part(part) for part in parts],
        "figures": [figure.as_dict() for figure in said.figures],
        "findings": [finding.as_dict() for finding in said.findings],
    }


def verdict(said: AsMade) -> bool | None:
    """Whether the mechanism runs as made; None where the family says nothing of it."""
    if not said.figures and not said.findings:
        return None
    return all(finding.severity is not Severity.ERROR for finding in said.findings)


def _part(part: MadePart) -> dict[str, Any]:
    off = part.off
    return {
        "name": part.name,
        "label": part.label,
        "corridor_mm": round(part.corridor, 5),
        "left_mean_mm": round(float(off.mean()), 5),
        "left_greatest_mm": round(float(off.max()), 5),
        "cut_deepest_mm": round(max(0.0, -float(off.min())), 5),
        "witness_lines": [
            {"depth_mm": round(one.depth, 4), "step_mm": round(one.step, 5), "x": one.at[0], "y": one.at[1]}
            for one in part.witnesses
        ],
    }


def html(name: str, design: str, parts: list[MadePart], said: AsMade) -> str:
    """The page."""
    from markupsafe import Markup

    from mechwright_cam.pages.as_made.picture import as_made_picture
    from mechwright_cam.pages.as_made.plot import plot
    from mechwright_cam.pages.setup_sheet.sheet import environment

    return (
        environment()
        .get_template("as-made.html")
        .render(
            name=name,
            design=design,
            verdict=verdict(said),
            rows=[_row(figure) for figure in said.figures],
            findings=said.findings,
            # Our own markup; all text in it is escaped where it is made.
            curves=[(curve.title, Markup(plot(curve))) for curve in said.curves],  # noqa: S704
            parts=[
                (part, _part(part), _drawing(part.label), Markup(as_made_picture(part)))  # noqa: S704
                for part in parts
            ],
        )
    )


def _row(figure: MadeFigure) -> dict[str, Any]:
    return {
        "title": figure.title,
        "unit": figure.unit,
        "rule": figure.rule,
        **{key: _short(getattr(figure, key)) for key in ("asked", "design", "made", "low", "high")},
    }


def _short(value: float | None) -> str:
    """Four figures, with a true minus sign.

    >>> _short(0.06165), _short(-1234.56), _short(None)
    ('0.06165', '−1235', '–')
    """
    if value is None:
        return "–"
    return (f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}").replace("-", "−")

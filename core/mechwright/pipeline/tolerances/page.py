"""The page ``tolerances.html``: one file without network or script. Imports jinja2 when it is made."""

from collections.abc import Mapping
from pathlib import Path

from mechwright.output.templates import templates
from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.page import FileName, Page

NAME = "tolerances.html"
"""The file."""


class TolerancePage(Page):
    """``tolerances.html``: bands of errors over the input, contributors by share, and the yield."""

    name = "tolerances"
    commands = frozenset({"build"})
    doing = "tolerances"

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page."""
        return [FileName(NAME, "the tolerances")]

    def files(self, build: Build) -> Mapping[str, str]:
        """The page; none where the family has no analysis of tolerances."""
        from mechwright.pipeline.tolerances.asked import analysis_of

        analysis = build.made(analysis_of)
        if analysis is None:
            return {}
        from mechwright.pipeline.tolerances import plots, report, units

        outputs = []
        for result in analysis.results:
            places = [*((result.worst,) if result.worst is not None else ()), *result.places]
            shown = (result.places or (result.worst,))[0]
            outputs.append(
                {
                    "name": result.output.name,
                    "unit": units.shown_unit(result.output.unit),
                    "plot": plots.plot(analysis, result),
                    "orders": [
                        (report.where(analysis, place, result.output), report.order(result, place))
                        for place in places
                    ],
                    "where": "" if shown is None else report.where(analysis, shown, result.output),
                    "lines": [] if shown is None else report.lines(analysis, result, shown),
                    "outcomes": [report.outcome(analysis, result.output, trial) for trial in result.trials],
                }
            )
        html = (
            templates(Path(__file__).parent)
            .get_template("page.html")
            .render(
                name=build.design.name,
                title=build.design.family.title,
                settings=analysis.tolerances.settings,
                outputs=outputs,
                notes=list(report.remarks(analysis)),
                percent=units.percent,
                p=plots,
            )
        )
        return {NAME: html}

"""What ``check`` says of a design that is printed."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.pipeline import Build, Inspection
from mechwright_print.settings import PRINT

if TYPE_CHECKING:
    from mechwright_print.job.print_job import JobPart, PrintJob


class Printable(Inspection):
    """Whether the printed parts come out of the printer as they are needed."""

    name = "printable"
    process = PRINT
    stage = Stage.MACHINING
    order = 16
    doing = "printed parts"
    share = 2.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """Those of the rules, where the design says anything of printing."""
        from mechwright_print.job.print_job import is_asked

        asked = build.wanted.command == PRINT or is_asked(build.design, build.parts)
        return build.made(findings_of) if asked else ()


def findings_of(build: Build) -> list[Finding]:
    """What the rules find of a print, whether the design asks for one or a command does."""
    from mechwright_print.job.print_job import PrintJob
    from mechwright_print.rules.holes import bush_rule, fit_rule, insert_rule
    from mechwright_print.rules.running import RUNNING

    job = build.made(PrintJob)
    found = [found for one in job.parts for found in part_findings(job, one)]
    found += [*fit_rule(job), *insert_rule(job), *bush_rule(job)]
    found += [found for rule in RUNNING for found in rule(build, job)]
    return at_stage(Stage.MACHINING, found)


def part_findings(job: "PrintJob", one: "JobPart") -> list[Finding]:
    """What the rules find of one part."""
    from mechwright_print.rules.judged import RULES

    return [found for rule in RULES for found in rule(job, one)]

"""What ``check`` tells: the run that a command would make, up to a stage, of which nothing is written."""

from mechwright.contracts.finding import Finding, Findings, Stage
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.pipeline import LOOK, Build, Inspection, Run, work_to
from mechwright.pipeline.page import pages_of
from mechwright.pipeline.run import refused
from mechwright.plugins.host import Host
from mechwright.remedies import with_remedies


def checked(
    build: Build, to: Stage | None = None, progress: Progress = unheard, *, remedies: bool = True
) -> Findings:
    """All that is found of a build up to a stage, with remedies that were tried if they are wanted.

    Without a stage nothing is made: it is said what can be said before. With one it is what the command says
    that ends there.

    Raises
    ------
    MechwrightError
        The design cannot be read, or a plugin is at fault.
    """
    if to is None:
        run = Run(build, LOOK, progress)
        run.look()
        return with_remedies(run) if remedies else run.findings
    command, work = work_to(to)
    # The build's own wishes hold where it is what its command asks: nothing is made twice then.
    same = build.wanted.command == command
    asked = build if same else build.asking(command=command or "check", work=work)
    run, unmakeable = Run(asked, work, progress), list[Finding]()
    with asked:
        try:
            run.make(pages_of(asked.host, command))
        except RefusedError:
            pass
        except PluginFaultError:
            raise
        except MechwrightError as error:
            unmakeable.append(refused(error, asked.path, to))
    return Findings([*(with_remedies(run) if remedies else run.findings), *unmakeable])


def unmade(host: Host, to: Stage | None) -> tuple[str, ...]:
    """What a check up to a stage does not make, and does not look at therefore."""
    work = LOOK if to is None else work_to(to)[1]
    asked = (one for one in host.all(Inspection) if not one.stage.is_after(work.stage))
    return tuple(sorted({need for one in asked for need in one.needs - work.makes}))

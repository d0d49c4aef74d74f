"""Whether the files of a design keep apart: what a check says of their names before one of them is made."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from mechwright.contracts.file_names import file_key, free_name, name_fault
from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.page import FileName, pages_of
from mechwright.pipeline.work import WORK


class FileNames(Inspection):
    """Files of one design that would be one file, here or on a system that does not tell cases apart."""

    name = "file-names"
    stage = Stage.MOTION
    order = 30
    doing = "names of files"
    share = 1.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """An error for each name that two files of the command would have.

        Of a whole build and of a check, the stage is that of the first command which would write them.
        """
        found: dict[str, Finding] = {}
        own, last = build.wanted.command, build.wanted.extent.stage
        upto = [command for command, work in WORK.items() if not work.stage.is_after(last)]
        for command in upto if own not in WORK or last is Stage.OUTPUT else (own,):
            for key, finding in _faults(files_of(build, replace(build.wanted, command=command))):
                found.setdefault(key, replace(finding, stage=WORK[command].stage))
        return list(found.values())


def files_of(build: Build, wanted: Wanted) -> list[FileName]:
    """The files that the pages of a command would write, as far as they know before any work."""
    return [one for page in pages_of(build.host, wanted.command) for one in page.names(build, wanted)]


def _faults(files: Sequence[FileName]) -> Iterator[tuple[str, Finding]]:
    """What is wrong with the names of one command, each by what file systems compare."""
    known: dict[str, FileName] = {}
    for one in files:
        key = file_key(one.name)
        if fault := name_fault(one.name):
            yield key, _error(one, f"the file of {one.of}, {one.name!r}, {fault}", files)
        other = known.setdefault(key, one)
        if other is not one:
            told = (
                one.name
                if one.name == other.name
                else f"{other.name} and {one.name}, one file on some systems"
            )
            named = one if one.key or not other.key else other
            yield key, _error(named, f"{other.of} and {one.of} would both be written as {told}", files)


def _error(named: FileName, message: str, files: Sequence[FileName]) -> Finding:
    change: tuple[Change, ...] = ()
    remedy = f"rename {named.of}"
    if named.key:
        stems = [one.name.partition(".")[0] for one in files]
        other = free_name(f"{named.text}-{named.key.split('.')[-2]}", stems)
        change, remedy = ({named.key: other},), f'set {named.key} = "{other}"'
    return Finding.error("files.names", named.key, message, remedy=remedy, proposed=change)

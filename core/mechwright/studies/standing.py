"""What of a sweep is on the disk: said when it is stopped, or fails, and as long as it runs."""

from pathlib import Path

from mechwright.errors import MechwrightError
from mechwright.studies.folder import SweepFolder
from mechwright.studies.study import Study
from mechwright.studies.task import Task

ON = "the same command goes on"


class Standing:
    """What a folder has of a study, asked of the folder itself.

    Parameters
    ----------
    study
        The study.
    """

    def __init__(self, study: Study) -> None:
        self.study = study
        self.place: SweepFolder | None = None
        """Where its files go, as soon as it is known to be the study's."""
        self.tasks: list[Task] = []
        """The batches that are known so far."""
        self.begun = False
        """Whether work has begun: what is wrong before, such as a table that is none, is said alone."""

    @property
    def total(self) -> int:
        """Designs that are drawn, and those of the rounds of search so far."""
        drawn = sum(task.size(self.study) for task in self.tasks if task.drawn is None)
        return self.study.count + drawn

    def saved(self) -> int:
        """Designs that are saved: no run evaluates them again."""
        if self.place is None:
            return 0
        slices, tables, count = self.place.all_slices(), self.place.whole(self.tasks), 0
        for task in self.tasks:
            if task.name in tables:
                count += task.size(self.study)
            else:
                count += sum(self._in_slice(task, path) for path in slices.get(task.name, []))
        return count

    def _in_slice(self, task: Task, path: Path) -> int:
        assert self.place is not None  # noqa: S101 - asked before
        try:
            return self.place.saved_in(task, path)
        except MechwrightError:
            return 0  # nobody goes on with it

    def sentence(self) -> str:
        """What is saved, and what the same command does then."""
        if self.place is None:
            return "the sweep had not begun; no file was changed"
        folder, saved, total = self.place.path, self.saved(), self.total
        if not saved:
            return f"saved in {folder}: none of {total:,} designs; the same command begins anew"
        if saved < total:
            rest = total - saved
            return f"saved in {folder}: {saved:,} of {total:,} designs; {ON} with the other {rest:,}"
        checks = len(self.place.checks())
        besides = f", and {checks:,} checks for the front" if checks else ""
        return f"saved in {folder}: all of {total:,} designs{besides}; {ON} from there"

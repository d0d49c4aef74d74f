"""A mechanism as scripts and the command line have it in hand."""

from dataclasses import replace
from html import escape
from pathlib import Path
from typing import Any

from mechwright.contracts.finding import Findings, Stage, errors
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.errors import DesignError, MechwrightError
from mechwright.output.folder import write_new
from mechwright.pipeline import Build, Page
from mechwright.scripting.changes import change_of
from mechwright.scripting.checking import checked
from mechwright.scripting.performing import Written, perform

MOTION_PAGE = "motion-page"
"""The page on which a mechanism moves, by the name under which it is registered."""
HEIGHT = 640
"""Of that page in a notebook, pixels."""


class Mechanism(Build):
    """A design, and all that is made of it: each thing when it is first asked for, and then kept.

    :func:`load` and :func:`design` give one. What plugins see of it is its base, :class:`Build`, with
    ``findings``, ``motion``, ``parts``, ``assembly`` and ``programs``.

    Examples
    --------
    >>> import mechwright as mw
    >>> pair = mw.design("elliptic-gears", eccentricity=0.4, teeth=25)
    >>> pair.findings.errors, pair.parts.names, pair.motion.samples
    ((), ('gear',), 721)
    >>> flatter = pair.with_(eccentricity=0.3)
    >>> [round(one.motion.scalars["ratio_max"].value, 3) for one in (flatter, pair)]
    [1.857, 2.333]
    """

    def __repr__(self) -> str:
        return f"<Mechanism {self.design.name}: {self.design.family.title.lower()}>"

    def with_(self, **changes: object) -> "Mechanism":
        """The same with other parameters, as a new mechanism.

        Parameters
        ----------
        changes
            Parameters by their names; a table, such as ``cam={"clearance": 8}``, changes the keys it has.

        Raises
        ------
        DesignError
            One line for each thing that is wrong.
        """
        design = self.design.changed(change_of(self.host, changes))
        return Mechanism(replace(design, digest=""), self.host, self.wanted)

    def asked(self, **wanted: Any) -> "Mechanism":
        """The same design with other wishes, such as ``samples=3601, at="40 deg"``: see :class:`Wanted`."""
        return self.asking(**wanted)

    @property
    def toml(self) -> str:
        """The design as a file, every key with a comment."""
        return self.design.text

    def save(self, path: "str | Path", *, replace: bool = False) -> Path:
        """Write the design file; raises OutputError where one is there, unless told to ``replace`` it."""
        write_new(Path(path), self.toml, replace=replace)
        return Path(path)

    def check(
        self, progress: Progress = unheard, to: Stage | str | None = None, *, remedies: bool = True
    ) -> Findings:
        """What ``mechwright check`` tells, with remedies that were tried.

        That is what the family finds, and if this allows it what every inspection does: bodies that meet,
        cutters that do not reach.

        Parameters
        ----------
        progress
            Told how far it is.
        to
            The last stage that is looked at, and all is made for: solids, programs with their proofs, files.
            By default every stage is looked at, and nothing is made. What is made stays, and ``write`` takes
            it.
        remedies
            Whether changes are tried against what is found, which may take seconds.
        """
        return checked(self, None if to is None else Stage(to), progress, remedies=remedies)

    def write(
        self,
        folder: "str | Path",
        progress: Progress = unheard,
        empty: str = "",
    ) -> Written:
        """Write everything that the command asked for writes, ``build`` by default; see :func:`perform`."""
        return perform(self, Path(folder), progress, empty)

    @property
    def page(self) -> str:
        """The page on which it moves, one file of HTML, as ``mechwright solve`` writes it.

        Raises RefusedError where it does not move, DesignError for a family of what stands still, PluginError
        where no such page is installed.
        """
        if not self.design.family.moves:
            name = self.design.family.name
            raise DesignError(f"{self.path}: family {name} stands still: there is no motion to show")
        found = self.host.get(Page, MOTION_PAGE)
        self.require(errors(self.findings, Stage.MOTION))
        with self.asking(command="solve") as build:
            files = found.files(build)
        content = next(iter(files.values()))
        if isinstance(content, str):
            return content
        return (content if isinstance(content, bytes) else b"".join(content)).decode()

    def _repr_html_(self) -> str:
        found = self.findings._repr_html_()
        try:
            page = self.page
        except MechwrightError:
            return found  # which says why it does not move
        title = escape(f"{self.design.name} moves")
        # Without a frame of its own the page's styles and scripts would be those of the notebook.
        return (
            f'<iframe srcdoc="{escape(page)}" sandbox="allow-scripts" title="{title}" '
            f'style="width:100%;height:{HEIGHT}px;border:0"></iframe>{found}'
        )

"""The contract of a mechanism family."""

from abc import abstractmethod
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, final

from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.plugin import Plugin
from mechwright.errors import DesignError

if TYPE_CHECKING:
    import shapely

    from mechwright.arrays import Array
    from mechwright.contracts.answers import Evaluated, Findings, Parts, WholeMotion
    from mechwright.contracts.as_made import AsMade
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.evaluation import Batch
    from mechwright.contracts.figure import Figure, PartMass
    from mechwright.contracts.made_part import MadePart
    from mechwright.contracts.motion import Channel
    from mechwright.contracts.mounting import Flange, GroundPlate, Mounting
    from mechwright.contracts.rule_list import Rules
    from mechwright.contracts.synthesis import Progress, Synthesis
    from mechwright.contracts.target import Target
    from mechwright.contracts.tolerance_settings import Tolerances
    from mechwright.contracts.tolerances import ToleranceModel
    from mechwright.contracts.transmission import Transmission

P = TypeVar("P", bound=Parameters)


class Family(Plugin, Generic[P]):
    """A mechanism family: parameters in, findings, motion and parts out.

    A family is stateless. Its methods take validated parameters and never touch files. Heavy imports
    (scipy, shapely, cadquery) belong at the top of the modules that need them, and those modules are
    imported inside the method that uses them, so that listing families stays fast.

    Every parameter that ``Params`` accepts changes some result.
    """

    kind = "family"
    plural = "families"
    limited = True
    steady = True
    unlimited = frozenset({"synthesise", "evaluate", "stretches"})
    derived = frozenset({"check", "judge", "evaluate"})
    inner = frozenset({"rules", "table", "remedy", "figures", "channels", "extremes", "masses"})
    piecewise = frozenset({"stretches"})

    title: ClassVar[str]
    """A few words, as a heading."""
    summary: ClassVar[str]
    """One sentence."""
    Params: type[P]
    """The table ``[parameters]``."""
    requirements: ClassVar[Mapping[str, type[Parameters]]] = {}
    """What ``synthesise`` can be asked for: kind to the table ``[requirement]``; its defaults can be met."""
    size_keys: ClassVar[Mapping[str, float]] = {}
    """Keys of lengths by which ``new --fit`` scales a design, each with the value that it starts from, mm."""
    moves: ClassVar[bool] = True
    """Whether there is a motion; families of what stands still derive from ``Standing``."""
    batch: ClassVar[int] = 256
    """Designs of a study that are evaluated together: half a minute's work of one core, or 10^5 and more."""
    structure: ClassVar[frozenset[str]] = frozenset()
    """Dotted keys of numbers in which designs of one table are alike; texts and whole numbers always are."""
    counts: ClassVar[frozenset[str]] = frozenset()
    """Dotted keys of whole numbers in which they may differ."""
    block: ClassVar[int] = 4096
    """Designs of a table that are evaluated at once."""
    sampled: ClassVar[int] = 64
    """Designs of it whose channels are evaluated at once."""

    def rules(self) -> "Rules[Any]":
        """What an engineer objects to, in order: see :mod:`mechwright.contracts.design_rule`."""
        from mechwright.contracts.rule_list import in_turn

        return in_turn()

    def table(self, params: P, size: int | None = None) -> "DesignTable[P]":
        """What rules and figures are asked of: one design, or ``size`` designs whose numbers are columns.

        A family overrides it where dimensions that are left open are completed, or where formulas share what
        takes long.
        """
        from mechwright.contracts.design_table import DesignTable

        return DesignTable(params, size)

    def remedy(self, params: P, finding: Finding) -> Finding:  # noqa: ARG002 - used by families that search
        """A finding of its rules with the remedy that is found by looking at the whole design."""
        return finding

    @final
    def check(self, params: P) -> "Findings":
        """Everything that an engineer would object to, and the figures worth knowing: from its rules."""
        from mechwright.contracts.checking import findings_of

        return findings_of(self, params, quick=False)

    @final
    def judge(self, params: P) -> "Findings":
        """What ``check`` finds, as far as it is found fast: asked of hundreds of designs to find a remedy.

        What it finds has codes, severities, parameters and messages of ``check``. Notes and remedies that
        take long to find may be missing; ``check`` is asked about every remedy before it is told.
        """
        from mechwright.contracts.checking import findings_of

        return findings_of(self, params, quick=True)

    @abstractmethod
    def solve(self, params: P, samples: int) -> "WholeMotion":
        """The motion over one period of the input, ``samples`` of them, both ends included.

        Motion needs closure, nothing else: it is asked for wherever ``check`` finds no error of the stage
        ``motion``, and whether parts can be made is no matter. What a period is, :class:`Motion` says.

        Raises
        ------
        MechwrightError
            ``check`` has an error of the motion.
        """

    def stretches(self, params: P, samples: int) -> "Iterator[WholeMotion]":
        """The motion of ``solve``, as many samples after the other as memory is to be spent on.

        Tables of millions of samples are written so. What follows each other are motions of the same bodies
        and channels, each with the figures of the whole; put together they are the motion of ``solve``. The
        default asks that for all at once: see :func:`~mechwright.contracts.stretch.in_stretches`, by which
        most families need no more than two lines.

        Raises
        ------
        MechwrightError
            As ``solve``, when the first of them is asked for, or a later one.
        """
        yield self.solve(params, samples)

    def breaks(self, params: P) -> "Sequence[float]":  # noqa: ARG002 - used by families with such laws
        """Where a rate of some channel jumps, or one of its rates does: where one law meets the next.

        Values of the channel that goes one way all along (:attr:`Motion.over`), in its unit. Between them all
        channels are smooth, and the contract tests compare rates with difference quotients there, not across.
        The default says that there are none.
        """
        return ()

    @abstractmethod
    def parts(self, params: P) -> "Parts":
        """The parts to make.

        Raises
        ------
        MechwrightError
            The parameters describe no part; ``check`` says why.
        """

    def mounting(self, params: P) -> "Mounting | GroundPlate | Flange | None":  # noqa: ARG002 - used by some
        """Where its shafts stand, or its own ground plate, so that a frame can be built around it.

        It is asked of a design whose ``check`` finds no error. None, the default, refuses a frame.

        Raises
        ------
        DesignError
            This design has no shafts that a frame could carry: the key, what is wrong, and what to do, as in
            ``"parameters.bore: gears without a bore have no shafts; set bore = 10"``.
        """
        return None

    def stacks(self, params: P) -> "Sequence[AxialStack]":  # noqa: ARG002 - used by some
        """Axial stacks of its own parts; asked of a design whose ``check`` finds no error."""
        return ()

    def transmission(self, params: P) -> "Transmission | None":  # noqa: ARG002 - used by some
        """The mechanism as a stage of a chain, whose input another stage may turn.

        It is asked of a design whose ``check`` finds no error of the motion. None, the default: mechanisms of
        this family are no stages, and a chain with one is refused.

        Raises
        ------
        DesignError
            This design is no stage: the key, what is wrong, and what to do.
        """
        return None

    def draft(self, source: str, text: str) -> P:  # noqa: ARG002 - used by families that have some
        """The design that ``new`` writes: what it sets, with the keys that one sets first.

        Parameters
        ----------
        source
            What ``new --from`` names: something that the family knows, or a file; empty without it.
        text
            What that file says; empty where no file is named.

        Raises
        ------
        DesignError
            The family begins with no such thing: what is wrong, and what it can begin with.
        """
        if source:
            raise DesignError(f"--from: family {self.name} begins with its defaults alone; leave --from out")
        return self.Params()

    def settings(
        self,
        params: P,  # noqa: ARG002 - used by families whose machines are set
    ) -> "Mapping[str, P]":
        """The designs that the same machine is set to besides this one.

        Parameters
        ----------
        params
            A design whose ``check`` finds no error.

        Returns
        -------
        settings
            What is set, as ``"phase = 45 deg"``, to the design of that setting. Bodies are looked at for
            interference in each. The default has none.
        """
        return {}

    def check_cut(
        self,
        params: P,  # noqa: ARG002 - used by families whose parts mate
        cut: "Mapping[str, shapely.Polygon]",  # noqa: ARG002
    ) -> "Findings":
        """Judge the parts as the chosen cutters leave them.

        Parameters
        ----------
        params
            The design.
        cut
            Part name to its outline, mm, with the corners that no chosen cutter reaches still filled.

        Returns
        -------
        findings
            An error where the remainder spoils the function (gears that no longer mesh). The default
            finds nothing: the remainder is reported by the proof all the same.
        """
        return ()

    def as_made(
        self,
        params: P,  # noqa: ARG002 - used by families whose parts mate
        made: "Mapping[str, Sequence[MadePart]]",  # noqa: ARG002
    ) -> "AsMade":
        """Say how the mechanism runs with parts as their programs leave them.

        Parameters
        ----------
        params
            The design.
        made
            Part name to its copies as they come off the machine; one where every copy is cut by the same
            program.

        Returns
        -------
        as_made
            Figures and curves over the corridor of the path and the tolerances of what is not made here;
            an error where it cannot be put together or does not turn, whose remedy has been tried. The
            default says nothing.
        """
        from mechwright.contracts.as_made import AsMade

        return AsMade()

    def tolerances(
        self,
        params: P,  # noqa: ARG002 - used by families that have an analysis
        tolerances: "Tolerances",  # noqa: ARG002
    ) -> "ToleranceModel | None":
        """How deviations of dimensions and joints change what the mechanism does.

        Parameters
        ----------
        params
            A design whose ``check`` finds no error of the motion.
        tolerances
            What the design file allows; it makes the contributors.

        Returns
        -------
        model
            None, the default, if the family has no tolerance analysis.
        """
        return None

    def synthesise(self, kind: str, requirement: Parameters, progress: "Progress") -> "Synthesis[P]":
        """Find designs that meet a requirement.

        Parameters
        ----------
        kind
            A key of ``requirements``.
        requirement
            An instance of its model. The same requirement gives the same designs: random starts are
            drawn from a seed that is one of its fields.
        progress
            To be called now and then.

        Returns
        -------
        synthesis
            Designs, best first; none, and an error finding that says what would be feasible, if the
            requirement cannot be met.
        """
        raise NotImplementedError(f"family {self.name} has no synthesis of kind {kind!r}")

    def figures(self, table: "DesignTable[P]") -> "Mapping[str, Figure]":  # noqa: ARG002 - of most families
        """The figures of designs by their names, for a study; those of one design are the motion's."""
        return {}

    def channels(self, table: "DesignTable[P]", samples: int) -> "Mapping[str, Channel]":  # noqa: ARG002
        """The channels (n, samples) of the motions of designs, whose extremes are columns of a study."""
        return {}

    def extremes(
        self, table: "DesignTable[P]", names: Collection[str]
    ) -> "Mapping[str, tuple[Array, Array, str]]":
        """Least and greatest values (n,) of channels, and their units; the default takes samples of them."""
        from mechwright.contracts.table_evaluation import extremes_of_samples

        return extremes_of_samples(self, table, names)

    def masses(self, table: "DesignTable[P]") -> "Mapping[str, PartMass] | None":  # noqa: ARG002
        """The masses of the parts of designs by their names; None: those of ``parts``, design by design."""
        return None

    def measures(self, params: P) -> Mapping[str, str]:
        """The columns that a study around this design can have, name to unit; angles are in degrees.

        The default are the figures of its motion, the extremes of its channels, and the masses of its parts.

        Raises
        ------
        MechwrightError
            The design does not move.
        """
        from mechwright.contracts.evaluation import figures
        from mechwright.contracts.finding import errors
        from mechwright.contracts.masses import UNIT, names_of
        from mechwright.contracts.sampling import SAMPLES

        found = {name: unit for name, (_, unit) in figures(self.solve(params, SAMPLES)).items()}
        if errors(self.judge(params), Stage.PARTS):
            return found
        return found | dict.fromkeys(names_of(self.parts(params)), UNIT)

    @final
    def evaluate(
        self, batch: "Batch[P]", columns: Collection[str], stage: Stage = Stage.PARTS
    ) -> "Evaluated":
        """Many designs at once: their figures, and what forbids those that cannot be.

        Parameters
        ----------
        batch
            The designs.
        columns
            Which of ``measures`` are asked for.
        stage
            Up to which stage a design has to be free of errors.

        Returns
        -------
        columns
            The same numbers as ``solve`` and ``parts`` give for each of them, and the code of the first error
            of its rules.
        """
        from mechwright.contracts.table_evaluation import evaluated

        return evaluated(self, batch, columns, stage)

    def targets(self, kind: str, requirement: Parameters) -> "Sequence[Target]":  # noqa: ARG002 - some do
        """The places that a requirement asks for, which ``mechwright live`` lets one drag.

        It is asked with every move of the pointer, of any requirement that its model takes, met or not. The
        default gives every list of points [x, y] in mm.
        """
        from mechwright.contracts.target import point_targets

        return point_targets(requirement)

    def design_targets(self, params: P) -> "Sequence[Target]":  # noqa: ARG002 - some do
        """The places of a design that its parameters state, which ``mechwright live`` lets one drag.

        :attr:`Target.moved` gives dotted keys of the table ``[parameters]``. The default gives none.
        """
        return ()

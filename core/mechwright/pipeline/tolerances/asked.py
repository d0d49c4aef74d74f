"""The analysis of a build, and whether what its design file asks can be done."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import ToleranceModel
from mechwright.errors import DesignError
from mechwright.mechanics.tolerance import Analysis, analyse, check_keys
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.tolerances.by_process import (
    SpreadTolerances,
    analysed,
    tolerances_for,
    tolerances_of,
)

KEYS = "tolerances.key"
"""Code of the finding that a key of ``[tolerances]`` cannot be obeyed."""


def model_of(build: Build) -> ToleranceModel | None:
    """The family's model of the design; None if it has none, and the design says nothing of tolerances.

    Raises
    ------
    DesignError
        What the design file says of tolerances cannot be obeyed.
    """
    design, asked = build.design, tolerances_of(build)
    model = design.family.tolerances(design.params, asked)
    if model is not None:
        check_keys(model, asked)
    elif asked != Tolerances():
        raise DesignError(f"tolerances: {_none(build)}; leave the table out")
    return model


def analysis_of(build: Build) -> Analysis | None:
    """The analysis of a build whose plates stray as their processes do; None where the family has none.

    Raises as :func:`model_of` does.
    """
    tolerances = tolerances_for(build, build.parts)
    if not isinstance(tolerances, SpreadTolerances):
        return build.made(drawn_analysis)
    return None if model_of(build) is None else analysed(build, tolerances)


def drawn_analysis(build: Build) -> Analysis | None:
    """The analysis by what the design file says alone, whoever makes the plates; else as analysis_of."""
    model = model_of(build)
    return None if model is None else analyse(model, tolerances_of(build))


def required_analysis(build: Build) -> Analysis:
    """The analysis of a build; raises DesignError where the family has none."""
    analysis = build.made(analysis_of)
    if analysis is None:
        raise DesignError(f"{build.path}: {_none(build)}; leave out --tolerances")
    return analysis


def _none(build: Build) -> str:
    return f"family {build.design.family.name} has no tolerance analysis"


class ToleranceKeys(Inspection):
    """Keys of ``[tolerances]`` that the family has no use for, and joints that would jam."""

    name = "tolerance-keys"
    stage = Stage.PARTS
    order = 5
    doing = "tolerances"

    def findings(self, build: Build) -> Sequence[Finding]:
        """One error at most: they are asked one after the other."""
        try:
            model_of(build)
        except DesignError as error:
            key, _, rest = str(error).partition(": ")
            message, _, remedy = rest.partition("; ")
            return [Finding(KEYS, Severity.ERROR, key, message, remedy=remedy, stage=self.stage)]
        return ()

"""What every family must do; a family's own tests subclass :class:`FamilyContract`.

Glossary
--------
table
    The ``[parameters]`` of a design file as plain data, before validation.
example
    A table that is a design to be built without an objection; ``{}`` is the design of all defaults.
result
    What a design leads to: findings, motion and parts.
"""

import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from pydantic import ValidationError

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.inputs import input_files
from mechwright.contracts.materials import material
from mechwright.contracts.motion import Motion
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.contracts.plugin import HOOK_API
from mechwright.designs.text import toml
from mechwright.errors import MechwrightError, PluginError
from mechwright.plugins.host import host
from mechwright.testing import commands, rules
from mechwright.testing.compare import assert_rotations
from mechwright.testing.evaluation import EvaluationTests
from mechwright.testing.fixes import FixTests
from mechwright.testing.frames import FrameTests
from mechwright.testing.joints import joint_faults
from mechwright.testing.likeness import repeated
from mechwright.testing.limits import limits_broken
from mechwright.testing.names import NameTests
from mechwright.testing.rates import assert_rates
from mechwright.testing.results import Results
from mechwright.testing.stretches import StretchTests
from mechwright.testing.targets import TargetTests
from mechwright.testing.tolerances import ToleranceTests
from mechwright.testing.transmissions import TransmissionTests
from mechwright.testing.variations import is_constant, variations
from mechwright.tolerances import TOLERANCES

_REFINED = 1e-9
"""Part of a channel's largest value by which the same instant may differ between two samplings: rounding."""


class FamilyContract(
    NameTests,
    ToleranceTests,
    FixTests,
    FrameTests,
    TargetTests,
    EvaluationTests,
    StretchTests,
    TransmissionTests,
):
    """Tests of one family; subclass it and set :attr:`family`.

    Examples
    --------
    ::

        class TestScotchYoke(FamilyContract):
            family = ScotchYoke
            examples = ({}, {"crank_radius": "1 in"})
            refused = (({"slot": 0.0}, "slot"),)
            derivatives = (("x", "velocity"),)
            input_rate = "omega"
    """

    family: ClassVar[type[Family[Any]]]
    """The class under test."""
    examples: ClassVar[Sequence[Mapping[str, Any]]] = ({},)
    """Tables of designs that build without an error finding."""
    refused: ClassVar[Sequence[tuple[Mapping[str, Any], str]]] = ()
    """Tables that must not build, each with the parameter that the refusal has to name."""
    cam: ClassVar[Mapping[str, Any]] = {}
    """The table ``[cam]`` that the examples are machined with."""
    variations: ClassVar[Mapping[str, Sequence[Any]]] = {}
    """Field to values worth trying, where a step from the example is not enough to change a result."""
    derivatives: ClassVar[Sequence[tuple[str, str]]] = ()
    """Channel and the channel of its rate over time, for each rate that the motion gives."""
    input_rate: ClassVar[str] = ""
    """Channel of the input's own rate over time; empty where it is the time or swings."""
    requirements: ClassVar[Mapping[str, Sequence[Mapping[str, Any]]]] = {}
    """Kind of synthesis to tables ``[requirement]`` that can be met; of a kind not named, its defaults."""
    max_examples: ClassVar[int] = 30
    """Random designs to try."""

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        """Run every test that takes a ``design`` once for each example."""
        if "design" in metafunc.fixturenames:
            titles = [json.dumps(dict(table), default=str)[1:-1][:60] for table in self.examples]
            metafunc.parametrize("design", self.examples, ids=[title or "defaults" for title in titles])

    def _motion(self, design: Mapping[str, Any], samples: int | None = None) -> Motion:
        return self.family().solve(self.params(design), samples or self.samples)

    def _parts(self, design: Mapping[str, Any]) -> Sequence[Part]:
        return self.family().parts(self.params(design))

    # The class

    def test_names(self) -> None:
        """The family can be chosen and listed."""
        family = self.family
        assert family.api == HOOK_API
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", family.name), f"name {family.name!r}"
        assert family.title.strip() == family.title != ""
        assert not family.title.endswith("."), "a title is a heading, without a full stop"
        assert re.fullmatch(r"[A-Z].*\.", family.summary), "a summary is one sentence on one line"

    def test_import_is_light(self) -> None:
        """Importing the family brings in no heavy library, so that listing families stays fast."""
        assert commands.heavy_imports(self.family.__module__) == []

    def test_schema(self) -> None:
        """Every field has a description, and every number bounds and a unit."""
        for model in (self.family.Params, *self.family.requirements.values()):
            _none(rules.schema_faults(model))

    # One design

    def test_design_builds(self, design: Mapping[str, Any]) -> None:
        """An example has no error finding, moves, and consists of parts."""
        assert errors(self.family().check(self.params(design))) == []
        assert self._motion(design).samples == self.samples
        assert len(self._parts(design)) > 0

    def test_design_round_trips(self, design: Mapping[str, Any]) -> None:
        """Parameters written as TOML and read again are the same parameters."""
        params = self.params(design)
        text = toml(params.model_dump(mode="json", exclude_none=True))
        assert self.params(tomllib.loads(f"all = {text}")["all"]) == params

    def test_findings(self, design: Mapping[str, Any]) -> None:
        """Findings are well formed, in all examples and refusals."""
        _none(self._finding_faults(self.family().check(self.params(design))))

    def test_channels(self, design: Mapping[str, Any]) -> None:
        """Channels are finite, in known units, and driven by an input that goes one way, or also back."""
        _none(rules.motion_faults(self._motion(design)))

    def test_samples(self, design: Mapping[str, Any]) -> None:
        """As many samples as asked for, both ends included: twice as fine meets the coarse ones."""
        coarse, fine = self._motion(design, 46), self._motion(design, 91)
        assert (coarse.samples, fine.samples) == (46, 91)
        for name, channel in coarse.channels.items():
            scale = np.abs(channel.values).max(initial=0.0)
            np.testing.assert_allclose(
                fine.channels[name].values[::2],
                channel.values,
                rtol=0,
                atol=_REFINED * max(scale, 1.0),
                err_msg=f"channel {name} depends on the number of samples",
            )

    def test_poses(self, design: Mapping[str, Any]) -> None:
        """Bodies move rigidly, joints hold them so, and every instance of a part belongs to a body."""
        motion = self._motion(design)
        for body, poses in motion.poses.items():
            assert np.isfinite(poses.position).all(), f"body {body}"
            assert_rotations(poses.rotation, f"body {body}")
        _none(joint_faults(motion))
        bodies = {instance.body for part in self._parts(design) for instance in part.instances}
        assert bodies <= motion.poses.keys(), f"no poses of {sorted(bodies - motion.poses.keys())}"

    def test_derivatives(self, design: Mapping[str, Any]) -> None:
        """Each rate is the derivative of its quantity over time between breaks, and has the unit of one."""
        if not self.derivatives:
            pytest.skip("the attribute derivatives is empty")
        breaks = self.family().breaks(self.params(design))
        assert_rates(self._motion(design), self.derivatives, self.input_rate, breaks)

    def test_parts(self, design: Mapping[str, Any]) -> None:
        """Parts have names of their own, known materials, and outlines that close and hold material."""
        for part in self._parts(design):
            assert material(part.material).density > 0
            _none(rules.outline_faults(part))

    def test_features(self, design: Mapping[str, Any]) -> None:
        """Features lie inside the plate, and what they leave is the outline."""
        for part in self._parts(design):
            _none(rules.feature_faults(part))

    def test_solids(self, design: Mapping[str, Any]) -> None:
        """The CAD kernel makes every part, and the same file each time."""
        try:
            step = host().get(Exporter, "step")
        except PluginError as error:
            pytest.skip(str(error))
        for part, again in zip(self._parts(design), self._parts(design), strict=True):
            data = step.part(part)
            assert (data or b"").startswith(b"ISO-10303-21;"), f"part {part.name} is no STEP file"
            assert data == step.part(again), f"part {part.name} is not the same file twice"
            if part.build is not None:
                solid = part.build()
                assert solid.isValid(), f"the solid of part {part.name} is not closed, or cuts itself"
                assert solid.Volume() > 0, f"the solid of part {part.name} is inside out"

    def test_programs_are_proven(self, design: Mapping[str, Any], tmp_path: Path) -> None:
        """Every plate part of the design is machined, by a program that has been proven."""
        file = self._file(design, tmp_path)
        if not any(contract.kind == "control" for contract in host().registered):
            pytest.skip("no control is installed")
        proofs = commands.machine(file, tmp_path)
        plates = {part.name for part in self._parts(design) if part.outline is not None}
        assert plates == set(proofs), "a plate part without a program"
        for part, proof in proofs.items():
            assert 0 <= proof["gouge_max_mm"] <= TOLERANCES.gouge, part
            assert 0 <= proof["leftover_reachable_max_mm"] <= TOLERANCES.leftover, part

    def test_no_interference(self, design: Mapping[str, Any], tmp_path: Path) -> None:
        """No two bodies stand in each other at any instant of the motion."""
        solids = any(part.outline is None for part in self._parts(design))
        _none(commands.collisions(self._file(design, tmp_path), tmp_path, solids=solids))

    def _file(self, design: Mapping[str, Any], folder: Path) -> Mapping[str, Any]:
        """The design file of an example, whose files go into the folder; skips if it is not installed."""
        registered = host().of(Family).get(self.family.name)
        if registered is None or type(registered.item) is not self.family:
            pytest.skip(f"family {self.family.name} is not installed")
        params = self.params(design)
        for file in input_files(params).values():
            (folder / file.name).parent.mkdir(parents=True, exist_ok=True)
            (folder / file.name).write_bytes(file.data)
        table = params.model_dump(mode="json", exclude_none=True)
        return {"format": 1, "family": self.family.name, "parameters": table, "cam": dict(self.cam)}

    def test_deterministic(self, design: Mapping[str, Any]) -> None:
        """The same parameters give the same result, whoever computed what before."""
        one, two = (Results(self.family(), self.params(design)) for _ in range(2))
        assert one.difference(two) == ""

    # Synthesis

    def test_synthesis(self) -> None:
        """Every kind gives distinct designs without an error, within its limits, the same each time."""
        if not self.family.requirements:
            pytest.skip("the family has no synthesis")
        unknown = set(self.requirements) - set(self.family.requirements)
        assert not unknown, f"requirements of unknown kinds: {sorted(unknown)}"
        for kind, model in self.family.requirements.items():
            for table in self.requirements.get(kind, ({},)):
                self._synthesise(kind, model.model_validate(dict(table)))

    def _synthesise(self, kind: str, requirement: Parameters) -> None:
        heard: list[float] = []
        result = self.family().synthesise(kind, requirement, lambda done, what: heard.append(done))  # noqa: ARG005
        again = self.family().synthesise(kind, requirement, lambda done, what: None)  # noqa: ARG005
        assert result == again, f"{kind}: another result for the same requirement"
        assert all(0 <= done <= 1 for done in heard), f"{kind}: progress {heard} leaves 0 to 1"
        assert heard == sorted(heard), f"{kind}: progress goes backwards"
        assert errors(result.findings) == [], f"{kind} finds no design"
        designs = [one.params for one in result.candidates]
        assert designs, f"{kind} finds no design, and no error says so"
        for number, (design, candidate) in enumerate(zip(designs, result.candidates, strict=True)):
            assert isinstance(design, self.family.Params)
            assert design not in designs[:number], f"{kind}: a design is given twice"
            assert errors(self.family().check(design)) == [], f"{kind}: design {number + 1} cannot be built"
            assert limits_broken(requirement, candidate) == [], f"{kind}: {number + 1} breaks a limit"
        assert repeated(self.family(), result.candidates) == [], f"{kind}: designs are not distinct"

    # All designs

    def test_every_parameter_counts(self) -> None:
        """Every field of the parameters that has more than one value changes some result of some example."""
        starts = [Results(self.family(), self.params(table)) for table in self.examples]
        fields = self.family.Params.model_fields
        free = [name for name, field in fields.items() if not is_constant(field.annotation)]
        idle = [name for name in free if not self._counts(name, starts)]
        assert not idle, (
            f"no result depends on {', '.join(idle)}; where a step from the examples is too small to show, "
            "add an example or an entry of the attribute variations"
        )

    def _counts(self, name: str, starts: Sequence[Results]) -> bool:
        for start in starts:
            given = start.params.model_dump(mode="json", exclude_none=True)
            for value in (*self.variations.get(name, ()), *variations(start.params, name)):
                try:
                    changed = self.params({**given, name: value})
                except ValidationError:
                    continue
                # Validation may complete one field from another: the rest has to be as it was.
                if changed != start.params and start.difference(Results(self.family(), changed)):
                    return True
        return False

    def test_refused(self) -> None:
        """What must not build is refused by validation or by an error finding that names the parameter."""
        if not self.refused:
            pytest.skip("the attribute refused is empty")
        for table, parameter in self.refused:
            named = self._refusal(table)
            assert named, f"{dict(table)} builds"
            assert parameter in " ".join(named), f"{dict(table)} is refused for {named}, not for {parameter}"

    def _refusal(self, table: Mapping[str, Any]) -> list[str]:
        """What a refusal is about: parameters, or the words of a rule; empty for a design to be built."""
        try:
            params = self.params(table)
        except ValidationError as error:
            return [self._subject(detail) for detail in error.errors(include_url=False)]
        findings = self.family().check(params)
        _none(self._finding_faults(findings))
        return [finding.parameter for finding in errors(findings)]

    def _subject(self, detail: Mapping[str, Any]) -> str:
        """The field that a validation error is about, or its words where a rule ties several fields."""
        where = ".".join(map(str, detail["loc"]))
        words = str(detail["msg"])
        assert where or any(name in words for name in self.family.Params.model_fields), (
            f"a rule refuses without naming a parameter: {words!r}"
        )
        return where or words

    def test_random_designs_build_or_are_refused(self) -> None:
        """Any table inside the bounds is built or refused by name; nothing else is ever raised."""
        built = 0

        # Inside the method: hypothesis wants one test function for each class that inherits this one.
        @settings(
            max_examples=self.max_examples,
            deadline=None,
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
        )
        @given(self.strategy())
        def build_or_refuse(table: Mapping[str, Any]) -> None:
            nonlocal built
            refusal = self._refusal(table)
            event("refused" if refusal else "built")
            if refusal:
                self._fails_politely(table)
                return
            motion = self._motion(table)
            _none(rules.motion_faults(motion))
            parts = self._parts(table)
            assert len(parts) > 0
            for part in parts:
                _none(rules.outline_faults(part))
                _none(rules.feature_faults(part))
            built += 1

        build_or_refuse()
        assert built, "no random table is a design to be built; override strategy with a likelier one"

    def test_errors_of_later_stages_leave_the_motion(self) -> None:
        """A refused design whose errors are about parts or machining only has a motion all the same."""
        moving = [table for table, _ in self.refused if self._moves(table)]
        if not moving:
            pytest.skip("no table of the attribute refused has errors of later stages only")
        for table in moving:
            assert self._motion(table).samples == self.samples
            _none(rules.motion_faults(self._motion(table)))

    def _moves(self, table: Mapping[str, Any]) -> bool:
        """Whether a table has no error of the motion."""
        try:
            params = self.params(table)
        except ValidationError:
            return False
        return not errors(self.family().check(params), Stage.MOTION)

    def _fails_politely(self, table: Mapping[str, Any]) -> None:
        """A refused design may still be asked for its motion and parts: an answer or an expected error.

        One without an error of the motion has a motion.
        """
        try:
            params = self.params(table)
        except ValidationError:
            return
        if self._moves(table):
            _none(rules.motion_faults(self._motion(table)))
        for ask in (self.family().parts, lambda asked: self.family().solve(asked, 9)):
            try:
                ask(params)
            except MechwrightError as error:
                assert str(error).strip(), f"{type(error).__name__} without a message"  # noqa: PT017

    def _finding_faults(self, findings: Sequence[Finding]) -> list[str]:
        return [fault for finding in findings for fault in rules.finding_faults(finding, self.family.Params)]


def _none(faults: Sequence[str]) -> None:
    assert not faults, "; ".join(faults)

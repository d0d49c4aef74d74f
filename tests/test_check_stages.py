"""One judge: what ``check`` allows to a stage passes it, and what it has made is not made again."""

import json
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import mechwright as mw
import mechwright_cad.solid_models
import mechwright_cam.machining
from mechwright.contracts.finding import Finding, Findings, Severity, Stage, errors
from mechwright.contracts.refused import RefusedError
from mechwright.designs.design import Design, design_of
from mechwright.errors import GeometryError, PluginFaultError
from mechwright.pipeline import LOOK, PROGRAMS, SOLIDS, WORK, Build, Inspection, Page, Run, Work, work_to
from mechwright.plugins.host import Host, Registered, host
from mechwright.remedies import with_remedies
from mechwright.worker_pool.budget import limited_cores
from mechwright_cad.exporters import StepExporter
from mechwright_geneva.family import Geneva

Command = Callable[..., tuple[int, str, str]]
GENEVA: dict[str, Any] = {
    "family": "geneva",
    "parameters": {"law": "straight", "rollers": 1, "entry_radius": 40},
}


@pytest.fixture
def wheel() -> Iterator[mw.Mechanism]:
    """A small Geneva wheel; all is made in this process, so that what is made can be counted."""
    with limited_cores(1):
        yield mechanism()


def mechanism(installed: Host | None = None, **content: Any) -> mw.Mechanism:
    found = installed or host()
    return mw.Mechanism(design_of(GENEVA | content, Path("wheel.toml"), "", found), found)


def codes(findings: Findings) -> set[str]:
    return {one.code for one in errors(findings)}


class Looks(Inspection):
    """Finds what it is told to."""

    name = "looks"
    stage = Stage.ASSEMBLY

    def __init__(
        self, *found: Finding, stage: Stage = Stage.ASSEMBLY, needs: frozenset[str] = frozenset()
    ) -> None:
        self.found, self.asked = found, list[str]()
        self.stage, self.needs = stage, needs  # type: ignore[misc]

    def outlook(self, build: Build) -> tuple[Finding, ...]:
        self.asked.append("outlook")
        return ()

    def findings(self, build: Build) -> tuple[Finding, ...]:
        self.asked.append("findings")
        return self.found


class Among:
    """What is installed, with more inspections."""

    def __init__(self, *more: Inspection) -> None:
        self.more = more

    def __getattr__(self, name: str) -> Any:
        return getattr(host(), name)

    def all(self, contract: Any) -> list[Any]:
        return [*host().all(contract), *(self.more if contract is Inspection else ())]


@pytest.mark.parametrize(
    ("stage", "needs", "asked"),
    {
        "of the assembly": (Stage.ASSEMBLY, frozenset(), {None: 1, "motion": 0, "parts": 0, "assembly": 1, "output": 1}),
        "of solids": (Stage.ASSEMBLY, frozenset({SOLIDS}), {None: 0, "motion": 0, "assembly": 1, "output": 1}),
        "of programs": (Stage.MACHINING, frozenset({PROGRAMS}), {None: 0, "assembly": 0, "machining": 1}),
    }.values(),
)  # fmt: skip
def test_an_inspection_is_asked_by_the_runs_that_come_to_its_stage(
    wheel: mw.Mechanism, stage: Stage, needs: frozenset[str], asked: dict[str | None, int]
) -> None:
    for to, count in asked.items():
        look = Looks(stage=stage, needs=needs)
        mechanism(Among(look)).check(to=to)  # type: ignore[arg-type]
        assert look.asked.count("findings") == count, to
        assert look.asked.count("outlook") == (to is None and bool(needs)), to


def test_the_commands_end_at_the_stages_in_their_order() -> None:
    ends = [work.stage for work in WORK.values()]
    assert ends == sorted(ends, key=list(Stage).index)
    assert {name: work_to(work.stage)[0] for name, work in WORK.items()} == {name: name for name in WORK}
    assert work_to(Stage.MACHINING)[1].makes == {SOLIDS, PROGRAMS}
    assert (work_to(Stage.PARTS), LOOK.makes) == (("", work_to(Stage.PARTS)[1]), frozenset())


@pytest.mark.parametrize("stage", [Stage.PARTS, Stage.ASSEMBLY, Stage.MACHINING, Stage.OUTPUT])
@pytest.mark.parametrize("needs", [frozenset[str](), frozenset({SOLIDS})])
def test_what_check_refuses_is_refused_by_the_command_with_the_same_codes(
    wheel: mw.Mechanism, tmp_path: Path, stage: Stage, needs: frozenset[str]
) -> None:
    fault = Finding.error("looks.bad", "", "it is bad", stage=stage)
    other = Finding.error("looks.too", "", "so is this", stage=stage)
    for command, work in WORK.items():
        looks = Looks(fault, other, stage=stage, needs=needs)
        late = stage.is_after(work.stage)
        wanted = set() if late or not needs <= work_to(work.stage)[1].makes else {"looks.bad", "looks.too"}
        assert codes(mechanism(Among(looks)).check(to=work.stage)) == wanted  # type: ignore[arg-type]
        built = mechanism(Among(looks)).asked(command=command)  # type: ignore[arg-type]
        place = tmp_path / f"{command}-{stage}-{len(needs)}"
        if late or not needs <= work.makes:  # cam makes no solids: it asks for less than check --to machining
            built.write(place)
            continue
        with pytest.raises(RefusedError) as refused:
            built.write(place)
        assert codes(refused.value.findings) == wanted


def test_errors_of_what_is_asked_first_are_told_together_before_anything_is_made(wheel: mw.Mechanism) -> None:
    one = Looks(Finding.error("looks.one", "", "bad", stage=Stage.MACHINING), stage=Stage.MACHINING)
    dear = Looks(needs=frozenset({SOLIDS}))
    dear.name = "dear"  # type: ignore[misc]
    other = Looks(Finding.error("looks.other", "", "bad"))
    other.name = "other"  # type: ignore[misc]
    found = mechanism(Among(one, dear, other)).check(to="output")  # type: ignore[arg-type]
    assert codes(found) == {"looks.one", "looks.other"}
    assert dear.asked == ["outlook"]


def test_what_an_exporter_cannot_write_is_found_by_check_to_output(
    wheel: mw.Mechanism, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> bytes:
        raise GeometryError("part wheel: no such file")

    monkeypatch.setattr(StepExporter, "part", fails)
    assert wheel.check().errors == ()
    (said,) = wheel.check(to="output").errors
    assert (said.code, said.message, said.stage) == (
        "build.refused",
        "part wheel: no such file",
        Stage.OUTPUT,
    )
    with pytest.raises(GeometryError, match="no such file"):
        mechanism().write(tmp_path / "out")


@pytest.mark.parametrize("to", [None, "output"])
def test_a_build_after_a_check_makes_nothing_twice(
    wheel: mw.Mechanism, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, to: str | None
) -> None:
    calls = Counter[str]()

    def counted(owner: Any, name: str) -> None:
        known = getattr(owner, name)

        def call(*given: Any, **named: Any) -> Any:
            calls[name if named.get("solids") is None else f"{name} {named['solids']}"] += 1
            return known(*given, **named)

        monkeypatch.setattr(owner, name, call)

    for owner, name in (
        (Design, "check"),
        (Design, "parts"),
        (mechwright_cam.machining, "prepare"),
        (mechwright_cam.machining, "machine"),
        (mechwright_cad.solid_models, "collisions"),
        (mechwright_cad.solid_models.Work, "files"),
        (mechwright_cad.solid_models, "motion_page"),
        (Geneva, "as_made"),
    ):
        counted(owner, name)
    wheel.check(to=to)
    once = calls.copy()
    wheel.write(tmp_path / "out")
    programs = calls["machine"]
    assert programs > 1
    if to == "output":
        assert calls == once
    plates = {} if to else {"collisions False": 1}
    assert calls == {
        "check": 1, "parts": 1, "prepare": 1, "machine": programs, "files": 1, "as_made": 1,
        "collisions True": 1, "motion_page True": 1, **plates,
    }  # fmt: skip


def test_an_inspection_that_fails_is_named_with_its_plugin() -> None:
    class Fails(Looks):
        def findings(self, build: Build) -> tuple[Finding, ...]:
            raise ZeroDivisionError("by zero")

    look = Registered(Fails(), "acme-checks", "acme").item
    with pytest.raises(PluginFaultError, match=r"plugin acme of acme-checks: inspection looks: findings\(\)"):
        mechanism(Among(look)).check()  # type: ignore[arg-type]


def test_an_inspection_that_hangs_is_named_with_its_plugin(monkeypatch: pytest.MonkeyPatch) -> None:
    class Hangs(Looks):
        def findings(self, build: Build) -> tuple[Finding, ...]:
            while True:
                time.sleep(0.01)

    monkeypatch.setenv("MECHWRIGHT_PLUGIN_SECONDS", "5")
    look = Registered(Hangs(), "acme-checks", "acme").item
    with pytest.raises(PluginFaultError, match=r"plugin acme of acme-checks: inspection looks: findings\(\)"):
        mechanism(Among(look)).check()  # type: ignore[arg-type]


def test_an_inspection_of_the_earlier_contract_is_refused_by_name() -> None:
    class Old(Looks):
        commands = frozenset({"check"})

    assert "leave commands out" in Old.fault()
    assert Looks.fault() == ""


def run_of(*looks: Inspection, **content: Any) -> Run:
    run = Run(mechanism(Among(*looks), **content), LOOK)  # type: ignore[arg-type]
    run.look()
    return run


class Thick(Looks):
    """Wants plates of the wheel to be as thick as it says, by a proposal."""

    def __init__(self, name: str, thickness: float, severity: Severity = Severity.ERROR) -> None:
        super().__init__()
        self.name, self.thickness, self.severity = name, thickness, severity  # type: ignore[misc]

    def findings(self, build: Build) -> tuple[Finding, ...]:
        now = build.design.params.thickness  # type: ignore[attr-defined]
        if now == self.thickness:
            return ()
        code = f"thick.{self.name}"
        words = f"{now:g} mm thick, {self.thickness:g} is wanted"
        change = {"parameters.thickness": self.thickness}
        return (
            Finding(
                code,
                self.severity,
                "thickness",
                words,
                remedy="as it is",
                stage=self.stage,
                proposed=(change,),
            ),
        )


def test_two_inspections_that_contradict_each_other_are_both_named() -> None:
    """Neither thickness is right for both: no remedy is told that undoes another's."""
    first, second = with_remedies(run_of(Thick("one", 5.0), Thick("other", 6.0))).errors
    assert (first.code, first.fix) == ("thick.one", {"parameters.thickness": 5.0})
    assert (second.code, second.fix) == ("thick.other", None)
    assert "would undo what is done about thick.one" in second.remedy


def test_a_remedy_that_brings_another_error_says_what_stands_in_the_way() -> None:
    fits, wants = Thick("fits", 8.0), Thick("wants", 5.0)
    first = run_of(fits, wants, parameters=GENEVA["parameters"] | {"thickness": 8.0})
    (said,) = with_remedies(first).errors
    assert (said.code, said.fix) == ("thick.wants", None)
    assert said.remedy.startswith("as it is; set thickness = 5")
    assert "would lead to thick.fits: thickness: 5 mm thick, 8 is wanted" in said.remedy


def test_a_change_against_a_warning_brings_no_warning() -> None:
    fits, wants = Thick("fits", 8.0, Severity.WARNING), Thick("wants", 5.0, Severity.WARNING)
    found = with_remedies(run_of(fits, wants, parameters=GENEVA["parameters"] | {"thickness": 8.0}))
    (said,) = (one for one in found if one.code == "thick.wants")
    assert said.fix is None
    assert "would lead to thick.fits" in said.remedy


SAID = {
    (): "can be built, as judged without programs and solids; check --to output makes them",
    ("--to", "motion"): "can be built up to motion",
    ("--to", "assembly"): "can be built up to assembly",
    ("--to", "output"): "can be built",
}


@pytest.mark.parametrize("options", SAID, ids=" ".join)
def test_the_verdict_names_the_stage_and_what_was_not_made(
    command_line: Command, tmp_path: Path, options: tuple[str, ...]
) -> None:
    path = tmp_path / "wheel.toml"
    path.write_text(mechanism().toml)
    with limited_cores(1):
        assert command_line("check", path, *options)[:2] == (0, f"{path}: {SAID[options]}\n")


def test_figures_are_a_table_and_json_has_everything(command_line: Command, tmp_path: Path) -> None:
    path = tmp_path / "wheel.toml"
    path.write_text(mechanism().toml)
    told = command_line("check", path, "--figures")[1].splitlines()
    data = json.loads(command_line("check", path, "--json")[1])
    notes = [one for one in data["findings"] if one["severity"] == "note"]
    assert len(told) == len(notes) + 1 + len(data["processes"]) + 1  # with the head of that table
    for line, note in zip(told, notes, strict=False):
        assert line.startswith(note["code"])
        assert note["message"] in line
    assert (data["to"], data["unmade"]) == ("output", ["programs", "solids"])


def test_parts_that_cannot_be_made_are_one_finding(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Every inspection would fail of them; the key that the error names is that of the finding."""

    def fails(*_: object) -> list[Any]:
        raise GeometryError("wheel.toml: cam.mark: no free place on part wheel; leave mark out")

    monkeypatch.setattr(Design, "parts", fails)
    (said,) = mechanism().check().errors
    assert (said.code, said.parameter, said.stage) == ("build.refused", "cam.mark", Stage.PARTS)
    assert (said.message, said.remedy) == ("no free place on part wheel", "leave mark out")
    with pytest.raises(GeometryError, match="no free place"):
        mechanism().write(tmp_path / "out")
    assert mechanism().check(to="motion").errors == ()


def test_a_mark_without_a_place_is_told_by_check() -> None:
    pair = mw.design("elliptic-gears", cam={"mark": "LONG TEXT", "mark_height": 90})
    (said,) = pair.check().errors
    assert (said.code, said.parameter) == ("build.refused", "cam.part.gear.mark")


def test_names_of_files_are_asked_of_every_command() -> None:
    names = [[one.name for one in Run(mechanism(), work).inspections] for work in WORK.values()]
    assert all("file-names" in each for each in names)


def test_what_only_programs_need_refuses_no_earlier_stage(tmp_path: Path) -> None:
    """Names of programs are known where tools are; no stage before asks for them."""
    lacking = {"cam": {"tools": ["none-such"]}}
    for to in ("motion", "parts", "assembly"):
        assert mechanism(**lacking).check(to=to).errors == (), to
    (said,) = mechanism(**lacking).check(to="machining").errors
    assert (said.code, said.stage) == ("build.refused", Stage.MACHINING)
    mechanism(**lacking).asked(command="model").write(tmp_path / "model")


class Sheets(Page):
    """What a process that is no milling writes."""

    name = "sheets"
    commands = frozenset({"laser"})

    def files(self, build: Build) -> dict[str, str]:
        return {"sheet.txt": f"{len(build.parts)} parts\n"}


class WithSheets(Among):
    """What is installed, with the page of such a process."""

    def all(self, contract: Any) -> list[Any]:
        return [*super().all(contract), *([Sheets()] if contract is Page else [])]


@pytest.mark.parametrize(
    ("work", "refused"), [(Work(Stage.PARTS), False), (Work(Stage.ASSEMBLY), True), (None, True)]
)
def test_a_command_of_somebody_else_says_how_far_it_goes(
    tmp_path: Path, work: Work | None, *, refused: bool
) -> None:
    """One that does not say is judged by all that can be said before anything is made."""
    looks = Looks(Finding.error("looks.bad", "", "it is bad", stage=Stage.ASSEMBLY))
    laser = mechanism(WithSheets(looks)).asking(command="laser", work=work)  # type: ignore[arg-type]
    if refused:
        with pytest.raises(RefusedError, match="it is bad"):
            laser.write(tmp_path / "out")
    else:
        assert laser.write(tmp_path / "out").files == ("sheet.txt",)

"""Rules of the proof: all judgements are of one table, a third party's too, and none passes by failing."""

import re
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from by_control import LINUXCNC
from planning_parts import bore, job, plate
from shop import plate_job, plate_program

from mechwright import Build, Host, PluginError, ProofError, ToolError, Wanted, hookimpl
from mechwright.plugins.host import host
from mechwright_cam import plugin
from mechwright_cam.controls.reading import Run
from mechwright_cam.machining import Machining, machine
from mechwright_cam.proof import Check, Proof, Rule, Scene, prove
from mechwright_cam.proof.rules import BUILT_IN
from mechwright_cam.proof.simulation import simulate
from mechwright_cam.proof.walls import wall_deviation

ROOT = Path(__file__).parents[2]
TEXT = LINUXCNC.write(plate_program())
WHO = "rule own cannot judge the program of plate: plugin another of another-shop: rule own: check(): "


def with_rules(*classes: type[Rule]) -> Host:
    """A host with the rules that are built in, and those of another distribution."""
    module = ModuleType("another")
    module.mechwright_register = hookimpl(lambda: list(classes), specname="mechwright_register")
    found = Host()
    found.add(plugin, "mechwright", "cam")
    found.add(module, "another-shop", "another")
    return found


def rule(judge: Callable[[Scene], object]) -> type[Rule]:
    class Own(Rule):
        name = "own"

        def check(self, scene: Scene) -> Check:
            return judge(scene)  # type: ignore[return-value]

    return Own


def judged(*classes: type[Rule]) -> Proof:
    return prove(TEXT, plate_job(), LINUXCNC, with_rules(*classes).all(Rule))


def test_a_third_partys_rule_is_asked_after_the_built_in_ones_and_can_fail_a_program() -> None:
    own = rule(lambda scene: scene.bad(len(scene.run) - 1, "does not end as we want", 2.0, 1.0, "mm"))
    proof = judged(own)
    assert list(proof.checks) == [*(one.name for one in BUILT_IN), "own"]
    assert [check.name for check in proof.failures] == ["own"]
    assert proof.as_dict()["checks"]["own"]["message"].startswith("line ")
    with pytest.raises(ProofError, match=r"fails its proof \[own\]: line \d+: does not end as we want"):
        proof.require()
    passing = judged(rule(lambda _: Check(True, "as we want")))
    assert passing.ok
    assert passing.checks["own"] == Check(True, "as we want", name="own")
    assert {**passing.checks, "own": None} == {**judged().checks, "own": None}


def test_a_build_asks_the_rules_of_its_host() -> None:
    found = with_rules(rule(lambda scene: Check(False, f"{scene.job.part.name} is not for us")))
    for name, entries in host().registered.items():
        found.registered.setdefault(name, entries)
    machining = Machining(Build(ROOT / "examples" / "elliptic-pair.toml", found, Wanted("cam")))
    with pytest.raises(ProofError, match=r"\[own\]: gear is not for us"):
        _ = machining.proven_programs


def test_a_program_is_read_once_for_its_proof_and_its_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    read, runs = type(LINUXCNC).read, []

    def counted(*arguments: Any, **more: Any) -> Run:
        runs.append(read(*arguments, **more))
        return runs[-1]

    monkeypatch.setattr(type(LINUXCNC), "read", counted)
    one = machine(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LINUXCNC)
    assert simulate(one.scene.paths, one.job).works
    assert wall_deviation(one.scene.sweeps, one.job).points.size
    assert len(runs) == 1
    assert one.scene.run is runs[-1]


@pytest.mark.parametrize(
    ("judge", "said"),
    [
        (lambda _: 1 / 0, f"{WHO}ZeroDivisionError: division by zero (test_rules.py, line "),
        (lambda scene: scene.nothing, f"{WHO}AttributeError: "),
        (lambda _: sys.exit(0), f"{WHO}ends the program by sys.exit(0)"),
        (lambda _: (_ for _ in ()).throw(ToolError("blunt")), "cannot judge the program of plate: blunt"),
        (lambda _: (_ for _ in ()).throw(ValueError("two\nlines")), "ValueError: two lines"),
        (lambda _: None, f"{WHO}gives None; a Check is wanted"),
        (lambda _: True, f"{WHO}gives True; a Check is wanted"),
        (lambda _: Check("no", "it fails"), f"{WHO}passed of what it gives is 'no'; True or False is wanted"),
    ],
)
def test_a_rule_that_cannot_tell_is_a_fault_of_its_own_and_never_a_pass(
    judge: Callable[[Scene], object], said: str
) -> None:
    with pytest.raises(PluginError) as caught:
        judged(rule(judge))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_every_built_in_rule_is_there_and_documented() -> None:
    table = (ROOT / "docs" / "machining" / "checks.md").read_text(encoding="utf-8")
    rows = "".join(re.findall(r"^(\| `.*?\|)", table, re.MULTILINE))
    for one in BUILT_IN:
        assert f"`{one.name}`" in rows, one.name
        judge = getattr(import_module(f"mechwright_cam.proof.{one.home}"), one.name.replace("-", "_"))
        assert judge.__doc__
    assert [one.name for one in host().all(Rule)][: len(BUILT_IN)] == [one.name for one in BUILT_IN]


def test_a_name_that_is_built_in_is_not_given_away() -> None:
    class Gouge(Rule):
        name = "gouge"

        def check(self, scene: Scene) -> Check:
            return Check(True, "never mind")

    found = with_rules(Gouge)
    assert [broken.reason for broken in found.broken] == [
        "rule 'gouge' is already registered by cam of mechwright"
    ]
    hurt = TEXT.replace("Z-6.3", "Z-16.3")
    assert not prove(hurt, plate_job(), LINUXCNC, found.all(Rule)).ok


def test_the_example_of_the_page_on_plugins_runs() -> None:
    page = (ROOT / "docs" / "plugins" / "operation.md").read_text(encoding="utf-8")
    _, _, section = page.partition("## `Rule`: a judgement of the proof")
    (example,) = re.findall(r"^```python\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)[:1]
    module = ModuleType("shop_feed")
    exec(compile(example, "operation.md", "exec"), module.__dict__)  # noqa: S102 - the page is ours
    found = Host()
    found.add(module, "shop", "feed")
    assert not found.broken
    (shop,) = found.all(Rule)
    proof = prove(TEXT, plate_job(), LINUXCNC, [shop])
    assert not proof.ok
    assert re.match(r"line \d+: F\d+, our limit is F400; lower the feed", proof.checks["shop-feed"].message)
    slow = re.sub(r"F\d+", "F300", TEXT)
    assert prove(slow, plate_job(), LINUXCNC, [shop]).checks["shop-feed"].passed

"""Who cuts what is decided once, and everything else reads it."""

from collections import Counter
from pathlib import Path

import pytest
import shapely
from planning_parts import LIBRARY, bore, job, part, plate, rounded_box

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import DesignError
from mechwright.geometry import Loop
from mechwright.pipeline import Build
from mechwright.plugins.host import Host, Registered, host
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import Machining
from mechwright_cam.operations.contract import Operation, Task
from mechwright_cam.operations.recess import plan_view
from mechwright_cam.operations.steps import Steps
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.table import BUILT_IN, job_operations
from mechwright_cam.operations.twins import Twins
from mechwright_cam.planning import Assignments, choose_tools, plan
from mechwright_cam.planning.prepare import cut_outlines
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def counted(monkeypatch):
    """How often each feature of each part has been claimed, and the cutters of each part chosen."""
    claims, choices = Counter(), Counter()

    def watch(operation, method):
        real = getattr(operation, method)

        def claim(self, feature, of, *more):
            task = real(self, feature, of, *more)
            claims[of.part.name, feature.name] += task is not None
            return task

        monkeypatch.setattr(operation, method, claim)

    for operation in {type(one) for one in BUILT_IN}:
        for method in ("claim", "claim_copy"):
            if method in vars(operation):
                watch(operation, method)

    def choose(of, *more):
        choices[of.name] += 1
        return choose_tools(of, *more)

    monkeypatch.setattr("mechwright_cam.planning.remarks.choose_tools", choose)
    return claims, choices


@pytest.mark.parametrize("name", ["geneva-cycloidal", "elliptic-pair"])
def test_every_feature_is_claimed_once_and_the_cutters_of_a_part_are_chosen_once(counted, name):
    claims, choices = counted
    build = Build(EXAMPLES / f"{name}.toml", host())
    design = build.design
    assert build.made(Machining).proven_programs
    parts = [one for one in design.family.parts(design.params) if one.outline is not None]
    assert set(claims) == {(one.name, feature.name) for one in parts for feature in one.features}
    assert set(claims.values()) == {1}
    assert choices == {one.name: 1 for one in parts}


def test_tasks_stay_with_a_job_that_is_only_changed():
    of, memory = job(plate(bore(12)), "mill-6"), Assignments()
    tasks = memory.of(of).every()
    assert memory.of(of).tasks is tasks
    assert memory.of(memory.carry(of, make_job(of.part, of.settings, of.tools))).tasks is tasks


def test_every_built_in_operation_has_a_name_of_its_own():
    names = [operation.name for operation in BUILT_IN]
    assert len({*names}) == len(names)
    assert job_operations(()) == BUILT_IN
    assert [one.name for one in job_operations(("clear", "face", "clear"))][:3] == ["clear", "face", "ream"]


class Plunge(Operation):
    """Plunges a mill as wide as the hole."""

    name = "plunge"

    def claim(self, feature, job):
        if not isinstance(feature, Bore):
            return None
        fit = [mill for mill in job.end_mills if abs(mill.diameter - feature.diameter) < 0.005]
        return (
            Task(feature, self, tuple(fit[:1]), -feature.top, job.floor, plan_view(feature)) if fit else None
        )

    def cut(self, task, stock, steps):
        def write(pen):
            pen.above(task.feature.centre)
            pen.sink(task.bottom, pen.rates.plunge)
            pen.retract()

        steps.add(f"{task.feature.name}: plunge", task.tools[0], write)
        return stock.without(task.region)


def program_of(of, *more):
    return LinuxCnc().write(plan(of, Assignments(more)))


def test_an_operation_of_another_is_asked_only_by_its_name():
    of = job(plate(bore(6)), "mill-6", "mill-4")
    assert program_of(of, Plunge()) == program_of(of)
    named = job(plate(bore(6)), "mill-6", "mill-4", operations=["plunge"])
    assert "bore-1: plunge" in program_of(named, Plunge())
    with pytest.raises(
        DesignError, match=r"cam\.operations: no operation is named 'plunge'; there is: adaptive, bore"
    ):
        program_of(named)


POCKET = Pocket("pocket", rounded_box(24, 14, 4), (), 0.0, 2.5)
OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)


@pytest.mark.parametrize("clearing", ["contour", "adaptive"])
def test_stock_is_a_value_and_cuts_leave_no_more_than_the_allowance(clearing):
    of = job(plate(bore(12, (20, 10)), machined=(POCKET, OUTSIDE)), "mill-6", "mill-4", clearing=clearing)
    steps = Steps(of, 5.0)
    for task in Assignments().of(of).every():
        before = Stock(task.region)
        after = task.operation.cut(task, before, steps)
        assert before.left is task.region
        assert not before.begun
        beside = shapely.union_all(
            [tab.shape.buffer(8.0) for tab in of.tabs]
        )  # corners that stay with the frame
        thick = shapely.buffer(after.left.difference(beside), -(of.settings.stock_to_leave / 2 + 0.05))
        assert thick.is_empty, task.feature.name
    assert len(steps.cuts) > 4


def test_what_is_left_of_the_part_follows_from_its_tasks():
    of = job(plate(bore(12)), "mill-6")
    (left,) = cut_outlines(of)
    finest = min(tool.radius for task in Assignments().of(of).every() for tool in task.tools)
    assert finest == 3.0
    assert left.area == pytest.approx(of.target.area, rel=1e-3)


def slots(count, *extra):
    """A round plate with as many equal slots, and more features."""
    turned = [
        Loop.polygon([(12, -4), (24, -4), (24, 4), (12, 4)]).moved(0, 0, 6.2831853 * i / count)
        for i in range(count)
    ]
    features = [Pocket(f"slot-{i}", loop, (), 0.0, 3.0) for i, loop in enumerate(turned)]
    return part(bore(60).reversed(), machined=(*features, *extra))


def test_turned_copies_have_one_first():
    of = job(slots(4), "mill-6", "mill-4")
    twins = Twins(of)
    firsts = [twins.first(feature) for feature in of.features]
    assert firsts[0] is None
    assert [one.name for one in firsts[1:]] == ["slot-0"] * 3


def test_a_neighbour_makes_another_of_a_copy():
    beside = Pocket("beside", Loop.polygon([(-20, 5), (-16, 5), (-16, 9), (-20, 9)]), (), 0.0, 3.0)
    of = job(slots(4, beside), "mill-6", "mill-4")
    twins = Twins(of)
    firsts = {feature.name: twins.first(feature) for feature in of.features}
    assert firsts["slot-2"] is None
    assert firsts["beside"] is None


def test_copies_are_given_what_each_would_get_alone():
    of = job(slots(3), "mill-6", "mill-4", "mill-2")
    tasks = Assignments().of(of).every()
    alone = [
        operation.claim(f, of) for f in of.features for operation in BUILT_IN if operation.name == "clear"
    ]
    assert [task.tools for task in tasks] == [task.tools for task in alone]
    assert all(a.region.equals(b.region) for a, b in zip(tasks, alone, strict=True))


def test_the_choice_of_cutters_takes_the_same_for_all_copies():
    wanted = CamSettings()
    one, four = (choose_tools(slots(count), wanted, LIBRARY) for count in (1, 4))
    assert {tool.name for tool in one} == {tool.name for tool in four}


def test_a_design_gets_the_operations_of_others_through_the_pipeline(tmp_path):
    text = (EXAMPLES / "elliptic-pair.toml").read_text(encoding="utf-8")
    file = tmp_path / "pair.toml"
    file.write_text(text.replace("[cam]\n", '[cam]\noperations = ["plunge"]\n', 1), encoding="utf-8")
    (found,) = {finding.message for finding in Build(file, host()).made(Machining).findings}
    assert found.startswith("no operation is named 'plunge'; there is: ")
    more = Host({**host().registered, Operation: {"plunge": Registered(Plunge(), "here", "plunge")}})
    assert not errors(Build(file, more).made(Machining).findings)

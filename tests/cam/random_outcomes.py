"""Random parts, machined and proven."""

from dataclasses import dataclass, replace

import numpy as np
from by_control import CONTROLS, prove
from random_parts import CUTTERS, OPERATIONS, Drawn, cutters

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore
from mechwright.errors import MechwrightError
from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.exactness import posted
from mechwright_cam.machining import Machined, second_setup
from mechwright_cam.planning import plan
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.proof import Proof
from mechwright_cam.proof.judge import judge
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind
from mechwright_cam.slowed import slowed


@dataclass(frozen=True)
class Outcome:
    """What became of a random part: programs with their proofs, or why planning refuses it."""

    drawn: Drawn
    control: str
    refusal: str = ""
    made: tuple[Machined, ...] = ()

    @property
    def failures(self) -> list[str]:
        return [check.message for one in self.made for check in one.proof.failures]


def run(operation: str, seed: int, **changes: object) -> Outcome:
    """One random part with random cutters, settings and control; changes go into its settings."""
    rng = np.random.default_rng(seed)
    drawn = OPERATIONS[operation](rng)
    control = str(rng.choice(CONTROLS))
    wanted = {
        "control": control,
        "tools": cutters(rng, drawn),
        "climb": bool(rng.integers(2)),
        "origin": str(rng.choice(["axis", "corner", "centre"])),
        "stock_to_leave": float(rng.choice([0.0, 0.1, 0.2, 0.5])),
        "spring_passes": int(rng.integers(0, 3)),
        "ramp_angle": float(rng.choice([1.0, 3.0, 10.0])),
        "hold": {"tabs": int(rng.integers(2, 5)), "tab_height": float(rng.choice([0.5, 1.0]))},
        **drawn.settings,
        **changes,
    }
    post = host().get(Control, control)
    made: list[Machined] = []
    try:
        cam = CamSettings.model_validate(wanted)
        jobs, found = lay_out_setups(drawn.part, cam, CUTTERS)
        if errors(found):
            return Outcome(drawn, control, str(errors(found)[0]))
        for job in jobs:
            laid = job if job.side == "top" else second_setup(made[-1], job)
            program, files, scene = posted(plan(laid), laid, post)
            while gentler := slowed(program, scene):
                program, files, scene = posted(gentler, laid, post)
            made.append(Machined(laid, program, files, judge(scene), scene))
    except MechwrightError as error:
        return Outcome(drawn, control, str(error))
    return Outcome(drawn, control, made=tuple(made))


def without(outcome: Outcome, place: int, name: str) -> Proof | None:
    """The proof of a program that lacks all operations on the feature or detail ``name``; None if it has none."""
    one = outcome.made[place]
    sections = []
    for section in one.program.sections:
        kept = tuple(o for o in section.operations if o.name.split(":")[0].split(" below")[0] != name)
        if kept:
            sections.append(replace(section, operations=kept))
    if tuple(sections) == one.program.sections:
        return None
    if not sections:
        return None
    post = host().get(Control, outcome.control)
    return prove(post.write(replace(one.program, sections=tuple(sections))), one.job, post)


def named(job: Job, tools: tuple[Tool, ...]) -> set[str]:
    """Names of the features and details that operations of their own have to cut: holes to size have none."""
    drills = {tool.diameter for tool in tools if tool.kind is ToolKind.DRILL}
    names = {detail.name for detail in job.details}
    for feature in job.features:
        drilled = isinstance(feature, Bore) and any(abs(feature.diameter - d) <= 0.005 for d in drills)
        if not drilled:
            names.add(feature.name)
    return names

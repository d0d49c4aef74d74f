"""From program text to proof: every rule is asked, and what they found goes into the report."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import count

import numpy as np

from mechwright.contracts.guard import is_foreign
from mechwright.contracts.plugin import who_of
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.errors import ProgramError
from mechwright.worker_pool.budget import threaded_map
from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading import Kind
from mechwright_cam.proof.found_tabs import with_found_tabs
from mechwright_cam.proof.holding import remarks
from mechwright_cam.proof.report import Check, Proof, Spot
from mechwright_cam.proof.rules import BUILT_IN, Rule, ask
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.several import combined_times
from mechwright_cam.proof.timing import operations, step_times
from mechwright_cam.proof.unreachable_stock import SPOTS
from mechwright_cam.setup.job import Job

SWITCHED = re.compile(r"^[^\S\n]*(?:\d+[^\S\n]*)?/", re.MULTILINE)
"""A line that a switch at the machine skips, or a block behind its number."""
RULES = tuple(rule() for rule in BUILT_IN)
"""What is asked unless a host knows more."""


def prove(text: str | Mapping[str, str], job: Job, control: Control, rules: Sequence[Rule] = RULES) -> Proof:
    """Simulate a program against the part it should make: :func:`judge` with the scene of its parameters."""
    return judge(Scene(text, job, control), rules)


def judge(scene: Scene, rules: Sequence[Rule] = RULES, progress: Progress = unheard) -> Proof:
    """Ask all rules about a program, with the switch for optional lines off, and on if there are such lines.

    ``progress`` is told how far the first of these is, by several threads.

    Returns
    -------
    proof
        All checks, in the order of the rules; :meth:`Proof.require` raises if one failed.

    Raises
    ------
    ProgramError
        The text cannot be read; the message names the line.
    PluginError
        A rule cannot tell; the message names the rule.
    """
    proof, text = _at_all(scene, rules, progress), scene.text
    if not proof.ok or not any(map(SWITCHED.search, [text] if isinstance(text, str) else text.values())):
        return proof
    words = "with lines that start with / skipped, "
    try:
        other = _at_all(replace(scene, block_delete=True), rules)
    except ProgramError as error:
        raise ProgramError(words + str(error)) from error
    if other.ok:
        return proof
    checks = {
        name: check if check.passed else replace(check, message=words + check.message)
        for name, check in other.checks.items()
    }
    return replace(other, checks=checks)


READ, SIMULATED = 0.05, 0.4
"""Parts of a proof that are done when the program is read, and when its cuts are simulated: as measured."""


def _at_all(scene: Scene, rules: Sequence[Rule], progress: Progress = unheard) -> Proof:
    """What the rules say of one run at all work offsets of the job: what one of them finds is found."""
    first = _judged(scene, rules, progress)
    more = scene.job.settings.more_offsets
    if not more or not first.ok:
        return first
    proofs = [first]
    for offset in more:
        proofs.append(_judged(scene.at(offset), rules))
        if not proofs[-1].ok:
            said = f"at {scene.control.offset_words(offset)}, "
            checks = {
                name: check if check.passed else replace(check, message=said + check.message)
                for name, check in proofs[-1].checks.items()
            }
            return replace(proofs[-1], checks=checks)
    changes = int(np.count_nonzero(scene.run.kind == Kind.TOOL)) * scene.job.settings.machine.tool_change
    times = [proof.operations for proof in proofs]
    return replace(
        first,
        gouge_max_mm=max(proof.gouge_max_mm for proof in proofs),
        leftover_reachable_max_mm=max(proof.leftover_reachable_max_mm for proof in proofs),
        # Each of them counts the changes of tools, which are made once.
        time_estimate_s=sum(proof.time_estimate_s for proof in proofs) - changes * len(more),
        cutting_length_mm=sum(proof.cutting_length_mm for proof in proofs),
        operations=combined_times(times),
        notes=tuple(dict.fromkeys(note for proof in proofs for note in proof.notes)),
    )


def _judged(scene: Scene, rules: Sequence[Rule], progress: Progress = unheard) -> Proof:
    """What the rules say of one run."""
    # Before any rule: that a text cannot be read is no fault of theirs, and they share stock and sweeps.
    progress(0.0, "reading the program")
    scene = with_found_tabs(scene)
    run = scene.run
    progress(READ, "simulating its cuts")
    _ = scene.stock, scene.sweeps, scene.simulation, scene.pieces
    asked = count()

    def answer(rule: Rule) -> Check:
        progress(SIMULATED + (1 - SIMULATED) * next(asked) / len(rules), "asking the rules")
        return ask(rule, scene=scene)

    ours = [rule for rule in rules if not is_foreign(who_of(rule))]
    known = dict(zip(ours, threaded_map(answer, ours), strict=True))  # none depends on another
    # Those of others in this thread, in which the guard has an alarm, and keeps the ground.
    checks = [known.get(rule) or answer(rule) for rule in rules]
    seconds, left = step_times(run, scene.job.settings.machine, scene.motion), scene.remains
    area, deepest = sum(spot[4] for spot in left.beyond), max((spot[3] for spot in left.beyond), default=0.0)
    notes = [*remarks(scene), *(check.message for check in checks if check.told)]
    if left.beyond:
        where = f"in {len(left.beyond)} place(s), up to {deepest:.3f} mm, {area:.3f} mm² in all"
        notes.insert(0, f"stock that no cutter of the program reaches: {where}")
    return Proof(
        part=scene.job.part.name,
        checks={check.name: check for check in checks},
        gouge_max_mm=max((cut.depth for cut in (scene.gouge, scene.in_tab) if cut), default=0.0),
        leftover_reachable_max_mm=left.reachable,
        unreachable_area_mm2=area,
        unreachable_max_mm=deepest,
        unreachable=tuple(Spot(*spot) for spot in left.beyond[:SPOTS]),
        rapids_in_stock=len(scene.stock.rapids),
        time_estimate_s=float(seconds.sum()),
        cutting_length_mm=float(np.nansum(run.length[run.cutting])),
        operations=operations(run, seconds),
        notes=tuple(notes),
    )

"""A job planned, posted for LinuxCNC, proven, and looked at by the crude simulation of the planning tests."""

from by_control import posted, prove
from planning_simulation import check_rules, gouge

from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Program
from mechwright_cam.proof import Proof
from mechwright_cam.setup.job import Job


def proven(of: Job) -> tuple[Program, str, Proof]:
    """The program of a job, its text and its proof, none of which has anything to complain of."""
    program = plan(of)
    text = posted(of, program)
    proof = prove(text, of)
    assert proof.ok, [check.message for check in proof.failures]
    assert gouge(of, program) <= 0.005
    check_rules(of, program)
    return program, text, proof

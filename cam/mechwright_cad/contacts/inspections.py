"""What speaks against the joints of an assembly."""

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.pipeline import Build, Inspection
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    from mechwright_cad.bodies import Body
    from mechwright_cad.contacts.screw_joints import ScrewJoint
    from mechwright_cad.contacts.touching import Gap


class ScrewLengths(Inspection):
    """Screws that bottom out in a blind thread, engage too little of one, or are in none."""

    name = "screw-lengths"
    stage = Stage.ASSEMBLY
    order = 12
    doing = "screw engagement"

    def findings(self, build: Build) -> Sequence[Finding]:
        """An error for each length of screw that is wrong in a kind of part."""
        from mechwright_cad.bodies import bodies_of
        from mechwright_cad.contacts.screw_joints import joints_of, screw_of

        if not any(screw_of(part) for part in build.parts):
            return ()
        bodies = bodies_of(build.parts, build.design.solve(2))
        return at_stage(self.stage, screw_findings(bodies, joints_of(bodies, 0)))


def screw_findings(bodies: "Sequence[Body]", joints: "Sequence[ScrewJoint]") -> "Iterator[Finding]":
    """One for each pair of parts, of the screw that is worst."""
    from mechwright_cad.contacts.screw_joints import screw_of

    told: set[tuple[str, str]] = set()
    for joint in sorted(joints, key=lambda one: min(one.spare, one.engaged - one.least)):
        screw, holder = bodies[joint.screw].part, bodies[joint.holder].part
        if (screw.name, holder.name) in told:
            continue
        found = _fault(joint, screw.name, holder.name)
        if found is not None:
            told.add((screw.name, holder.name))
            yield found
    inside = {joint.screw for joint in joints}
    loose = [body for k, body in enumerate(bodies) if screw_of(body.part) is not None and k not in inside]
    for name in dict.fromkeys(body.part.name for body in loose):
        first = next(body for body in loose if body.part.name == name)
        yield Finding.error(
            "screw.thread",
            "",
            f"{first.name}: the screw {name} is in no thread of its size",
            remedy="put a threaded hole in its axis, or take a longer screw",
        )


def _fault(joint: "ScrewJoint", screw: str, holder: str) -> Finding | None:
    what = f"{screw} in {holder}"
    size, length, deep = joint.what.of.size, joint.what.length, joint.engaged + max(-joint.spare, 0.0)
    if joint.spare < -TOLERANCES.closure:
        return Finding.error(
            "screw.bottoms",
            "",
            f"{what}: the screw goes {deep:.4g} mm into a thread that takes {joint.hole.depth:.4g} mm, and "
            "meets its bottom before the head clamps",
            deep,
            joint.hole.depth,
            "mm",
            f"take a screw {-joint.spare:.3g} mm shorter than {length:g} mm, a thicker plate, or a washer",
        )
    if joint.engaged < joint.least - TOLERANCES.closure:
        short = joint.least - joint.engaged
        return Finding.error(
            "screw.engagement",
            "",
            f"{what}: the screw engages {joint.engaged:.4g} mm of thread, and M{size:g} needs "
            f"{joint.least:.4g} mm",
            joint.engaged,
            joint.least,
            "mm",
            f"take a screw {short:.3g} mm longer than {length:g} mm, or a thinner plate",
        )
    return None


class Contact(Inspection):
    """Bodies of a machine or a chain that touch nothing, and gaps that no part declares."""

    name = "contact"
    stage = Stage.ASSEMBLY
    order = 14
    doing = "contacts"

    def findings(self, build: Build) -> Sequence[Finding]:
        """Nothing of a mechanism alone, whose shafts and frame are somebody else's."""
        from mechwright.machine.made import settings_of
        from mechwright.mechanics.chain import Chain

        if settings_of(build).frame == "none" and not isinstance(build.design.family, Chain):
            return ()
        from mechwright_cad.bodies import bodies_of
        from mechwright_cad.contacts.engaged import disengaged
        from mechwright_cad.contacts.screw_joints import joints_of
        from mechwright_cad.contacts.touching import Touching
        from mechwright_cad.contacts.vacant import vacancies

        motion = build.design.solve(2)
        bodies = bodies_of(build.parts, motion)
        if len(bodies) < 2:
            return ()
        touching, joints = Touching(bodies, motion, 0), joints_of(bodies, 0)
        found = [*touching.gaps(joints), *vacancies(touching, joints), *disengaged(touching)]
        return at_stage(self.stage, gap_findings(found))


_DISTANCES = {
    "floating": (
        "{one} touches no other body: the nearest, {two}, is {gap:.3f} mm away",
        "make it touch what carries it",
    ),
    "end": ("{one} stands {gap:.3f} mm out of {two}, in which it ends", "let both end at one height"),
    "seat": (
        "{two} leaves {gap:.3f} mm of its hole in {one} empty",
        "make both as long, or move them together",
    ),
    "column": (
        "{one} and {two} turn as one on one pin, with a gap of {gap:.3f} mm between them",
        "put a spacer of that length between them",
    ),
    "screw": (
        "{one} clamps {two} over a gap of {gap:.3f} mm",
        "close the gap, or put a spacer of that length in it",
    ),
    "driving": (
        "{one} and {two} drive each other, and {gap:.3f} mm of the thinner one faces nothing",
        "move both to one height",
    ),
}
"""Kind of a gap, where it is a distance, to what is wrong and what is done about it."""

_VACANCIES = {
    "empty": (
        "a bore of {one}, {gap:.3f} mm long, has no pin",
        "put in its pin, or declare the bore as vacant in its part",
    ),
    "thread": (
        "a thread of {one}, {gap:.3f} mm deep, has no screw",
        "put in its screw, or leave the thread out",
    ),
    "groove": (
        "a groove of {one}, {gap:.3f} mm wide, has no circlip",
        "put in its circlip, or leave the groove out",
    ),
    "missing": (
        "{one} has no plate, and {two}, {gap:.3f} mm thick, drives it or is driven by it",
        "add the plate to the parts",
    ),
    "motor": ("the shaft of {one} is in no coupling", "put a coupling on it"),
}
"""Kind of a place without its part to the same."""


def gap_findings(gaps: "Iterable[Gap]") -> Iterator[Finding]:
    """An error for each."""
    from mechwright.mechanics.mating.rounds import CONTACT

    for one in gaps:
        code, limit = f"contact.{one.kind}", CONTACT + one.play
        names = {"one": one.body, "two": one.other, "gap": one.gap}
        if one.kind in _VACANCIES:
            said, done = _VACANCIES[one.kind]
            yield Finding.error(code, "", said.format(**names), remedy=done)
            continue
        said, done = _DISTANCES[one.kind]
        yield Finding.error(
            code,
            "",
            f"{said.format(**names)}; up to {limit:.3g} mm count as contact",
            float(one.gap),
            limit,
            "mm",
            f"{done}, or declare the clearance as the play of its part",
        )

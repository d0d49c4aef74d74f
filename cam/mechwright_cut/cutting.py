"""Sheets, programs and proofs of a build: the one place where planning and proof meet."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.part import Part, name_from
from mechwright.errors import DesignError, GeometryError, ProofError
from mechwright.pipeline import Build
from mechwright.pipeline.process import plates_by, process_of
from mechwright_cut.cuts import Contour, WireContour
from mechwright_cut.jobs import CutJob, CutPart, cut_part
from mechwright_cut.nest import nested
from mechwright_cut.paths.common_lines import UNSHARED
from mechwright_cut.paths.order import contours
from mechwright_cut.paths.wire import wire_contours
from mechwright_cut.programs.grbl_laser import grbl_laser
from mechwright_cut.programs.iso_wire import iso_wire
from mechwright_cut.programs.linuxcnc_beam import linuxcnc_beam
from mechwright_cut.proof.judge import CutProof, Question, TargetPiece, prove
from mechwright_cut.proof.wire_judge import WireQuestion, prove_wire
from mechwright_cut.rows import SHORTEST
from mechwright_cut.rules.part_rules import loses, part_findings, refused
from mechwright_cut.rules.service_rules import service_findings
from mechwright_cut.rules.unused_keys import unused_keys
from mechwright_cut.settings.cut_settings import NAMES, SERVICE, WIRE, CutSettings
from mechwright_cut.settings.cut_table import cut_settings
from mechwright_cut.settings.figures import Kerf, Process, kerf_of, refusal
from mechwright_cut.settings.services import services

WRITERS = {"grbl-laser": grbl_laser, "linuxcnc-beam": linuxcnc_beam}
"""Control of a beam to what writes its programs."""
SUFFIXES = {"grbl-laser": ".nc", "linuxcnc-beam": ".ngc", "iso-wire": ".iso"}
"""Control to how its files end."""
Ways = Sequence[Contour] | Sequence[WireContour]


@dataclass(frozen=True)
class ProvenCut:
    """A program and its proof."""

    job: CutJob
    contours: Ways
    text: str
    suffix: str
    proof: CutProof

    @property
    def name(self) -> str:
        """That of its sheet."""
        return self.job.name

    @property
    def files(self) -> Mapping[str, str]:
        """The one file."""
        return {self.name: self.text}


def question(job: CutJob, control: str) -> Question:
    """What the proof has to know of a sheet: parts, kerf and powers, and nothing of how it is cut."""
    settings, plasma = job.settings, job.process.name == "plasma"
    why = refusal(job.process.name, job.material)
    lifted = why is not None and why.unless and getattr(settings, why.unless)
    joints = settings.joints if job.process.joints else 0
    pieces = tuple(
        TargetPiece(
            piece.label,
            piece.outline,
            tuple(tuple(stroke) for stroke in piece.strokes) if job.process.engraves else (),
            joints,
        )
        for piece in job.pieces
    )
    return Question(
        control=control,
        kerf=job.kerf.width,
        sheet=job.size,
        pieces=pieces,
        through=1.0 if plasma else settings.cutting[0],
        mark=0.0 if plasma else settings.marking[0],
        full=float(settings.full_power),
        passes=settings.passes,
        joint_width=settings.joint_width,
        taper=job.process.taper,
        refused="" if why is None or lifted else why.why,
        common=bool(job.common),
    )


def wire_question(job: CutJob) -> WireQuestion:
    """What the proof of a wire has to know of a sheet."""
    why = refusal(job.process.name, job.material)
    return WireQuestion(
        registers=job.settings.registers(job.kerf.width),
        start_hole=job.settings.start_hole,
        sheet=job.size,
        pieces=tuple(TargetPiece(piece.label, piece.outline) for piece in job.pieces),
        refused="" if why is None else why.why,
    )


def control_of(job: CutJob) -> str:
    """The control of a sheet: that of the process, or the one that is named for beams."""
    usual = job.process.control
    return usual if usual == "iso-wire" else job.settings.control or usual


def written(job: CutJob, ways: Ways, control: str) -> tuple[str, CutProof]:
    """A program and its proof."""
    if control == "iso-wire":
        text = iso_wire(job, [way for way in ways if isinstance(way, WireContour)])
        return text, prove_wire(text, wire_question(job))
    text = WRITERS[control](job, [way for way in ways if isinstance(way, Contour)])
    return text, prove(text, question(job, control))


class Cutting:
    """What is cut of a build."""

    def __init__(self, build: Build) -> None:
        self._build = build
        self.settings: CutSettings = cut_settings(build.design)

    @cached_property
    def plates(self) -> dict[str, list[Part]]:
        """Process to the plates that are cut by it."""
        found = {name: plates_by(self._build.design, self._build.parts, name) for name in NAMES}
        return {name: parts for name, parts in found.items() if parts}

    def kerf(self, process: Process, part: Part, *, chosen: bool = True) -> Kerf | None:
        """The kerf in a part's material: that of the design, a measured one, or a built-in one.

        That of the design is of the process which it has ``chosen``.
        """
        if self.settings.kerf is not None and chosen:
            return Kerf(self.settings.kerf, 0.0, "cut.kerf", measured=True)
        return kerf_of(process.name, part.material, part.thickness, self.settings.kerfs)

    def _may(self, name: str, process: Process, part: Part) -> bool:
        """Whether a part can be cut at all; else the choice of its process is told."""
        return refused(part, process, self.settings, service=name == SERVICE) is None

    @cached_property
    def cut_parts(self) -> list[tuple[str, Process, Kerf, CutPart]]:
        """Each part that its process can make: the name of that, its figures, the kerf, and the part."""
        found = []
        for name, parts in self.plates.items():
            for part in parts:
                process, kerf = self._by(name, part)
                if kerf is not None and self._may(name, process, part):
                    found.append((name, process, kerf, self._cut_part(name, process, part)))
        return found

    def _by(self, name: str, part: Part) -> tuple[Process, Kerf | None]:
        process = self.settings.kind(name, part.material)
        return process, self.kerf(process, part, chosen=process_of(self._build.design, part.name) == name)

    def _cut_part(self, name: str, process: Process, part: Part) -> CutPart:
        marks = services()[self.settings.service].engraves if name == SERVICE else process.engraves
        return cut_part(part, process, self.settings, marks=marks)

    def rules_of(self, name: str, part: Part) -> list[Finding]:
        """What the rules find of a plate by a process that does not refuse it, chosen or not."""
        process, kerf = self._by(name, part)
        if kerf is None:
            return [_no_kerf(process, part)]
        return [*self._told(name, self._cut_part(name, process, part), process, kerf)]

    def _told(self, name: str, cut: CutPart, process: Process, kerf: Kerf) -> Iterator[Finding]:
        for one in part_findings(cut, process, kerf.width, self.settings):
            # Who sends a drawing away measures no kerf, and chooses no beam.
            drawn = name == SERVICE and one.code == "cut.path"
            yield replace(one, remedy=one.remedy.partition(", or ")[0]) if drawn else one
        if name == SERVICE:
            jet = process.name == "waterjet"
            yield from service_findings(cut, services()[self.settings.service], jet)

    def losses_of(self, name: str, part: Part) -> list[str]:
        """What a plate has less of than as drawn by a process, in a few words each."""
        process, kerf = self._by(name, part)
        width = 0.0 if kerf is None else kerf.width
        return [*loses(self._cut_part(name, process, part), process, width)]

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What speaks against it; what a process cannot make at all is told of the choice of processes."""
        return tuple(self._findings())

    def _findings(self) -> Iterator[Finding]:
        yield from unused_keys(self._build.design.content.get("cut", ()), self.plates)
        for name, parts in self.plates.items():
            kinds = {one.name: one for one in (self.settings.kind(name, part.material) for part in parts)}
            for process in kinds.values():
                yield from _wrong_settings(self.settings, name, process)
            for part in parts:
                process, kerf = self._by(name, part)
                if kerf is None and self._may(name, process, part):
                    yield _no_kerf(process, part)
        found = [
            one for name, process, kerf, cut in self.cut_parts for one in self._told(name, cut, process, kerf)
        ]
        yield from found
        # A contour that cannot be cut is told by the rules of its part, where they find why.
        told = {one.code for one in found} & {"cut.path", "cut.start-hole"}
        yield from (one for one in self._planned[1] if one.code != "cut.path" or not told)
        jobs = [job for job, _ in self._planned[0] if not job.process.no_common]
        alone = jobs and not self.settings.joints and not any(job.common for job in jobs)
        if self.settings.common_lines and alone:
            yield Finding.warning(
                "cut.common-lines",
                "cut.common_lines",
                f"no two parts share an edge: it has to be straight, outermost and at least {SHORTEST:g} mm "
                "long, the shorter at least half the longer, and the row has to go on the sheet",
                remedy=UNSHARED,
                stage=Stage.MACHINING,
            )

    @cached_property
    def _planned(self) -> tuple[list[tuple[CutJob, Ways]], list[Finding]]:
        groups: dict[tuple[str, str, float], list[tuple[Process, Kerf, CutPart]]] = {}
        for name, process, kerf, cut in self.cut_parts:
            if name != SERVICE:
                alike = groups.setdefault((name, cut.part.material, cut.part.thickness), [])
                alike.append((process, kerf, cut))
        found: list[tuple[CutJob, Ways]] = []
        wrong: list[Finding] = []
        for (by, material, thickness), rows in groups.items():
            stem = name_from(f"{by}-{material}-{thickness:g}", by)
            process, kerf, _ = rows[0]
            try:
                job = nested(stem, [cut for *_, cut in rows], process, kerf, self.settings)
                found.append((job, wire_contours(job) if by == WIRE else contours(job)))
            except DesignError as error:
                key, _, said = str(error).partition(": ")
                message, _, remedy = said.rpartition("; ")
                wrong.append(_error("cut.sheet", key, message, remedy))
            except GeometryError as error:
                message, _, remedy = str(error).partition("; ")
                wrong.append(_error("cut.path", "cut", message, remedy))
        return found, wrong

    @cached_property
    def programs(self) -> list[ProvenCut]:
        """The programs; raises ProofError where one would not cut the right parts."""
        if errors(self.findings):
            return []
        found = []
        for job, ways in self._planned[0]:
            control = control_of(job)
            text, proof = written(job, ways, control)
            if not proof.ok:
                said = "; ".join(f"{one.name}: {one.message}" for one in proof.failures)
                raise ProofError(f"{job.name}: the program would not cut the right parts: {said}")
            found.append(ProvenCut(job, ways, text, SUFFIXES[control], proof))
        return found

    @property
    def program_names(self) -> list[str]:
        """Files of the programs."""
        return [job.name + SUFFIXES[control_of(job)] for job, _ in self._planned[0]]

    @property
    def ordered(self) -> list[CutPart]:
        """The parts that a service cuts."""
        return [cut for name, *_, cut in self.cut_parts if name == SERVICE]

    @property
    def drawing_names(self) -> list[str]:
        """Files of the drawings for a service."""
        return [cut.part.name + "-cut.dxf" for cut in self.ordered]

    @cached_property
    def drawings(self) -> dict[str, bytes]:
        """Drawings for a service by file; raises ProofError where the service would not take one."""
        from mechwright_cut.service.checker import Drawn, faults
        from mechwright_cut.service.drawing import service_drawing

        rules = services()[self.settings.service]
        found = {}
        for name, cut in zip(self.drawing_names, self.ordered, strict=True):
            part = cut.part
            content = service_drawing(cut, rules)
            wanted = Drawn(
                cut.outline, part.thickness, rules.offset(part.material), self.settings.by == "waterjet"
            )
            if said := faults(content, wanted, rules):
                raise ProofError(f"{name}: {rules.words} would not take it: {'; '.join(said[:3])}")
            found[name] = content
        return found


def _error(code: str, key: str, message: str, remedy: str) -> Finding:
    return Finding.error(code, key, message, remedy=remedy, stage=Stage.MACHINING)


def _no_common_lines(settings: CutSettings, name: str, process: Process) -> Iterator[Finding]:
    """Why parts cannot share edges by a process, or with other keys."""
    remedy = UNSHARED
    if name == SERVICE:
        said = "common lines, and a service lays the parts on its sheets: each drawing has one part"
        yield _error("cut.common-lines", "cut.common_lines", said, remedy)
    elif process.no_common:
        said = f"common lines, and not by {process.words}: {process.no_common}"
        yield _error("cut.common-lines", "cut.common_lines", said, remedy)
    elif settings.joints and process.joints:
        said = (
            f"common lines, and {settings.joints} micro-joints: at a common line no part hangs in the sheet"
        )
        yield _error("cut.common-lines", "cut.common_lines", said, f"{remedy}, or cut.joints = 0")


def _no_kerf(process: Process, part: Part) -> Finding:
    return _error(
        "cut.kerf",
        "cut.kerf",
        f"no table has the kerf of {process.words} in {part.material} {part.thickness:g} mm",
        "cut one square, measure it, and set cut.kerf = 0.2, or what you find",
    )


def _wrong_settings(settings: CutSettings, name: str, process: Process) -> Iterator[Finding]:
    """Keys that do not go with a process."""
    if settings.joints and not process.joints and name != SERVICE:
        said = f"{settings.joints} micro-joints, and {process.words} has none"
        yield _error("cut.joints", "cut.joints", said, "set cut.joints = 0")
    if settings.common_lines:
        yield from _no_common_lines(settings, name, process)
    laser = process.name.endswith("laser")
    if settings.control == "grbl-laser" and not laser:
        said = f"grbl-laser is for lasers, and not for {process.words}"
        yield _error("cut.control", "cut.control", said, f'set cut.control = "{process.control}"')

"""The page of the certificates."""

import json
from typing import TYPE_CHECKING, Any

from mechwright.designs.files import digest_of
from mechwright.output.folder import distinct_files
from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright_cad.exporters import DxfExporter
from mechwright_cam.pages.registered import COMMANDS, DOING, drawings, setup_sheets
from mechwright_cam.program.endings import CERTIFICATE

if TYPE_CHECKING:
    from mechwright_cam.machining import Machined


class Certificates(Page):
    """A certificate for each program, for a checker that shares no code with this project."""

    name = "certificates"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """One for each job."""
        from mechwright_cam.pages.file_names import machined, named

        machining = machined(build)
        if machining is None:
            return []
        return [
            named(machining, job, job.part.name, CERTIFICATE, "the certificate of ") for job in machining.jobs
        ]

    def files(self, build: Build) -> dict[str, str]:
        """JSON by file."""
        from mechwright_cam.machining import Machining

        programs = build.made(Machining).proven_programs
        return distinct_files(
            (item.program.name + CERTIFICATE, sealed(_content(item, build))) for item in programs
        )


def _content(item: "Machined", build: Build) -> dict[str, Any]:
    from mechwright.scripting.provenance import facts
    from mechwright_cam.machining import Machining
    from mechwright_cam.pages.certificate.content import certificate
    from mechwright_cam.pages.setup_sheet import SHEET

    job, control = item.job, build.made(Machining).control
    drawing, sheet = job.part.name + DxfExporter.suffix, item.program.name + SHEET
    drawn = build.made_as_wanted(drawings).get(drawing)
    bound = [] if drawn is None else [("drawing", drawing, digest_of(drawn))]
    bound.append(("setup sheet", sheet, digest_of(build.made_as_wanted(setup_sheets)[sheet])))
    inputs = facts(build.design, build.host)["inputs_sha256"]
    bound += [("input", name, digest) for name, digest in inputs.items()]
    return certificate(item, control.name, control.suffix, bound)


def sealed(content: dict[str, Any]) -> str:
    """The text of a certificate with its seal: the hash of all else, by which a later change shows."""
    plain = json.dumps(content, sort_keys=True, separators=(",", ":"))
    whole = {**content, "seal": digest_of(plain)}
    return json.dumps(whole, separators=(",", ":")) + "\n"

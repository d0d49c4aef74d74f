"""Programs whose certificates hold, by the word of the checker in a process of its own."""

import hashlib
import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from mechwright.errors import DesignError, OutputError, PluginError, ProofError
from mechwright.extras import distribution_line
from mechwright.reading import read_bytes, regular
from mechwright_cam.program.endings import CERTIFICATE

CHECKER = "mechwright_check"
"""The module of the checker, which is a distribution of its own and is never imported here."""

LARGEST = 100_000_000
"""Bytes of a certificate or program, as the checker has it."""

SECONDS = 600.0
"""The checker's time: the longest program of the examples takes 8 s."""


@dataclass(frozen=True)
class ProgramFile:
    """A file of a program whose certificate holds."""

    name: str
    data: bytes
    control: str
    """The control that it is written for."""


def certified(paths: Sequence[Path], note: Callable[[str], object]) -> list[ProgramFile]:
    """The files that are named, or all of a certificate, as bytes that their certificates are of.

    Parameters
    ----------
    paths
        Programs, or certificates in the place of all files of theirs; in the order in which they are sent.
    note
        Takes what the checker says beside its verdict.

    Raises
    ------
    ProofError
        A program has no certificate, or one that does not hold.
    OutputError
        A file cannot be read, or changed meanwhile.
    DesignError
        Two files have one name.
    PluginError
        The checker is not installed.
    """
    wanted: dict[Path, list[str]] = {}
    for path in paths:
        certificate = path if path.name.endswith(CERTIFICATE) else _certificate_of(path)
        names = wanted.setdefault(certificate, [])
        content = _content(certificate)
        every = [str(file["name"]) for file in content["files"]]
        names += [name for name in (every if certificate == path else [path.name]) if name not in names]
    found: list[ProgramFile] = []
    for certificate, names in wanted.items():
        found += _confirmed(certificate, names, note)
    every = [file.name for file in found]
    if twice := [name for name in every if every.count(name) > 1]:
        raise DesignError(f"{twice[0]}: is named twice, from two folders; send one after the other")
    return found


def _certificate_of(program: Path) -> Path:
    """The certificate beside a program that names it."""
    if not regular(program):
        raise OutputError(f"{program}: is no file; name a program that was written")
    beside = sorted(program.parent.glob(f"*{CERTIFICATE}"))
    own = program.with_suffix("").with_name(program.with_suffix("").name + CERTIFICATE)
    for one in sorted(beside, key=lambda path: path != own):
        if any(file["name"] == program.name for file in _content(one)["files"]):
            return one
    raise ProofError(
        f"{program}: not sent: no {program.stem}{CERTIFICATE} beside it names it; "
        f"mechwright cam DESIGN -o {program.parent} writes both"
    )


def _content(certificate: Path) -> dict[str, Any]:
    try:
        content = json.loads(read_bytes(certificate, LARGEST))
        if all(
            isinstance(file["name"], str) and isinstance(file["sha256"], str) for file in content["files"]
        ):
            return {"files": content["files"], "control": str(content["control"])}
    except (ValueError, LookupError, TypeError, RecursionError):
        pass
    raise ProofError(f"{certificate}: not sent: it is no whole certificate; build the design again")


def _confirmed(certificate: Path, names: Sequence[str], note: Callable[[str], object]) -> list[ProgramFile]:
    """Files of one certificate, of which the checker has found nothing wrong."""
    before, content = read_bytes(certificate, LARGEST), _content(certificate)
    hashes = {file["name"]: file["sha256"] for file in content["files"]}
    verdict = _checked(certificate, note)
    if verdict:
        raise ProofError(f"{certificate}: not sent: {verdict}")
    files = [
        ProgramFile(name, read_bytes(certificate.parent / name, LARGEST), content["control"])
        for name in names
    ]
    # The checker has read the files by itself: what is sent is what it has read.
    if read_bytes(certificate, LARGEST, anew=True) != before or any(
        hashlib.sha256(file.data).hexdigest() != hashes[file.name] for file in files
    ):
        raise OutputError(f"{certificate}: not sent: program or certificate changed meanwhile; try again")
    return files


def _checked(certificate: Path, note: Callable[[str], object]) -> str:
    """What the checker has against a certificate; nothing if it holds."""
    try:
        done = subprocess.run(  # noqa: S603 - our own words, without a shell
            [*_checker(), str(certificate.resolve())],
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            encoding="utf-8",
            errors="replace",
            timeout=SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return f"the checker took longer than {SECONDS:g} s"
    except OSError as error:
        raise PluginError(f"the checker of certificates cannot be run: {error.strerror}") from error
    lines = done.stdout.splitlines()
    if done.returncode == 0 and lines:
        for line in lines[:-1]:
            note(line)
        return ""
    said = lines[-1].removeprefix(f"{certificate.resolve()}: ") if lines else f"exit code {done.returncode}"
    return f"the checker says: {said}"


def _checker() -> list[str]:
    """The command of the checker: of this interpreter, else the one on the path."""
    if find_spec(CHECKER) is not None:
        return [sys.executable, "-P", "-m", CHECKER]
    command = shutil.which("mechwright-check")
    if command is None:
        line = distribution_line("mechwright-check", f"cam/{CHECKER}")
        raise PluginError(f"send: mechwright-check, which checks certificates, is not installed: {line}")
    return [command]

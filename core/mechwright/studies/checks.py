"""Designs of the front, checked up to their programs: side by side, each saved as soon as it is done."""

import hashlib
import json
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path

from mechwright.contracts.finding import errors
from mechwright.contracts.part import check_name
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.change import changed
from mechwright.errors import MechwrightError, PluginError
from mechwright.plugins.host import Host, host
from mechwright.reading import read_bytes
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.pareto import spread
from mechwright.scripting.provenance import facts
from mechwright.studies.folder import SweepFolder
from mechwright.studies.front import Chosen, Front
from mechwright.studies.shard import NUMBER
from mechwright.studies.study import Study, design_of, study_of
from mechwright.worker_pool.budget import limited_cores
from mechwright.worker_pool.sharing import side_by_side

TRIES = 4
"""Times as many designs of the front as are asked for that are checked until there are enough that build."""

CHECK_BYTES = 100_000
"""Of the file of a check, which holds a line."""


@dataclass(frozen=True)
class Candidate:
    """A design to check, as it goes to another process.

    Parameters
    ----------
    file, path
        The study file's content as JSON, and its path, from which files that it names are found.
    values
        Dotted name of a parameter to the design's value.
    name
        Of the design, while it is checked.
    """

    file: str
    path: Path
    values: dict[str, object]
    name: str


def checked(place: SweepFolder, front: Front, cores: int, progress: Progress) -> list[Chosen]:
    """Designs of the front that build up to their programs, and those that were tried for them.

    As many are checked at once as may still be needed, so that it does not matter which of them are faster.

    Raises
    ------
    PluginError
        A process that checks a design was killed.
    """
    study = place.study
    wanted, found = study.asked.front, list[Chosen]()
    places = spread(front.costs, TRIES * wanted) if len(front) and wanted else []
    built = 0
    while places and built < wanted:
        some, places = places[: wanted - built], places[wanted - built :]
        verdicts = _verdicts(place, front, some, cores, partial(_share, progress, built, wanted))
        for at, refused in zip(some, verdicts, strict=True):
            figures = {column: front.columns[column][at].item() for column in study.units}
            built += not refused
            name = "" if refused else name_of(study, built)
            found.append(Chosen(int(front.columns[NUMBER][at]), name, figures, refused))
    return found


def _share(progress: Progress, built: int, wanted: int, part: float, what: str) -> None:
    """Progress of what follows some designs that build."""
    progress((built + part * (wanted - built)) / wanted, what)


def name_of(study: Study, number: int) -> str:
    """Name of the design of the front with this number, from 1 on."""
    return check_name(f"{study.name}-{number:0{len(str(study.asked.front))}}", "name of a design")


def mechanism_of(study: Study, values: dict[str, object], name: str, known: Host) -> Mechanism:
    """The design of a study whose parameters with a range have these values, by dotted name."""
    change = {f"parameters.{key}": value for key, value in values.items()}
    content = changed({"parameters": dict(study.content)}, change)["parameters"]
    return Mechanism(design_of(study, name, study.family.Params.model_validate(content), known), known)


def _verdicts(
    place: SweepFolder, front: Front, some: Sequence[int], cores: int, progress: Progress
) -> list[str]:
    """What forbids each of some designs, by their places on the front; empty where nothing does."""
    study = place.study
    text, name = json.dumps(study.file, default=str), name_of(study, 1)
    candidates = [Candidate(text, study.path, front.design(at), name) for at in some]
    installed = _installed(place.host)
    digests = [
        _digest(mechanism_of(study, one.values, name, place.host), place.host, installed)
        for one in candidates
    ]
    stems = [f"design-{int(front.columns[NUMBER][at]):012d}" for at in some]
    found = {n: said for n in range(len(some)) if (said := _kept(place, stems[n], digests[n])) is not None}
    missing = [n for n in range(len(some)) if n not in found]
    progress(len(found) / len(some), f"{len(found)} of {len(some)} designs of the front checked")
    for n, said in _checks([candidates[n] for n in missing], missing, cores, study, place.host):
        place.store_check(stems[n], json.dumps(_check(digests[n], said)).encode())
        found[n] = said
        progress(len(found) / len(some), f"{len(found)} of {len(some)} designs of the front checked")
    return [found[n] for n in range(len(some))]


def _checks(
    candidates: Sequence[Candidate], numbers: Sequence[int], cores: int, study: Study, known: Host
) -> Iterator[tuple[int, str]]:
    """The number of each candidate and what forbids it, as soon as it is known."""
    if len(candidates) < 2 or cores < 2:
        with limited_cores(cores):
            for number, one in zip(numbers, candidates, strict=True):
                yield number, _refused(mechanism_of(study, one.values, one.name, known))
        return
    with closing(side_by_side(check, candidates, cores)) as found:
        for n, said in found:
            if said is None:
                raise PluginError(
                    "a process that checks a design of the front was killed, mostly for want of memory; take "
                    "fewer --workers"
                )
            yield numbers[n], said


def check(one: Candidate, progress: Progress = unheard) -> str:
    """What forbids a candidate, in a process of its own."""
    known = host()
    study = study_of(json.loads(one.file), one.path, known)
    return _refused(mechanism_of(study, one.values, one.name, known), progress)


def _refused(mechanism: Mechanism, progress: Progress = unheard) -> str:
    said = errors(mechanism.check(progress, remedies=False))
    return f"[{said[0].code}] {said[0].message}" if said else ""


def _digest(mechanism: Mechanism, known: Host, installed: str) -> str:
    """SHA-256 of all that a check depends on: design, files that it names, versions, installed plugins."""
    said = json.dumps([facts(mechanism.design, known), installed], sort_keys=True)
    return hashlib.sha256(said.encode()).hexdigest()


def _installed(known: Host) -> str:
    """SHA-256 of the texts of all plugins' packages."""
    found = hashlib.sha256()
    items = [entry.item for entries in known.registered.values() for entry in entries.values()]
    for package in sorted({type(item).__module__.partition(".")[0] for item in items}):
        root = Path(str(import_module(package).__file__)).parent
        for path in sorted(root.rglob("*")):
            if path.is_file() and path.suffix in {".py", ".toml"}:
                found.update(str(path.relative_to(root)).encode())
                found.update(path.read_bytes())
    return found.hexdigest()


def _kept(place: SweepFolder, stem: str, digest: str) -> str | None:
    """What an earlier run found of the same design; None where none did, and then its file is gone."""
    for path in place.checks():
        if path.stem == stem:
            said = _read(path)
            refused = said.get("refused") if isinstance(said, dict) else None
            if isinstance(refused, str) and said == _check(digest, refused):
                return refused
            place.drop([path])
    return None


def _check(digest: str, refused: str) -> dict[str, str]:
    """What the file of a check says: of what it is, what it found, and a digest of both."""
    seal = hashlib.sha256(json.dumps([digest, refused]).encode()).hexdigest()
    return {"of": digest, "refused": refused, "seal": seal}


def _read(path: Path) -> object:
    try:
        return json.loads(read_bytes(path, CHECK_BYTES, anew=True))
    except (MechwrightError, ValueError, RecursionError):
        return None

"""Known advisories against what a release asks for: ``python .ci/advisories.py [--read FOLDER]``.

``advisories.toml`` lists for packages which versions are affected by which advisory. A version that
``requirements.lock`` pins must not be among them, nor the lowest one that ``pyproject.toml`` declares for the
project or an extra. With ``--read`` the list takes what a checkout of the advisory database of PyPA tells of
these packages, and keeps what it has besides: the database is out of reach while a release is made.
"""

import argparse
import re
import sys
import tomllib
from collections import defaultdict
from datetime import UTC, datetime
from pathlib import Path

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import Version

ROOT = Path(__file__).parents[1]
LIST = Path(__file__).with_name("advisories.toml")
_PIN = re.compile(r"^([A-Za-z0-9_.-]+)==([^ ;\\]+)", re.MULTILINE)
_STALE = 180
"""Days after which the list has to be read again."""

HEAD = """# Advisories of packages that Mechwright, an extra or its tests install: the affected versions.
# Read anew by: python .ci/advisories.py --read FOLDER
"""


def wanted() -> dict[str, set[str]]:
    """Package to versions that a release asks for: pinned ones, and the lowest that are declared."""
    found = defaultdict(set)
    for name, version in _PIN.findall((ROOT / "requirements.lock").read_text("utf-8")):
        found[canonicalize_name(name)].add(version)
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    for text in (
        *project["dependencies"],
        *(one for extra in project["optional-dependencies"].values() for one in extra),
    ):
        requirement = Requirement(text)
        found[canonicalize_name(requirement.name)] |= {
            one.version for one in requirement.specifier if one.operator in {">=", "==", "~="}
        }
    return dict(found)


def affected(known: dict) -> list[str]:
    """What is asked for although an advisory affects it, in words."""
    return [
        f"{name} {version}: {', '.join(row['ids'])} ({row['versions']})"
        for name, versions in sorted(wanted().items())
        for version in sorted(versions)
        for row in known.get(name, ())
        if Version(version) in SpecifierSet(row["versions"], prereleases=True)
    ]


def read(folder: Path, known: dict) -> None:
    """Add what a checkout of the database tells of the packages that are asked for."""
    import yaml

    for name in wanted():
        rows = {row["versions"]: set(row["ids"]) for row in known.get(name, ())}
        for path in sorted((folder / "vulns" / name).glob("*.yaml")):
            told = yaml.safe_load(path.read_text("utf-8"))
            if told.get("withdrawn"):
                continue
            number = next((one for one in told.get("aliases", ()) if one.startswith("CVE-")), told["id"])
            for part in told["affected"]:
                for span in part.get("ranges", ()):
                    if span["type"] == "ECOSYSTEM":
                        for versions in _spans(span["events"]):
                            rows.setdefault(versions, set()).add(number)
        if rows:
            known[name] = [{"versions": key, "ids": sorted(ids)} for key, ids in sorted(rows.items())]


def _spans(events: list[dict]) -> list[str]:
    """Specifiers of the versions between what introduced a fault and what mended it."""
    found, low = [], "0"
    for event in events:
        if "introduced" in event:
            low = event["introduced"]
        elif "fixed" in event or "last_affected" in event:
            high = f"<{event['fixed']}" if "fixed" in event else f"<={event['last_affected']}"
            found.append(high if low == "0" else f">={low},{high}")
    return found


def write(known: dict) -> None:
    lines = [f"read = {datetime.now(UTC).date()}\n"]
    for name, rows in sorted(known.items()):
        lines += [
            f"\n[[package.{name}]]\nversions = {row['versions']!r}\nids = {row['ids']!r}\n" for row in rows
        ]
    LIST.write_text(HEAD + "".join(lines).replace("'", '"'), "utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--read", type=Path, metavar="FOLDER")
    asked = parser.parse_args()
    content = tomllib.loads(LIST.read_text("utf-8"))
    known = content["package"]
    if asked.read:
        read(asked.read, known)
        write(known)
    told = affected(known)
    if told:
        print("versions that an advisory affects:", *told, sep="\n  ", file=sys.stderr)
        return 1
    days = (datetime.now(UTC).date() - content["read"]).days
    age = f"; the list is {days} days old, read it anew" if days > _STALE else ""
    count = sum(len(row["ids"]) for rows in known.values() for row in rows)
    print(f"{len(wanted())} packages, none affected by {count} advisories of {len(known)} of them{age}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

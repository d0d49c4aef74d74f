"""What a release brings along, and under which licences: ``python .ci/components.py SBOM [--write]``.

``SBOM`` is a list of components in CycloneDX's JSON of an environment with nothing but Mechwright in it.
Every licence is brought to its SPDX identifier and has to be one of those allowed; ``docs/components.md`` has
to say the same, and is written with ``--write``.
"""

import argparse
import json
import re
import sys
from pathlib import Path

PAGE = Path(__file__).parents[1] / "docs" / "components.md"
NONE_OF_THEM = {"mechwright", "pip", "setuptools"}
"""The project, and what an environment comes with."""

ALLOWED = {
    "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "CC0-1.0", "ISC",
    "LGPL-3.0-or-later", "MIT", "MIT-CMU", "MPL-2.0", "PSF-2.0", "Python-2.0", "Zlib",
}  # fmt: skip
"""SPDX identifiers of permissive licences, and of weak copyleft for libraries that are used as they are."""

SPELLINGS = {
    "License :: OSI Approved :: Apache Software License": "Apache-2.0",
    "License :: OSI Approved :: BSD License": "BSD-3-Clause",
    "License :: OSI Approved :: MIT License": "MIT",
    "License :: OSI Approved :: Mozilla Public License 2.0 (MPL 2.0)": "MPL-2.0",
}
"""What packages say in place of an identifier."""

SAID_ELSEWHERE = {"casadi": "LGPL-3.0-or-later"}
"""Packages whose metadata name no licence, with that of the text they come with."""

HEAD = """# Components

What an installation of Mechwright without extras brings along, and under which licences (SPDX identifiers).
`bash .ci/release` makes this list of what is installed by `requirements.lock`, compares it, and refuses a
licence that is neither permissive nor of the LGPL kind. A release carries the whole list with versions in
CycloneDX's form (`sbom.json`).

| package | licence |
| --- | --- |
"""


def licence(component: dict) -> str:
    """The SPDX expression of a component: of several that say the same, one."""
    name = component["name"]
    if name in SAID_ELSEWHERE:
        return SAID_ELSEWHERE[name]
    said = set()
    for entry in component.get("licenses", []):
        inner = entry.get("license", {})
        text = entry.get("expression") or inner.get("id") or inner.get("name") or ""
        said.add(SPELLINGS.get(text, text))
    return " OR ".join(sorted(said))


def unknown(expression: str) -> list[str]:
    """The identifiers of an expression that are not allowed; of none at all, a word for it."""
    parts = [part.strip(" ()") for part in re.split(r" AND | OR ", expression)]
    return [part or "no licence" for part in parts if part not in ALLOWED]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sbom", type=Path)
    parser.add_argument("--write", action="store_true")
    asked = parser.parse_args()
    components = json.loads(asked.sbom.read_text("utf-8"))["components"]
    found = {item["name"]: licence(item) for item in components if item["name"].lower() not in NONE_OF_THEM}
    refused = [f"{name}: {', '.join(bad)}" for name, text in found.items() if (bad := unknown(text))]
    if refused:
        print("licences that are not allowed:", *refused, sep="\n  ", file=sys.stderr)
        return 1
    lines = [
        f"| {name} | {text} |\n" for name, text in sorted(found.items(), key=lambda item: item[0].lower())
    ]
    page = HEAD + "".join(lines)
    if asked.write:
        PAGE.write_text(page, "utf-8")
    elif PAGE.read_text("utf-8") != page:
        print(f"{PAGE.name} says something else; write it anew with --write", file=sys.stderr)
        return 1
    print(f"{len(found)} components, all licences allowed")
    return 0


if __name__ == "__main__":
    sys.exit(main())

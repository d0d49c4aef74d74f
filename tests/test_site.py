"""The documentation site holds everything, leads nowhere wrong, and asks nobody elsewhere."""

import doctest
import importlib
import os
import posixpath
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

import family_pictures
import first_hour
import gallery
import gif
import numpy as np
import proven
import pytest
import tour
import tree
from by_night import by_night

import mechwright as mw
from mechwright_cad.animation import PAGE_SAMPLES

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in DOCS.rglob("*.md") if path.parent.name != "paper"
)
CONFIG = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
BUILT = os.environ.get("MECHWRIGHT_SITE", "")
"""Folder of the site, where it has been built."""

built = pytest.mark.skipif(
    not BUILT, reason="mkdocs build --strict -d FOLDER, then with MECHWRIGHT_SITE=FOLDER"
)


@pytest.mark.parametrize("name", ["tree", "docstrings", "notebook_pages"])
def test_examples_of_the_scripts(name):
    if name == "docstrings":
        pytest.importorskip("markdown", reason="pip install 'mechwright[docs]'")
    done = doctest.testmod(importlib.import_module(name))
    assert done.attempted
    assert not done.failed


def test_the_menu_holds_every_page_once():
    menu = re.findall(r"[\w./-]+\.md", CONFIG[CONFIG.index("\nnav:") :])
    outside = {name for name in menu if not (DOCS / name).is_file()}
    assert all(tree.place(name) == name and (ROOT / name).is_file() for name in outside)
    assert sorted(set(menu) - outside) == sorted(tree.place(page) for page in PAGES)
    assert len(menu) == len(set(menu))


def test_the_gallery_has_a_card_for_every_example():
    page = gallery.index(gallery.examples())
    others = {"pyproject.toml", "bench-inches.toml"}  # no design of anything
    files = [path for path in (ROOT / "examples").rglob("*.toml") if path.name not in others]
    assert len(files) > 40
    assert [
        path.name for path in files if f"({path.stem}.md)" not in page and f'"{path.stem}.html"' not in page
    ] == []


def test_an_example_is_drawn_and_moves():
    mechanism = mw.load(ROOT / "examples" / "elliptic-pair.toml").asked(samples=PAGE_SAMPLES, command="solve")
    shown = gallery.drawn(mechanism)
    assert shown.keys() == {"still.svg", "motion.html"}
    assert shown["still.svg"].count("<path") >= 3
    example = gallery.Example(ROOT / "examples" / "elliptic-pair.toml")
    page = gallery.page_of(example, gallery.framed("elliptic-pair", shown), gallery.listed(mechanism))
    assert example.text.strip() in page
    assert 'src="elliptic-pair/motion.html"' in page
    assert "`gear.mesh`" in page


@by_night
def test_the_pictures_of_the_tour_are_what_a_build_draws():
    for name, drawn in tour.pictures().items():
        assert (tour.IMAGES / name).read_text(encoding="utf-8") == drawn, "python docs/tour.py draws it anew"


@by_night
def test_the_pictures_and_the_film_of_the_first_hour_are_what_its_commands_make():
    for name, drawn in first_hour.pictures().items():
        assert (first_hour.IMAGES / name).read_bytes() == drawn, "python docs/first_hour.py draws it anew"


def test_a_film_has_the_frames_that_it_was_made_of():
    frames = [np.full((5, 7), k) for k in range(3)]
    frames[1][2, 3:] = 0
    film = gif.animation(frames, ("#000000", "#ffffff", "#1f6f8b"), 10)
    assert film.startswith(b"GIF89a\x07\x00\x05\x00")
    assert film.endswith(b"\x00\x3b")
    assert film.count(b"\x21\xf9\x04") == 3
    # 35 places of one colour: runs of 1, 2, 3 ... places, between the codes to clear and to end.
    assert [code for code, _ in gif.codes([1] * 6)] == [16, 1, 18, 19, 17]


@by_night
@pytest.mark.parametrize("name", family_pictures.SHOWN)
def test_the_picture_of_a_family_is_what_its_example_shows(name):
    file = f"family-{name}.svg"
    assert (tour.IMAGES / file).read_text(encoding="utf-8") == family_pictures.picture(name), (
        "python docs/family_pictures.py draws it anew"
    )
    page = (DOCS / f"{name}.md").read_text(encoding="utf-8")
    assert f"(images/{file})" in page
    assert f"(../examples/{family_pictures.SHOWN[name]}.toml)" in page


def test_the_reference_has_every_public_name_once():
    text = "".join(path.read_text(encoding="utf-8") for path in (DOCS / "reference").glob("*.md"))
    assert sorted(re.findall(r"^::: mechwright\.(\w+)$", text, re.M)) == sorted(
        set(mw.__all__) - {"__version__"}
    )


@pytest.mark.parametrize("origin", PAGES)
def test_links_lead_to_pages_of_the_site(origin):
    made = {tree.place(path.relative_to(ROOT).as_posix()) for path in (ROOT / "examples").rglob("*.*")}
    made |= {*tree.TOP.values(), "gallery/README.md"}
    text = tree.FENCED.sub("", tree.relinked((ROOT / origin).read_text(encoding="utf-8"), origin))
    for _, target, _ in tree.LINK.findall(text):
        file = target.partition("#")[0]
        if file and not re.match(r"[a-z]+:", file):
            wanted = posixpath.normpath(posixpath.join(posixpath.dirname(tree.place(origin)), file))
            assert wanted in made or (DOCS / wanted).is_file(), f"{origin} leads to {target}"


def test_every_source_is_in_the_table_of_figures():
    table = (DOCS / "seeds" / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\|.*\|.+\|.+\|.*\]\(.*\|$", table, re.M)
    assert len(rows) > 20
    sources = {path.stem for path in (DOCS / "seeds").glob("*.md")} - {"README"}
    assert [source for source in sorted(sources) if f"({source}.md" not in table] == []


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("# A\n\n## B\n\n[fine](#b), [fine](other.md)", ""),
        ("# A\n\n[gone](nowhere.md)", "nowhere.md"),
        ("# A\n\n[gone](other.md#nowhere)", "#nowhere"),
        ("# A\n\n[gone](#nowhere)", "#nowhere"),
        ("# A\n\n[absolute](/other.md)", "/other.md"),
        ("# A\n\n![gone](images/none.svg)", "none.svg"),
    ],
)
def test_a_broken_link_stops_the_build(text, says, tmp_path):
    pytest.importorskip("mkdocs", reason="pip install 'mechwright[docs]'")
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "README.md").write_text(text)
    (tmp_path / "docs" / "other.md").write_text("# Other\n")
    (tmp_path / "mkdocs.yml").write_text(
        f"INHERIT: {ROOT / 'mkdocs.yml'}\nsite_name: tried\ndocs_dir: docs\nsite_dir: site\ntheme: {{name: mkdocs}}\n"
        "hooks: []\nextra_css: []\nplugins: []\nnav: [README.md, other.md]\n"
    )
    done = subprocess.run(
        [
            sys.executable,
            "-W",
            "ignore",
            "-m",
            "mkdocs",
            "build",
            "--strict",
            "-f",
            str(tmp_path / "mkdocs.yml"),
        ],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
    )
    assert done.returncode == int(bool(says)), done.stderr
    assert says in done.stderr


LOADED = re.compile(
    r"<(?:script|link|img|iframe|source|video|audio)\b[^>]*?\b(?:src|href)=[\"']?([^\"'\s>]+)", re.I
)
"""Addresses that a browser fetches by itself."""
STYLE = re.compile(r"url\(\s*[\"']?([^)\"']+)|@import\s+[\"']([^\"']+)")
FOREIGN = re.compile(r"(?:[a-z]+:)?//", re.I)


@built
def test_nothing_is_fetched_from_elsewhere():
    asked = []
    for path in Path(BUILT).rglob("*"):
        if path.suffix in {".html", ".svg"}:
            text = path.read_text(encoding="utf-8")
            asked += [(path.name, one) for one in LOADED.findall(text)]
        if path.suffix in {".html", ".svg", ".css"}:
            asked += [(path.name, one or two) for one, two in STYLE.findall(path.read_text(encoding="utf-8"))]
    assert len(asked) > 1000
    assert [one for one in asked if FOREIGN.match(one[1])] == []


@built
def test_whatever_a_page_of_the_site_loads_or_leads_to_is_there():
    missing = []
    for path in Path(BUILT).rglob("*.html"):
        if path.name in {"motion.html", "404.html"}:
            continue
        text = re.sub(r"<(pre|code|script)\b.*?</\1>", "", path.read_text(encoding="utf-8"), flags=re.S)
        for target in {*LOADED.findall(text), *re.findall(r"<a\b[^>]*?\bhref=\"([^\"]+)\"", text)}:
            file = unquote(target.partition("#")[0].partition("?")[0])
            if file and not re.match(r"[a-z]+:", file) and not (path.parent / file).exists():
                missing.append((path.relative_to(BUILT).as_posix(), target))
    assert missing == []


@built
def test_every_example_moves_on_the_site():
    for one in gallery.examples():
        page = Path(BUILT) / "gallery" / f"{one.name}.html"
        assert page.is_file()
        assert (page.with_suffix("") / "motion.html").is_file() is not one.required
        assert (page.with_suffix("") / "still.svg").is_file() is not one.required


def test_the_twenty_mechanisms_have_parts_and_proof():
    found = proven.entries()
    assert list(found) == list(proven.TWENTY)
    assert len(set(proven.TWENTY)) == 20
    for name, one in found.items():
        text = "\n".join(proven.lines(name))
        assert one["parts"]
        assert one["programs"]
        for part in one["parts"]:
            assert f"| {part['name']} | {part['material']} |" in text
        for program in one["programs"]:
            assert program["proven"]
            assert program["gouge_um"] <= 5
            assert program["leftover_um"] <= 10
            assert program["certificate"] != "refuted"
            assert f"| {program['name']} | {program['checks']} |" in text
    assert proven.lines("geneva-requirement") == []


@pytest.mark.parametrize(
    "name", [proven.TWENTY[0], *(pytest.param(one, marks=by_night) for one in proven.TWENTY[1:])]
)
def test_parts_and_proof_are_what_the_command_makes(name, tmp_path):
    assert proven.entry(name, tmp_path / "out") == proven.entries()[name], "python docs/site/proven.py"

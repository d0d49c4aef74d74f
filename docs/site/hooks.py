"""What MkDocs does not do by itself: pages made of examples, notebooks, commands; links out of ``docs``."""

import re
from collections.abc import Iterator

import command_pages
import gallery
import notebook_pages
from docstrings import Docstrings
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from tree import GALLERY, NOTEBOOKS, ROOT, TOP, anchor, relinked

ORIGINS: dict[str, str] = {}
"""Place on the site to the path in the repository, of pages that come from outside ``docs``."""

COMMANDS = "<!-- commands -->"
"""Where a page has the reference of the command line."""
MOVING = re.compile(r"<!-- moving: (\S+) -->\n\n\[!\[.*?\]\(.*?\)\]\(.*?\)")
"""Where a page shows an example moving, in place of the picture that others see there."""


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Take docstrings as they are written; fill the menu where pages come from outside ``docs``."""
    config.markdown_extensions.append(Docstrings())
    config.mdx_configs["toc"]["slugify"] = anchor
    for entry in config.nav or ():
        if "Gallery" in entry:
            entry["Gallery"] = [f"{GALLERY}/README.md", *_by_family()]
        if "Notebooks" in entry:
            names = sorted(path.stem for path in notebook_pages.FOLDER.glob("*.ipynb"))
            entry["Notebooks"] = [f"{NOTEBOOKS}/README.md", *(f"{NOTEBOOKS}/{name}.md" for name in names)]
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are made, and those that stand outside ``docs``."""
    for place, content in _made():
        files.append(File.generated(config, place, content=content))
    for origin, place in TOP.items():
        ORIGINS[place] = origin
        files.append(File.generated(config, place, content=(ROOT / origin).read_text(encoding="utf-8")))
    for path in _templates():
        ORIGINS[path] = path
        files.append(File.generated(config, path, content=(ROOT / path).read_text(encoding="utf-8")))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001
    """Fill in what is made, and turn links to files of the repository into links to their pages."""
    markdown = MOVING.sub(_moving, markdown).replace(COMMANDS, command_pages.sections())
    place = page.file.src_uri
    if place.startswith((f"{GALLERY}/", f"{NOTEBOOKS}/")) and place != f"{NOTEBOOKS}/README.md":
        return markdown  # made for the site
    origin = "examples/notebooks/README.md" if place == f"{NOTEBOOKS}/README.md" else f"docs/{place}"
    return relinked(markdown, ORIGINS.get(place, origin))


def _made() -> Iterator[tuple[str, str]]:
    """Place on the site and content of every file that is made."""
    yield from ((f"{GALLERY}/{name}", content) for name, content in gallery.files())
    yield from ((f"{NOTEBOOKS}/{name}", content) for name, content in notebook_pages.files())


def _by_family() -> list[dict[str, list[str]]]:
    """The examples in the menu, each family with its own."""
    shown = gallery.examples()
    return [
        {family: [f"{GALLERY}/{one.name}.md" for one in shown if one.family == family]}
        for family in gallery.FAMILIES
    ]


def _templates() -> list[str]:
    """Files of ``examples`` that pages link to and that no gallery shows: templates, scripts, processes."""
    kept = {".md", ".toml", ".py"}
    folders = [
        *sorted(gallery.EXAMPLES.glob("*-template")),
        gallery.EXAMPLES / "cqgi",
        gallery.EXAMPLES / "processes",
    ]
    found = (path for folder in folders for path in sorted(folder.rglob("*")) if path.suffix in kept)
    return [path.relative_to(ROOT).as_posix() for path in found]


def _moving(match: re.Match[str]) -> str:
    name = match[1]
    return f'<iframe class="moving" src="{GALLERY}/{name}/motion.html" title="{name} moves"></iframe>'

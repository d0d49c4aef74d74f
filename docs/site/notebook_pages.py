"""The notebooks as pages, with what their cells show where they have been run."""

import json
import os
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path
from typing import Any

from tree import ROOT

FOLDER = ROOT / "examples" / "notebooks"
EXECUTED = "MECHWRIGHT_EXECUTED"
"""Environment variable: where ``tests/test_notebooks.py`` keeps the notebooks that it has run."""
PLOTLY = "plotly.min.js"
"""The script that draws figures, from the installed package, once for all pages."""
FIGURE = "application/vnd.plotly.v1+json"
NOT_RUN = (
    "!!! note\n    These pages were made without running the notebooks, so that only their code is shown.\n"
)


def files() -> Iterator[tuple[str, str]]:
    """Every file below the folder of the notebooks: its path and content."""
    executed = os.environ.get(EXECUTED, "")
    drawn = False
    for path in sorted(FOLDER.glob("*.ipynb")):
        run = Path(executed) / path.name
        content = json.loads((run if executed else path).read_text(encoding="utf-8"))
        markdown, figures = page(content["cells"], path.name)
        drawn = drawn or figures
        yield f"{path.stem}.md", markdown
        yield path.name, path.read_text(encoding="utf-8")
    if drawn:
        from plotly.offline import get_plotlyjs

        yield PLOTLY, get_plotlyjs()
    listed = [f"* [{_title(path)}]({path.stem}.md)" for path in sorted(FOLDER.glob("*.ipynb"))]
    readme = (FOLDER / "README.md").read_text(encoding="utf-8")
    yield "README.md", "\n".join([readme, "" if executed else NOT_RUN, *listed, ""])


def page(cells: list[dict[str, Any]], name: str) -> tuple[str, bool]:
    """A notebook as Markdown, and whether it has a figure.

    >>> cells = [{"cell_type": "markdown", "source": ["# A"]}]
    >>> cells += [{"cell_type": "code", "source": ["1 + 1"], "outputs": []}]
    >>> print(page(cells, "a.ipynb")[0])
    # A
    <BLANKLINE>
    [The notebook itself](a.ipynb)
    <BLANKLINE>
    ```python
    1 + 1
    ```
    <BLANKLINE>
    """
    rows, figures = [], 0
    for cell in cells:
        source = "".join(cell["source"]).strip()
        if cell["cell_type"] == "markdown":
            rows += [source, ""]
        else:
            rows += ["```python", source, "```", ""]
        if len(rows) == 2:
            rows += [f"[The notebook itself]({name})", ""]
        for output in cell.get("outputs", ()):
            rows += [_shown(output, figures), ""]
            figures += FIGURE in output.get("data", {})
    script = f'<script src="{PLOTLY}"></script>\n\n' if figures else ""
    head, _, rest = "\n".join(rows).partition("\n")
    return f"{head}\n{script and chr(10)}{script.strip()}{script and chr(10)}{rest}", bool(figures)


def _shown(output: Mapping[str, Any], number: int) -> str:
    """What a cell shows, as HTML."""
    data = output.get("data", {})
    if FIGURE in data:
        figure = json.dumps(data[FIGURE]).replace("<", "\\u003c")
        place = f"figure-{number}"
        return (
            f'<div class="shown plot" id="{place}"></div>\n<script>{{ const shown = {figure};\n'
            f'Plotly.newPlot("{place}", shown.data, shown.layout, '
            "{ responsive: true, displaylogo: false }); }</script>"
        )
    if "text/html" in data:
        content = "".join(data["text/html"])
        # A blank line would end the element for Markdown, and not for the browser.
        return (
            '<div class="shown">' + "\n".join(row for row in content.splitlines() if row.strip()) + "</div>"
        )
    text = output.get("text") or data.get("text/plain") or ""
    return f'<pre class="shown">{escape("".join(text)).replace(chr(10), "&#10;")}</pre>'


def _title(path: Path) -> str:
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return "".join(cells[0]["source"]).splitlines()[0].lstrip("# ")

"""The saw list of a build: a line for each part."""

import csv
import io
from dataclasses import asdict, dataclass

from mechwright import Build, Page, Part, material

STEM = "saw-list"
"""Of both files."""

HTML = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{{ design }}: saw list</title>
<style>body{font-family:sans-serif}td,th{padding:.2em .6em;text-align:left}.n{text-align:right}</style>
<h1>{{ design }}: saw list</h1>
<table>
<tr><th>part<th>count<th>material<th>least stock, mm<th>mass of one, g<th>mass of all, g
{% for item in items -%}
<tr><td>{{ item.part }}<td class="n">{{ item.count }}<td>{{ item.material }}
  <td class="n">{{ "%.1f × %.1f × %.1f" | format(item.length_mm, item.width_mm, item.height_mm) }}
  <td class="n">{{ "%.1f" | format(item.mass_g) }}<td class="n">{{ "%.1f" | format(item.total_g) }}
{% endfor -%}
</table>
<p>{{ "%.3f" | format(items | sum(attribute="total_g") / 1000) }} kg in all.
</html>
"""


@dataclass(frozen=True)
class Item:
    """A line of the list: sizes of the box around one part, mm, and masses, g."""

    part: str
    count: int
    material: str
    length_mm: float
    width_mm: float
    height_mm: float
    mass_g: float
    total_g: float


class SawList(Page):
    """``saw-list.csv`` and the same as HTML."""

    name = "saw-list"
    commands = frozenset({"model", "build"})
    doing = "saw list"

    def files(self, build: Build) -> dict[str, str]:
        """Both files; heavy libraries are imported only now."""
        import jinja2

        items = [item_of(part) for part in build.parts]
        environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
        page = environment.from_string(HTML).render(design=build.design.name, items=items)
        return {f"{STEM}.csv": table(items), f"{STEM}.html": page + "\n"}


def item_of(part: Part) -> Item:
    """The line of a part; one that stands nowhere in the assembly is made once all the same."""
    if part.outline is not None:
        from mechwright.contracts.moments import volume

        x0, y0, x1, y1 = part.outline.bounds
        size, cubic = (x1 - x0, y1 - y0, part.thickness), volume(part)
    else:
        from mechwright_cad.solids.solid import part_solid

        solid = part_solid(part)
        box = solid.BoundingBox()
        size, cubic = (box.xlen, box.ylen, box.zlen), solid.Volume()
    count = max(len(part.instances), 1)
    mass = cubic / 1000 * material(part.material).density
    return Item(part.name, count, part.material, *(round(one, 3) for one in (*size, mass, count * mass)))


def table(items: list[Item]) -> str:
    """The lines as CSV, under their names."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(Item.__dataclass_fields__), lineterminator="\n")
    writer.writeheader()
    writer.writerows(asdict(item) for item in items)
    return text.getvalue()

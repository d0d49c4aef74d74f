"""Plates that nobody sells so thick."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Change, Finding, Stage, at_stage
from mechwright.pipeline import Build, Inspection

if TYPE_CHECKING:
    from mechwright.contracts.part import Part


class SoldPlates(Inspection):
    """Plates are as thick as they are sold, or as those in hand."""

    name = "sold-plates"
    stage = Stage.PARTS
    order = 60
    doing = "thicknesses of plates"

    def findings(self, build: Build) -> Sequence[Finding]:
        """One for each thickness that is not sold: a warning where a key gives it, else a note."""
        from mechwright.machine.made import settings_of
        from mechwright.remedies.keys import thickness_keys
        from mechwright.standards.stock import AS_THICK, is_sold

        in_hand = settings_of(build).plates
        odd: dict[tuple[str, float], list[Part]] = {}
        for part in build.parts:
            mine = any(abs(one - part.thickness) <= AS_THICK for one in in_hand)
            if part.kind == "plate" and not mine and not is_sold(part.thickness, part.material):
                odd.setdefault((part.material, part.thickness), []).append(part)
        found = [
            _fault(parts, thickness, material, thickness_keys(build.design, thickness))
            for (material, thickness), parts in odd.items()
        ]
        return at_stage(self.stage, found)


def _fault(parts: "Sequence[Part]", thickness: float, material: str, keys: Sequence[str]) -> Finding:
    names = ", ".join(dict.fromkeys(part.name for part in parts))
    near = list(_nearest(thickness, material))
    above = [one for one in near if one > thickness]
    face = f"one of {above[0]:g} mm has to be faced" if above else "two have to be screwed together"
    said = f"no plate of {material} is sold {thickness:g} mm thick, as {names} takes it: {face}"
    if not keys:
        return Finding.note("stock.thickness", said, thickness, "mm")
    sizes = " or ".join(f"{one:g}" for one in near)
    proposed: tuple[Change, ...] = tuple({key: one} for one in near for key in keys)
    return Finding.warning(
        "stock.thickness",
        keys[0],
        said,
        thickness,
        near[-1] if near else None,
        "mm",
        f"make it {sizes} mm",
        proposed=proposed,
    )


def _nearest(thickness: float, material: str) -> Iterator[float]:
    """The sold thicknesses next to one, mm, the smaller first."""
    from mechwright.standards.stock import plate_stock, plate_within

    below = plate_within(thickness, material)
    if below is not None:
        yield below
    above = [float(one) for one in plate_stock(material).thicknesses if one > thickness]
    yield from above[:1]

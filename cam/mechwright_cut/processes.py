"""Laser, waterjet, plasma, wire and a service as processes that ``process`` names."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding
from mechwright.contracts.made_part import MadePart
from mechwright.contracts.part import Part
from mechwright.pipeline import Build
from mechwright.pipeline.process import Process, Spread, process_of


class Cut(Process):
    """What processes that cut through have in common."""

    name = ""
    title = ""

    def refuses(self, part: Part, build: Build) -> str | None:
        """Recesses, materials that must not be cut, thickness, shapes that overlap."""
        from mechwright_cut.rules.part_rules import refused
        from mechwright_cut.settings.cut_settings import SERVICE
        from mechwright_cut.settings.cut_table import cut_settings

        settings = cut_settings(build.design)
        kind = settings.kind(self.name, part.material)
        return refused(part, kind, settings, service=self.name == SERVICE)

    def objections(self, part: Part, build: Build) -> Sequence[Finding]:
        """A kerf that no table has; holes, webs, corners and fits."""
        from mechwright_cut.cutting import Cutting

        return build.made(Cutting).rules_of(self.name, part)

    def loses(self, part: Part, build: Build) -> Sequence[str]:
        """Fits that it does not hold, holes to drill, corners, its tolerance, and the taper."""
        from mechwright_cut.cutting import Cutting

        return build.made(Cutting).losses_of(self.name, part)

    def spread(self, part: Part, build: Build) -> Spread:
        """Its tolerance and taper."""
        from mechwright_cut.settings.cut_table import cut_settings

        process = cut_settings(build.design).kind(self.name, part.material)
        return Spread(process.size, process.taper)

    def produced(self, part: Part, build: Build) -> Sequence[MadePart]:
        """The walls of the text, or of the drawing for a service, and the taper."""
        from mechwright_cut.as_cut import plates_as_cut

        return build.made(plates_as_cut).get(part.name, ())

    by_material = True
    untimed = "by cut.feed"

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:
        """The kerf: what stays on a wall is half of what it is narrower than it was taken for."""
        from mechwright_cut.cutting import Cutting

        cutting = build.made(Cutting)
        kind = cutting.settings.kind(self.name, part.material)
        kerf = cutting.kerf(kind, part)
        if kerf is None or kerf.width - 2 * off <= 0:
            return super().correction(off, walls, part, build)
        wide = f"{kerf.width - 2 * off:.4f}"
        which = "" if walls == "all" else f", as {walls} walls have it"
        if cutting.settings.kerf is not None:
            return f"set kerf = {wide} in [cut]{which} (now {kerf.width:g})"
        rows = [
            f'{{ process = "{one.process}", material = "{one.material}", thickness = {one.thickness:g}, '
            f"kerf = {one.kerf:g} }}"
            for one in cutting.settings.kerfs
            if (one.process, one.material, one.thickness) != (kind.name, part.material, part.thickness)
        ]
        rows.append(
            f'{{ process = "{kind.name}", material = "{part.material}", thickness = {part.thickness:g}, '
            f"kerf = {wide} }}"
        )
        return f"set kerfs = [{', '.join(rows)}] in [cut]{which} (now {kerf.width:g})"

    def seconds(self, part: Part, build: Build) -> float | None:
        """The way around outside and openings at the feed, as often as it is run, and the pierces.

        Nobody knows the feed of a process that the design has not chosen, unless its file gives one.
        """
        from mechwright_cut.settings.cut_table import cut_settings

        settings = cut_settings(build.design)
        known = "feed" in settings.model_fields_set or process_of(build.design, part.name) == self.name
        if part.outline is None or not known:
            return None
        way = float(part.outline.polygon().length)
        pierces = len(part.outline.loops) * settings.pierce
        return settings.passes * (60 * way / settings.feed + pierces)


class Laser(Cut):
    """By ``cut.laser``: CO2, diode or fibre."""

    name = "laser"
    title = "laser cutting"


class Waterjet(Cut):
    """By a jet of water with grit."""

    name = "waterjet"
    title = "waterjet cutting"


class Plasma(Cut):
    """By an arc: blanks, whose bores are drilled."""

    name = "plasma"
    title = "plasma cutting"


class Wire(Cut):
    """By wire erosion."""

    name = "wire"
    title = "wire erosion"

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:
        """The registers of the wire, by which its middle stands off the wall."""
        from mechwright_cut.cutting import Cutting

        cutting = build.made(Cutting)
        kerf = cutting.kerf(cutting.settings.kind(self.name, part.material), part)
        if kerf is None:
            return super().correction(off, walls, part, build)
        before = cutting.settings.registers(kerf.width)
        after = ", ".join(f"{one - off:.4f}" for one in before)
        which = "" if walls == "all" else f", as {walls} walls have it"
        return f"set offsets = [{after}] in [cut]{which} (now {', '.join(f'{one:g}' for one in before)})"

    untimed = "by cut.wire_rate"

    def seconds(self, part: Part, build: Build) -> float | None:
        """The area of the walls at the rate of the machine, as often as it is run.

        No public table gives the rate: thickness, wire and the generator's conditions decide it.
        """
        from mechwright_cut.settings.cut_table import cut_settings

        settings = cut_settings(build.design)
        if part.outline is None or settings.wire_rate is None:
            return None
        walls = float(part.outline.polygon().length) * part.thickness
        return 60 * settings.passes * walls / settings.wire_rate


class Service(Cut):
    """By a service, which gets drawings."""

    name = "service"
    title = "a cutting service"

    def correction(self, off: float, walls: str, part: Part, build: Build) -> str:  # noqa: ARG002
        """Services allow for their kerf, or have one that is known: it is theirs to correct."""
        which = "" if walls == "all" else f" on {walls} walls"
        more = "left" if off > 0 else "cut off"
        return f"write to the service that {abs(off):.4f} mm too much is {more}{which}"

    untimed = "by the service"

    def seconds(self, part: Part, build: Build) -> float | None:  # noqa: ARG002
        """None: what counts is the service's lead time, which is no time of a machine."""
        return None

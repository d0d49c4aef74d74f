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
        """The walls of the text, and the taper; nothing of a service."""
        from mechwright_cut.as_cut import plates_as_cut

        return build.made(plates_as_cut).get(part.name, ())

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

    def seconds(self, part: Part, build: Build) -> float | None:  # noqa: ARG002
        """The generator's conditions decide, and nobody here knows them."""
        return None


class Service(Cut):
    """By a service, which gets drawings."""

    name = "service"
    title = "a cutting service"

    def seconds(self, part: Part, build: Build) -> float | None:  # noqa: ARG002
        """Nobody here knows."""
        return None

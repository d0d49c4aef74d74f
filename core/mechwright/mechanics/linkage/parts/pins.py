"""Pins in the plates of one scheme: what each is pressed into, and what turns or slides on it."""

from collections.abc import Mapping
from dataclasses import dataclass

from mechwright.errors import GeometryError
from mechwright.mechanics.linkage import Spindle
from mechwright.mechanics.linkage.clamp import Clamp
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import Axis
from mechwright.mechanics.linkage.parts.scheme import UPPER, Scheme
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.linkage.parts.slides import Guided
from mechwright.mechanics.linkage.turned import HEAD, SHAFT
from mechwright.mechanics.planar.dynamics import GROUND


@dataclass(frozen=True)
class Pin:
    """A pin or shaft.

    Parameters
    ----------
    name
        Of its part.
    body
        The link into which it is pressed.
    places
        Link to the place of its axis in it, x + i y, mm; that link among them.
    pressed
        Plates into which it is pressed.
    turning
        Plates that turn on it, each with its link.
    rolling
        Plates in whose slots it runs, each with the link that moves as its roller does.
    eye
        Name of its eye in the links.
    head, foot
        Whether it has a head on top, and one below its lowest plate.
    below, above
        How far it goes on under its lowest plate and over its highest one, in pin diameters.
    number
        Of a guide pin, 1 or 2; of others 0.
    clamp
        Of a stud that is clamped in a slot of its body and turns in the other plate; None of a pin that is
        pressed in.
    """

    name: str
    body: str
    places: Mapping[str, complex]
    pressed: tuple[str, ...]
    turning: tuple[tuple[str, str], ...]
    rolling: tuple[tuple[str, str], ...]
    eye: str
    head: bool = False
    foot: bool = False
    below: float = 0.0
    above: float = 0.0
    number: int = 0
    clamp: Clamp | None = None

    @property
    def place(self) -> complex:
        """Its axis in the link that holds it."""
        return self.places[self.body]

    @property
    def tag(self) -> str:
        """What its frames are named after: its eye, and of guide pins the number."""
        return f"{self.eye}-{self.number}".lower() if self.number else self.eye.lower()

    @property
    def plates(self) -> tuple[str, ...]:
        """All plates that it joins."""
        return (*self.pressed, *(one for one, _ in self.turning), *(one for one, _ in self.rolling))

    def spindle(self, sizes: Sizes) -> Spindle:
        """What keeps plates off it; what goes on above its plates covers others as a head does."""
        radius = sizes.pin_diameter / 2
        over = HEAD * radius if self.head else radius if self.above else 0.0
        body = self.body
        if self.clamp is not None:  # in other phases it is elsewhere in the slot
            over, body = self.clamp.reach, self.turning[0][1]
        return Spindle(self.name, body, self.places[body], radius, self.plates, over)


def pins_of(
    linkage: Linkage, axes: tuple[Axis, ...], guided: tuple[Guided, ...], scheme: Scheme
) -> list[Pin]:
    """All pins, without heads; raises GeometryError for two of one name."""
    found = [_pin(linkage, axis, scheme) for axis in axes]
    for one in guided:
        slide = one.slide
        for count, place in enumerate(one.pins, start=1):
            slots = scheme.plates(slide.guide, slide.name)
            found.append(
                Pin(
                    f"pin-{slide.name.lower()}-{count}",
                    slide.block,
                    {slide.block: place},
                    scheme.plates(slide.block, slide.name),
                    (),
                    tuple((plate, slide.block) for plate in slots),
                    slide.name,
                    number=count,
                )
            )
    names = [one.name for one in found]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise GeometryError(f"two pins are named {twice}; give their points names that differ in lower case")
    return found


def _pin(linkage: Linkage, axis: Axis, scheme: Scheme) -> Pin:
    body = _body(axis, scheme)
    point = axis.point.lower()
    turning = tuple(
        (plate, link) for link in axis.places if link != body for plate in scheme.plates(link, axis.point)
    )
    rolling = tuple(
        (plate, block)
        for block, slide in axis.rollers.items()
        for plate in scheme.plates(slide.guide if block == slide.block else slide.block, slide.name)
    )
    turns_above = any(plate == UPPER for plate, _ in turning) and not axis.shaft
    output = turns_above and body == linkage.output
    return Pin(
        "shaft" if axis.shaft else f"shaft-{point}" if output else f"pin-{point}",
        body,
        axis.places,
        scheme.plates(body, axis.point),
        turning,
        rolling,
        axis.point,
        below=SHAFT if axis.shaft else 0.0,
        above=SHAFT if output else 0.0,
    )


def _body(axis: Axis, scheme: Scheme) -> str:
    """The link that holds a pin."""
    split = scheme.split
    if axis.shaft:
        return axis.holder
    if split is not None and split.shared == axis.point and split.link in axis.places:
        return split.link
    if GROUND not in axis.places:
        return axis.holder
    alone = len(axis.places) == 2
    return axis.holder if alone and scheme.plates(GROUND, axis.point) == (UPPER,) else GROUND

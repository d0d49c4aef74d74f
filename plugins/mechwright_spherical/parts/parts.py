"""The parts of a design: links and pins as solids, base plate and flat strips as plates."""

import math
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache, partial
from typing import TYPE_CHECKING

from mechwright import Colour, Instance, Part, Step, Turned
from mechwright.contracts.free_form import FormBore, FreeForm
from mechwright.contracts.holes import threaded
from mechwright.mechanics.linkage.clamp import screw_parts, stud_part
from mechwright_spherical.kinematics.drive import Train, train_of
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.axis_parts import axis_parts, pin_frames
from mechwright_spherical.parts.bores import coupler_bores, gear_bore, ground_bores, link_bores
from mechwright_spherical.parts.drawn import free_form
from mechwright_spherical.parts.flat import strip, strip_outline
from mechwright_spherical.parts.frame import ground_arcs, shells_of
from mechwright_spherical.parts.mount import hubs_of, thread_of
from mechwright_spherical.parts.places import gear_cones, link_arcs, pin_places, second_size, tool_of
from mechwright_spherical.parts.seats import clamp_of, head_of, slotted_of, stud_length
from mechwright_spherical.parts.shells import Shells
from mechwright_spherical.parts.stand import FLANGE_SCREWS, MOUNTING_SCREWS, base_outline
from mechwright_spherical.rules.stand import makes_strips

if TYPE_CHECKING:
    import cadquery as cq

COLOURS: dict[str, Colour] = {
    "ground": (0.55, 0.58, 0.62),
    "base": (0.45, 0.48, 0.52),
    "crank": (0.80, 0.30, 0.25),
    "rocker": (0.25, 0.50, 0.75),
    "arm": (0.90, 0.65, 0.20),
    "coupler": (0.35, 0.65, 0.40),
    "pin": (0.82, 0.82, 0.84),
    "gear": (0.75, 0.68, 0.45),
    "flat": (0.70, 0.70, 0.72),
}


def parts_of(params: SphericalParams) -> tuple[Part, ...]:
    """All parts; those of the phase that is shown stand in the assembly."""
    linkage, shells = linkage_of(params), shells_of(params)
    train = train_of(linkage, params.drive)
    return (
        *_links(params, linkage, shells, train),
        *_pins(params, shells),
        *_clamps(params, shells),
        *axis_parts(params),
        *_plates(params, linkage, shells),
    )


def _solid(
    name: str, params: SphericalParams, body: str, kind: str, form: FreeForm, *, shown: bool = True
) -> Part:
    hardware = params.hardware
    return Part(
        name,
        None,
        0.0,
        hardware.pin_material if kind == "gear" else hardware.material,
        instances=(Instance(body),) if shown else (),
        colour=COLOURS[kind],
        free_form=form,
        vacant=_vacant(form),
    )


def _vacant(form: FreeForm) -> tuple[str, ...]:
    """Bores of the coupler that are places of one pin: it is in one of them."""
    return tuple(one.name for one in form.bores if one.name[:2] in {"a-", "c-"})


def shape_of(params: SphericalParams) -> SphericalParams:
    """The design without what changes no solid, so that designs alike in shape share their solids.

    A machine has the same ones in every phase that it is set to.
    """
    fields = type(params).model_fields
    idle = ("speed", "path_tolerance", "least_transmission", "flat")
    first = {name: getattr(params, name).model_copy(update={"phase": 1}) for name in ("four_bar", "five_bar")}
    return params.model_copy(update={name: fields[name].default for name in idle} | first)


@lru_cache(maxsize=512)
def _builder(shape: SphericalParams, name: str) -> "Callable[[], cq.Solid]":
    """What builds a solid: the same for designs alike in shape, so that their parts are equal."""
    return partial(_build, shape, name)


def _build(params: SphericalParams, name: str) -> "cq.Solid":
    # The kernel is imported when a solid is wanted.
    from mechwright_spherical.parts import links

    return links.body(params, name)


def _links(params: SphericalParams, linkage: Linkage, shells: Shells, train: Train | None) -> Iterator[Part]:
    shape, other = shape_of(params), second_size(linkage, shells)
    second = linkage.shown.number == 2

    def form(name: str, bores: Iterable[FormBore]) -> FreeForm:
        return free_form(params, name, _builder(shape, name), tuple(bores))

    bores = ground_bores(shape, shells, linkage, train)
    yield _solid("ground", params, "ground", "ground", form("ground", bores))
    for name, angle in link_arcs(linkage).items():
        if name == "ground":
            continue
        own = form(name, link_bores(params, shells, name, angle))
        yield _solid(name, params, name, name, own, shown=not (second and name in other))
        if name in other:
            own = form(f"{name}-n", link_bores(params, shells, name, other[name]))
            yield _solid(f"{name}-n", params, name, name, own, shown=second)
    bores = coupler_bores(params, shells, linkage)
    yield _solid("coupler", params, "coupler", "coupler", form("coupler", bores))
    if train is not None:
        for name, (body, _) in gear_cones(train).items():
            own = form(name, [gear_bore(params, shells, train, name)])
            yield _solid(name, params, body, "gear", own)


def _pins(params: SphericalParams, shells: Shells) -> Iterator[Part]:
    hardware, spans, frames = params.hardware, shells.pins, pin_frames(params)
    diameter, steel = hardware.pin_diameter, hardware.pin_material
    loose = {f"shaft-{name}" for name in hubs_of(params)}
    keys = {name: span for name, (span, _, _) in pin_places(params).items() if name not in loose}
    for name, span in keys.items():
        low, high = spans[span]
        at = (Instance(name, low),) if name in frames else ()
        turned = Turned((Step(diameter, high - low),))
        yield Part(name, None, 0.0, steel, at, COLOURS["pin"], turned=turned)
    form, at = tool_of(params, shells), (Instance("tool", spans["tool"][0]),)
    # A tip that is longer than the standoff begins in the coupler's bore.
    free = max(form.steps[0].length - hardware.standoff, 0.0)
    yield Part("tool", None, 0.0, steel, at, COLOURS["pin"], turned=form, play=free)


def _clamps(params: SphericalParams, shells: Shells) -> Iterator[Part]:
    """Studs in slots with their screws and washers, which come from inside the coupler."""
    clamp = clamp_of(params)
    if clamp is None:
        return
    (inner, outer), head = shells.links["coupler"], head_of(params)
    names = slotted_of(params)
    seat = math.sqrt(
        inner**2 - (clamp.washer[0] / 2) ** 2
    )  # a washer lies on its rim in the hollow of the coupler
    for name in names:
        at = Instance(f"coupler-{name}", -(outer + stud_length(params) + head[1]))
        yield stud_part(f"pin-{name}", params.hardware.pin_diameter, stud_length(params), head, clamp, at)
    yield from screw_parts("clamp", clamp, [Instance(f"coupler-{name}", -seat) for name in names])


def _plates(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Part]:
    hardware, stand, flat = params.hardware, params.stand, params.flat
    thread = None if stand.motor_flange is None else thread_of(stand)
    base = Part(
        "base",
        base_outline(stand, thread or stand.screw),
        stand.plate_thickness,
        hardware.material,
        instances=(Instance("base"),),
        colour=COLOURS["base"],
    )
    if thread is not None:
        for number in range(1, len(FLANGE_SCREWS) + len(MOUNTING_SCREWS) + 1):
            base = threaded(base, f"bore-{number}", f"M{thread:g}")
    yield base
    if not makes_strips(params):
        return
    arcs = link_arcs(linkage) | ground_arcs(params)
    arcs |= {f"{n}-n": a for n, a in second_size(linkage, shells).items()}
    arcs |= {
        f"coupler{f'-{phase.mark}' if phase.mark else ''}": math.acos(float(phase.loop.ca))
        for phase in linkage.phases
    }
    for name, angle in arcs.items():
        radius = shells.arc("coupler" if name.startswith("coupler") else name.removesuffix("-n"))[0]
        outline = strip_outline(
            strip(angle, radius, flat), hardware.boss_diameter, hardware.pin_diameter + hardware.fit
        )
        yield Part(f"flat-{name}", outline, flat.thickness, hardware.material, colour=COLOURS["flat"])

"""What an engineer would object to in a cam, and the figures worth knowing.

Each group needs what the groups before it have found to be sound.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from mechwright import Finding, Severity, Stage, at_stage, kept, material, until_error
from mechwright.contracts.finding import errors
from mechwright.mechanics.strength.allowed import allowed
from mechwright.tolerances import exceeds
from mechwright_cam_follower.closure import closure_findings
from mechwright_cam_follower.cures import base_for, offset_for, roller_for
from mechwright_cam_follower.extremes import (
    Extremes,
    extremes_of,
    face_of,
    greatest,
    regular_limit,
    weakest_of,
)
from mechwright_cam_follower.gentler import gentler
from mechwright_cam_follower.loads import preload_needed, rate_needed, spring_of
from mechwright_cam_follower.motion import loaded
from mechwright_cam_follower.params import CamParams
from mechwright_cam_follower.usual import DECIDES
from mechwright_cam_follower.walls import wall_findings


@kept
def findings(params: CamParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design."""
    found = closure_findings(params)
    if errors(found):
        more = () if params.translating else gentler(params)
        return tuple(replace(one, proposed=(*one.proposed, *more)) for one in found)
    return (*found, *at_stage(Stage.PARTS, until_error(params, _undercut, wall_findings, _pressed, _figures)))


def seen(params: CamParams) -> Iterator[tuple[str, Extremes]]:
    """Each cam by its name."""
    yield "cam", extremes_of(params)
    if params.conjugate:
        yield "cam 2", extremes_of(params, second=True)


def _undercut(params: CamParams) -> Iterator[Finding]:
    for name, found in seen(params):
        limit = regular_limit(params)
        if not found.regular.value < limit:
            continue
        roller = params.contact == "roller"
        cures = list(
            filter(None, (base_for(params), *((roller_for(params), offset_for(params)) if roller else ())))
        )
        said = [f"{key} = {value:g}" for key, value in cures]
        at = math.degrees(found.regular.angle)
        what = (
            f"the pitch curve of {name} has a radius of {_pitch(params, found):.4g} mm"
            if roller
            else f"{name} has a radius of curvature of {found.regular.value:.4g} mm"
        )
        need = (
            f", and the roller {params.value('roller_radius'):g}" if roller else ", which no flat face makes"
        )
        yield Finding.error(
            "follower.undercut",
            "base_radius",
            f"{what} at {at:.1f} degrees{need}: the cam is undercut",
            found.regular.value,
            limit,
            "" if roller else "mm",
            f"set {' or '.join(said)}" if said else "use longer angles, or smaller lifts",
            proposed=tuple({f"parameters.{key}": value} for key, value in cures) or gentler(params),
        )
        return


def _pitch(params: CamParams, found: Extremes) -> float:
    """ρ of the pitch curve from its regularity, mm."""
    return params.value("roller_radius") / (1 - found.regular.value)


def _pressed(params: CamParams) -> Iterator[Finding]:
    yield from _pressure_angle(params)
    yield from _spring(params)
    yield from _hertz(params)


def _pressure_angle(params: CamParams) -> Iterator[Finding]:
    for name, found in seen(params):
        angle = math.degrees(found.pressure.value)
        if not exceeds(angle, params.steepest):
            continue
        cures = [one for one in (base_for(params, steep=True), offset_for(params, steep=True)) if one]
        said = [f"{key} = {value:g}" for key, value in cures]
        yield Finding.warning(
            "follower.pressure-angle",
            "base_radius",
            f"the pressure angle of {name} reaches {angle:.1f} degrees at "
            f"{math.degrees(found.pressure.angle):.1f} degrees of the cam, above {params.steepest:g}",
            angle,
            params.steepest,
            "deg",
            f"set {' or '.join(said)}"
            if said
            else "use longer angles, smaller lifts, or another place of the follower",
            proposed=tuple({f"parameters.{key}": value} for key, value in cures)
            or gentler(params, steep=True),
        )
        return


def _spring(params: CamParams) -> Iterator[Finding]:
    if params.conjugate:
        return
    weakest, unit = weakest_of(params), "N" if params.translating else "N*m"
    if weakest.value > 0:
        return
    names = ("spring_preload", "spring_rate") if params.translating else ("spring_torque", "spring_stiffness")
    needs = (
        greatest(params, lambda rates: preload_needed(params, rates)).value,
        greatest(params, lambda rates: rate_needed(params, rates)).value,
    )
    cures = [(name, _up(need)) for name, need in zip(names, needs, strict=True) if math.isfinite(need)]
    # The rate does nothing at the lowest place.
    cures = [one for one in cures if weakest_of(params.model_copy(update=dict([one]))).value > 0]
    yield Finding.warning(
        "follower.contact",
        names[0],
        f"the follower leaves its cam at {math.degrees(weakest.angle):.1f} degrees: {-weakest.value:.4g} "
        f"{unit} are missing that hold it",
        weakest.value,
        0.0,
        unit,
        f"set {' or '.join(f'{name} = {value:g}' for name, value in cures)}, or turn slower",
        proposed=tuple({f"parameters.{name}": value} for name, value in cures),
    )


def _up(value: float) -> float:
    """A tenth more, to three digits upwards.

    >>> _up(100.0), _up(0.0123)
    (111.0, 0.0136)
    """
    step = 10.0 ** (math.floor(math.log10(1.1 * value)) - 2) if value > 0 else 1.0
    return float(f"{(math.floor(1.1 * value / step) + 1) * step:.6g}")


def _hertz(params: CamParams) -> Iterator[Finding]:
    pressure = loaded(params)["contact_pressure_max"]
    names = (params.material, params.roller_material if params.contact == "roller" else params.material)
    limit = min(allowed(material(name).name).contact for name in names)
    if exceeds(pressure.value, limit):
        thick = math.ceil(params.thickness * (pressure.value / limit) ** 2 * 10) / 10
        yield Finding.warning(
            "follower.contact-pressure",
            "thickness",
            f"the contact pressure reaches {pressure.value:.0f} MPa at {math.degrees(pressure.angle):.1f} "
            f"degrees, above {limit:g} of {' on '.join(dict.fromkeys(names))}",
            pressure.value,
            limit,
            "MPa",
            f"set thickness = {thick:g}, a larger roller, or a softer spring",
            proposed=({"parameters.thickness": thick},),
        )


def _figures(params: CamParams) -> Iterator[Finding]:
    smaller = [
        f"{name} = {getattr(params, name):g}"
        for name, field in CamParams.model_fields.items()
        if name in DECIDES and name not in params.model_fields_set and getattr(params, name) < field.default
    ]
    if smaller:
        yield Finding.note(
            "follower.fitted", f"left out, and smaller than usual so that walls stay: {', '.join(smaller)}"
        )
    for name, found in seen(params):
        yield Finding.note(
            "follower.size",
            f"{name}: radius {found.innermost.value:.3f} to {found.outermost.value:.3f} mm, pressure angle "
            f"up to {math.degrees(found.pressure.value):.2f} degrees "
            f"at {math.degrees(found.pressure.angle):.1f}"
            + (
                f", sharpest radius {found.sharpest.value:.3f} mm at {math.degrees(found.sharpest.angle):.1f}"
                if math.isfinite(found.sharpest.value)
                else ""
            ),
            found.outermost.value,
            "mm",
        )
    if params.contact == "flat":
        low, high = face_of(params)
        yield Finding.note(
            "follower.face",
            f"the face is touched from {low:.3f} to {high:.3f} mm: {high - low:.3f} mm of it",
            high - low,
            "mm",
        )
    if not params.conjugate:
        yield from _held(params)
    most = loaded(params)
    yield Finding.note(
        "follower.loads",
        f"contact force up to {most['contact_force_max'].value:.4g} N and contact pressure up to "
        f"{most['contact_pressure_max'].value:.4g} MPa; camshaft torque up to "
        f"{most['torque_max'].value:.4g} N·m at {math.degrees(most['torque_max'].angle):.1f} degrees",
        most["torque_max"].value,
        "N*m",
    )


def _held(params: CamParams) -> Iterator[Finding]:
    weakest, (preload, _, _) = weakest_of(params), spring_of(params)
    unit = "N" if params.translating else "N·m"
    need = max(0.0, greatest(params, lambda rates: preload_needed(params, rates)).value)
    yield Finding(
        "follower.preload",
        Severity.NOTE,
        "",
        f"the follower is held with at least {weakest.value:.4g} {unit}, at "
        f"{math.degrees(weakest.angle):.1f} degrees; of the preload of {preload:g} {unit} it needs "
        f"{need:.4g}",
        weakest.value,
        unit="N" if params.translating else "N*m",
    )

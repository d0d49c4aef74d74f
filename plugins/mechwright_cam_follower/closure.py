"""Whether a follower reaches its cam all the way, and whether its laws are laws: errors of the motion."""

import math
from collections.abc import Iterator

from mechwright import Finding, Severity, until_error
from mechwright.contracts.finding import Change
from mechwright.mechanics.laws.faults import LawFault, polynomial_faults, table_faults
from mechwright_cam_follower.params import CamParams

FLATTEST = math.radians(2)
"""Least angle between arm and line of centres: nearer to it the lever does not know which way to go."""


def closure_findings(params: CamParams) -> tuple[Finding, ...]:
    """Everything that keeps the follower from moving."""
    return until_error(params, law_findings, _slide if params.translating else _lever)


def law_findings(params: CamParams) -> Iterator[Finding]:
    """Errors of a table or a polynomial that is no law."""
    faults: list[tuple[str, LawFault]] = []
    if params.polynomial is not None:
        faults += [("polynomial", fault) for fault in polynomial_faults(params.polynomial)]
    if params.table is not None:
        faults += [("table", fault) for fault in table_faults(params.table)]
    for name, fault in faults:
        changes = tuple(_laws_instead(params, name))
        yield Finding.error(
            f"follower.law-{fault.kind}",
            name,
            fault.message,
            fault.value,
            fault.limit,
            "",
            f"{fault.remedy}, or take the nearest law that is one, as proposed" if changes else fault.remedy,
            proposed=changes,
        )


def _laws_instead(params: CamParams, name: str) -> Iterator[Change]:
    """Laws near to a table or polynomial that is none, the nearest first."""
    from mechwright.mechanics.laws.mended import instead, rows_of

    rows = params.table if name == "table" else rows_of(params.polynomial or ())
    for law, table in instead(rows or ()):
        laws = [law if one == name else one for one in params.laws]
        if law != "table":
            yield {f"parameters.{name}": None, "parameters.laws": laws}
        elif params.table is None or name == "table":
            change: Change = {"parameters.table": [list(row) for row in table or ()]}
            yield (
                change
                if name == "table"
                else {
                    **change,
                    f"parameters.{name}": None,
                    "parameters.laws": laws,
                }
            )


def _slide(params: CamParams) -> Iterator[Finding]:
    if params.contact == "flat":
        return
    prime, offset = params.base_radius + params.value("roller_radius"), abs(params.value("offset"))
    if offset >= prime * REACH:
        most = math.floor(prime * REACH * 10) / 10
        yield Finding.error(
            "follower.offset",
            "offset",
            f"a follower {offset:g} mm off the axis misses the prime circle of {prime:g} mm",
            offset,
            prime * REACH,
            "mm",
            f"make it at most {most:g}, or base_radius larger",
            proposed=({"parameters.offset": math.copysign(most, params.value("offset"))},),
        )


REACH = 0.95
"""Greatest offset, in radii of the prime circle: beyond it the follower hardly rises."""


def _lever(params: CamParams) -> Iterator[Finding]:
    yield from _flat_lever(params) if params.contact == "flat" else _roller_lever(params)


def _roller_lever(params: CamParams) -> Iterator[Finding]:
    axis, arm = params.value("centre_distance"), params.value("arm_length")
    prime = params.base_radius + params.value("roller_radius")
    least, most = abs(axis - arm), axis + arm
    if not least < prime < most:
        near = math.sqrt(abs(axis**2 - prime**2)) if axis > prime else axis
        yield Finding.error(
            "follower.arm",
            "arm_length",
            f"an arm of {arm:g} mm, {axis:g} mm off the cam's axis, does not reach the prime circle of "
            f"{prime:g} mm",
            prime,
            least if prime <= least else most,
            "mm",
            f"make arm_length about {near:.4g}: the roller's circle has to cut the prime circle",
            proposed=({"parameters.arm_length": float(f"{near:.4g}")},),
        )
        return
    start = math.acos((axis**2 + arm**2 - prime**2) / (2 * axis * arm))
    last = start + math.radians(params.stroke)
    if start < FLATTEST or last > math.pi - FLATTEST:
        yield _swing(
            params,
            math.degrees(min(start, math.pi - last)),
            "a shorter swing, or arms as long as the cam's axis is away",
        )


def _flat_lever(params: CamParams) -> Iterator[Finding]:
    axis, high = params.value("centre_distance"), params.base_radius + params.face
    if high >= axis * math.cos(FLATTEST):
        need = math.ceil(high / math.cos(FLATTEST) * 1.05)
        yield Finding.error(
            "follower.axis",
            "centre_distance",
            f"the lever's axis, {axis:g} mm off the cam's, stands within base circle and face, {high:g} mm",
            axis,
            high,
            "mm",
            f"make centre_distance {need:g}, or base_radius smaller",
            proposed=({"parameters.centre_distance": float(need)},),
        )
        return
    last = math.acos(high / axis) - math.radians(params.stroke)
    if last < FLATTEST:
        yield _swing(params, math.degrees(last), "a shorter swing, or a larger centre_distance")


def _swing(params: CamParams, left: float, cure: str) -> Finding:
    return Finding(
        "follower.swing",
        Severity.ERROR,
        "swings" if params.swings is not None else "centre_distance",
        f"at {params.stroke:g} degrees of swing the lever comes within {left:.3g} degrees of the line of "
        "centres",
        left,
        math.degrees(FLATTEST),
        "deg",
        f"use {cure}",
    )

"""Remedies that are tried on the design: the least base radius, the largest roller, the best offset."""

import math
from dataclasses import replace

import numpy as np

from mechwright import Array, Finding, Severity, Stage, kept
from mechwright.contracts.design_rule import Bools
from mechwright_cam_follower.kinematics.extremes import of_cams, pressure_peak
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.rules.gentler_motion import gentler
from mechwright_cam_follower.rules.validity import bisected, first_good, is_valid, with_values

_LARGEST, _STEP = 1000.0, 1.5
"""Of a base radius, mm, as the design table has it; and the ratio of those that are tried."""
_ROUND = 100.0
"""Remedies are named in hundredths of a millimetre."""
_OFFSETS = 41
"""Offsets that are tried over half the prime circle to either side."""

Remedy = tuple[str, float]
"""A parameter, and the value that helps."""


def with_remedy(params: CamParams, finding: Finding) -> Finding:
    """Give an error of a lever's motion with gentler motions that have been tried."""
    if params.translating or finding.severity is not Severity.ERROR or finding.stage is not Stage.MOTION:
        return finding
    return replace(finding, proposed=(*finding.proposed, *gentler(params)))


def sizes_for(params: CamParams, *, steep: bool) -> list[Remedy]:
    """Give single sizes that help a cam that is undercut, or ``steep``."""
    found = [base_for(params, steep=steep)]
    if params.contact == "roller" and not steep:
        found.append(roller_for(params))
    return [one for one in (*found, offset_for(params, steep=steep)) if one]


@kept
def base_for(params: CamParams, *, steep: bool = False) -> Remedy | None:
    """The least base radius above the present one that helps; None if none does."""

    def good(values: Array) -> Bools:
        return is_valid(with_values(params, base_radius=values), steep=steep)

    ladder = [params.base_radius]
    while ladder[-1] * _STEP <= _LARGEST:
        ladder.append(ladder[-1] * _STEP)
    ends = first_good(good, ladder)
    return None if ends is None else ("base_radius", math.ceil(bisected(good, *ends) * _ROUND) / _ROUND)


@kept
def roller_for(params: CamParams) -> Remedy | None:
    """The largest roller below the present one that is not undercut; None if not even 1 mm is."""

    def good(values: Array) -> Bools:
        return is_valid(with_values(params, roller_radius=values), steep=False)

    if not good(np.ones(1)).any():
        return None
    return "roller_radius", math.floor(bisected(good, params.value("roller_radius"), 1.0) * _ROUND) / _ROUND


@kept
def offset_for(params: CamParams, *, steep: bool = False) -> Remedy | None:
    """The offset of a slide with the least pressure angle, if it helps; None if it does not."""
    if not params.translating or params.contact == "flat":
        return None
    reach = (params.base_radius + params.value("roller_radius")) / 2
    offsets = np.round(np.linspace(-reach, reach, _OFFSETS), 2)
    m: Mechanism = with_values(params, offset=offsets)
    fits = np.flatnonzero(is_valid(m, steep=steep))
    if not fits.size:
        return None
    angles = of_cams(m.rows(fits), pressure_peak).max(axis=1)
    return "offset", offsets[fits[np.argmin(angles)]].item()

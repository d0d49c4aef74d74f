"""What annotations of contracts ask of findings, motions and parts beyond their kinds."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Any

import numpy as np

from mechwright.contracts.declared import Declared, refuse
from mechwright.contracts.evaluation import Columns
from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Part
from mechwright.contracts.surroundings import Surroundings
from mechwright.errors import GeometryError

LEAST, GREATEST = 0.01, 100_000.0
"""Sizes of a part, mm: below it is no thing that is made, above it a length in wrong units."""

TURNED = 1e-6
"""How far a rotation may be off an orthogonal one: rounding over some turns is a thousandth of it."""


_STRICT = Declared(leave=(Poses,))
"""Poses may be worked out as they are asked for, and have a check of their own."""


def _hold_findings(found: Sequence[Finding], *_: object) -> None:
    for one in found:
        if any(x != x for x in (one.value, one.limit)):
            raise UnsoundError(f"the finding {one.code!r} has a figure that is not a number")
    refuse(_STRICT.fault(found, Sequence[Finding]))


def _hold_motion(answer: Motion, _: object = None, samples: int | None = None) -> None:
    if samples not in {None, answer.samples}:
        raise UnsoundError(f"gives {answer.samples} samples; {samples} are asked for")
    for name, channel in answer.channels.items():
        _numbers(channel.values, f"channel {name!r}")
    for name, scalar in answer.scalars.items():
        _numbers(np.asarray(scalar.value), f"figure {name!r}")
    for body, poses in answer.poses.items():
        _poses(poses, body)
        far = max(np.abs(np.asarray(values)).max(initial=0.0) for values in poses.given[:2])
        if far > GREATEST:
            raise UnsoundError(
                f"body {body!r} is {far:.3g} mm away from the origin; the limit is {GREATEST:,.0f} mm"
            )
    refuse(_STRICT.fault(answer, Motion))


def _numbers(values: Any, what: str) -> None:
    if values.dtype.kind not in "fiu":
        raise UnsoundError(f"{what} is of the type {values.dtype}; real numbers are wanted")
    bad = ~np.isfinite(values)
    if bad.any():
        first = int(np.argmax(bad))
        raise UnsoundError(
            f"{what} is {np.ravel(values)[first]} at sample {first}; a motion has finite numbers alone"
        )


def _poses(poses: Poses, body: str) -> None:
    for values in poses.given:
        _numbers(np.asarray(values), f"the pose of body {body!r}")
    if type(poses) is not Poses:
        return  # it makes its rotations itself
    error = np.abs(np.einsum("nij,nkj->nik", poses.rotation, poses.rotation) - np.eye(3)).max()
    if not error <= TURNED:
        raise UnsoundError(f"the rotations of body {body!r} are no rotations: off by {error:.3g}")


def _hold_parts(found: Sequence[Part], *_: object) -> None:
    """Parts that can be made, of names of their own."""
    refuse(_STRICT.fault(found, Sequence[Part]))
    names = [part.name for part in found]
    for part in found:
        for fault in _faults(part):
            raise UnsoundError(f"part {part.name!r}{fault}")
        if names.count(part.name) > 1:
            raise UnsoundError(f"two parts are called {part.name!r}; each has files of its name")


def _faults(part: Part) -> Iterator[str]:
    """Why a part cannot be made, or stands nowhere, in words that follow its name."""
    for outline in part.outlines:
        x0, y0, x1, y1 = outline.bounds
        for size, what in ((x1 - x0, "wide"), (y1 - y0, "high"), (part.thickness, "thick")):
            if not LEAST <= size <= GREATEST:
                yield f" is {size:.3g} mm {what}; a part has {LEAST:g} to {GREATEST:,.0f} mm"
        try:
            outline.polygon()
        except GeometryError as error:
            yield f": {error}"
    if part.kind in {"plate", "turned"} and part.material not in MATERIALS:
        yield f" is of {part.material!r}; materials are {', '.join(sorted(MATERIALS))}"
    for colour in (part.colour, *(one.colour for one in part.instances if one.colour is not None)):
        if not all(0 <= share <= 1 for share in colour):
            yield f" has the colour {colour}; red, green and blue are 0 to 1"
    corners = [number for outline in part.outlines for number in outline.bounds]
    for far in (*corners, *(one.z for one in part.instances)):
        if not abs(far) <= GREATEST:
            yield f" has something {far:.3g} mm away from the origin; the limit is {GREATEST:,.0f} mm"


def _hold_surroundings(found: Surroundings | None, *_: object) -> None:
    _hold_parts(found.parts if found else ())


Findings = Annotated[Sequence[Finding], Declared(leave=(Finding,)), _hold_findings]
"""Findings whose figures are finite."""
WholeMotion = Annotated[Motion, Declared(leave=(Motion,)), _hold_motion]
"""A motion of finite numbers, with as many samples as were requested."""
Parts = Annotated[Sequence[Part], Declared(leave=(Part,)), _hold_parts]
"""Parts that can be made."""
Evaluated = Annotated[Columns, Declared(finite=False, nan=True)]
"""Columns, which have NaN for designs that are forbidden."""
Around = Annotated[Surroundings | None, _hold_surroundings]
"""What stands around a mechanism, of parts that can be made."""

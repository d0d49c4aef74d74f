"""What a family's methods may give: findings, a motion, parts; anything else is refused by name."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError

LEAST, GREATEST = 0.01, 100_000.0
"""Sizes of a part, mm: below it is no thing that is made, above it a length in wrong units."""

TURNED = 1e-6
"""How far a rotation may be off an orthogonal one: rounding over some turns is a thousandth of it."""


def sound(method: str, answer: Any, arguments: tuple[Any, ...]) -> Any:
    """The answer of a family's method, if it is one.

    Raises
    ------
    UnsoundError
        What is wrong with it; the guard says whose it is.
    """
    check = _CHECKS.get(method)
    return answer if check is None else check(answer, arguments)


def _findings(answer: Any, _: tuple[Any, ...]) -> Sequence[Finding]:
    found = _several(answer, Finding, "findings")
    for one in found:
        figures = [x for x in (one.value, one.limit) if x is not None]
        if any(x != x for x in figures):
            raise UnsoundError(f"the finding {one.code!r} has a figure that is not a number")
    return found


def _several(answer: Any, kind: type[Any], what: str) -> Sequence[Any]:
    if isinstance(answer, (str, bytes)) or not isinstance(answer, Iterable):
        raise UnsoundError(f"gives {_shown(answer)}; {what} are wanted, in a list or tuple")
    found = answer if isinstance(answer, Sequence) else tuple(answer)
    for one in found:
        if not isinstance(one, kind):
            raise UnsoundError(f"gives {_shown(one)} among its {what}; each is a {kind.__name__}")
    return found


def _motion(answer: Any, arguments: tuple[Any, ...]) -> Motion:
    if not isinstance(answer, Motion):
        raise UnsoundError(f"gives {_shown(answer)}; a Motion is wanted")
    wanted = arguments[1] if len(arguments) > 1 else answer.samples
    if answer.samples != wanted:
        raise UnsoundError(f"gives {answer.samples} samples; {wanted} are asked for")
    for name, channel in answer.channels.items():
        _numbers(channel.values, f"channel {name!r}")
    for name, scalar in answer.scalars.items():
        _numbers(np.asarray(scalar.value), f"figure {name!r}")
    for body, poses in answer.poses.items():
        _poses(poses, body)
    return answer


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


def _parts(answer: Any, _: tuple[Any, ...]) -> Sequence[Part]:
    found = _several(answer, Part, "parts")
    for part in found:
        for outline in part.outlines:
            x0, y0, x1, y1 = outline.bounds
            for size, what in ((x1 - x0, "wide"), (y1 - y0, "high"), (part.thickness, "thick")):
                if not LEAST <= size <= GREATEST:
                    raise UnsoundError(
                        f"part {part.name!r} is {size:.3g} mm {what}; a part has {LEAST:g} to "
                        f"{GREATEST:,.0f} mm"
                    )
            try:
                outline.polygon()
            except GeometryError as error:
                raise UnsoundError(f"part {part.name!r}: {error}") from error
    return found


def _shown(answer: Any) -> str:
    return f"{answer!r:.80}"


_CHECKS: Mapping[str, Callable[[Any, tuple[Any, ...]], Any]] = {
    "check": _findings,
    "judge": _findings,
    "check_cut": _findings,
    "solve": _motion,
    "parts": _parts,
}

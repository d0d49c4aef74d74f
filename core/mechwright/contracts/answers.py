"""What a family's methods may give: findings, a motion, parts; anything else is refused by name."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from mechwright.contracts.declared import LOOSE, Declared, hold, refuse, shown
from mechwright.contracts.finding import Finding
from mechwright.contracts.guard import UnsoundError
from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError

LEAST, GREATEST = 0.01, 100_000.0
"""Sizes of a part, mm: below it is no thing that is made, above it a length in wrong units."""

TURNED = 1e-6
"""How far a rotation may be off an orthogonal one: rounding over some turns is a thousandth of it."""


def sound(contract: Any, method: str, answer: Any, arguments: tuple[Any, ...]) -> Any:
    """The answer of a family's method, if it is one of the contract.

    Raises
    ------
    UnsoundError
        What is wrong with it; the guard says whose it is.
    """
    check = _CHECKS.get(method)
    if check is not None:
        return check(answer, arguments)
    hold(contract, method, answer, LOOSE if method != "evaluate" else _EMPTY)
    return answer


_EMPTY = Declared(finite=False, nan=True)
"""Of designs that are forbidden a column has nothing."""
_STRICT = Declared(leave=(Poses,))
"""Poses may be worked out as they are asked for, and have a check of their own."""


def _declared(answer: Any, kind: Any, asked: Declared = _STRICT) -> None:
    refuse(asked.fault(answer, kind))


def _findings(answer: Any, _: tuple[Any, ...]) -> Sequence[Finding]:
    found = _several(answer, Finding, "findings")
    for one in found:
        if any(x != x for x in (one.value, one.limit)):
            raise UnsoundError(f"the finding {one.code!r} has a figure that is not a number")
    _declared(found, Sequence[Finding])
    return found


def _several(answer: Any, kind: type[Any], what: str) -> Sequence[Any]:
    if isinstance(answer, (str, bytes)) or not isinstance(answer, Iterable):
        raise UnsoundError(f"gives {shown(answer)}; {what} are wanted, in a list or tuple")
    found = answer if isinstance(answer, Sequence) else tuple(answer)
    for one in found:
        if not isinstance(one, kind):
            raise UnsoundError(f"gives {shown(one)} among its {what}; each is a {kind.__name__}")
    return found


def _motion(answer: Any, arguments: tuple[Any, ...]) -> Motion:
    if not isinstance(answer, Motion):
        raise UnsoundError(f"gives {shown(answer)}; a Motion is wanted")
    wanted = arguments[1] if len(arguments) > 1 else answer.samples
    if answer.samples != wanted:
        raise UnsoundError(f"gives {answer.samples} samples; {wanted} are asked for")
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
    _declared(answer, Motion)
    return answer


def _stretch(answer: Any, arguments: tuple[Any, ...]) -> Motion:
    """One of the motions that follow each other; whoever gives them together gives something else."""
    if arguments:
        raise UnsoundError(
            f"gives {shown(answer)}; motions are wanted, one after the other, as yield gives them"
        )
    return _motion(answer, ())


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


def parts(answer: Any, _: tuple[Any, ...] = ()) -> Sequence[Part]:
    """Parts that can be made, of names of their own; raises UnsoundError for others."""
    found = _several(answer, Part, "parts")
    _declared(found, Sequence[Part])
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
        _place(part)
    names = [part.name for part in found]
    for name in names:
        if names.count(name) > 1:
            raise UnsoundError(f"two parts are called {name!r}; each has files of its name")
    return found


def _place(part: Part) -> None:
    """Whether it is of something, and where and in which colour its copies stand."""
    if part.kind in {"plate", "turned"} and part.material not in MATERIALS:
        raise UnsoundError(
            f"part {part.name!r} is of {part.material!r}; materials are {', '.join(sorted(MATERIALS))}"
        )
    colours = (part.colour, *(one.colour for one in part.instances if one.colour is not None))
    for colour in colours:
        if not all(0 <= share <= 1 for share in colour):
            raise UnsoundError(f"part {part.name!r} has the colour {colour}; red, green and blue are 0 to 1")
    corners = [number for outline in part.outlines for number in outline.bounds]
    for far in (*corners, *(one.z for one in part.instances)):
        if not abs(far) <= GREATEST:
            raise UnsoundError(
                f"part {part.name!r} has something {far:.3g} mm away from the origin; the limit is "
                f"{GREATEST:,.0f} mm"
            )


_CHECKS: Mapping[str, Callable[[Any, tuple[Any, ...]], Any]] = {
    "check": _findings,
    "judge": _findings,
    "check_cut": _findings,
    "solve": _motion,
    "stretches": _stretch,
    "parts": parts,
}

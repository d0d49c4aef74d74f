"""The table of operations: the built-in ones, and those that a design asks for by name."""

from collections.abc import Sequence

from mechwright.errors import DesignError
from mechwright_cam.operations.adaptive import Adaptive
from mechwright_cam.operations.bore import BoreOperation
from mechwright_cam.operations.chamfer import ChamferOperation
from mechwright_cam.operations.clear import Clear
from mechwright_cam.operations.contour import Contour
from mechwright_cam.operations.contract import Operation
from mechwright_cam.operations.engrave import Engrave
from mechwright_cam.operations.face import Face
from mechwright_cam.operations.groove import Groove
from mechwright_cam.operations.peel import Peel
from mechwright_cam.operations.ream import Ream
from mechwright_cam.operations.tap import TapOperation
from mechwright_cam.operations.thread import ThreadOperation

BUILT_IN: tuple[Operation, ...] = (
    Ream(),
    TapOperation(),
    BoreOperation(),
    Groove(),
    Face(),
    Adaptive(),
    Clear(),
    Peel(),
    Contour(),
    ChamferOperation(),
    ThreadOperation(),
    Engrave(),
)
"""In the order in which they are asked to claim a feature, and cut those that begin at one height."""


def job_operations(names: Sequence[str], more: Sequence[Operation] = ()) -> tuple[Operation, ...]:
    """The operations of a job: those of some names first, then the built-in ones.

    ``more`` are those that others bring; without its name none of them is asked. Raises DesignError for a
    name that is not known; the message lists those that are.
    """
    known = {operation.name: operation for operation in (*more, *BUILT_IN)}
    for name in names:
        if name not in known:
            listed = ", ".join(sorted(known))
            raise DesignError(f"cam.operations: no operation is named {name!r}; there is: {listed}")
    first = [known[name] for name in dict.fromkeys(names)]
    return (*first, *(operation for operation in BUILT_IN if operation not in first))

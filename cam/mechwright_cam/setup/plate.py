"""The plate that a part is cut from: how far it reaches beyond the part on each side."""

from mechwright.contracts.part import Part
from mechwright.errors import DesignError, GeometryError
from mechwright_cam.shop.settings import CamSettings

AS_WIDE = 0.01
"""Stock with two finished edges is as wide as the part to this, mm: what the leftover limit calls clean."""

Box = tuple[float, float, float, float]
"""Least x, least y, greatest x, greatest y, mm."""


def plate_box(part: Part, settings: CamSettings, margins: tuple[float, float]) -> Box:
    """The stock around a part, in the part's coordinates.

    ``margins`` are the stock beyond it in X and Y where the design leaves that open, mm; there is none at a
    finished edge.
    Raises GeometryError for a part that is no plate, DesignError for one that does not fit into the stock, or
    not between its finished edges.
    """
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate: it has no outline to mill")
    x0, y0, x1, y1 = part.outline.bounds
    wanted = settings.stock
    left, right = _beside(part, settings, "length", x1 - x0, ("left", "right"), margins[0])
    front, rear = _beside(part, settings, "width", y1 - y0, ("front", "rear"), margins[1])
    if min(left, right, front, rear) < 0:
        raise DesignError(
            f"cam.stock: the part {part.name} is {x1 - x0:.1f} x {y1 - y0:.1f} mm and does not fit into "
            f"{wanted.length:g} x {wanted.width:g} mm; take a larger plate"
        )
    return x0 - left, y0 - front, x1 + right, y1 + rear


def _beside(
    part: Part, settings: CamSettings, key: str, size: float, edges: tuple[str, str], margin: float
) -> tuple[float, float]:
    """Stock beyond the part at its lower and its upper end along one axis, mm."""
    stock = settings.stock
    finished = [edge in stock.finished for edge in edges]
    given: float | None = getattr(stock, key)
    if given is None:
        open_ = margin if stock.margin is None else stock.margin
        low, high = (0.0 if done else open_ for done in finished)
        return low, high
    free = given - size
    match finished:
        case [True, True]:
            if abs(free) > AS_WIDE:
                raise DesignError(
                    f"cam.stock.{key}: the {edges[0]} and {edges[1]} edges are finished, so the stock is "
                    f"there as long as part {part.name}: {size:.3f} mm, not {given:g} mm"
                )
            return 0.0, 0.0
        case [True, False]:
            return 0.0, free
        case [False, True]:
            return free, 0.0
    return free / 2, free / 2

"""The stock of a job from the plates that a shop has in hand."""

from mechwright.contracts.finding import Change, Finding
from mechwright.designs.design import Design
from mechwright.remedies.keys import thickness_keys
from mechwright.standards.stock import AS_THICK
from mechwright_cam.setup.clamping import widest_channel
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import FRAME
from mechwright_cam.shop.holding import Stock
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.workshop_file import Shop


def from_hand(job: Job, shop: Shop, design: Design) -> tuple[Stock | None, list[Finding]]:
    """The blank that a job is cut from, and what is to be said of what is in hand.

    There is none where pieces are sawn off as the part asks, where the design says length and width itself,
    and where none is large enough; the smallest of those that are is taken, turned where it fits only so.
    """
    material, thickness, stock = job.part.material, job.thickness, job.settings.stock
    if not shop.workshop.stock:
        return None, []
    mine = [row for row in shop.workshop.stock if row.material == material]
    thick = [row for row in mine if any(abs(one - thickness) <= AS_THICK for one in row.in_hand)]
    if not thick:
        return None, [_no_thickness(job, shop, design)]
    sizes = blanks(shop, material, thickness, job.settings)
    if not sizes:
        return None, []
    fitting = next((found for needed in _needs(job) if (found := _larger(sizes, needed))), [])
    if not fitting:
        return None, [_too_small(job, shop, sizes[-1])]
    length, width = fitting[0]
    return Stock(length=length, width=width, finished=stock.finished), []


def _needs(job: Job) -> list[tuple[float, float]]:
    """Sizes of a blank, mm: with a rim for clamps, and where the design leaves the stock open without one."""
    (x0, y0, x1, y1), stock = job.stock, job.settings.stock
    found = [(x1 - x0, y1 - y0)]
    if stock.margin is None and not stock.finished:
        left, low, right, high = job.target.bounds
        around = 2 * (widest_channel(job) + FRAME)
        found.append((right - left + around, high - low + around))
    return found


def _larger(sizes: list[tuple[float, float]], needed: tuple[float, float]) -> list[tuple[float, float]]:
    return [size for size in sizes if size[0] >= needed[0] and size[1] >= needed[1]]


def blanks(shop: Shop, material: str, thickness: float, settings: CamSettings) -> list[tuple[float, float]]:
    """Lengths and widths of the ready blanks that a plate may be cut from, each lying both ways.

    The smallest come first, of one blank the way in which it lies within the machine's travel. There are none
    where a piece is sawn off as a part asks, or the design says length and width itself.
    """
    thick = [
        row
        for row in shop.workshop.stock
        if row.material == material and any(abs(one - thickness) <= AS_THICK for one in row.in_hand)
    ]
    ready = [(row.length, row.width) for row in thick if row.length is not None and row.width is not None]
    if settings.stock.length is not None or len(ready) < len(thick):
        return []
    machine = settings.machine

    def order(size: tuple[float, float]) -> tuple[float, float, float]:
        beyond = max(size[0] - machine.travel_x, 0.0) + max(size[1] - machine.travel_y, 0.0)
        return size[0] * size[1], beyond, size[1]

    return sorted({way for size in ready for way in (size, size[::-1])}, key=order)


def _no_thickness(job: Job, shop: Shop, design: Design) -> Finding:
    """That a plate of this thickness is not in hand, with the nearest ones as remedies."""
    material, thickness = job.part.material, job.thickness
    near = sorted(shop.thicknesses(material), key=lambda one: (abs(one - thickness), one))[:2]
    have = f"in hand are {' and '.join(f'{one:g}' for one in near)} mm" if near else "none of it is in hand"
    message = f"{job.part.name} takes a plate of {material} {thickness:g} mm thick; {have}"
    keys = thickness_keys(design, thickness)
    proposed: tuple[Change, ...] = tuple({key: one} for one in near for key in keys)
    remedy = f"add {thickness:g} to the thicknesses of {material} in {shop.path.name}"
    if near:
        remedy = f"make it {near[0]:g} mm, or {remedy}"
    where = keys[0].removeprefix("parameters.") if keys else "shop"
    limit = near[0] if near else None
    return Finding.warning("shop.stock", where, message, thickness, limit, "mm", remedy, proposed=proposed)


def _too_small(job: Job, shop: Shop, largest: tuple[float, float]) -> Finding:
    length, width = _needs(job)[-1]
    message = (
        f"{job.part.name} takes a plate of {length:.1f} x {width:.1f} x {job.thickness:g} mm of "
        f"{job.part.material}; the largest blank in hand is {largest[0]:g} x {largest[1]:g} mm"
    )
    return Finding.warning("shop.stock", "shop", message, remedy=f"add a larger one to {shop.path.name}")

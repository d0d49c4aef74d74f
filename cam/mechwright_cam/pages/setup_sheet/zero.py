"""Where the zero of a job lies, and how it is found by hand."""

from dataclasses import dataclass

from mechwright.contracts.part import Bore
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_plane.nest import Nest


def origin_words(job: Job) -> str:
    """What X0 Y0 is."""
    bored = any(isinstance(feature, Bore) and feature.centre == (0.0, 0.0) for feature in job.features)
    of = job.part.placed[0].label if isinstance(job.part, Nest) else "the part"
    return {
        "axis": f"the axis of {of}" + (" (its bore)" if bored else ""),
        "corner": "the lower left corner of the stock",
        "centre": "the centre of the stock",
    }[job.settings.origin]


@dataclass(frozen=True)
class Edge:
    """An edge of the stock from which X0 or Y0 is found; what the axis reads with an edge finder on it."""

    name: str
    at: float
    reads: str


def datum_edges(job: Job, to: Lengths) -> tuple[Edge, Edge]:
    """The edges of the stock from which X0 and Y0 are found."""
    x, y = job.datum
    right, rear = x == job.stock[2], y == job.stock[3]
    return (
        Edge("right" if right else "left", x, f"{to.signed(x)} {'+' if right else '−'} r"),
        Edge("rear" if rear else "front", y, f"{to.signed(y)} {'+' if rear else '−'} r"),
    )


def plane(job: Job, offset: str, to: Lengths) -> tuple[str, ...]:
    """How X and Y are set."""
    x0, y0, _, _ = job.stock
    lines = [f"X0 Y0 is {origin_words(job)}."]
    if job.settings.origin == "corner":
        lines.append(
            f"With an edge finder of radius r: on the left edge set {offset} X so that X reads −r, "
            "on the front edge Y so that Y reads −r."
        )
    else:
        lines.append(
            f"The stock's left edge is X {to.signed(x0)}, its front edge is Y {to.signed(y0)}. With an edge "
            f"finder of radius r: on the left edge set {offset} X so that X reads {to.signed(x0)} − r, on "
            f"the front edge Y so that Y reads {to.signed(y0)} − r."
        )
    return tuple(lines)


def second_plane(job: Job, offset: str, to: Lengths) -> tuple[str, ...]:
    """How X and Y are found of a plate that has been turned over."""
    match job.settings.second_side.locate:
        case "dowels":
            places = " and ".join(f"X {to.signed(x)}, Y {to.signed(y)}" for x, y in job.pick_up)
            how = f"The dowels are at {places} in {offset}: indicate one to {to.with_unit(0.01)}."
            if job.settings.origin == "axis":
                how += f" These are X and Y of the first side, so {offset} X and Y may be copied from it."
        case "bore":
            ((x, y),) = job.pick_up
            axis = f"Its axis is X {to.signed(x)}, Y {to.signed(y)} in {offset}."
            how = f"Indicate the largest bore to {to.with_unit(0.01)}. {axis}"
        case "edges":
            one, two = datum_edges(job, to)
            how = (
                f"The {one.name} edge is X {to.signed(one.at)}, the {two.name} edge is Y "
                f"{to.signed(two.at)}: they "
                "are the first side's left and front edges, so that the plate's true size does not matter. "
                f"With an edge finder of radius r: on the {one.name} edge X reads {one.reads}, on the "
                f"{two.name} edge Y {two.reads}."
            )
    return (how,)

"""Plates, pins and masses of a design."""

from collections.abc import Mapping

from mechwright import GeometryError, GroundPlate, Joint, KinematicsError, MountingError, Part, Poses, kept
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.planar.rigid import BodyMotion
from mechwright_linkage.kinematics.linkage_table import table_of
from mechwright_linkage.kinematics.period import course_of, period_of
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.parts import frames, masses, mounting, parts
from mechwright_linkage.parts.layout import Layout
from mechwright_linkage.parts.layout import layout_of as laid_out
from mechwright_linkage.parts.sizes import Sizes

SIZES = tuple(Sizes.__dataclass_fields__)
"""Their names, which are those of the design's keys."""


def sizes_of(params: LinkageParams) -> Sizes:
    """The sizes that a design states."""
    return Sizes(**{name: getattr(params, name) for name in SIZES})


def unloaded(params: LinkageParams) -> LinkageParams:
    """The same plates without loads and at one speed: what is kept of them serves all loads and speeds."""
    still = {"loads": (), "springs": (), "gravity_x": 0.0, "gravity_y": 0.0, "speed": 60.0, "pairs": ()}
    return params.model_copy(update=still)


def layout_of(params: LinkageParams) -> Layout:
    """Plates and layers.

    Raises
    ------
    GeometryError
        There are gears, bores leave no rim, or no order of layers keeps all plates apart.
    """
    found = _layout(unloaded(params))
    if isinstance(found, str):
        raise GeometryError(found)
    return found


@kept
def _layout(params: LinkageParams) -> Layout | str:
    """The layout, or why there is none, which is asked for as often."""
    table = table_of(params)
    turns = max(1, round(abs(course_of(table).travel) / 6.3)) if not course_of(table).rocks else 1
    bodies = period_of(table, turns * (STACK_SAMPLES - 1) + 1).solution.bodies
    try:
        return laid_out(table.linkage, sizes_of(params), bodies)
    except (GeometryError, KinematicsError) as error:
        return str(error)


def layout_or_none(params: LinkageParams) -> Layout | None:
    """As :func:`layout_of`; None where there is none."""
    found = _layout(unloaded(params))
    return None if isinstance(found, str) else found


def parts_of(params: LinkageParams) -> tuple[Part, ...]:
    """All parts; raises as :func:`layout_of`."""
    return parts.parts_of(layout_of(params))


def mounting_of(params: LinkageParams) -> GroundPlate:
    """The ground plate and the driver's shaft; raises MountingError where no shaft drives."""
    layout = layout_of(params)
    if table_of(params).driver_slides:
        raise MountingError("driver: it slides, and a frame carries the shaft of one that turns")
    return mounting.mounting_of(layout)


def masses_of(params: LinkageParams) -> Mapping[str, Mass]:
    """The masses of all moving links; raises as :func:`layout_of`."""
    return masses.masses_of(layout_of(params))


def masses_or_none(params: LinkageParams) -> Mapping[str, Mass] | None:
    """The same; None where there are no parts."""
    layout = layout_or_none(params)
    return None if layout is None else masses.masses_of(layout)


def frames_of(params: LinkageParams, bodies: Mapping[str, BodyMotion]) -> Mapping[str, Poses]:
    """Poses of all links, and of the frames on their axes where there are parts."""
    layout = layout_or_none(params)
    if layout is not None:
        return frames.frames_of(layout, bodies)
    return {name: body.poses() for name, body in bodies.items()}


def held_by(params: LinkageParams) -> Mapping[str, Joint]:
    """What holds the bodies; of a linkage without parts nothing is known."""
    layout = layout_or_none(params)
    return {} if layout is None else frames.joints_of(layout)

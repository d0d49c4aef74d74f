"""What formulas ask of a design, or of many at once."""

from typing import Protocol, TypeVar

from mechwright import Array

V = TypeVar("V", float, Array)
"""A size of one design, or those (n, 1) of many."""

V_co = TypeVar("V_co", float, Array, covariant=True)


class Sized(Protocol[V_co]):
    """One design, :class:`~mechwright_cam_follower.params.CamParams`, or many that have their laws in common.

    What the members are, the design table says.
    """

    @property
    def contact(self) -> str:
        """What touches the cam."""

    @property
    def conjugate(self) -> bool:
        """Whether there are two cams."""

    @property
    def translating(self) -> bool:
        """Whether the follower slides."""

    @property
    def sense(self) -> int:
        """1 where the cam turns counter-clockwise, -1 where it turns clockwise."""

    @property
    def stroke(self) -> float:
        """Greatest lift, mm, or swing, degrees."""

    @property
    def material(self) -> str:
        """Of cam and follower."""

    @property
    def roller_material(self) -> str:
        """Of the rollers."""

    @property
    def base_radius(self) -> V_co:
        """Radius of the base circle, mm."""

    @property
    def face(self) -> V_co:
        """From a lever's axis to its flat face, mm."""

    @property
    def thickness(self) -> V_co:
        """Of a cam, mm."""

    @property
    def omega(self) -> V_co:
        """Speed of the cam, rad/s."""

    def value(self, name: str) -> V_co:
        """A field that belongs to one kind of follower."""

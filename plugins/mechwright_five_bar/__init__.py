"""Family five-bar: a crank, an arm geared to it, and two links between, with synthesis of paths in phases."""

from mechwright_five_bar.params import FOLLOWING, FiveBarParams


def _face(params: FiveBarParams) -> float:
    from mechwright_five_bar.face import face_of

    return face_of(params)


FOLLOWING.append(_face)

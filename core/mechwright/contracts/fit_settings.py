"""The keys of ``[fits]``."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from mechwright.contracts.limits import limits
from mechwright.contracts.parameters import Parameters
from mechwright.errors import DesignError


def _class(text: str) -> str:
    """Refuse what is no class, whatever the size."""
    try:
        limits(1.0, text)
    except DesignError as error:
        raise ValueError(str(error).removeprefix(f"{text!r} ")) from error
    return text


def hole_name(text: object) -> str:
    """The class of a hole, given back; raises ValueError for anything else."""
    if not isinstance(text, str):
        raise ValueError("is no text; write a class such as H7")
    if not _class(text)[0].isupper():
        raise ValueError(f"is a class of shafts; holes have capitals: {text.upper()}")
    return text


def _shaft(text: str) -> str:
    if not _class(text)[0].islower():
        raise ValueError(f"is a class of holes; shafts have small letters: {text.lower()}")
    return text


RUNNING = "G7"
"""Of a hole in which a pin of the same drawn size turns: on h6 without shake, at moderate speed."""

HoleName = Annotated[str, Field(max_length=6), AfterValidator(hole_name)]
ShaftName = Annotated[str, Field(max_length=6), AfterValidator(_shaft)]


class FitSettings(Parameters):
    """The table ``[fits]``: ISO 286 classes of pairs of which no part says its own."""

    shaft: ShaftName = Field("h6", description="Of pins and shafts that are made: ground bar is sold to h6.")
    running: HoleName | None = Field(
        None,
        description="Of holes in which a pin turns. Default: the clearance with which the design draws it, "
        "else G7.",
    )
    pressed: HoleName = Field("P7", description="Of the hole in which a pin sits for good.")
    hub: HoleName = Field(
        "H7", description="Of the hole of a hub on its shaft, and of one through which a bolt locates plates."
    )
    journal: ShaftName = Field("f7", description="Of a shaft that turns in a bush that is bought.")
    bush: ShaftName = Field("r6", description="Of the outside of a bush that is made.")
    housing: HoleName = Field("H7", description="Of the hole into which a bush or a dowel is pressed.")
    dowel: HoleName = Field("F7", description="Of a dowel's hole in the part that comes off.")
    key: Literal["auto", "N9", "P9"] = Field(
        "auto",
        description="Of the key's seat in a shaft. auto: P9 where the torque of the drive changes its sense "
        "within a turn, else N9. With P9 the hub's seat on the shaft is j6 in place of h6.",
    )
    spacer: HoleName = Field("H11", description="Of a spacer on its shaft, which it centres on nothing.")


@dataclass(frozen=True)
class Fits:
    """What a design file says of fits: the settings, and ``"PIN in PART"`` to the class of that hole."""

    settings: FitSettings = field(default_factory=FitSettings)
    own: Mapping[str, str] = field(default_factory=dict)

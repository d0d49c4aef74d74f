"""The key ``shop`` in the head of a design file: the shop that it is made in."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from mechwright.contracts.in_hand import InHand
from mechwright.contracts.table import Table
from mechwright.designs.design import Design
from mechwright.designs.files import beside
from mechwright.designs.text import toml
from mechwright.errors import DesignError
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.packing import WEB, fits_blank
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import widest_mill
from mechwright_cam.shop.workshop import Plates
from mechwright_cam.shop.workshop_file import VARIABLE, Shop, named_by, read_shop, schema


class ShopTable(Table[Shop | None]):
    """Reads the shop file that a design names, or the environment; None without either."""

    name = "shop"
    lender = True

    def read(self, content: object, path: Path) -> Shop | None:
        """The shop; an empty text is none, whatever the environment names."""
        if content == {}:
            file = named_by()
            return None if file is None else read_shop(file)
        if not isinstance(content, str):
            raise DesignError(f"{path}: shop: is {content!r}; write the name of a shop file in quotes")
        return read_shop(beside(path, content, "shop"), content) if content else None

    def text(self, value: Shop | None = None) -> list[str]:  # noqa: ARG002 - it is no table
        """Nothing below the head."""
        return []

    def head(self, value: Shop | None = None) -> list[str]:
        """The key, where the design names its shop."""
        return [f"shop = {toml(value.said)}"] if value is not None and value.said else []

    def lends(self, value: Shop | None) -> Mapping[str, Mapping[str, Any]]:
        """Control, mill, units, and what the shop prefers."""
        return {} if value is None else value.lends

    def in_hand(self, value: Shop | None) -> InHand | None:
        """The sheet of a shop that has one; its mills keep their channel around each part."""
        if value is None:
            return None
        rows = value.workshop.stock
        if len(rows) != 1 or len(rows[0].in_hand) != 1:
            return InHand()
        row = rows[0]
        return InHand(row.material, row.in_hand[0], _fits(value, row), {"cam.nest.turn": True})

    def schema(self) -> dict[str, Any]:
        """A text."""
        return {"type": "string", "description": f"The shop file. Default: that which {VARIABLE} names."}

    def file_schema(self) -> dict[str, Any]:
        """That of a shop file."""
        return schema()

    def inputs(self, value: Shop | None, path: Path) -> dict[str, Path]:  # noqa: ARG002
        """The shop file, and what it names."""
        return {} if value is None else {value.said or value.path.name: value.path, **value.files}

    def carried(self, value: Shop | None, path: Path) -> tuple[Shop | None, dict[str, Path]]:  # noqa: ARG002
        """The same shop, which goes along with the files that it names."""
        if value is None or not value.said:
            return value, {}
        name = value.path.name
        carried = Shop(value.path, name, value.workshop, value.library, value.files)
        return carried, {name: value.path, **value.files}


def shop_of(design: Design) -> Shop | None:
    """The shop that a design is made in; None without one."""
    shop: Shop | None = design.tables.get(ShopTable.name)
    return shop


def _fits(shop: Shop, row: Plates) -> Callable[[Sequence[tuple[float, float]]], bool] | None:
    """Whether plates go on a ready blank together, with the channels of the widest mill around them."""
    if row.length is None or row.width is None:
        return None
    machine = shop.workshop.machine or Machine()
    left = shop.lends.get("cam", {}).get("stock_to_leave", CamSettings().stock_to_leave)
    gap = 2 * (widest_mill(shop.library) + left) + WEB
    room = (machine.travel_x, machine.travel_y)
    return partial(fits_blank, blank=(row.length, row.width), gap=gap, room=room, turn=True)

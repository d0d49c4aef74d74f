"""A sheet as the files of a build."""

from mechwright_cad.sheet.sheet import Sheet
from mechwright_cad.sheet.title import TitleBlock
from mechwright_cad.sheet.to_dxf import dxf
from mechwright_cad.sheet.to_pdf import pdf


def files(sheet: Sheet, names: tuple[str, str], title: str, block: TitleBlock) -> dict[str, bytes]:
    """The DXF and the PDF of a sheet by their names."""
    drawing, page = names
    return {drawing: dxf(sheet), page: pdf(sheet, title, block.settings.font.data)}

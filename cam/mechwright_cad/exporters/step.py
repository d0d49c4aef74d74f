"""STEP files (ISO 10303-21) through the CAD kernel, the same bytes for the same parts.

Files are of AP214, those of parts with limits of size of AP242, which has a place for them.
Three things in the kernel's files vary: the time stamp, the product names that it invents, and the numbers of
assembly occurrences, which count on through the process. All are set here before the file is written.
"""

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import cadquery as cq
from cadquery.occ_impl.assembly import toCAF
from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.Interface import Interface_Static
from OCP.STEPCAFControl import STEPCAFControl_Writer
from OCP.STEPControl import STEPControl_StepModelType
from OCP.StepData import StepData_StepModel
from OCP.StepRepr import StepRepr_NextAssemblyUsageOccurrence
from OCP.StepShape import StepShape_GeometricCurveSet
from OCP.TCollection import TCollection_ExtendedString, TCollection_HAsciiString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label, TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool
from OCP.XSControl import XSControl_WorkSession

from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.pipeline.result_store import stored
from mechwright_cad.exporters.decimals import of_step
from mechwright_cad.exporters.size_limits import add_limits, limited_faces
from mechwright_cad.exporters.step_text import sort_styles, typed_measures
from mechwright_cad.solids import solid as solids

TIME_STAMP = "2000-01-01T00:00:00"
"""Stands in every file in place of the time of writing."""

# Curves on surfaces are left out: they double the size and the time, and readers compute them again.
_SETTINGS_INT = {"write.surfacecurve.mode": 0, "write.precision.mode": 0, "write.stepcaf.subshapes.name": 0}
_SETTINGS_TEXT = {"xstep.cascade.unit": "MM", "write.step.unit": "MM", "write.step.schema": "AP214IS"}
_LIMITED_INT = {**_SETTINGS_INT, "write.stepcaf.subshapes.name": 1}
_LIMITED_TEXT = {**_SETTINGS_TEXT, "write.step.schema": "AP242DIS"}


@stored
def part(part: Part) -> bytes:
    """A part's solid, named and coloured, as the text of a STEP file."""
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    # A solid straight in the document, where an assembly would put it into another product.
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    label = shapes.AddShape(solids.part_shape(part).wrapped, False)
    TDataStd_Name.Set_s(label, TCollection_ExtendedString(part.name))
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    colours.SetColor(label, cq.Color(*part.colour).wrapped, XCAFDoc_ColorType.XCAFDoc_ColorGen)
    add_limits(document, label, part)
    return _write(document, part.name, [part], limited=bool(limited_faces(part)))


@stored
def assembly(name: str, parts: Sequence[Part], motion: Motion, sample: int = 0) -> bytes:
    """All instances in their poses, as the text of a STEP file.

    A product is named by its part, an occurrence by its body.
    """
    whole = solids.assembly(name, parts, motion, sample)
    label, document = toCAF(whole, coloredSTEP=True)
    _name_products(label, [part.name for part in parts for _ in part.instances])
    return _write(document, name, parts, occurrences=True)


def _name_products(label: TDF_Label, names: list[str]) -> None:
    components = TDF_LabelSequence()
    XCAFDoc_ShapeTool.GetComponents_s(label, components)
    for place, name in enumerate(names, start=1):
        product = TDF_Label()
        XCAFDoc_ShapeTool.GetReferredShape_s(components.Value(place), product)
        TDataStd_Name.Set_s(product, TCollection_ExtendedString(name))


def _write(
    document: TDocStd_Document,
    name: str,
    parts: Sequence[Part],
    *,
    occurrences: bool = False,
    limited: bool = False,
) -> bytes:
    text = io.BytesIO()
    # The first writer of a process makes the settings known; before that they cannot be set.
    writer = STEPCAFControl_Writer(XSControl_WorkSession(), False)
    with _settings(limited=limited):
        writer.SetColorMode(True)
        writer.SetNameMode(True)
        writer.SetDimTolMode(limited)
        if not writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs):
            raise GeometryError(f"the CAD kernel cannot turn {name} into STEP entities")
        model = writer.ChangeWriter().Model()
        _set_header(model, name)
        _name_marks(model, parts)
        if occurrences:
            _number_occurrences(model)
        status = writer.WriteStream(text)
    if status != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise GeometryError(f"the CAD kernel cannot write {name} as STEP ({status.name})")
    return of_step(sort_styles(typed_measures(text.getvalue())))


def _set_header(model: StepData_StepModel, name: str) -> None:
    header = APIHeaderSection_MakeHeader(model)
    header.SetName(_text(f"{name}.step"))
    header.SetTimeStamp(_text(TIME_STAMP))
    header.SetAuthorValue(1, _text(""))
    header.SetOrganizationValue(1, _text(""))
    header.SetDescriptionValue(1, _text(name))
    header.SetOriginatingSystem(_text("Mechwright"))
    header.SetAuthorisation(_text(""))


def _name_marks(model: StepData_StepModel, parts: Sequence[Part]) -> None:
    """Name the curves of threads and engravings; the kernel writes them in the order of the parts."""
    names = [name for part in parts for name, _ in solids.marks(part)]
    curves = [
        entity
        for place in range(1, model.NbEntities() + 1 if names else 0)
        if isinstance(entity := model.Value(place), StepShape_GeometricCurveSet)
    ]
    for entity, name in zip(curves, names, strict=True):
        entity.SetName(_text(name))


def _number_occurrences(model: StepData_StepModel) -> None:
    number = 0
    for place in range(1, model.NbEntities() + 1):
        entity = model.Value(place)
        if isinstance(entity, StepRepr_NextAssemblyUsageOccurrence):
            number += 1
            entity.SetId(_text(str(number)))


def _text(text: str) -> TCollection_HAsciiString:
    return TCollection_HAsciiString(text)


@contextmanager
def _settings(*, limited: bool) -> Iterator[None]:
    """The kernel's writing settings are global to the process: set ours, and put the others back."""
    numbers = {key: Interface_Static.IVal_s(key) for key in _SETTINGS_INT}
    texts = {key: Interface_Static.CVal_s(key) for key in _SETTINGS_TEXT}
    _set(*((_LIMITED_INT, _LIMITED_TEXT) if limited else (_SETTINGS_INT, _SETTINGS_TEXT)))
    try:
        yield
    finally:
        _set(numbers, texts)


def _set(numbers: dict[str, int], texts: dict[str, str]) -> None:
    for key, number in numbers.items():
        Interface_Static.SetIVal_s(key, number)
    for key, text in texts.items():
        Interface_Static.SetCVal_s(key, text)

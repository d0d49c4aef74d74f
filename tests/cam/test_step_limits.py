"""Limits of size in STEP files: as the kernel reads them back, and as a reader of the bare text does."""

import hashlib
import re
import subprocess
import sys
from pathlib import Path

import pytest
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDF import TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.TopoDS import TopoDS
from OCP.XCAFApp import XCAFApp_Application
from OCP.XCAFDoc import XCAFDoc_Dimension, XCAFDoc_DocumentTool

from mechwright import Outline, Part, circle, host
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Bore, Profile
from mechwright.contracts.turned import KeySeat, Step, Turned
from mechwright.designs.design import load
from mechwright.geometry import Loop
from mechwright.standards.bearings import bearing
from mechwright_cad.exporters import step

ROOT = Path(__file__).parents[2]


def plate(*holes):
    """A disc with holes of (x, size, class), drawn in the middle of their limits."""
    rim = Loop((circle((0.0, 0.0), 60.0),))
    bores = []
    for k, (x, size, name) in enumerate(holes):
        fit = hole_fit(size, name)
        bores.append(Bore(f"bore-{k}", (x, 5.0), fit.middle, 0.0, 10.0, fit))
    bores.append(Bore("plain", (0.0, -30.0), 9.0, 0.0, 10.0))
    loops = [Loop((circle(one.centre, one.diameter / 2, clockwise=True),)) for one in bores]
    cut = (*bores, Profile("outside", rim, "outside", 0.0, 10.0))
    return Part("plate", Outline(rim, tuple(loops)), 10.0, "aluminium", machined=cut)


PLATE = plate((-40.0, 8.0, "F7"), (-10.0, 10.0, "H7"), (20.0, 6.0, "P7"))
SHAFT = Part(
    "shaft",
    None,
    0.0,
    "steel",
    turned=Turned(
        (Step(10, 8, shaft_fit(10, "k6")), Step(16, 4), Step(12, 30, shaft_fit(12, "h6"))),
        seats=(KeySeat(34.0, 8.0, 4.0, 3.5),),
    ),
)
RING = Part("ring", None, 0.0, "steel", bought=bearing("608").bought)


def read_back(text, path):
    """Least and greatest size of each dimension, and the radii of the faces that it is on, by the kernel."""
    path.write_bytes(text)
    document = TDocStd_Document(TCollection_ExtendedString("BinXCAF"))
    XCAFApp_Application.GetApplication_s().InitDocument(document)
    reader = STEPCAFControl_Reader()
    reader.SetGDTMode(True)
    assert reader.ReadFile(str(path)).name == "IFSelect_RetDone"
    assert reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.DimTolTool_s(document.Main())
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    labels, found = TDF_LabelSequence(), []
    tool.GetDimensionLabels(labels)
    for place in range(1, labels.Length() + 1):
        size = XCAFDoc_Dimension.Set_s(labels.Value(place)).GetObject()
        faces, others = TDF_LabelSequence(), TDF_LabelSequence()
        tool.GetRefShapeLabel_s(labels.Value(place), faces, others)
        radii = {
            BRepAdaptor_Surface(TopoDS.Face_s(shapes.GetShape_s(faces.Value(k)))).Cylinder().Radius()
            for k in range(1, faces.Length() + 1)
        }
        limits = size.GetLowerBound(), size.GetUpperBound()
        if not size.IsDimWithRange():
            # The kernel has the lower deviation as how far it is below.
            limits = size.GetValue() - size.GetLowerTolValue(), size.GetValue() + size.GetUpperTolValue()
        found.append((*limits, radii))
    return found


def of_text(text):
    """Limits from the bare text, and the names of the faces: what a reader without the kernel finds."""
    entities = dict(re.findall(r"#(\d+) = (.*?);\n", re.sub(r"\s*\n\s*(?!#\d+ =|ENDSEC)", "", text.decode())))

    def all_of(kind, key):
        return [
            body for body in entities.values() if body.startswith(f"{kind}(") and f"#{key}" in tokens(body)
        ]

    def tokens(body):
        return re.findall(r"#\d+", body)

    def value(key):
        return float(re.search(r"LENGTH_MEASURE\(([-+.\dE]+)\)", entities[key.removeprefix("#")])[1])

    found = []
    for size, body in entities.items():
        if not body.startswith("DIMENSIONAL_SIZE("):
            continue
        assert body.endswith(",'diameter')")
        (aspect,) = tokens(body)
        (shown,) = all_of("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION", size)
        items = tokens(entities[tokens(shown)[1][1:]])[:-1]
        named = {
            re.search(r"REPRESENTATION_ITEM\('(.*?)'\)", entities[one[1:]])[1]: value(one) for one in items
        }
        limits = named.get("lower limit"), named.get("upper limit")
        for tolerance in all_of("PLUS_MINUS_TOLERANCE", size):
            pair = tokens(entities[tokens(tolerance)[0][1:]])
            limits = tuple(named["nominal value"] + value(one) for one in pair)
        usages = all_of("GEOMETRIC_ITEM_SPECIFIC_USAGE", aspect[1:])
        names = {re.match(r"ADVANCED_FACE\('(.*?)'", entities[tokens(one)[-1][1:]])[1] for one in usages}
        found.append((*limits, names))
    return found


@pytest.mark.parametrize(
    ("part", "expected"),
    [
        (
            PLATE,
            [
                (8.0, 0.013, 0.028, "bore-0 8 F7 (+0.013/+0.028)"),
                (10.0, 0.0, 0.015, "bore-1 10 H7 (0/+0.015)"),
                (6.0, -0.020, -0.008, "bore-2 6 P7 (-0.02/-0.008)"),
            ],
        ),
        (
            SHAFT,
            [
                (10.0, 0.001, 0.010, "step-1 10 k6 (+0.001/+0.01)"),
                (12.0, -0.011, 0.0, "step-3 12 h6 (-0.011/0)"),
            ],
        ),
        (RING, [(8.0, -0.008, 0.0, "inside 8 (-0.008/0)"), (22.0, -0.009, 0.0, "outside 22 (-0.009/0)")]),
    ],
    ids=lambda one: one.name if isinstance(one, Part) else "",
)
def test_every_fitted_face_has_its_limits_for_either_reader(part, expected, tmp_path):
    text = step.part(part)
    assert b"AP242" in text
    limits = sorted((size + low, size + high, name) for size, low, high, name in expected)
    by_text = sorted(of_text(text), key=lambda one: one[:2])
    by_kernel = sorted(read_back(text, tmp_path / "part.step"), key=lambda one: one[:2])
    for (least, most, name), own, other in zip(limits, by_text, by_kernel, strict=True):
        assert own == (pytest.approx(least, abs=1e-9), pytest.approx(most, abs=1e-9), {name})
        assert other[:2] == (pytest.approx(least, abs=1e-9), pytest.approx(most, abs=1e-9))
        drawn = (least + most) / 2 if part is PLATE else round(most)
        assert list(other[2]) == [pytest.approx(drawn / 2, abs=1e-6)]


def test_a_part_without_fits_stays_ap214_and_has_no_dimension(tmp_path):
    bare = plate()
    text = step.part(bare)
    assert b"AP242" not in text
    assert of_text(text) == read_back(text, tmp_path / "part.step") == []
    # The settings of the kernel are put back after a file with limits.
    step.part(PLATE)
    assert step.part(bare) == text


def test_another_process_writes_the_same_bytes():
    code = (
        "import hashlib, sys; sys.path[:0] = ['tests/cam'];"
        "import test_step_limits as t; from mechwright_cad.exporters import step;"
        "print([hashlib.sha256(step.part(one)).hexdigest() for one in (t.RING, t.SHAFT, t.PLATE)])"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(
        [hashlib.sha256(step.part(one)).hexdigest() for one in (RING, SHAFT, PLATE)]
    )


def test_files_of_a_machine_have_the_limits_that_its_parts_have(tmp_path):
    parts = {part.name: part for part in load(ROOT / "examples/geneva-machine.toml", host()).parts()}
    for name in ("lower-plate", "shaft-driver", "crank"):
        part = parts[name]
        own = [one.fit for one in part.features if isinstance(one, Bore) and one.fit] if part.outline else []
        own += [one.fit for one in part.turned.steps if one.fit] if part.turned else []
        found = read_back(step.part(part), tmp_path / f"{name}.step")
        assert sorted(one[:2] for one in found) == [
            (pytest.approx(least, abs=1e-9), pytest.approx(most, abs=1e-9))
            for least, most in sorted(fit.limits for fit in own)
        ]
        assert len(found) >= 2

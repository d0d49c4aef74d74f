"""The checker of machines finds what is planted: in files that were written, and in the parts of a design."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from by_night import by_night
from machine_papers import drawing_faults
from machine_stacks import stack_faults
from machines import Machine, faults, machine_of

from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.holes import exchanged, hole
from mechwright.contracts.named import Named
from mechwright.contracts.part import Bore, Instance, Part
from mechwright.contracts.turned import Step, Turned
from mechwright.geometry import Loop, Outline, circle
from mechwright.pipeline import Build, Wanted
from mechwright.pipeline.fits import DeclaredFits
from mechwright.plugins.host import host
from mechwright_cad.assembly_order.inspections import AssemblyOrder
from mechwright_cad.contacts.inspections import Contact, ScrewLengths
from mechwright_cad.exporters.dxf import part as plate_drawing

EXAMPLES = Path(__file__).parents[1] / "examples"


def test_a_limit_that_a_drawing_has_otherwise_is_named():
    seat = Bore("seat", (3.0, 0.0), 6.006, 0.0, 5.0, hole_fit(6, "H7"))
    inner = Loop((circle((3.0, 0.0), 3.003, clockwise=True),))
    outline = Outline(Loop.polygon([(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)]), (inner,))
    part = Part("plate", outline, 5.0, "steel", (Instance("a"),), machined=(seat,))
    drawn = plate_drawing(part)
    assert list(drawing_faults([part], {"plate.dxf": drawn})) == []
    other = drawn.replace(b"H7 (0/+0.012)", b"H7 (0/+0.018)")
    assert list(drawing_faults([part], {"plate.dxf": other})) == ["plate.dxf: seat is not 6 H7 (0/+0.012)"]
    wide = replace(part, machined=(replace(seat, diameter=6.006, fit=hole_fit(6, "F7")),))
    assert any("is drawn at" in one for one in drawing_faults([wide], {"plate.dxf": drawn}))


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("nominal", 9.9, "float is 0.0000 to 0.2000 mm, and [0.1, 0.3] is told"),
        ("meant", [0.2, 0.3], "closes to 0.1000 to 0.3000 mm"),
        ("name", "other", "no float"),
        ("part", "drum", "a length of drum, which is no part"),
        ("lower", -0.2, "height of pin differs from its drawing"),
    ],
)
def test_a_stack_that_does_not_add_up_is_named(key, value, said):
    length = StackLength("gap", 1, 10.0, -0.1, 0.1)
    stack = AxialStack("float", (length, StackLength("height", -1, 9.8, 0.0, 0.0, part="pin")), 0.1, 0.3)
    from mechwright.contracts.turned import Length

    pin = Turned((Step(4.0, 9.8),), lengths=(Length("height", 0.0, 9.8, 0.0, 0.0),))
    parts = [Part("pin", None, 0.0, "steel", (Instance("a"),), turned=pin)]
    rows = [
        {"name": one.name, "sign": one.sign, "nominal": one.nominal, "part": one.part, "lower": one.lower,
         "upper": one.upper}
        for one in stack.lengths
    ]  # fmt: skip
    told = {"name": "float", "meant": [0.1, 0.3], "worst": [0.1, 0.3], "lengths": rows}

    def found(told: dict) -> list[str]:
        return list(stack_faults(parts, [stack], {"stacks.json": json.dumps([told]).encode()}))

    assert found(told) == []
    if key in told:
        changed = {**told, key: value}
    else:
        which = 0 if key == "nominal" else 1
        changed = {
            **told,
            "lengths": [{**one, key: value} if n == which else one for n, one in enumerate(rows)],
        }
    assert any(said in one for one in found(changed))
    assert list(stack_faults(parts, [stack], {})) == ["stacks.json is not there"]


@pytest.fixture(scope="module")
def four_bar() -> Machine:
    """A machine with its programs and sheets, without a fault."""
    return machine_of(EXAMPLES / "four-bar-machine.toml", "build")


def _without_line(machine: Machine, name: str) -> Machine:
    text = machine.files["bill-of-materials.csv"].decode()
    left = "".join(line for line in text.splitlines(keepends=True) if f",{name}," not in line)
    return replace(machine, files={**machine.files, "bill-of-materials.csv": left.encode()})


def _line(machine: Machine, old: str, new: str) -> Machine:
    return machine.rewritten("bill-of-materials.csv", old, new)


PLANTED = {
    "a line of the list": (lambda m: _without_line(m, "crank"), "crank stands in 0 lines"),
    "a count": (lambda m: _line(m, ",4,pcs,pillar,", ",3,pcs,pillar,"), "3 of pillar, and the assembly has 4"),
    "a mass": (lambda m: _line(m, "6.89,6.89", "8.89,8.89"), "crank weighs 8.89 g"),
    "a sum of masses": (lambda m: _line(m, "29.33,117.30", "29.33,29.33"), "pillar weigh 29.33 g in all"),
    "an order": (lambda m: _line(m, '"flexible coupling 19 x 25, 6 / 6 mm",,coupling.step', ",,coupling.step"),
                 "coupling is bought, and nothing is said of its order"),
    "a drawing": (lambda m: m.without("pin-a.pdf"), "pin-a.pdf, which is not there"),
    "a solid": (lambda m: m.without("crank.step"), "crank.step, which is not there"),
    "a limit in a plate's drawing": (lambda m: m.rewritten("crank.dxf", "P7 (-0.02/-0.008)", "P7 (-0.02/0)"),
                                     "crank.dxf: bore-2 is not 6 P7 (-0.02/-0.008)"),
    "a limit in a pin's drawing": (lambda m: m.rewritten("pin-a.dxf", "h6 (-0.008/0)", "h6 (-0.009/0)"),
                                   "pin-a.dxf: no %%c6 h6 (-0.008/0)"),
    "a limit in a sheet": (lambda m: m.rewritten("crank.setup.html", "5.9800", "5.9700"),
                           "crank.setup.html: bore-2 is not measured from 5.9800 to 5.9920"),
    "a size in a sheet": (lambda m: m.rewritten("crank.setup.html", "made to 5.986", "made to 5.996"),
                          "crank.setup.html: bore-2 is not made to 5.986"),
    "a fit in the guide": (lambda m: m.rewritten("assembly.html", "⌀6 P7 / 6 h6", "⌀6 N7 / 6 h6"),
                           "assembly.html: pin-a in crank is ⌀6 N7 / 6 h6"),
    "a play in the guide": (lambda m: m.rewritten("assembly.html", "0.004 to 0.028 mm tight", "0.004 to 0.030 mm tight"),
                            "bushing in coupler has 0.004 to 0.030 mm tight"),
    "a step of the guide": (lambda m: m.rewritten("assembly.html", "circlip-6 (102)", "the ring"),
                            "assembly.html: no step names circlip-6"),
    "a play on the page of tolerances": (lambda m: m.rewritten("tolerances.html", "0.02..0.04", "0.02..0.05"),
                                         "tolerances.html: pin-a has 0.02..0.05"),
    "a length of a stack": (lambda m: m.rewritten("stacks.json", '"nominal": 15.4', '"nominal": 15.3'),
                            "upper end of the shaft to the loaded wall of the groove of shaft differs"),
    "a bore": (lambda m: replace(m, files={**m.files, "crank.step": m.files["coupler.step"]}),
               "crank.step: bore-1 is"),
    "a body": (lambda m: replace(m, files={**m.files, "assembly.step": m.files["crank.step"]}),
               "assembly.step: crank-shaft is not there"),
}  # fmt: skip
"""What is planted to how, and to words in which the checker names it."""


@by_night
def test_the_machine_is_without_a_fault(four_bar):
    assert faults(four_bar) == []


@by_night
@pytest.mark.parametrize("what", list(PLANTED))
def test_what_is_planted_in_the_papers_is_named(four_bar, what):
    plant, said = PLANTED[what]
    found = faults(plant(four_bar))
    assert any(said in one for one in found), found


def _codes(example: str, change) -> set[str]:
    """What the inspections of the assembly find once the parts are changed."""
    with Build(EXAMPLES / f"{example}.toml", host(), Wanted("model")) as build:
        build._kept["parts"] = Named(change({part.name: part for part in build.parts}).values())
        asked = (DeclaredFits(), ScrewLengths(), Contact(), AssemblyOrder())
        return {
            finding.code for one in asked for finding in one.findings(build) if finding.severity != "note"
        }


def _without(name: str):
    return lambda parts: {key: part for key, part in parts.items() if key != name}


def _bore(name: str, bore: str, **changes):
    def change(parts):
        old = hole(parts[name], bore)
        return {**parts, name: exchanged(parts[name], old, replace(old, **changes))}

    return change


def _moved(name: str, lift: float):
    def change(parts):
        part = parts[name]
        return {
            **parts,
            name: replace(part, instances=tuple(replace(at, z=at.z + lift) for at in part.instances)),
        }

    return change


def _ringless(parts):
    """Without the circlip, and the shaft without its groove."""
    shaft = parts["shaft-2"]
    plain = replace(shaft, turned=replace(shaft.turned, grooves=(), lengths=(), threads=()), build=None)
    return {key: part for key, part in {**parts, "shaft-2": plain}.items() if not key.startswith("circlip")}


CHANGED = {
    "no circlip": ("four-bar-machine", _without("circlip-6"), "contact.groove"),
    "no screw": ("four-bar-machine", _without("screw-m5x12"), "contact.thread"),
    "no bush": ("four-bar-machine", _without("bushing-ground"), "contact.empty"),
    "no coupling": ("four-bar-machine", _without("coupling"), "contact.motor"),
    "a pin without limits": ("four-bar-machine", _bore("crank", "bore-2", fit=None), "fit.missing"),
    "a hole in which a pin may be loose": (
        "four-bar-machine", _bore("ground", "bore-2", diameter=6.0, fit=hole_fit(6, "J7")), "assembly.loose"),
    "a link over its place": ("four-bar-machine", _moved("motor-plate", -0.4), "contact.seat"),
    "a foot beside its leg": ("four-bar-machine", _moved("foot", -60.0), "contact.floating"),
}  # fmt: skip
"""What is planted to the example, the change, and the code of the finding."""


@by_night
@pytest.mark.parametrize("what", list(CHANGED))
def test_what_is_planted_in_the_parts_is_named(what):
    example, change, code = CHANGED[what]
    assert code in _codes(example, change)

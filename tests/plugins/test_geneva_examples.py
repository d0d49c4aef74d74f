"""The examples are built without a warning, and LinuxCNC takes every program."""

import importlib.util
import json
import re
import sys
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.contracts.finding import Severity
from mechwright.contracts.part import Pocket
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright.testing.commands import run
from mechwright.tolerances import TOLERANCES
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.parameters import GenevaParams

ROOT = Path(__file__).parents[2]
EXAMPLES = {"cycloidal": "build", "prototype": "build", "straight": "cam", "twelve-stops": "cam"}
"""How much of each is made here; the contract models a straight wheel, whose roller takes long to compare."""
LIKE = {"prototype", "straight", "twelve-stops"}
"""Those that are like another one are made by night: the contract machines a straight wheel."""


def rs274():
    path = ROOT / "tests" / "cam" / "rs274.py"
    spec = importlib.util.spec_from_file_location("rs274", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["rs274"] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(
    scope="module", params=[pytest.param(name, marks=by_night if name in LIKE else ()) for name in EXAMPLES]
)
def built(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param) / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            "mechwright_cad.solid_models.available_cores", lambda: 1
        )  # a second process would import all again
        done = run(EXAMPLES[request.param], ROOT / "examples" / f"geneva-{request.param}.toml", "-o", folder)
    assert done.returncode == 0, done.stderr
    return request.param, folder, done


def test_without_a_warning(built):
    """But that no plate is sold as thick as that of the worked design."""
    name, _, done = built
    warned = re.findall(r"warning \[([a-z.-]+)\]", done.stderr + done.stdout)
    assert set(warned) == ({"stock.thickness"} if name == "cycloidal" else set())
    design = load(ROOT / "examples" / f"geneva-{name}.toml", host())
    assert {finding.severity for finding in design.family.check(design.params)} == {Severity.NOTE}


def test_every_plate_is_proven(built):
    name, folder, _ = built
    proofs = json.loads((folder / "proof.json").read_text(encoding="utf-8"))
    assert set(proofs) == {"wheel", "locking-disc", "crank"}
    for part, proof in proofs.items():
        assert 0 <= proof["gouge_max_mm"] <= TOLERANCES.gouge, part
        assert 0 <= proof["leftover_reachable_max_mm"] <= TOLERANCES.leftover, part
        assert (folder / f"{part}.dxf").stat().st_size > 1000
        assert EXAMPLES[name] == "cam" or (folder / f"{part}.step").stat().st_size > 1000
    assert EXAMPLES[name] == "cam" or (folder / "roller.step").exists()
    assert not (folder / "roller.nc").exists()


def test_linuxcnc_takes_every_program(built, tmp_path):
    witness = rs274()
    if witness.RS274 is None:
        pytest.skip("rs274 is not installed (Debian package linuxcnc-uspace)")
    _, folder, _ = built
    programs = sorted({*folder.glob("*.nc"), *folder.glob("*.ngc")})
    assert len(programs) >= 3
    for program in programs:
        text = program.read_text(encoding="utf-8")
        table = (folder / "tool.tbl").read_text(encoding="utf-8")
        # The packaged interpreter reads lengths in inches: the tools are named, and have none.
        tools = "".join(
            f"{' '.join(line.split()[:2])}\n" for line in table.splitlines() if line.startswith("T")
        )
        canon = witness.run_rs274(text, tmp_path, tools)
        assert canon.ok, f"{program.name}: {canon.error}"
        assert len(canon.ends) > 100
        assert "G54" in text
        assert "G43" in text


def test_the_reference_example_is_the_worked_design():
    params = load(ROOT / "examples" / "geneva-cycloidal.toml", host()).params
    assert isinstance(params, GenevaParams)
    m = mechanism_of(params)
    assert (m.axes, m.crank) == pytest.approx((128.557521937308, 100.0), abs=1e-9)
    assert (m.roller, m.rim, m.lock, m.slots) == (5, 100, 70, 4)
    assert m.params.roller_length == 10


def test_the_prototype_says_what_is_inferred():
    path = ROOT / "examples" / "geneva-prototype.toml"
    text = path.read_text(encoding="utf-8")
    assert "inferred" in text
    params = load(path, host()).params
    assert (params.entry_radius, params.offset_angle, params.roller_radius, params.thickness) == (
        70,
        12,
        5,
        10,
    )


def test_blind_grooves_are_open_at_the_rim():
    design = load(ROOT / "examples" / "geneva-cycloidal.toml", host())
    wheel = next(part for part in design.family.parts(design.params) if part.name == "wheel")
    grooves = [feature for feature in wheel.features if isinstance(feature, Pocket)]
    assert len(grooves) == 4
    assert {groove.depth for groove in grooves} == {10.5}
    for groove in grooves:
        corners = groove.boundary.flatten()
        reach = (corners**2).sum(axis=1) ** 0.5
        assert (reach > 100.9).sum() >= 4
        assert reach.min() > 23


def test_a_straight_wheel_is_cut_through():
    design = load(ROOT / "examples" / "geneva-straight.toml", host())
    wheel = next(part for part in design.family.parts(design.params) if part.name == "wheel")
    assert not [feature for feature in wheel.features if isinstance(feature, Pocket)]
    assert len([s for s in wheel.outline.outer.segments if s.tag == "slot"]) == 3 * 6


@by_night
@pytest.mark.parametrize(("slots", "law"), [(3, "cycloidal"), (12, "4-5-6-7")])
def test_a_number_of_slots_builds_end_to_end(tmp_path, slots, law):
    """The widest and the narrowest curved slots: solids without interference, programs proven, as made it runs."""
    table = f'slots = {slots}\nlaw = "{law}"\nmaterial = "aluminium"\n'
    path = tmp_path / "design.toml"
    path.write_text(f'family = "geneva"\nname = "stops"\n[parameters]\n{table}', encoding="utf-8")
    done = run("build", path, "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert "error" not in done.stderr
    assert set(json.loads((tmp_path / "out" / "proof.json").read_text(encoding="utf-8"))) == {
        "wheel",
        "locking-disc",
        "crank",
    }
    assert (tmp_path / "out" / "as-made.html").exists()


@by_night
def test_the_requirement_gives_designs_that_build(tmp_path):
    done = run("synthesize", ROOT / "examples" / "geneva-requirement.toml", "-o", tmp_path / "found")
    assert done.returncode == 0, done.stderr
    files = sorted((tmp_path / "found").glob("six-stops-*.toml"))
    assert len(files) == 3
    pressures = []
    summary = json.loads((tmp_path / "found" / "synthesis.json").read_text(encoding="utf-8"))
    for file in files:
        assert run("check", file).returncode == 0
        m = mechanism_of(load(file, host()).params)
        params = m.params
        length = m.rim + m.axes + m.crank + max(m.roller, params.pin_diameter / 2 + params.least_wall)
        assert length <= 320 + 1e-6
        assert length > 310, "the space is used"
        assert 2 * m.crank_half / (2 * 3.141592653589793) <= 0.4 + 1e-9
        from mechwright_geneva.kinematics.contact_forces import loads

        pressures.append(loads(m).pressure)
    assert pressures == sorted(pressures)
    assert max(pressures) <= 400
    assert summary

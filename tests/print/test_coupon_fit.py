"""A coupon of a printer with known errors gives them back, and what is out of reason is named."""

import numpy as np
import pytest
from synthetic import SyntheticPrinter, drawn

from mechwright.errors import DesignError
from mechwright_print.coupon.calibrated import calibrated
from mechwright_print.coupon.doubts import doubts
from mechwright_print.coupon.features import ROWS
from mechwright_print.coupon.filled import Measured, empty_table, read_coupon
from mechwright_print.coupon.fitted import UNKNOWNS, fit, system
from mechwright_print.printer.printer_file import printer_text, read_printer
from mechwright_print.printer.settings import Printer

DRAWS = 200
GOOD = SyntheticPrinter(1.002, 0.999, -0.25, -0.12, 0.08, 0.1, 0.12)


def test_printers_are_measured_back_without_noise():
    for seed in range(DRAWS):
        true = drawn(seed)
        found = fit(true.sizes(np.random.default_rng(seed), 0.0))
        for name in UNKNOWNS:
            # a scale counts by what it does to the longest size of the coupon
            lever = 100.0 if name.startswith("scale") else 1.0
            assert abs(found.values[name] - getattr(true, name)) * lever < 0.01
        assert found.spread < 1e-9


def test_standard_errors_are_true_with_the_noise_of_a_calliper():
    score = []
    spreads = []
    for seed in range(DRAWS):
        true = drawn(seed)
        sizes = true.sizes(np.random.default_rng(1000 + seed), 0.02)
        found = fit(sizes)
        score.append([(found.values[name] - getattr(true, name)) / found.errors[name] for name in UNKNOWNS])
        spreads.append(found.spread)
        assert doubts(Measured(sizes)) == []
    score = np.abs(score)
    # Student's t with 34 degrees of freedom: 0.5 % lie beyond 3, and their standard deviation is 1.03.
    assert (score < 3).mean() > 0.99
    assert score.max() < 5
    assert np.sqrt((score**2).mean(axis=0)) == pytest.approx(1.03, abs=0.12)
    assert np.mean(spreads) == pytest.approx(0.02, rel=0.02)


def test_the_system_is_that_of_the_model():
    matrix = system()
    values = np.array([0.002, -0.001, -0.25, -0.12, 0.08, 0.1, 0.12])
    more = [GOOD.size(row.kind, row.axis, row.nominal) - row.nominal for row in ROWS]
    assert matrix @ values == pytest.approx(more, abs=1e-12)
    assert np.linalg.matrix_rank(matrix) == len(UNKNOWNS)


def noisy() -> dict[str, float]:
    return GOOD.sizes(np.random.default_rng(5), 0.015)


def said(sizes: dict[str, float], **trials: str) -> str:
    return "\n".join(doubts(Measured(sizes, trials)))


def test_inches_are_named():
    for row in ROWS:
        sizes = noisy()
        sizes[row.name] /= 25.4
        assert said(sizes).startswith(f"{row.name}: ")
        assert "inches" in said(sizes)
        assert "\n" not in said(sizes)


def test_a_whole_table_in_inches_is_one_line():
    assert said({name: value / 25.4 for name, value in noisy().items()}) == (
        "all values are in inches; write them in mm, or multiply them by 25.4"
    )


@pytest.mark.parametrize(
    ("one", "two"),
    [("hole-3", "hole-4"), ("hole-5", "hole-10"), ("length-x-20", "length-x-100"), ("pin-x-8", "wall-y-2")],
)
def test_exchanged_rows_are_named(one, two):
    sizes = noisy()
    sizes[one], sizes[two] = sizes[two], sizes[one]
    told = said(sizes)
    assert "exchanged" in told
    assert one in told
    assert two in told
    assert "\n" not in told


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_an_outlier_is_named_alone(row):
    sizes = noisy()
    sizes[row.name] += 0.45
    told = said(sizes)
    assert told.startswith(f"{row.name}: ")
    assert "measure it again" in told
    assert "\n" not in told


def test_trials_that_contradict_each_other_are_named():
    found = doubts(Measured(noisy(), {0.1: "turns", 0.2: "stuck"}))
    assert len(found) == 1
    assert "gap-0.20" in found[0]
    assert "gap-0.10" in found[0]


def filled(sizes: dict[str, float], comma: bool = False) -> str:
    lines = []
    for line in empty_table().splitlines():
        name, nominal, value, *how = line.split(",", 3)
        value = f"{sizes[name]:.3f}" if name in sizes else value
        cells = [name, nominal, value, *how]
        lines.append(";".join(cells).replace(".", ",") if comma else ",".join(cells))
    if comma:
        lines = [
            line.replace("gap-0,", "gap-0.")
            .replace("wall-x-1,2", "wall-x-1.2")
            .replace("wall-y-1,2", "wall-y-1.2")
            for line in lines
        ]
    return "\n".join(lines) + "\n"


def test_a_table_is_read_with_points_and_with_commas(tmp_path):
    sizes = {name: round(value, 3) for name, value in noisy().items()}
    for comma in (False, True):
        path = tmp_path / f"coupon-{comma}.csv"
        path.write_text(filled(sizes, comma))
        assert read_coupon(path).sizes == pytest.approx(sizes)


def test_missing_unknown_double_and_wrong_rows_are_told_with_their_places(tmp_path):
    lines = filled(noisy()).splitlines()
    kept = [line for line in lines if not line.startswith(("hole-5,", "pin-x-3,"))]
    kept += ["hole-99,5,4.9,", lines[1], 'pin-x-3,3,"about 3",']
    path = tmp_path / "coupon.csv"
    path.write_text("\n".join(kept))
    with pytest.raises(DesignError) as caught:
        read_coupon(path)
    told = str(caught.value)
    assert "the row hole-5 is missing" in told
    assert "no feature is named 'hole-99'" in told
    assert f"{lines[1].split(',')[0]} is there twice" in told
    assert "pin-x-3: 'about 3' is no number" in told


def test_a_doubtful_coupon_writes_nothing(tmp_path, command_line):
    sizes = noisy()
    sizes["hole-5"] /= 25.4
    path, out = tmp_path / "coupon.csv", tmp_path / "printer.toml"
    path.write_text(filled(sizes))
    code, _, err = command_line("print", "--measured", path, "-o", out)
    assert code == 2
    assert "hole-5" in err
    assert not out.exists()


def test_the_printer_is_written_and_read_back(tmp_path):
    measured = Measured(noisy(), GOOD.trials(0.15))
    printer, found = calibrated(measured, Printer(nozzle=0.6, name="test"))
    path = tmp_path / "printer.toml"
    path.write_text(printer_text(printer, "measured"))
    assert read_printer(path) == printer
    assert printer.measured
    assert printer.nozzle == 0.6
    assert printer.deviation.hole == pytest.approx(found.values["hole"], abs=1e-4)
    # from a gap of 0.33 mm on the pin turns, and 0.40 mm is the first such trial
    assert printer.clearance.turning == pytest.approx(0.40 + (-0.25 - 0.08) / 2, abs=0.02)
    assert 0 <= printer.clearance.snug < printer.clearance.sliding < printer.clearance.turning


def test_bores_and_pins_of_a_pair_come_out_within_the_fit():
    rng = np.random.default_rng(3)
    outside = 0
    for seed in range(DRAWS):
        true = drawn(seed)
        printer, _ = calibrated(Measured(true.sizes(rng, 0.02)), Printer())
        scatter = printer.scatter("hole", "pin")
        for size in (4.0, 8.0, 12.0):
            scale = (printer.deviation.scale_x + printer.deviation.scale_y) / 2
            target = size + 2 * printer.clearance.turning
            hole = true.size("hole", "round", (target - printer.hole_off(target)) / scale)
            pin = true.size("pin", "round", (size - printer.deviation.pin) / scale)
            play = hole - pin + 0.02 * float(rng.standard_normal() - rng.standard_normal())
            outside += abs(play - 2 * printer.clearance.turning) > scatter
    assert outside / (3 * DRAWS) < 0.01

"""The printer that a measured coupon describes, and what there is to say of it."""

from collections.abc import Iterator, Mapping

from mechwright.errors import DesignError
from mechwright_print.coupon.doubts import doubts
from mechwright_print.coupon.features import GAUGE_PIN, WORDS
from mechwright_print.coupon.filled import Measured
from mechwright_print.coupon.fitted import PrinterFit, fit
from mechwright_print.printer.settings import SIGMAS, Clearances, Deviation, Printer, Uncertainty

WIDE = 0.1
"""Above this spread, mm, a printer is worth a look before parts are printed."""
STEP = 0.05
"""Between two trials, mm: a shaft that is pressed has so much less than one that is pushed."""
DIGITS = 4
"""A tenth of a micrometre: the file says what was found, and no more."""


def calibrated(measured: Measured, base: Printer) -> tuple[Printer, PrinterFit]:
    """The printer ``base`` with what a coupon says of it.

    Raises DesignError with one line for each thing that is out of reason.
    """
    if found := doubts(measured):
        raise DesignError("\n".join(found))
    of = fit(measured.sizes)
    value = {name: round(one, DIGITS) + 0.0 for name, one in of.values.items()}
    error = {name: round(one, DIGITS) for name, one in of.errors.items()}
    for name in ("scale_x", "scale_y"):
        if not 0.9 <= of.values[name] <= 1.1:
            raise DesignError(f"{name} would be {of.values[name]:.3f}; lengths are in mm along their axis")
    changes = {
        "measured": True,
        "spread": round(of.spread, DIGITS),
        "deviation": Deviation(
            hole=value["hole"],
            slot=value["slot"],
            pin=value["pin"],
            wall=value["wall"],
            foot=max(value["foot"], 0.0),
            scale_x=round(of.values["scale_x"], 6),
            scale_y=round(of.values["scale_y"], 6),
        ),
        "uncertainty": Uncertainty(
            hole=error["hole"], slot=error["slot"], pin=error["pin"], wall=error["wall"], foot=error["foot"]
        ),
        "clearance": _clearances(measured.trials, of, base.clearance),
    }
    return base.model_copy(update=changes), of


def side_clearance(gap: float, of: PrinterFit) -> float:
    """What stood on each side of the gauge pin in a trial, as printed, mm."""
    return gap + (of.values["hole"] - of.values["pin"]) / 2


def _clearances(trials: Mapping[float, str], of: PrinterFit, base: Clearances) -> Clearances:
    """By what the gauge pin did; what no trial tells stays as it was."""
    if not trials:
        return base
    least: dict[str, float] = {}
    for word in WORDS:
        gaps = [gap for gap, said in trials.items() if WORDS.index(said) >= WORDS.index(word)]
        if gaps:
            least[word] = side_clearance(min(gaps), of)
    found = base.model_dump()
    pairs = {"snug": "pushed", "sliding": "slides", "turning": "turns"}
    found |= {kind: round(max(least[word], 0.0), DIGITS) for kind, word in pairs.items() if word in least}
    if "pushed" in least:
        found["press"] = round(least["pushed"] - STEP, DIGITS)
    if "turns" in least:
        found["loose"] = found["turning"]
    return Clearances(**found)


def report(printer: Printer, of: PrinterFit, measured: Measured) -> Iterator[str]:
    """What to say of a fit, a line each."""
    yield f"{len(of.residuals)} sizes, spread {of.spread:.3f} mm (standard deviation about the fit)"
    for name in ("hole", "slot", "pin", "wall", "foot"):
        yield f"{name} {round(of.values[name], 3) + 0.0:+.3f} mm, standard error {of.errors[name]:.3f} mm"
    for axis in ("x", "y"):
        growth, error = 1000 * (of.values[f"scale_{axis}"] - 1), 1000 * of.errors[f"scale_{axis}"]
        yield f"lengths along {axis.upper()} {growth:+.2f} mm in a metre, standard error {error:.2f} mm"
    pair = printer.scatter("hole", "pin")
    for kind in ("press", "snug", "sliding", "turning"):
        side = printer.side_clearance(kind)
        hole = printer.scatter("hole")
        yield (
            f"{kind}: play {2 * side:.2f} mm on the diameter; ±{hole:.2f} mm on a metal shaft, "
            f"±{pair:.2f} mm on a printed one"
        )
    if of.values["foot"] < -SIGMAS * of.errors["foot"]:
        yield "note: the lowest layer is narrower than the rest: the nozzle stands too far from the bed"
    if of.spread > WIDE:
        yield f"note: a spread above {WIDE:g} mm is wide: look at belts, temperature and filament first"
    if not measured.trials:
        yield f"note: no trial of the gauge pin ⌀{GAUGE_PIN:g} is written: the clearances stay as they were"
    elif "turns" not in measured.trials.values():
        yield "note: the gauge pin turned in no trial: clearance.turning stays as it was"

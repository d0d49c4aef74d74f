"""What tests of tolerance models share: differences of their errors, and deviations by name."""

import numpy as np


def deviations(model, shape=(), **given):
    """Deviations of all contributors, none but those that are given."""
    found = {one.name: np.zeros((one.components, *shape)) for one in model.contributors}
    for name, value in given.items():
        found[name.replace("_", "-")][0] = value
    return list(found.values())


def differences(model, output, at, step=1e-5):
    """Central differences (c, m, n) of the exact error by each contributor."""
    found = []
    for number, one in enumerate(model.contributors):
        rows = []
        for component in range(one.components):
            ends = []
            for sign in (1, -1):
                moved = deviations(model, (1,))
                moved[number][component] = sign * step
                ends.append(model.errors(output, moved, at))
            rows.append((ends[0] - ends[1]) / (2 * step))
        found.append(np.stack(rows, axis=1))
    return found


def assert_exact(model, at, within=1e-6, step=1e-5):
    """Sensitivities are the derivatives of the exact errors, and no deviation is no error."""
    for output in model.outputs:
        rows = model.sensitivities(output.name, at)
        for one, row, slope in zip(
            model.contributors, rows, differences(model, output.name, at, step), strict=True
        ):
            assert row.shape == (output.components, one.components, at.size)
            good = np.isfinite(row)
            scale = max(1.0, float(np.abs(row[good]).max(initial=0.0)))
            worst = np.abs(row - slope)[good].max(initial=0.0)
            assert worst <= within * scale, f"{output.name} by {one.name}: {worst:g} off"
        nothing = model.errors(output.name, deviations(model, (1,)), at)
        assert np.nanmax(np.abs(nothing)) < 1e-9

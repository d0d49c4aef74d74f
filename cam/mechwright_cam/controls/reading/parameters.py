"""Parameters that LinuxCNC keeps for itself: a program that writes them changes the machine, not its sums."""

FIRST, LAST = 1, 5000
"""Numbers of the parameters that belong to programs."""
_KEPT = (
    (5061, 5070, "results of a probe"),
    (5161, 5169, "the place that G28 goes to"),
    (5181, 5189, "the place that G30 goes to"),
    (5210, 5219, "the origin shift of G92"),
    (5220, 5390, "the work offsets"),
    (5399, 5399, "the result of M66"),
    (5400, 5413, "the tool in the spindle and its offsets"),
    (5420, 5428, "where the tool is"),
    (5599, 5599, "whether comments are shown"),
)
_NAMES = frozenset(
    (
        *("_abs_x", "_abs_y", "_abs_z", "_abs_a", "_abs_b", "_abs_c", "_absolute", "_adaptive_feed"),
        *("_call_level", "_ccomp", "_coord_system", "_current_pocket", "_current_tool", "_feed"),
        *("_feed_hold", "_feed_override", "_flood", "_ijk_absolute_mode", "_imperial", "_incremental"),
        *("_lathe_diameter_mode", "_lathe_radius_mode", "_line", "_metric", "_mist", "_motion_mode"),
        "_inverse_time",
        *("_plane", "_remap_level", "_retract_old_z", "_retract_r_plane", "_rpm", "_selected_pocket"),
        *("_selected_tool", "_speed_override", "_spindle_css_mode", "_spindle_cw", "_spindle_on"),
        *("_spindle_rpm_mode", "_task", "_tool_offset", "_units_per_minute", "_units_per_rev", "_vmajor"),
        *("_vminor", "_x", "_y", "_z", "_a", "_b", "_c", "_u", "_v", "_w", "_value", "_value_returned"),
    )
)


def check_writable(name: float | str) -> None:
    """Do nothing if a program may write this parameter.

    Raises
    ------
    ValueError
        The machine keeps it; the text says what it holds.

    Examples
    --------
    >>> check_writable(31.0), check_writable("depth"), check_writable("_depth")
    (None, None, None)
    >>> check_writable(5221.0)
    Traceback (most recent call last):
    ValueError: #5221 holds the work offsets, which the machine keeps; a program writes #1 to #5000
    """
    if isinstance(name, str):
        if name in _NAMES or name.startswith(("_ini[", "_hal[")):
            raise ValueError(
                f"#<{name}> is kept by the machine and not written by a program; take another name"
            )
    elif not FIRST <= round(name) <= LAST:
        held = [what for first, last, what in _KEPT if first <= round(name) <= last]
        holds = f"holds {held[0]}, which the machine keeps" if held else "is no program's"
        raise ValueError(f"#{name:g} {holds}; a program writes #{FIRST} to #{LAST}")

"""What of the machine's travel is not known: the operator looks where the proof cannot."""

from collections.abc import Sequence

from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths


def about_ends(
    job: Job, tools: Sequence[int], reach: tuple[float, float, float, float] | None, to: Lengths
) -> tuple[str, ...]:
    """Sentences about ends of axes, and places of the work in the machine, that are not known.

    Parameters
    ----------
    tools
        T numbers of the program.
    reach
        Least x, least y, greatest x, greatest y that any cutter reaches, mm.
    """
    machine, measured = job.settings.machine, job.settings.measured
    if not machine.homed:  # there are no machine coordinates: the room around the zero is told instead
        return ()
    said = []
    if machine.open_axes:
        axes = " and ".join(axis.upper() for axis in machine.open_axes)
        keys = ", ".join(f"low_{axis}" for axis in machine.open_axes)
        said.append(f"The ends of {axes} in machine coordinates are not known ([cam.machine], {keys}).")
    if machine.low_z is None:
        low, high = (to.signed(end, 1) for end in machine.ends("z"))
        said.append(f"Machine Z is taken to travel from {low} to {high} ([cam.machine], low_z is not given).")
    places = [axis for axis in "xyz" if getattr(measured, axis) is None]
    if places:
        said.append(
            "Where the work stands in the machine is not known ([cam.measured], "
            f"{', '.join(places)}), so no move in the work is compared with the ends of travel."
        )
    elif lacking := [tool for tool in job.tools if tool.number in tools and tool.length is None]:
        names = ", ".join(f"T{tool.number}" for tool in lacking)
        said.append(
            f"The lengths of {names} are not known, so their heights are not compared with the ends of Z."
        )
    if said and reach is not None:
        x0, y0, x1, y1 = (to.signed(value, 1) for value in reach)
        said.append(
            f"When zero is set, jog from X {x0} to {x1}, from Y {y0} to {y1}, and up to "
            f"Z {to.signed(job.settings.clearance, 1)} with the longest tool: no axis may come to its end."
        )
    return tuple(said)

"""The motion of a five-bar: channels, poses and figures over one period of the crank."""

from mechwright import Channel, KinematicsError, Load, Motion, Scalar, Stage, Trace
from mechwright.contracts.figure import scalars
from mechwright.contracts.finding import errors, refuse
from mechwright.contracts.stretch import Samples
from mechwright.mechanics.linkage.kinematics.period import Period, period_of
from mechwright_five_bar.kinematics.channels import channels_over
from mechwright_five_bar.kinematics.figures import figures_of
from mechwright_five_bar.kinematics.loads import FORCES, forces_of, loads_of
from mechwright_five_bar.parts.bodies import masses_of
from mechwright_five_bar.parts.frames import frames_of, held_by
from mechwright_five_bar.rules.motion import RUNS
from mechwright_five_bar.rules.rule_table import DESIGN
from mechwright_five_bar.table import FiveBarTable


def motion_of(m: FiveBarTable, samples: Samples) -> Motion:
    """Sample the turns of the crank that bring the linkage back, or one swing there and back, ends included.

    Forces and masses are those of the real parts, and left out where there can be none.

    Raises
    ------
    KinematicsError
        There is an error of the motion; the message is that of the first one.
    """
    require_motion(m)
    return motion_over(m, period_of(m, samples), varies=bool(m.is_lever))


def require_motion(m: FiveBarTable) -> None:
    """Raise as :func:`motion_of` does."""
    refuse(RUNS.findings(m, quick=True), Stage.MOTION, KinematicsError)


def motion_over(m: FiveBarTable, period: Period, *, varies: bool = True) -> Motion:
    """The motion over samples of the crank; ``varies``: its speed does."""
    channels, figures = channels_over(m, period, varies=varies), scalars(figures_of(m))
    if not m.once("faults", lambda: errors(DESIGN.findings(m, quick=True))):
        masses = masses_of(m)
        forces = forces_of(m, period.solution, masses)
        channels |= {name: Channel(forces[name], *said) for name, said in FORCES.items()}
        figures |= {f"{name}_max": value for name, value in loads_of(m).peaks.items()}
        figures |= {f"mass_{name}": Scalar(mass.mass, "kg") for name, mass in masses.items()}
    point, params = m.params.coupler_point, m.params
    trace = Trace("coupler", (point.real, point.imag, 0.0))
    load = Load("coupler", force=(params.load_x, params.load_y, 0.0), point=trace.point)
    frames, held = frames_of(m, period.solution.bodies), held_by(m)
    return Motion("theta", channels, frames, figures, {"P": trace}, held, loads={"load": load})

"""Torques and tooth forces of the meshes over a turn, at constant speed of gear 2.

The torque on a driven gear is the power that goes through its mesh over its speed: what gears and coupler
behind it take up by inertia, and the load. Teeth touch at the pitch point, where one pair carries all.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.gearing import TO_NM, driven_torque, turned_back
from mechwright.mechanics.peak import Peak
from mechwright.mechanics.strength.tooth_bending import EllipticMesh, tangential_force
from mechwright_elliptic_gears.kinematics.equations import Turning, driven, train
from mechwright_elliptic_gears.kinematics.joint_load import gear_inertia, masses_of, torque_behind
from mechwright_elliptic_gears.kinematics.peak import grid_of, peak
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of

_SAMPLES = 721
"""Angles of a turn at which the sign of a torque is asked for."""


@dataclass(frozen=True)
class Mesh:
    """One pair of a design.

    Parameters
    ----------
    names
        Of driver and driven gear, such as ``("2", "3")``.
    params
        The design.
    """

    names: tuple[str, str]
    params: EllipticGearParams

    def turning(self, theta2: Array) -> tuple[Turning, Turning, Array]:
        """Driver and driven gear at angles (n,) of gear 2, rad and rad/s, and the torque on the driven one.

        The torque, N m, is positive where the mesh drives that gear on, negative where it holds it back.
        """
        params, e = self.params, self.params.eccentricity
        gear2 = Turning.of(theta2, params.speed * math.tau / 60)
        if params.stages == 1:
            follower = driven(gear2, e)
            faster = np.sign(follower.omega) * follower.alpha
            return gear2, follower, driven_torque(gear_inertia(params), faster, params.load_torque)
        masses = masses_of(params)
        gear3, gear4, gear5 = train(gear2, e, params.phase_angle or 0.0)
        if self.names == ("2", "3"):
            behind = torque_behind(gear4, gear5, params, masses) + masses.gear * gear3.alpha * TO_NM
            return gear2, gear3, np.sign(gear3.omega) * behind
        # All that is behind gear 4 goes through this mesh; the coupler's own way is left out.
        behind = torque_behind(gear4, gear5, params, masses, driver=False)
        return gear4, gear5, np.sign(gear5.omega) * behind * gear4.omega / gear5.omega

    def torque(self, theta2: Array) -> Array:
        """On the driven gear, N m, as of :meth:`turning`."""
        return self.turning(theta2)[2]

    def loaded(self, theta2: Array) -> tuple[EllipticMesh, Array]:
        """The pitch point, and the force (n,), N, along the pitch tangent, of the shorter lever."""
        driver, _, torque = self.turning(theta2)
        point = EllipticMesh.at(driver.theta, ellipse_of(self.params).semi_major, self.params.eccentricity)
        alpha = math.radians(self.params.pressure_angle)
        return point, tangential_force(np.abs(torque), point.radius, point.slant, alpha)

    def greatest(self, size: Callable[[EllipticMesh, Array], Array]) -> Peak:
        """The greatest of what follows from pitch point and force, as of :meth:`loaded`, and where it is."""
        return self._peak(lambda theta2: size(*self.loaded(theta2)), size(*_loaded(self)))

    def _peak(self, function: Callable[[Array], Array], values: Array | None = None) -> Peak:
        return peak(function, grid_of(self.params.eccentricity), values)

    @property
    def greatest_force(self) -> Peak:
        """Of the teeth on each other, along their normal, N, and where it is."""
        return _greatest_force(self)

    @property
    def greatest_torque(self) -> float:
        """On the driven gear, N m."""
        return self._peak(lambda theta2: np.abs(self.torque(theta2))).value

    @property
    def input_torque(self) -> float:
        """The greatest on the driver, N m."""

        def own(theta2: Array) -> Array:
            driver, follower, torque = self.turning(theta2)
            found: Array = np.abs(torque * follower.omega / driver.omega)
            return found

        return self._peak(own).value

    @property
    def reverses(self) -> bool:
        """Whether the torque changes its sign over a turn, so that both flanks of a tooth are loaded."""
        return turned_back(self.torque(np.linspace(0.0, math.tau, _SAMPLES)))


@kept
def _loaded(mesh: Mesh) -> tuple[EllipticMesh, Array]:
    """What all stresses of a mesh follow from, on the grid where their peaks are sought."""
    return mesh.loaded(grid_of(mesh.params.eccentricity))


@kept
def _greatest_force(mesh: Mesh) -> Peak:
    cos = math.cos(math.radians(mesh.params.pressure_angle))
    return mesh.greatest(lambda _, force: force / cos)


def meshes_of(params: EllipticGearParams) -> tuple[Mesh, ...]:
    """The pairs of a design, from the driver on."""
    if params.stages == 1:
        return (Mesh(("2", "4"), params),)
    return (Mesh(("2", "3"), params), Mesh(("4", "5"), params))

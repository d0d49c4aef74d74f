"""Torques and tooth forces of the meshes over a turn, at constant speed of gear 2.

The torque on a driven gear is the power that goes through its mesh over its speed: what gears and coupler
behind it take up by inertia, and the load. Teeth touch at the pitch point, where one pair carries all.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.strength.tooth_bending import EllipticMesh, tangential_force
from mechwright_elliptic_gears.gear import ellipse_of
from mechwright_elliptic_gears.joint_load import TO_NM, gear_inertia, joint_torque, masses_of
from mechwright_elliptic_gears.kinematics import Turning, driven, train
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.peak import Peak, peak

_SAMPLES = 721
"""Angles of a turn at which the sign of a torque is asked for."""

STEADY = 0.02
"""Share of the greatest torque that has to be turned back before a tooth counts as loaded on both sides."""


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

    def driver(self, theta2: Array) -> Turning:
        """The driving gear at angles (n,) of gear 2, rad and rad/s."""
        gear2 = Turning.of(theta2, self.params.speed * math.tau / 60)
        if self.names[0] == "2":
            return gear2
        return train(gear2, self.params.eccentricity, self.params.phase_angle or 0.0)[1]

    def contact(self, theta2: Array) -> EllipticMesh:
        """The pitch point; angles of a driver that turns backwards count the other way."""
        driver = self.driver(theta2)
        return EllipticMesh.at(driver.theta, ellipse_of(self.params).semi_major, self.params.eccentricity)

    def torque(self, theta2: Array) -> Array:
        """On the driven gear, N m, positive where the mesh drives it on, negative where it holds it back."""
        params, e = self.params, self.params.eccentricity
        follower = driven(self.driver(theta2), e)
        sense = np.sign(follower.omega)
        if self.names == ("2", "3"):
            masses = masses_of(params)
            behind = joint_torque(theta2, params, params.phase_angle or 0.0, masses)
            return sense * (behind + masses.gear * follower.alpha * TO_NM)
        if self.names == ("4", "5"):
            # All that is behind gear 4 goes through this mesh; the coupler's own way is left out.
            behind = joint_torque(theta2, params, params.phase_angle or 0.0, masses_of(params), driver=False)
            back: Array = sense * behind * self.driver(theta2).omega / follower.omega
            return back
        own: Array = sense * gear_inertia(params) * follower.alpha * TO_NM + params.load_torque
        return own

    def force(self, theta2: Array) -> Array:
        """Along the pitch tangent, N, of the flank that has the shorter lever."""
        point = self.contact(theta2)
        alpha = math.radians(self.params.pressure_angle)
        return tangential_force(np.abs(self.torque(theta2)), point.radius, point.slant, alpha)

    @property
    def greatest_force(self) -> Peak:
        """Of the teeth on each other, along their normal, N, and where it is."""
        cos = math.cos(math.radians(self.params.pressure_angle))
        return peak(lambda theta2: self.force(theta2) / cos)

    @property
    def greatest_torque(self) -> float:
        """On the driven gear, N m."""
        return peak(lambda theta2: np.abs(self.torque(theta2))).value

    @property
    def input_torque(self) -> float:
        """The greatest on the driver, N m."""

        def own(theta2: Array) -> Array:
            driver = self.driver(theta2)
            ratio = driven(driver, self.params.eccentricity).omega / driver.omega
            found: Array = np.abs(self.torque(theta2) * ratio)
            return found

        return peak(own).value

    @property
    def reverses(self) -> bool:
        """Whether the torque changes its sign over a turn, so that both flanks of a tooth are loaded."""
        torque = self.torque(np.linspace(0.0, math.tau, _SAMPLES))
        most = float(np.abs(torque).max())
        return bool(torque.min() < -STEADY * most and torque.max() > STEADY * most)


def meshes_of(params: EllipticGearParams) -> tuple[Mesh, ...]:
    """The pairs of a design, from the driver on."""
    if params.stages == 1:
        return (Mesh(("2", "4"), params),)
    return (Mesh(("2", "3"), params), Mesh(("4", "5"), params))

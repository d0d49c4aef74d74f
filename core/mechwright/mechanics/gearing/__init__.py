"""Gears of any pitch curves that roll on each other: teeth, outlines, and the proof that a pair meshes.

Glossary
--------
pitch curve
    The curve of a gear that rolls on that of its mate without slip; round in a spur gear.
pitch point
    Where both pitch curves touch, on the line of centres.
driver, driven gear
    The gear whose angle is given, and the other.
"""

from mechwright.mechanics.gearing.bodies import TO_NM, body, driven_torque, turned_back
from mechwright.mechanics.gearing.contour import gear_loop, tip_sites
from mechwright.mechanics.gearing.data import gear_data
from mechwright.mechanics.gearing.exactness import exact_fit, lever_fit
from mechwright.mechanics.gearing.gauging import gear_measures
from mechwright.mechanics.gearing.mesh import Mesh, first_depth, mesh, swing
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.pitch_curve import Frame, PitchCurve
from mechwright.mechanics.gearing.primitive import Primitive
from mechwright.mechanics.gearing.proof import MeshProof, prove_mesh
from mechwright.mechanics.gearing.rack import SIDES, Rack
from mechwright.mechanics.gearing.ratio import RatioLaw
from mechwright.mechanics.gearing.rolled import RolledCurve, RolledPair, Rolling
from mechwright.mechanics.gearing.round import Round, RoundPair
from mechwright.mechanics.gearing.sector import SectorTeeth, sector_loop
from mechwright.mechanics.gearing.shaper import Shaper
from mechwright.mechanics.gearing.teeth import FIT, Teeth

__all__ = [
    "FIT",
    "SIDES",
    "TO_NM",
    "Frame",
    "Mesh",
    "MeshProof",
    "Pair",
    "PitchCurve",
    "Primitive",
    "Rack",
    "RatioLaw",
    "RolledCurve",
    "RolledPair",
    "Rolling",
    "Round",
    "RoundPair",
    "SectorTeeth",
    "Shaper",
    "Teeth",
    "body",
    "driven_torque",
    "exact_fit",
    "first_depth",
    "gear_data",
    "gear_loop",
    "gear_measures",
    "lever_fit",
    "mesh",
    "prove_mesh",
    "sector_loop",
    "swing",
    "tip_sites",
    "turned_back",
]

"""Mechwright: from how a mechanism should move to a proven program for the mill.

What a plugin or a script needs has its name here; each is imported when it is first asked for. Nothing is
before that: until the program listens, the keyboard stops it with a traceback.
"""

__version__ = "0.9.0"

TYPE_CHECKING = False  # as checkers know it by its name; importing it takes longer than everything here
if TYPE_CHECKING:
    from typing import Any

    from mechwright.arrays import Array
    from mechwright.cli.command import Command
    from mechwright.contracts.as_made import AsMade, MadeCurve, MadeFigure
    from mechwright.contracts.axial_stack import AxialStack, Shimming, StackLength
    from mechwright.contracts.bought import Bought
    from mechwright.contracts.design_rule import DesignRule
    from mechwright.contracts.design_table import DesignTable
    from mechwright.contracts.details import Chamfer, Detail, Engraving, Thread
    from mechwright.contracts.evaluation import Batch, Columns
    from mechwright.contracts.exporter import Exporter
    from mechwright.contracts.family import Family
    from mechwright.contracts.figure import Figure, PartMass, scalars
    from mechwright.contracts.finding import (
        Finding,
        Findings,
        Severity,
        Stage,
        at_stage,
        of_stage,
        refuse,
    )
    from mechwright.contracts.fitting_marks import FittingMark
    from mechwright.contracts.inputs import InputFile
    from mechwright.contracts.joint import GROUND, Joint
    from mechwright.contracts.load import Load
    from mechwright.contracts.made_part import MadeHole, MadePart, MadeRing, MadeSection
    from mechwright.contracts.materials import MaterialName, material
    from mechwright.contracts.measure import Measure
    from mechwright.contracts.motion import Channel, Curve, Motion, Poses, Rates, Scalar, Trace
    from mechwright.contracts.mounting import Flange, Foot, GroundPlate, Hub, Mounting, MountingError, Spindle
    from mechwright.contracts.named import Named
    from mechwright.contracts.on_plates import GuideSize, Post, Slideway
    from mechwright.contracts.parameters import FIRST, FITTED, GIVEN, Parameters, kept
    from mechwright.contracts.part import Bore, Colour, Feature, Instance, OpenProfile, Part, Pocket, Profile
    from mechwright.contracts.plugin import HOOK_API, Plugin
    from mechwright.contracts.procedure import Note, Procedure
    from mechwright.contracts.refused import RefusedError
    from mechwright.contracts.result import Result
    from mechwright.contracts.rule_list import Rules, all_of, in_turn
    from mechwright.contracts.standing import Standing
    from mechwright.contracts.synthesis import Candidate, Progress, Reason, Rejected, Synthesis
    from mechwright.contracts.table import Table
    from mechwright.contracts.target import Target, point_targets
    from mechwright.contracts.tolerance_settings import Tolerances
    from mechwright.contracts.tolerances import Contributor, Output, ToleranceModel, Zone
    from mechwright.contracts.transmission import Index, Port, Transmission
    from mechwright.contracts.turned import Groove, KeySeat, Length, Step, Turned
    from mechwright.contracts.turning import Turning
    from mechwright.designs.design import Design
    from mechwright.errors import (
        DesignError,
        GeometryError,
        KinematicsError,
        MechwrightError,
        OutputError,
        PluginError,
        ProgramError,
        ProofError,
        ToolError,
    )
    from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, Segment, circle
    from mechwright.geometry.segments import Point
    from mechwright.pipeline import Blank, Build, Feedstock, FileName, Inspection, Page, RawStock, Wanted
    from mechwright.pipeline.process import Process
    from mechwright.plugins.hookspecs import hookimpl
    from mechwright.plugins.host import Host, host
    from mechwright.scripting.mechanism import Mechanism
    from mechwright.scripting.opening import check, design, load
    from mechwright.scripting.performing import Written
    from mechwright.scripting.synthesis import Found, synthesize
    from mechwright.studies.scripts import Sweep, sweep
    from mechwright.tolerances import TOLERANCES

_HOMES = {
    "mechwright.arrays": "Array",
    "mechwright.pipeline": "Blank Build Feedstock FileName Inspection Page RawStock Wanted",
    "mechwright.pipeline.process": "Process",
    "mechwright.cli.command": "Command",
    "mechwright.contracts.as_made": "AsMade MadeCurve MadeFigure",
    "mechwright.contracts.axial_stack": "AxialStack Shimming StackLength",
    "mechwright.contracts.bought": "Bought",
    "mechwright.contracts.design_rule": "DesignRule",
    "mechwright.contracts.procedure": "Note Procedure",
    "mechwright.contracts.design_table": "DesignTable",
    "mechwright.contracts.details": "Chamfer Detail Engraving Thread",
    "mechwright.contracts.fitting_marks": "FittingMark",
    "mechwright.contracts.evaluation": "Batch Columns",
    "mechwright.contracts.exporter": "Exporter",
    "mechwright.contracts.family": "Family",
    "mechwright.contracts.figure": "Figure PartMass scalars",
    "mechwright.contracts.finding": "Finding Findings Severity Stage at_stage of_stage refuse",
    "mechwright.contracts.made_part": "MadeHole MadePart MadeRing MadeSection",
    "mechwright.contracts.inputs": "InputFile",
    "mechwright.contracts.joint": "GROUND Joint",
    "mechwright.contracts.load": "Load",
    "mechwright.contracts.materials": "MaterialName material",
    "mechwright.contracts.measure": "Measure",
    "mechwright.contracts.motion": "Channel Curve Motion Poses Rates Scalar Trace",
    "mechwright.contracts.mounting": "Flange Foot GroundPlate Hub Mounting MountingError Spindle",
    "mechwright.contracts.on_plates": "GuideSize Post Slideway",
    "mechwright.contracts.named": "Named",
    "mechwright.contracts.parameters": "FIRST FITTED GIVEN Parameters kept",
    "mechwright.contracts.part": "Bore Colour Feature Instance OpenProfile Part Pocket Profile",
    "mechwright.contracts.plugin": "HOOK_API Plugin",
    "mechwright.contracts.refused": "RefusedError",
    "mechwright.contracts.result": "Result",
    "mechwright.contracts.rule_list": "Rules all_of in_turn",
    "mechwright.contracts.standing": "Standing",
    "mechwright.contracts.synthesis": "Candidate Progress Reason Rejected Synthesis",
    "mechwright.contracts.table": "Table",
    "mechwright.contracts.target": "Target point_targets",
    "mechwright.contracts.tolerance_settings": "Tolerances",
    "mechwright.contracts.tolerances": "Contributor Output ToleranceModel Zone",
    "mechwright.contracts.turned": "Groove KeySeat Length Step Turned",
    "mechwright.contracts.transmission": "Index Port Transmission",
    "mechwright.contracts.turning": "Turning",
    "mechwright.designs.design": "Design",
    "mechwright.errors": (
        "DesignError GeometryError KinematicsError MechwrightError OutputError PluginError ProgramError "
        "ProofError ToolError"
    ),
    "mechwright.geometry": "Arc BSpline Line Loop Outline Segment circle",
    "mechwright.geometry.segments": "Point",
    "mechwright.plugins.host": "Host host",
    "mechwright.plugins.hookspecs": "hookimpl",
    "mechwright.scripting.mechanism": "Mechanism",
    "mechwright.scripting.opening": "check design load",
    "mechwright.scripting.performing": "Written",
    "mechwright.scripting.synthesis": "Found synthesize",
    "mechwright.studies.scripts": "Sweep sweep",
    "mechwright.tolerances": "TOLERANCES",
}
"""Module to the public names that come from it."""

_HOME = {name: module for module, names in _HOMES.items() for name in names.split()}

__all__ = ["HOOK_API", "Host", "Plugin", "__version__", "hookimpl", "host"]
__all__ += ["Found", "Mechanism", "Named", "Result", "Sweep", "Written"]
__all__ += ["check", "design", "load", "sweep", "synthesize"]
__all__ += [
    "Command",
    "Exporter",
    "Family",
    "Feedstock",
    "FileName",
    "Inspection",
    "Page",
    "Process",
    "RawStock",
    "Standing",
    "Table",
]
__all__ += ["FIRST", "FITTED", "GIVEN", "InputFile", "MaterialName", "Parameters", "material"]
__all__ += [
    "GROUND",
    "Array",
    "Channel",
    "Curve",
    "Joint",
    "Load",
    "Motion",
    "Poses",
    "Rates",
    "Scalar",
    "Trace",
]
__all__ += ["Arc", "BSpline", "Line", "Loop", "Outline", "Point", "Segment", "circle"]
__all__ += ["Bore", "Colour", "Feature", "Instance", "OpenProfile", "Part", "Pocket", "Profile"]
__all__ += ["Chamfer", "Detail", "Engraving", "Thread"]
__all__ += [
    "FittingMark",
    "Flange",
    "Foot",
    "GroundPlate",
    "GuideSize",
    "Hub",
    "Measure",
    "Mounting",
    "MountingError",
    "Post",
    "Slideway",
    "Spindle",
]
__all__ += [
    "AxialStack",
    "Bought",
    "Groove",
    "KeySeat",
    "Length",
    "Shimming",
    "StackLength",
    "Step",
    "Turned",
]
__all__ += [
    "Finding",
    "Findings",
    "Severity",
    "Stage",
    "at_stage",
    "kept",
    "of_stage",
    "refuse",
]
__all__ += ["DesignRule", "DesignTable", "Figure", "Note", "PartMass", "Procedure", "Rules"]
__all__ += ["Batch", "Columns", "all_of", "in_turn", "scalars"]
__all__ += ["Index", "Port", "Transmission", "Turning"]
__all__ += ["Candidate", "Progress", "Reason", "Rejected", "Synthesis", "Target", "point_targets"]
__all__ += ["Blank", "Build", "Design", "Wanted"]
__all__ += ["DesignError", "GeometryError", "KinematicsError", "MechwrightError", "OutputError"]
__all__ += ["PluginError", "ProgramError", "ProofError", "RefusedError", "ToolError"]
__all__ += ["TOLERANCES", "Contributor", "Output", "ToleranceModel", "Tolerances", "Zone"]
__all__ += ["AsMade", "MadeCurve", "MadeFigure", "MadeHole", "MadePart", "MadeRing", "MadeSection"]


def __getattr__(name: str) -> "Any":
    if name not in _HOME:
        raise AttributeError(f"module 'mechwright' has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__

"""The rules behind the family contract: each function lists what breaks its rule, nothing if all is well."""

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.motion import TIME, Motion
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Bore, Part, Pocket, Profile, is_outside
from mechwright.geometry import Outline
from mechwright.tolerances import TOLERANCES
from mechwright.units import kind

_CODE = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*(\.[a-z0-9]+(-[a-z0-9]+)*)+")
_LEAST = {"minimum", "exclusiveMinimum"}
_GREATEST = {"maximum", "exclusiveMaximum"}
_CHANNEL = re.compile(r"[A-Za-z][A-Za-z0-9_'.-]*")


def schema_faults(params: type[Parameters]) -> list[str]:
    """Fields without a description, and numbers without bounds or a known unit, in nested tables as well."""
    schema = model_schema(params)
    found = []
    for table, where in _tables(schema):
        for name, field in table.get("properties", {}).items():
            path = f"{where}{name}"
            # A table that is described elsewhere in the schema has a reference there and nothing beside it.
            described = schema["$defs"][field["$ref"].rpartition("/")[2]] if "$ref" in field else field
            if not str(described.get("description", "")).strip():
                found.append(f"{path} has no description")
            for number in _numbers(field):
                if not _LEAST & number.keys():
                    found.append(f"{path} has no least value")
                if not _GREATEST & number.keys():
                    found.append(f"{path} has no greatest value")
                if "unit" in number:
                    found += unit_faults(number["unit"], path)
                elif number["type"] == "number":
                    found.append(f"{path} has no unit; use a type of mechwright.units")
    return found


def _tables(schema: Mapping[str, Any]) -> Iterator[tuple[Mapping[str, Any], str]]:
    yield schema, ""
    for name, table in schema.get("$defs", {}).items():
        yield table, f"{name}."


def _numbers(node: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """The nodes of a field's schema that take a number; tables it refers to are looked at by themselves."""
    if node.get("type") in {"number", "integer"} and not {"enum", "const"} & node.keys():
        yield node
    for key in ("anyOf", "oneOf", "allOf", "prefixItems"):
        for inner in node.get(key, ()):
            yield from _numbers(inner)
    for key in ("items", "additionalProperties"):
        if isinstance(node.get(key), Mapping):
            yield from _numbers(node[key])


def has_parameter(params: type[Parameters], path: str) -> bool:
    """Whether a dotted path leads to a field: of the parameters, or of the table ``[cam]``."""
    head, _, rest = path.partition(".")
    if head == "cam":
        return bool(rest)
    field = params.model_fields.get(head)
    if field is None or not rest:
        return field is not None
    inner = field.annotation
    return isinstance(inner, type) and issubclass(inner, Parameters) and has_parameter(inner, rest)


def unit_faults(unit: str, where: str) -> list[str]:
    """A unit that does not exist."""
    try:
        kind(unit)
    except ValueError:
        return [f"{where}: unit {unit!r} is not known"]
    return []


def is_rate(rate: str, quantity: str) -> bool:
    """Whether the unit ``rate`` is ``quantity`` per second.

    >>> is_rate("mm/s^2", "mm/s"), is_rate("rad/s", "rad"), is_rate("mm", "mm/s")
    (True, True, False)
    """
    # A pure number in the numerator has no symbol to write.
    return kind(rate) == kind(f"{quantity or '1'}/s")


def finding_faults(finding: Finding, params: type[Parameters]) -> list[str]:
    """A finding that a person or a program could not use."""
    where, found = f"finding {finding.code!r}", []
    if not _CODE.fullmatch(finding.code):
        found.append(f"{where}: a code is lower-case words with dots, such as 'gear.undercut'")
    if not finding.message.strip() or "\n" in finding.message + finding.remedy:
        found.append(f"{where}: the message is one line, not {finding.message!r}")
    if finding.severity is not Severity.NOTE and not (finding.remedy.strip() and finding.parameter):
        found.append(f"{where}: an {finding.severity} names a parameter and says what to do")
    if finding.parameter and not has_parameter(params, finding.parameter):
        found.append(f"{where}: there is no parameter {finding.parameter!r}")
    found += unit_faults(finding.unit, where)
    try:
        json.dumps(finding.as_dict(), allow_nan=False)
    except (TypeError, ValueError) as error:
        found.append(f"{where}: cannot be written as JSON: {error}")
    return found


def motion_faults(motion: Motion) -> list[str]:
    """Channels and scalars that cannot be printed or computed with."""
    found = _input_faults(motion)
    for name, channel in motion.channels.items():
        where = f"channel {name}"
        if not _CHANNEL.fullmatch(name):
            found.append(f"{where}: a name is letters, digits, - and _, a letter first")
        if channel.values.dtype != np.float64:
            found.append(f"{where}: values are {channel.values.dtype}, not float64")
        found += unit_faults(channel.unit, where)
    for name, scalar in motion.scalars.items():
        found += unit_faults(scalar.unit, f"scalar {name}")
    return found


def _input_faults(motion: Motion) -> list[str]:
    """An input that goes neither one way nor there and back, or a lever's without a time that goes on."""
    where, values = f"input {motion.input_name}", motion.channels[motion.input_name].values
    steps = np.sign(np.diff(values))
    if not motion.rocks:
        still = np.flatnonzero(steps == 0)
        return [f"{where}: neither rising nor falling from sample {still[0]} on"] if still.size else []
    turns = np.flatnonzero(np.diff(steps[steps != 0]))
    if turns.size > 1:
        return [
            f"{where}: goes back more than once, first after sample {turns[0]}; one way and back is a period"
        ]
    time = motion.channels.get(TIME)
    if time is None or time.unit != "s" or not (np.diff(time.values) > 0).all():
        return [f"{where}: goes there and back, which needs a channel {TIME} [s] that goes on all along"]
    return []


def outline_faults(part: Part) -> list[str]:
    """An outline that holds no material or is further from the exact curve than it may be.

    Raises GeometryError for one that cuts itself.
    """
    if part.outline is None:
        return []
    found = []
    if not part.outline.polygon().area > 0:
        found.append(f"part {part.name} has no area")
    if not 0 <= part.outline.deviation <= TOLERANCES.outline:
        found.append(
            f"part {part.name}: deviation {part.outline.deviation:g} mm, limit {TOLERANCES.outline:g} mm"
        )
    return found


def feature_faults(part: Part) -> list[str]:
    """Features that reach out of the plate, share a name, or do not leave the outline."""
    if part.outline is None:
        return []
    names = [feature.name for feature in part.features]
    found = [] if len(set(names)) == len(names) else [f"part {part.name}: feature names {names}"]
    for feature in part.features:
        where = f"feature {feature.name} of part {part.name}"
        if not (feature.top >= 0 and feature.depth > 0):
            found.append(f"{where}: top {feature.top} mm, depth {feature.depth} mm")
        if feature.top + feature.depth > part.thickness + TOLERANCES.closure:
            found.append(f"{where} is deeper than the plate of {part.thickness:g} mm")
        if isinstance(feature, Bore) and not feature.diameter > 0:
            found.append(f"{where}: diameter {feature.diameter} mm")
    return found or _left_over(part, part.outline)


def _left_over(part: Part, outline: Outline) -> list[str]:
    """Compare what the through features leave with the outline."""
    import shapely

    left = shapely.union_all(
        [shapely.Polygon(feature.loop.flatten()) for feature in part.features if is_outside(feature)]
    )
    for feature in part.features:
        if feature.top + feature.depth < part.thickness - TOLERANCES.closure:
            continue
        match feature:
            case Bore():
                # 512 chords: 2e-5 of the radius off.
                opening = shapely.Point(feature.centre).buffer(feature.diameter / 2, quad_segs=128)
            case Pocket():
                islands = [loop.flatten() for loop in feature.islands]
                opening = shapely.Polygon(feature.boundary.flatten(), islands)
            case Profile(side="inside"):
                opening = shapely.Polygon(feature.loop.flatten())
            case _:
                continue
        left = left.difference(opening)
    target = outline.polygon()
    # Either side is within its chord error all along the boundary; twice that for bores and for rounding.
    allowed = 4 * TOLERANCES.flatten * target.length
    wrong = left.symmetric_difference(target).area
    if wrong > allowed:
        return [
            f"part {part.name}: features and outline differ by {wrong:.4g} mm², {allowed:.4g} mm² is rounding"
        ]
    return []

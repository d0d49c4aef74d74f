"""Mechanisms as pylinkage saves them: joints in their drawn position, and links by their joints.

A joint is ``ground``, ``revolute``, ``prismatic`` or ``tracker``; one that a motor stands on, or that is of a
link of the ground, is fixed whatever its type says. A prismatic joint slides along its axis on the ground. A
tracker is a point of the link that has both of its reference joints.
"""

import json
import math
from collections.abc import Mapping
from typing import Any

from mechwright import DesignError
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright_linkage.formats.drawing import Drawing, name_of

_DRIVERS = ("driver", "arc_driver")


def read(text: str, source: str) -> Drawing:
    """The linkage of a file; raises DesignError for a file of another kind, or one that is broken."""
    try:
        content = json.loads(text)
        joints = {str(one["id"]): one for one in content["joints"]}
        links = [one for one in content["links"] if isinstance(one["joints"], list)]
        return _drawing(joints, links, content, source)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise DesignError(
            f"{source}: it is no mechanism of pylinkage, which has joints with id, type and position and "
            f"links with id, type and joints ({type(error).__name__}: {error})"
        ) from error


def _drawing(
    joints: Mapping[str, Mapping[str, Any]], links: list[Mapping[str, Any]], content: Any, source: str
) -> Drawing:
    found, names = Drawing(), dict[str, str]()
    for key, joint in joints.items():
        if joint["type"] == "tracker":
            continue
        x, y = (float(value) for value in joint["position"])
        names[key] = name_of(str(joint.get("name") or key), found.points, f"P{len(names) + 1}")
        found.points[names[key]] = (x, y)
    still = {key for key, joint in joints.items() if joint["type"] == "ground"}
    still |= {str(link["motor_joint"]) for link in links if link["type"] in _DRIVERS}
    still |= {str(key) for link in links if link["type"] == "ground" for key in link["joints"]}
    for key in joints:
        if key in still and key in names:
            found.add(names[key], GROUND)
    for link in links:
        if link["type"] == "ground":
            continue
        name = name_of(str(link.get("name") or link["id"]), found.links, f"link{len(found.links)}")
        for key in link["joints"]:
            found.add(names[str(key)], name)
        if link["type"] in _DRIVERS:
            if found.driver:
                raise DesignError(f"{source}: {found.driver} and {name} are both drivers; keep one")
            found.driver = name
    _sliders(found, joints, names)
    _trackers(found, joints, names, source)
    if not content.get("ground") and GROUND not in found.links:
        raise KeyError("ground")
    return found


def _sliders(found: Drawing, joints: Mapping[str, Mapping[str, Any]], names: Mapping[str, str]) -> None:
    for key, joint in joints.items():
        if joint["type"] == "prismatic":
            along = math.degrees(math.atan2(float(joint["axis"][1]), float(joint["axis"][0])))
            block = name_of(f"slider_{names[key]}", found.links, "slider")
            found.add(names[key], block)
            found.slide(names[key], block, GROUND, along)


def _trackers(
    found: Drawing, joints: Mapping[str, Mapping[str, Any]], names: Mapping[str, str], source: str
) -> None:
    for key, joint in joints.items():
        if joint["type"] != "tracker":
            continue
        one, two = (names[str(joint[f"ref_joint{number}_id"])] for number in (1, 2))
        link = next((name for name, own in found.links.items() if {one, two} <= set(own)), None)
        if link is None:
            raise DesignError(
                f"{source}: the tracker {key} refers to {one} and {two}, which are on no one link"
            )
        (x, y), (u, v) = found.points[one], found.points[two]
        angle = math.atan2(v - y, u - x) + float(joint["angle"])
        name = name_of(str(joint.get("name") or key), found.points, "T")
        distance = float(joint["distance"])
        found.points[name] = x + distance * math.cos(angle), y + distance * math.sin(angle)
        found.add(name, link)

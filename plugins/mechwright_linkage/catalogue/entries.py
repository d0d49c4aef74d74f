"""The linkages that have a name."""

from collections.abc import Mapping

from mechwright_linkage.catalogue.entry import Entry
from mechwright_linkage.catalogue.legs import Jansen, Klann
from mechwright_linkage.catalogue.parallels import Pantograph, ParallelGuide
from mechwright_linkage.catalogue.quick_return import CrankShaper, Whitworth
from mechwright_linkage.catalogue.six_bars import StephensonOne, StephensonThree, WattOne, WattTwo
from mechwright_linkage.catalogue.slides import ScissorLift, ScotchYoke, TogglePress
from mechwright_linkage.catalogue.stephenson_two import StephensonTwo
from mechwright_linkage.catalogue.straight_lines import Chebyshev, Hoecken, Peaucellier, Roberts, WattLine
from mechwright_linkage.catalogue.wipers import Wiper

ENTRIES: Mapping[str, type[Entry]] = {
    "watt-1": WattOne,
    "watt-2": WattTwo,
    "stephenson-1": StephensonOne,
    "stephenson-2": StephensonTwo,
    "stephenson-3": StephensonThree,
    "whitworth": Whitworth,
    "crank-shaper": CrankShaper,
    "scotch-yoke": ScotchYoke,
    "pantograph": Pantograph,
    "parallel-guide": ParallelGuide,
    "peaucellier": Peaucellier,
    "hoecken": Hoecken,
    "chebyshev": Chebyshev,
    "roberts": Roberts,
    "watt-line": WattLine,
    "jansen": Jansen,
    "klann": Klann,
    "toggle-press": TogglePress,
    "wiper": Wiper,
    "scissor-lift": ScissorLift,
}
"""Name, as a design file gives it, to its class."""

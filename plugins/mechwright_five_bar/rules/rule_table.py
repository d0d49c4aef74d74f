"""The rules of a five-bar, in the order in which they are asked, and the figures worth knowing."""

from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright_five_bar.rules.clamps import CLAMPS, ORDER, POSE
from mechwright_five_bar.rules.gears import GEARS, GEARS_NOTE
from mechwright_five_bar.rules.layers import LAYERS, LAYERS_NOTES
from mechwright_five_bar.rules.motion import MOTION_NOTE, RUNS
from mechwright_five_bar.rules.room import ROOM
from mechwright_five_bar.rules.strength import BEARINGS, ROOT
from mechwright_five_bar.table import FiveBarTable

SHAPES: Rules[FiveBarTable] = in_turn(RUNS, GEARS, GEARS_NOTE, ROOM, LAYERS, LAYERS_NOTES, MOTION_NOTE)
"""Of motion and shapes, before any load."""

DESIGN = in_turn(SHAPES, BEARINGS, ROOT, CLAMPS)
"""Of a design that shows its first phase; no error among them means that its parts can be made."""

RULES = in_turn(POSE, all_of(DESIGN, ORDER))

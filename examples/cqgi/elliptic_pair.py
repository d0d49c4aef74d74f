"""A pair of elliptic gears for CQ-editor, and for anything else that runs CQGI scripts.

What is assigned here is what CQGI takes for parameters; ``show_object`` is given by whoever runs the script.
"""

import mechwright as mw

eccentricity = 0.4
teeth = 25
thickness = 10.0
crank_angle = 0.0

pair = mw.design("elliptic-gears", eccentricity=eccentricity, teeth=teeth, thickness=thickness)
pair = pair.asked(at=f"{crank_angle} deg")
show_object(pair.assembly, name="elliptic pair")  # noqa: F821 - given by CQGI

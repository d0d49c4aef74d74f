"""The proof: a program text is read back, simulated against the part, and judged before it is written.

Nothing here uses what planned or posted the program: an error there must not hide itself here. That is why
small helpers such as the closing of a polygon exist in both places.
"""

from mechwright_cam.proof.carried import cut_away
from mechwright_cam.proof.prove import prove, read
from mechwright_cam.proof.report import Check, OperationTime, Proof, Spot

__all__ = ["Check", "OperationTime", "Proof", "Spot", "cut_away", "prove", "read"]

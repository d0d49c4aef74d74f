"""All solutions of equations with parameters: loops, paths, certificates.

Glossary
--------
parameters of the equations
    What is asked for, such as places of points. Equations have the same number of solutions, counted over the
    complex numbers, at almost all parameters.
loop, monodromy
    Parameters that move and come back lead a solution to another one. Loops that bring nothing new for long
    have found all that one irreducible set of solutions has.
path
    A solution while the parameters move on a straight line from complex ones, where all solutions are known,
    to those that are asked for. A straight line from parameters in general position meets no singular ones.
certificate
    A box that is proven, in ball arithmetic, to hold one solution, one alone.
"""

from mechwright.mechanics.continuation.complete import Proven, Solutions, Start, all_solutions, read
from mechwright.mechanics.continuation.loops import closed
from mechwright.mechanics.continuation.system import Balls, System

__all__ = ["Balls", "Proven", "Solutions", "Start", "System", "all_solutions", "closed", "read"]
